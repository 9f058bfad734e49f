# SPDX-License-Identifier: BSD-3-Clause
"""In the real GUI, beside a scan that is large and far away: a new source starts on top of it, an eighth of its size.
(gui_session.py has the defaults, beside nothing and beside a model of their own size.)
"""
import json
import os
import sys
import tempfile

import gui_session
import plugin
import proxies

CENTER, RADIUS = (1000.0, -300.0, 50.0), 200.0
SOURCES = sorted(name for name, group in plugin.PROXIES.items() if group == "sources")
ROUND = 100.0  # an eighth of the diagonal is 87


def numbers(source):
    return {key: value for key, value in source.items() if key not in ("kind", "drawn", "bounds")}


def is_point(key):
    return key in ("Center", "Origin", "Points", "Point1", "Point2", "Point3")


def is_length(key):
    return key == "Lengths" or "Radi" in key


def placed(name, default):
    """The source is the default one, scaled by one round number and moved."""

    def check(pipeline, _):
        source = pipeline[name + "1"]
        found = numbers(source)
        top = (CENTER[0], CENTER[1] + RADIUS, CENTER[2])
        scales = [now / before for key in default if is_length(key)
            for now, before in zip(found[key], default[key]) if before]
        assert scales and max(scales) - min(scales) < 1e-9 * max(scales), (name, scales)
        scale = scales[0]
        assert abs(scale / ROUND - 1) < 1e-9, (name, scale)
        for key, before in default.items():
            if is_point(key):
                moved = [now - scale * old for now, old in zip(found[key], before)]
                near = [abs(value - top[k % 3]) <= 0.05001 * scale for k, value in enumerate(moved)]
                assert all(near), (name, key, found[key], top)
            elif not is_length(key):
                assert found[key] == before, (name, key, found[key], before)
        if source["drawn"]:
            low, high = source["bounds"][0::2], source["bounds"][1::2]
            assert all(a - 3 * scale < value < b + 3 * scale for a, value, b in zip(low, top, high)), source["bounds"]

    return check


def defaults(name):
    """As gui_recorder writes them down."""
    proxy = plugin.new_proxy(name)
    return {key: [prop.GetElement(k) for k in range(prop.GetNumberOfElements())]
        for key, prop in proxies.properties(proxy) if prop.IsA("vtkSMVectorProperty")
        and not proxies.is_input(prop) and not prop.GetIsInternal()}


def main():
    with tempfile.TemporaryDirectory() as home:
        session = gui_session.Session(os.path.join(home, "session.pvsm"))
        for name in SOURCES:
            session.source(name)
            session.expect(placed(name, defaults(name)))
            session.delete()
        session.source(SOURCES[0])
        session.undo(2)
        session.redo(2)
        session.expect(placed(SOURCES[0], defaults(SOURCES[0])))
        output = gui_session.play(session, sys.argv[1], home, HYBRIDTREE_SCAN=json.dumps([CENTER, RADIUS]))
        for sign in ("ERR|", "WARN|"):
            assert sign not in output, output
        with open(os.path.join(home, "records")) as file:
            records = [json.loads(line) for line in file]
    assert len(records) == len(session.checks), f"{len(records)} records, {len(session.checks)} expected\n{output}"
    for record, check in zip(records, session.checks):
        check(record, records)
    print(f"{len(SOURCES)} sources placed")


if __name__ == "__main__":
    main()

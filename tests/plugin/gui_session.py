# SPDX-License-Identifier: BSD-3-Clause
"""A session of clicks in the real ParaView GUI: draw a skeleton, create, apply, undo, redo, copy and paste, drag,
change the input, delete, save and reload a state. ParaView's own event player clicks; each step waits for the one before.
"""
import json
import os
import sys
import tempfile
from xml.sax.saxutils import quoteattr

import screen

FOLDER = os.path.dirname(os.path.abspath(__file__))
WINDOW = "pqClientMainWindow"
PANEL = WINDOW + "/propertiesDock/propertiesPanel"
PROPERTIES = PANEL + "/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents"
BROWSER = WINDOW + "/pipelineBrowserDock/pipelineBrowser"
VIEW = (WINDOW + "/centralwidget/MultiViewWidget/CoreWidget/qt_tabwidget_stackedwidget/MultiViewWidget1"
    "/Container/Frame.0/CentralWidgetFrame/Viewport")
LEFT, CTRL = 1, 0x04000000


class Session:
    """Events for ParaView's player, and what is expected at each record: a function of the recorded pipeline."""

    def __init__(self, state):
        self.state = state
        self.events = []
        self.checks = []

    def event(self, target, command, arguments=""):
        values = (quoteattr(value) for value in (target, command, arguments))
        self.events.append("  <pqevent object=%s command=%s arguments=%s />" % tuple(values))

    def menu(self, menu, action):
        self.event(f"{WINDOW}/menubar/{menu}", "activate", action)

    def source(self, name):
        self.menu("menuSources/HybridTree", name)
        self.apply()

    def filter(self, name):
        self.menu("menuFilters/HybridTree", name)
        self.apply()

    def apply(self):
        self.event(PANEL + "/Accept", "activate")

    def delete(self):
        self.event(PANEL + "/Delete", "activate")

    def undo(self, times=1):
        for _ in range(times):
            self.event(WINDOW + "/MainControlsToolbar/actionUndo", "activate")

    def redo(self, times=1):
        for _ in range(times):
            self.event(WINDOW + "/MainControlsToolbar/actionRedo", "activate")

    def type(self, widget, text):
        self.event(f"{PROPERTIES}/PropertiesFrame/ProxyPanel/{widget}", "set_string", text)

    def pick(self, tree, *rows):
        """Click on rows of a tree, with Control from the second on."""
        for index, row in enumerate(rows):
            keys = CTRL if index else 0
            self.event(tree, "mousePress", f"{LEFT},{LEFT},{keys},64,8,{row}")
            self.event(tree, "mouseRelease", f"{LEFT},0,{keys},64,8,{row}")

    def toggle_eye(self, row):
        self.event(BROWSER, "mousePress", f"{LEFT},{LEFT},0,8,8,{row}")
        self.event(BROWSER, "mouseRelease", f"{LEFT},0,0,8,8,{row}")

    def mouse(self, what, x, y, button=0, buttons=0):
        self.event(VIEW, what, f"({x},{y},{button},{buttons},0)")

    def drag(self, x0, y0, x1, y1):
        """Across the view; coordinates are shares of its size."""
        self.mouse("mouseMove", x0, y0)
        self.mouse("mousePress", x0, y0, LEFT, LEFT)
        for step in (0.25, 0.5, 0.75, 1):
            self.mouse("mouseMove", x0 + step * (x1 - x0), y0 + step * (y1 - y0), 0, LEFT)
        self.mouse("mouseRelease", x1, y1, LEFT, 0)

    def expect(self, check):
        """Has gui_recorder write the pipeline down; check(pipeline, records before) is for after the session.
        Returns the number of the record."""
        self.mouse("mouseMove", 0.001, 0.5)
        self.mouse("mouseMove", 0.02, 0.5)
        self.checks.append(check)
        return len(self.checks) - 1

    def expect_by_shell(self, check):
        """As expect, where the view is not the one that is watched."""
        self.menu("menu_View", "Python Shell")
        self.event(WINDOW + "/pythonShellDock/pythonShell/consoleWidget", "executeCommand",
            f"import sys; sys.path.insert(0, {FOLDER!r}); import gui_recorder; gui_recorder.record()")
        self.checks.append(check)


def kinds(pipeline):
    return sorted(source["kind"][len("HybridTree"):] for source in pipeline.values())


def names(*expected):
    def check(pipeline, _):
        assert sorted(pipeline) == sorted("HybridTree" + name for name in expected), sorted(pipeline)
        assert all(source["drawn"] is None or source["drawn"] > 100 for source in pipeline.values()), pipeline

    return check


def drawn(*expected):
    def check(pipeline, _):
        found = [name for name, source in pipeline.items() if (source["drawn"] or 0) > 100]
        assert sorted(found) == sorted("HybridTree" + name for name in expected), found

    return check


def value(name, key, expected):
    def check(pipeline, _):
        found = pipeline["HybridTree" + name][key]
        assert found == expected, f"{name}.{key} is {found}, not {expected}"

    return check


def same_as(index):
    def check(pipeline, records):
        assert pipeline == records[index], (pipeline, records[index])

    return check


def draw_skeleton(session):
    """Drags a point of the Skeleton Editor; the surface on top of it follows."""
    session.source("HybridTreeSkeletonEditor")
    session.event(WINDOW + "/cameraToolbar/actionResetCamera", "activate")
    session.filter("HybridTreeSubdivisionSkeleton")
    session.expect(lambda pipeline, _: pipeline["HybridTreeSubdivisionSkeleton1"]["drawn"] > 1000)
    session.pick(BROWSER, "/0:0/0:0")
    # ParaView took the handles away when it hid the editor under the surface.
    session.event(f"{PROPERTIES}/PropertiesFrame/ProxyPanel/InteractivePolyLine/show3DWidget", "set_boolean", "true")
    session.drag(0.4907, 0.5, 0.4907, 0.3)  # point 2, 0.05 to the left of the middle of what there is to see
    session.apply()

    def followed(pipeline, records):
        start = records[0]["HybridTreeSkeletonEditor1"]["Points"]
        points = pipeline["HybridTreeSkeletonEditor1"]["Points"]
        moved = [k for k in range(6) if points[3 * k:3 * k + 3] != start[3 * k:3 * k + 3]]
        assert moved == [2] and points[7] > 0.4, (moved, points)
        before, after = (p["HybridTreeSubdivisionSkeleton1"]["bounds"] for p in (records[0], pipeline))
        assert after[3] > before[3] + 0.05, (before, after)

    session.expect(followed)
    session.undo()
    session.expect(same_as(0))
    session.pick(BROWSER, "/0:0/0:0/0:0/0:0")  # below the editor's first output
    session.delete()
    session.pick(BROWSER, "/0:0/0:0")
    session.delete()
    session.expect(lambda pipeline, _: kinds(pipeline) == [])


def drag_corner(session):
    session.source("HybridTreeTriangle")
    session.event(WINDOW + "/cameraToolbar/actionResetCamera", "activate")
    session.drag(0.5, 0.217, 0.65, 0.117)  # the upper corner of the default triangle
    session.apply()

    def moved(pipeline, _):
        triangle = pipeline["HybridTreeTriangle1"]
        assert triangle["Point1"] == [-0.5, -0.5, 0] and triangle["Point2"] == [0.5, -0.5, 0], triangle
        assert triangle["Point3"][0] > 0.2 and triangle["Point3"][1] > 0.6, triangle
        assert triangle["bounds"][3] > 0.7, triangle

    session.expect(moved)
    session.delete()


def create(session):
    session.source("HybridTreePoint")
    session.expect(names("Point1"))
    session.source("HybridTreeSegment")
    session.expect(names("Point1", "Segment1"))
    session.pick(BROWSER, "/0:0/0:0", "/0:0/1:0")
    session.filter("HybridTreeBlend")
    session.expect(value("Blend1", "Input", ["HybridTreePoint1", "HybridTreeSegment1"]))
    session.created = session.expect(names("Point1", "Segment1", "Blend1"))
    session.expect(drawn("Blend1"))


def undo_creation(session):
    """Apply and creation are a step each."""
    session.undo(2)
    session.expect(names("Point1", "Segment1"))
    session.undo(4)
    session.expect(lambda pipeline, _: kinds(pipeline) == [])
    session.redo(6)
    session.expect(same_as(session.created))


def undo_property(session):
    session.pick(BROWSER, "/0:0/0:0")
    session.type("InteractiveSphere/radius", "0.7")
    session.apply()
    session.expect(value("Point1", "SurfaceRadius", [0.7]))

    def blend_followed(pipeline, records):
        assert pipeline["HybridTreeBlend1"]["drawn"] != records[session.created]["HybridTreeBlend1"]["drawn"]

    session.expect(blend_followed)
    session.undo()
    session.expect(same_as(session.created))
    session.redo()
    session.expect(value("Point1", "SurfaceRadius", [0.7]))
    # The point has handed only its tree on since; it is meshed as soon as it is looked at.
    session.toggle_eye("/0:0/0:1")
    session.expect(drawn("Point1", "Blend1"))
    session.toggle_eye("/0:0/0:1")


def copy_and_paste(session):
    session.event(PROPERTIES + "/PropertiesButtons/PropertiesCopy", "activate")
    session.source("HybridTreePoint")
    session.expect(value("Point2", "SurfaceRadius", [0.5]))
    session.event(PROPERTIES + "/PropertiesButtons/PropertiesPaste", "activate")
    session.apply()
    session.expect(value("Point2", "SurfaceRadius", [0.7]))


def drag_widget(session):
    session.event(WINDOW + "/cameraToolbar/actionResetCamera", "activate")
    session.drag(0.5, 0.5, 0.6, 0.4)
    session.apply()

    def moved(pipeline, _):
        x, y, z = pipeline["HybridTreePoint2"]["Center"]
        assert x > 0.05 and y > 0.05 and abs(z) < 1e-6, (x, y, z)

    session.expect(moved)
    session.undo()
    session.expect(value("Point2", "Center", [0, 0, 0]))


def change_input(session):
    session.filter("HybridTreeTwist")
    session.expect(value("Twist1", "Input", ["HybridTreePoint2"]))
    session.menu("menu_Edit", "actionChangeInput")
    session.pick(WINDOW + "/ChangeInputDialog/pipelineView", "/0:0/1:0")
    session.event(WINDOW + "/ChangeInputDialog/buttonBox/1QPushButton0", "activate")
    session.apply()
    session.expect(value("Twist1", "Input", ["HybridTreeSegment1"]))


def delete(session):
    session.pick(BROWSER, "/0:0/0:0")
    session.pick(BROWSER, "/0:0/1:0/1:0")
    session.delete()
    session.expect(names("Point1", "Segment1", "Blend1", "Point2"))
    session.undo()
    session.expect(value("Twist1", "Input", ["HybridTreeSegment1"]))


def reload_state(session):
    index = len(session.checks) - 1
    session.menu("menu_File", "actionFileSaveServerState")
    session.event(WINDOW + "/FileSaveServerStateDialog", "filesSelected", session.state)
    session.menu("menu_Edit", "actionDelete_All")
    session.expect_by_shell(lambda pipeline, _: kinds(pipeline) == [])
    session.menu("menu_File", "actionFileLoadServerState")
    session.event(WINDOW + "/FileLoadServerStateDialog", "filesSelected", session.state)
    session.expect_by_shell(same_as(index))


def play(session, xvfb_run, home, **variables):
    """Returns what the GUI printed."""
    events = os.path.join(home, "session.xml")
    with open(events, "w") as file:
        file.write('<?xml version="1.0" ?>\n<pqevents>\n' + "\n".join(session.events) + "\n</pqevents>\n")
    return screen.run_paraview(xvfb_run, ["--script=" + os.path.join(FOLDER, "gui_recorder.py"),
        "--test-directory=" + home, "--test-script=" + events, "--exit"], home,
        HYBRIDTREE_RECORD=os.path.join(home, "records"), **variables)


def main():
    with tempfile.TemporaryDirectory() as home:
        session = Session(os.path.join(home, "session.pvsm"))
        for part in (draw_skeleton, drag_corner, create, undo_creation, undo_property, copy_and_paste, drag_widget,
                change_input, delete, reload_state):
            part(session)
        output = play(session, sys.argv[1], home)
        for sign in ("ERR|", "WARN|"):
            assert sign not in output, output
        with open(os.path.join(home, "records")) as file:
            records = [json.loads(line) for line in file]
    assert len(records) == len(session.checks), f"{len(records)} records, {len(session.checks)} expected\n{output}"
    for index, check in enumerate(session.checks):
        assert check(records[index], records) is not False, f"step {index}: {records[index]}"
    print(f"{len(session.events)} events, {len(records)} states of the pipeline as expected")


if __name__ == "__main__":
    main()

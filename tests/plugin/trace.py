# SPDX-License-Identifier: BSD-3-Clause
"""The Python trace of a session, and its Python state, run again and give the same shape."""
import plugin
from paraview import simple, smstate, smtrace


def session():
    """A pipeline with numbers, enumerations, switches, rows and several inputs. Returns its last node."""
    ball = plugin.HybridTreePoint(registrationName="Ball", SurfaceRadius=0.6, InfluenceRadius=1.2)
    bar = plugin.HybridTreeSegment(
        registrationName="Bar", Point1=[-1, 0.2, 0], Point2=[1.2, 0.2, 0], FieldMode="By Maximum Field", MaximumField=1.5)
    groove = plugin.HybridTreeCircle(
        registrationName="Groove", Radius=0.6, SurfaceRadius=0.1, InfluenceRadius=0.3, Negative=1)
    blend = plugin.HybridTreeBlend(registrationName="Blend", Input=[ball, bar, groove], EdgeLength=0.1)
    return plugin.HybridTreeFreeFormDeformation(
        registrationName="Lattice", Input=blend, Displacements=[1, 1, 1, 0, 0.4, 0], EdgeLength=0.1)


def check_runs_again(kind, script, expected):
    for _, proxy in list(simple.GetSources().items()):
        simple.Delete(proxy)
    assert not simple.GetSources()
    names = {name: value for name, value in vars(plugin).items() if name.startswith("HybridTree")}
    exec(compile(script, kind, "exec"), names)
    last = simple.FindSource("Lattice")
    assert last, f"the {kind} makes no Lattice:\n{script}"
    found = plugin.volume(plugin.run(last))
    assert found == expected, f"volume {expected}, but {found} by the {kind}:\n{script}"
    print(f"{kind}: {len(script.splitlines())} lines, volume {found:.6f}")


def main():
    smtrace.start_trace()
    last = session()
    trace = smtrace.stop_trace()
    state = smstate.get_state()
    data = plugin.run(last)
    plugin.check_solid(data, "Lattice")
    expected = plugin.volume(data)
    del last
    check_runs_again("trace", trace, expected)
    check_runs_again("state", state, expected)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""What an update costs in ParaView while something on a scan is dragged: a ball that is blended with
it, the angle of a bend above that, one of eight regions in which balls on it are blended locally, and
beside them, as a peer, the sphere of ParaView's own Clip.

    pvpython benchmarks/drag_blend.py mesh.ply [updates, default 20]

For each the update, with what ParaView asks of every result (ranges of its arrays, bounds), and that
drawn in a view of 400 x 400; medians of the wall time and of the processor time of all threads. Needs a
display, such as that of xvfb-run.
"""
import os
import statistics
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../examples/python"))
from stage import load_plugin
from paraview.simple import *

UPDATES = int(sys.argv[2]) if len(sys.argv) > 2 else 20
globals().update(load_plugin())


def measure(name, shape, move):
    """move(k) changes one property, a little, for the k-th time."""
    view = CreateRenderView(ViewSize=[400, 400])
    move(0)
    shape.UpdatePipeline()
    triangles = shape.GetDataInformation().GetNumberOfCells()
    Show(shape, view)
    Render(view)
    updated, drawn = [], []
    for step in range(1, UPDATES + 1):
        move(step)
        wall, cpu = time.perf_counter(), time.process_time()
        shape.UpdatePipeline()
        updated.append((time.perf_counter() - wall, time.process_time() - cpu))
        Render(view)
        drawn.append((time.perf_counter() - wall, time.process_time() - cpu))
    print(f"{name:14} {triangles:9}", end="")
    for times in (updated, drawn):
        wall, cpu = (1e3 * statistics.median(values) for values in zip(*times))
        print(f" {wall:7.1f} {cpu:7.1f}", end="")
    print(flush=True)
    Delete(view)


scan = OpenDataFile(sys.argv[1])
scan.UpdatePipeline()
bounds = scan.GetDataInformation().GetBounds()
size = max(bounds[1] - bounds[0], bounds[3] - bounds[2], bounds[5] - bounds[4])
middle = [(bounds[2 * k] + bounds[2 * k + 1]) / 2 for k in range(3)]
ball = HybridTreePoint(SurfaceRadius=0.08 * size, InfluenceRadius=0.16 * size)
blend = HybridTreeBlend(Input=[scan, ball])
bend = HybridTreeBend(Input=blend, Axis=[0, 1, 0], Normal=[1, 0, 0])
points = servermanager.Fetch(scan).GetPoints()
spots = [points.GetPoint((k + 1) * points.GetNumberOfPoints() // 9) for k in range(8)]
balls = [HybridTreePoint(Center=at, SurfaceRadius=0.015 * size, InfluenceRadius=0.03 * size) for at in spots]
regions = [HybridTreePoint(Center=at, SurfaceRadius=0.02 * size, InfluenceRadius=0.04 * size) for at in spots]
local = HybridTreeLocalBlend(A=scan, B=HybridTreeBlend(Input=balls), Region=regions)
clip = Clip(Input=scan, ClipType="Sphere", Crinkleclip=0, Invert=0)
clip.ClipType.Radius = 0.12 * size


def place(step):
    return [middle[0] + 0.005 * size * (step % 10), middle[1], bounds[5]]


def beside(spot, step):
    return [spot[0] + 0.001 * size * (step % 10), spot[1], spot[2]]


print(f"{'milliseconds of':24} {'an update':>15} {'that drawn':>15}")
print(f"{'dragged':14} {'triangles':>9}" + 2 * f" {'wall':>7} {'CPU':>7}")
measure("ball of blend", blend, lambda step: setattr(ball, "Center", place(step)))
measure("angle of bend", bend, lambda step: setattr(bend, "Angle", 20.0 + 0.5 * step))
measure("local's region", local, lambda step: setattr(regions[7], "Center", beside(spots[7], step)))
measure("local's ball", local, lambda step: setattr(balls[7], "Center", beside(spots[7], step)))
measure("Clip's sphere", clip, lambda step: setattr(clip.ClipType, "Center", place(step)))

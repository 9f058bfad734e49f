# SPDX-License-Identifier: BSD-3-Clause
"""Updates a second while one vertex of the alien (15 triangles, 102 segments, level 2) is dragged,
through the filter as ParaView runs it: every blending, both kernels, the closed mesh and the preview.

    pvpython benchmarks/drag_skeleton.py [updates, default 12]

A fingertip and the chest, which reaches nearly all; medians of the wall time and of the processor time
of all threads. The first update is a cold start. Needs no display: nothing is shown.
"""
import os
import statistics
import sys
import time

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "../examples/python"))
import creature_skeletons
from stage import load_plugin
from paraview.simple import *

UPDATES = int(sys.argv[1]) if len(sys.argv) > 1 else 12
globals().update(load_plugin())


def seconds(update):
    wall, cpu = time.perf_counter(), time.process_time()
    update()
    return time.perf_counter() - wall, time.process_time() - cpu


def drag(vertex, blending, kernel, preview):
    polydata = creature_skeletons.alien().polydata()
    producer = TrivialProducer()
    producer.GetClientSideObject().SetOutput(polydata)
    shape = HybridTreeSubdivisionSkeleton(
        Input=producer, Level=2, Blending=blending, Kernel=kernel, Preview=preview)
    points = polydata.GetPoints()
    start = points.GetPoint(vertex)
    times = []
    for step in range(UPDATES + 1):
        points.SetPoint(vertex, start[0] + 0.01 * step, start[1] + 0.005 * step, start[2])
        points.Modified()
        polydata.Modified()
        producer.MarkModified(producer)
        times.append(seconds(shape.UpdatePipeline))
    triangles = shape.GetDataInformation().GetNumberOfCells()
    Delete(shape)
    Delete(producer)
    wall, cpu = (statistics.median(column) for column in zip(*times[1:]))
    return triangles, times[0], wall, cpu


def farthest(direction):
    points = creature_skeletons.alien().polydata().GetPoints()
    along = [sum(a * b for a, b in zip(points.GetPoint(k), direction)) for k in range(points.GetNumberOfPoints())]
    return along.index(max(along))


print(f"{'vertex':7} {'blending':11} {'kernel':10} {'mesh':8} triangles  cold ms   wall ms    CPU ms  updates/s")
for name, vertex in (("finger", farthest((1, 0, 0.3))), ("chest", 3)):
    for preview in (1, 0):
        for kernel in ("Polynomial", "Cauchy"):
            for blending in ("Everything", "Neighbours", "Paper"):
                triangles, cold, wall, cpu = drag(vertex, blending, kernel, preview)
                print(
                    f"{name:7} {blending:11} {kernel:10} {'preview' if preview else 'closed':8} {triangles:9} "
                    f"{1e3 * cold[0]:8.0f} {1e3 * wall:9.1f} {1e3 * cpu:9.1f} {1 / wall:10.1f}", flush=True)

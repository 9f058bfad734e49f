# SPDX-License-Identifier: BSD-3-Clause
"""A bunny with wings, after Figure 9 of the HybridTree paper: a local blend in two cylinders.

    xvfb-run -a pvpython examples/python/winged_bunny.py [output folder]

The wings are a mesh of their own, here made of spline feathers. The region of the blend is the union of a
cylinder at the root of each wing: there they grow out of the back, and nowhere else do they touch the fur.
"""
import os

from figures import *  # heads, wings, arms; paraview.simple and our helpers

folder = output_folder("winged-bunny")
view = make_view()
portrait_light(view)

start = clock()
body = HybridTreeMeshField(registrationName="body", Input=bunny(folder), InfluenceRadius=0.06)
roots = {side: (0.13, 0.12, 0.10 * side) for side in (-1, 1)}
feathers = []
for side, root in roots.items():
    # Made to the side, then turned about the upright axis: to the back of the bunny, which looks along -x.
    for curve in wing(side, (0, 0, 0), span=0.7, feathers=19):
        feathers.append([((root[0] - p[2], root[1] + p[1], root[2] + p[0]), r) for p, r in curve])
drawn = splines("wings", feathers, folder, SurfaceRadius=0.03, InfluenceRadius=0.045, EdgeLength=0.008)
wings = HybridTreeMeshField(registrationName="wings as a mesh", Input=Clean(Input=drawn), InfluenceRadius=0.06)
region = HybridTreeBoolean(
    registrationName="two cylinders", Operation="Union",
    A=HybridTreeCylinder(Point1=[0.02, 0.10, -0.08], Point2=[0.26, 0.16, -0.22], Radius=0.05, SurfaceRadius=0.03, InfluenceRadius=0.08),
    B=HybridTreeCylinder(Point1=[0.02, 0.10, 0.08], Point2=[0.26, 0.16, 0.22], Radius=0.05, SurfaceRadius=0.03, InfluenceRadius=0.08),
)
winged = HybridTreeLocalBlend(registrationName="winged bunny", A=body, B=wings, Region=region, EdgeLength=0.008)
finish(winged, "winged bunny", start, volume=(0.05, 0.6))

look(view, direction=(-0.75, 0.45, 1.0), focus=(0.10, 0.14, 0.0), distance=3.0)
picture(view, winged, os.path.join(folder, "winged-bunny.png"), colour=CLAY)

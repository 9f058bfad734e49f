# SPDX-License-Identifier: BSD-3-Clause
"""A bottle, deformed and pierced twelve times, after Figure 21 of the HybridTree paper.

    xvfb-run -a pvpython examples/python/holed_bottle.py [output folder]

The bottle of bottle.py, five primitives, leans by a free-form deformation; then one Boolean takes twelve balls
from its wall, all of them connected to its second input.
"""
import math
import os

from figures import *  # heads, wings, arms; paraview.simple and our helpers

folder = output_folder("holed-bottle")
view = make_view()
portrait_light(view)

start = clock()
bottle = HybridTreeBlend(registrationName="bottle", Input=bottle_parts(), EdgeLength=0.02)
displacements = []  # the neck leans back, towards the handle
for i in range(3):
    for k in range(3):
        displacements += [i, 3, k, 0.30, -0.02 + 0.10 * (1 - i), 0.0]
leaning = HybridTreeFreeFormDeformation(
    registrationName="leaning", Input=bottle, LatticeDimensions=[3, 4, 3], Displacements=displacements, EdgeLength=0.02
)
balls = []
for ring, (height, out, size) in enumerate(((-0.60, 0.66, 0.15), (-0.12, 0.58, 0.13))):
    for k in range(6):
        turn = math.radians(60 * k + 30 * ring + 15)
        balls.append(HybridTreePoint(
            registrationName=f"hole {6 * ring + k + 1}", Center=[out * math.cos(turn), height, out * math.sin(turn)],
            SurfaceRadius=size, InfluenceRadius=2 * size,
        ))
pierced = HybridTreeBoolean(
    registrationName="pierced", A=leaning, B=balls, Operation="Difference A - B", EdgeLength=0.02
)
finish(pierced, "holed bottle", start, volume=(0.2, 1.5))

# For the picture alone: points at the rims are doubled, so that both sides are shaded by themselves.
pierced.PointNormals = "Split"
look(view, direction=(0.35, 0.38, 1.0), focus=(0.12, -0.02, 0), distance=5.2)
picture(view, pierced, os.path.join(folder, "holed-bottle.png"), colour=CEMENT)

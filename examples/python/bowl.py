# SPDX-License-Identifier: BSD-3-Clause
"""A bowl with two handles, after Figure 20 of the HybridTree paper.

    xvfb-run -a pvpython examples/python/bowl.py [output folder]

The inside of a head is carved by a cylinder whose field is negative, then two circles become handles by a
local blend: it happens where both boxes of the region are, at the ends of each handle.
"""
import os

from figures import *  # heads, wings, arms; paraview.simple and our helpers

folder = output_folder("bowl")
view = make_view()
portrait_light(view)

start = clock()
head = HybridTreeMeshField(registrationName="head", Input=igea(folder), InfluenceRadius=0.08)
hollow = HybridTreeCylinder(
    registrationName="hollow", Point1=[0, -0.2, -0.05], Point2=[0, 0.9, -0.05], Radius=0.16, SurfaceRadius=0.06,
    InfluenceRadius=0.14, Negative=1,
)
carved = HybridTreeBlend(registrationName="carved", Input=[head, hollow], EdgeLength=0.01)
handles = HybridTreeBoolean(
    registrationName="handles", Operation="Union",
    A=HybridTreeCircle(Center=[-0.34, -0.02, -0.08], Normal=[0, 0, 1], Radius=0.2, SurfaceRadius=0.035, InfluenceRadius=0.08),
    B=HybridTreeCircle(Center=[0.34, -0.02, -0.08], Normal=[0, 0, 1], Radius=0.2, SurfaceRadius=0.035, InfluenceRadius=0.08),
)
# What of the circles lies inside of the bowl goes: the same cylinder, as a solid, cuts it away.
outside = HybridTreeBoolean(
    registrationName="handles outside", Operation="Difference A - B", A=handles,
    B=HybridTreeCylinder(Point1=[0, -0.6, -0.05], Point2=[0, 0.9, -0.05], Radius=0.2, SurfaceRadius=0.06, InfluenceRadius=0.12),
)
region = HybridTreeBox(
    registrationName="region", Center=[0, -0.02, -0.08], Lengths=[0.6, 0.5, 0.2], SurfaceRadius=0.03, InfluenceRadius=0.1
)
bowl = HybridTreeLocalBlend(registrationName="bowl", A=carved, B=outside, Region=region, EdgeLength=0.01)
finish(bowl, "bowl", start, volume=(0.02, 0.4))

look(view, direction=(0.3, 0.8, 1.0), focus=(0.02, -0.03, 0), distance=2.3)
picture(view, bowl, os.path.join(folder, "bowl.png"), colour=TERRACOTTA)

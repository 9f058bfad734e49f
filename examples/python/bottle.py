# SPDX-License-Identifier: BSD-3-Clause
"""The bottle of the HybridTree paper (Figure 4): five primitives, then warped as in its Figure 11.

    xvfb-run -a pvpython examples/python/bottle.py [output folder]

body      surface of revolution, a wall with a smooth profile
handle    spline
foot      circle
lip       circle
neck      hollow cylinder

Leaves pictures of the bottle, and of it twisted, tapered and bent, and bottle.vtp (opens as a live tree).
"""
import os

from stage import *  # paraview.simple and our helpers

folder = output_folder("bottle")
globals().update(load_plugin())
view = make_view()

body = HybridTreeSurfaceOfRevolution(
    registrationName="body", Solid=0, Axis=[0, 1, 0], SurfaceRadius=0.05, InfluenceRadius=0.14,
    Points=[0, -1, 0, 0.45, -0.97, 0, 0.62, -0.6, 0, 0.55, -0.1, 0, 0.3, 0.25, 0, 0.2, 0.5, 0],
)
handle = HybridTreeSpline(
    registrationName="handle", SurfaceRadius=0.06, InfluenceRadius=0.16,
    Points=[0.22, 0.62, 0, 0.5, 0.72, 0, 0.82, 0.5, 0, 0.85, 0.05, 0, 0.6, -0.25, 0],
)
foot = HybridTreeCircle(
    registrationName="foot", Center=[0, -1.0, 0], Normal=[0, 1, 0], Radius=0.5, SurfaceRadius=0.07, InfluenceRadius=0.18
)
lip = HybridTreeCircle(
    registrationName="lip", Center=[0, 0.95, 0], Normal=[0, 1, 0], Radius=0.24, SurfaceRadius=0.06, InfluenceRadius=0.14
)
neck = HybridTreeHollowCylinder(
    registrationName="neck", Point1=[0, 0.45, 0], Point2=[0, 0.95, 0], OuterRadius=0.22, InnerRadius=0.18,
    SurfaceRadius=0.03, InfluenceRadius=0.1,
)
EDGE = 0.02
bottle = HybridTreeBlend(registrationName="bottle", Input=[body, handle, foot, lip, neck], EdgeLength=EDGE)
CAMERA = dict(direction=(0.25, 0.45, 1.0), focus=(0.1, -0.05, 0), distance=4.6)
look(view, **CAMERA)
picture(view, bottle, os.path.join(folder, "bottle.png"), colour=GLAZE)
check_closed(bottle, "bottle")

frame = dict(Origin=[0, 0, 0], Axis=[0, 1, 0], Normal=[1, 0, 0], Range=[-1, 1], EdgeLength=EDGE)
for name, warped in (
    ("twisted", HybridTreeTwist(registrationName="twisted", Input=bottle, Angle=120, **frame)),
    ("tapered", HybridTreeTaper(registrationName="tapered", Input=bottle, Factor=0.5, **frame)),
    ("bent", HybridTreeBend(registrationName="bent", Input=bottle, Angle=50, **frame)),
):
    look(view, **CAMERA)
    picture(view, warped, os.path.join(folder, f"bottle-{name}.png"), colour=GLAZE)
    check_closed(warped, f"{name} bottle")

# Not appended: the XML parser of Debian 12 refuses to read ParaView's appended data back.
SaveData(os.path.join(folder, "bottle.vtp"), proxy=bottle, DataMode="Binary")

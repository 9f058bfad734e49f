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

from figures import *  # the parts of the bottle; paraview.simple and our helpers

folder = output_folder("bottle")
view = make_view()

EDGE = 0.02
bottle = HybridTreeBlend(registrationName="bottle", Input=bottle_parts(), EdgeLength=EDGE)
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

# SPDX-License-Identifier: BSD-3-Clause
"""A statue with new arms and a new head, after Figure 22 of the HybridTree paper.

    xvfb-run -a pvpython examples/python/victory.py [output folder]

The paper starts from a scan of the Victory of Samothrace, without arms and head; a mesh of a draped body stands
in, made of splines. Arms of 18 splines each and the head of Igea are blended locally, in balls at the shoulders
and a cylinder around the neck; the right hand gets a shepherd's crook.
"""
import math
import os

from figures import *  # heads, wings, arms; paraview.simple and our helpers

folder = output_folder("victory")
view = make_view()
portrait_light(view)
EDGE = 0.012


def drapery(folds=38):
    """A dress: a core, and folds down from below the breast that swing out towards the hem."""
    yield [((0, 1.25, 0), 0.115), ((0, 0.70, 0.0), 0.19), ((0, 0.20, 0.0), 0.27)]
    for k in range(8):  # filled up to the folds
        c, s = math.cos(0.25 * math.pi * k), math.sin(0.25 * math.pi * k)
        yield [((0.05 * c, 1.15, 0.04 * s), 0.12), ((0.09 * c, 0.6, 0.06 * s), 0.16), ((0.19 * c, 0.05, 0.14 * s), 0.165)]
    for k in range(folds):
        turn = 2 * math.pi * k / folds
        sway = 0.018 * math.sin(5 * turn + 1.0)
        at = lambda y, r, by=0.0: ((1.12 * r * math.cos(turn + by), y, 0.85 * r * math.sin(turn + by)), 0.036)
        yield [at(1.42 - 0.02 * (k % 2), 0.115), at(1.28, 0.118), at(1.10, 0.165)]
        yield [at(1.10, 0.165), at(0.72, 0.20 + 0.5 * sway, 0.05), at(0.35, 0.27 + sway, 0.10), at(0.02, 0.32 + 1.3 * sway, 0.14)]


start = clock()
carved = splines("statue", [*torso(), *drapery()], folder, SurfaceRadius=0.1, InfluenceRadius=0.118, EdgeLength=EDGE)
broken = HybridTreeBoolean(  # its head has gone, and below the hem there is nothing
    registrationName="broken", A=carved, Operation="Difference A - B", EdgeLength=EDGE,
    B=[
        HybridTreePoint(Center=[0, 2.08, 0.03], SurfaceRadius=0.19, InfluenceRadius=0.3),
        HybridTreeBox(Center=[0, -0.47, 0], Lengths=[2, 1, 2], SurfaceRadius=0.0, InfluenceRadius=0.1),
    ],
)
statue = HybridTreeMeshField(registrationName="statue as a mesh", Input=Clean(Input=broken), InfluenceRadius=0.05)

hands = {  # shoulder, elbow, wrist, fingers, palm
    "right": ((-0.225, 1.69, -0.01), (-0.42, 1.46, 0.06), (-0.50, 1.60, 0.30), (-0.10, 0.30, 0.94), (0.1, -0.94, 0.30)),
    "left": ((0.225, 1.69, -0.01), (0.43, 1.50, 0.02), (0.60, 1.74, 0.14), (0.42, 0.88, 0.20), (0.1, -0.2, 0.97)),
}
for name, (shoulder, elbow, wrist, fingers, palm) in hands.items():
    limb = splines(
        name + " arm", arm(shoulder, elbow, wrist, fingers=fingers, palm=palm), folder,
        SurfaceRadius=0.05, InfluenceRadius=0.064, EdgeLength=EDGE,
    )
    ball = HybridTreePoint(registrationName=name + " shoulder", Center=shoulder, SurfaceRadius=0.12, InfluenceRadius=0.18)
    statue = HybridTreeLocalBlend(
        registrationName="with " + name + " arm", A=statue, B=limb, Region=ball, EdgeLength=EDGE
    )

head = HybridTreeMeshField(
    registrationName="head", InfluenceRadius=0.05,
    Input=HybridTreeAffineTransform(
        registrationName="head in place", Input=igea(folder), Scale=[0.40, 0.40, 0.40], Translate=[0, 2.055, 0.0]
    ),
)
neck = HybridTreeCylinder(
    registrationName="neck", Point1=[0, 1.80, 0], Point2=[0, 1.88, 0], Radius=0.12, SurfaceRadius=0.04, InfluenceRadius=0.1
)
statue = HybridTreeLocalBlend(registrationName="with head", A=statue, B=head, Region=neck, EdgeLength=EDGE)

x, z = -0.515, 0.385
shaft = [c for y in (0.02, 0.7, 1.4, 1.9, 2.12) for c in (x, y, z)]
hook = [c for k in range(1, 7) for c in (
    x + 0.12 - 0.12 * math.cos(k * math.pi / 4.6), 2.16 + 0.12 * math.sin(k * math.pi / 4.6), z)]
crook = HybridTreeSpline(
    registrationName="crook", Points=shaft + hook, SurfaceRadius=0.02, InfluenceRadius=0.05, EdgeLength=EDGE
)
plinth = HybridTreeCylinder(
    registrationName="plinth", Point1=[-0.06, -0.1, 0.05], Point2=[-0.06, 0.05, 0.05], Radius=0.62, SurfaceRadius=0.02, InfluenceRadius=0.1
)
victory = HybridTreeBoolean(registrationName="victory", A=statue, B=[crook, plinth], Operation="Union", EdgeLength=EDGE)
finish(victory, "victory", start, volume=(0.1, 1.0))

look(view, direction=(-0.3, 0.15, 1.0), focus=(0.0, 1.05, 0.05), distance=5.2)
picture(view, victory, os.path.join(folder, "victory.png"), colour=MARBLE)

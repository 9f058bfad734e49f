# SPDX-License-Identifier: BSD-3-Clause
"""Control of blending, after figures 13, 15 and 16 of Angelidis and Cani (2002): what does blend and should not, the
thickness along a curve of unequal elements, and a short element between two long ones.

    xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython examples/python/blending.py [output folder]

Leaves limbs.png, thickness.png and corner.png: from above, everything blends, neighbours blend as in the paper, and
neighbours blend by their distance along the skeleton; with the coarse skeletons inside.
"""
import os

from creature_skeletons import Skeleton
from stage import *  # paraview.simple and our helpers

folder = output_folder("blending")
globals().update(load_plugin())

WAYS = "Everything", "Paper", "Neighbours"
SIZE = 960, 720


def chain(radius, *places):
    skeleton = Skeleton()
    start = skeleton.point(*places[0], 0.0, radius)
    skeleton.curve(start, *((x, y, 0.0, radius) for x, y in places[1:]))
    return skeleton


def limbs():
    """A hairpin, whose legs come near each other far apart along it."""
    return chain(0.5, (0, 0), (3, 0), (6, 0), (9, 0), (9, 1.2), (6, 1.2), (3, 1.2), (0, 1.2))


def thickness():
    """A straight curve whose elements get shorter and shorter."""
    places, x, step = [(0.0, 0.0)], 0.0, 2.4
    while x < 8.5:
        x += step
        places.append((x, 0.0))
        step = max(0.25, 0.7 * step)
    return chain(0.5, *places)


def corner():
    """Two long elements, and a tiny one between them."""
    return chain(0.5, (0, -1.6), (4.47, -0.03), (4.53, -0.03), (9, -1.6))


def figure(skeleton, name, level, step):
    """The ways to blend, one below the other."""
    path = os.path.join(folder, name)
    skeleton.write(path + "-skeleton.vtp")
    elements = XMLPolyDataReader(registrationName=name, FileName=[path + "-skeleton.vtp"])
    view = make_view(SIZE)
    for k, way in enumerate(WAYS):
        place = [0.0, -step * k, 0.0]
        shape = HybridTreeSubdivisionSkeleton(Input=elements, Blending=way, Level=level, EdgeLength=0.04)
        surface = Show(shape, view)
        surface.ColorArrayName = ["POINTS", ""]
        surface.DiffuseColor = surface.AmbientColor = CLAY
        surface.Specular = 0.3
        surface.Opacity = 0.5
        surface.Position = place
        check_closed(shape, f"{name}, {way.lower()}")
        ends = Glyph(Input=elements, GlyphType="Sphere", ScaleFactor=0.24, ScaleArray=["POINTS", "No scale array"], GlyphMode="All Points")
        for inside in (Tube(Input=elements, Radius=0.05), ends):
            coarse = Show(inside, view)
            coarse.ColorArrayName = ["POINTS", ""]
            coarse.DiffuseColor = coarse.AmbientColor = [0.75, 0.3, 0.05]
            coarse.Position = place
    look(view, (0.0, 0.0, 1.0), [0, 0, 0], 10.0)
    ResetCamera(view)
    view.CameraViewAngle = 30.0 / 1.45
    Render(view)
    SaveScreenshot(path + ".png", view, ImageResolution=list(SIZE))
    print("  picture", os.path.relpath(path + ".png"))


figure(limbs(), "limbs", 2, 2.9)
figure(thickness(), "thickness", 1, 2.0)
figure(corner(), "corner", 0, 2.6)

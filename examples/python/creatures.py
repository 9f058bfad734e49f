# SPDX-License-Identifier: BSD-3-Clause
"""Figures made of subdivided skeletons, after Angelidis and Cani (2002): figures 15, 18 and 19.

    xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython examples/python/creatures.py [output folder]

Leaves bretzel.png and alien.png (neighbours blend, beside everything blends), nessie.png and bat.png (levels 0, 1
and 2, with their skeletons), and of each the coarse skeleton and the surface as .vtp.
"""
import os

import creature_skeletons
from stage import *  # paraview.simple and our helpers

folder = output_folder("creatures")
globals().update(load_plugin())


def skeleton_of(name):
    path = os.path.join(folder, name + "-skeleton.vtp")
    figure = getattr(creature_skeletons, name)()
    figure.write(path)
    print(f"{name}: {len(figure.segments)} segments and {len(figure.triangles)} triangles")
    return XMLPolyDataReader(registrationName=name, FileName=[path])


def row(shapes, direction, colour, step, size, zoom, path):
    """One picture of shapes side by side, `step` apart."""
    view = make_view(size)
    for k, shape in enumerate(shapes):
        place = [(k - 0.5 * (len(shapes) - 1)) * s for s in step]
        surface = Show(shape, view)
        surface.Representation = "Surface"
        surface.ColorArrayName = ["POINTS", ""]
        surface.DiffuseColor = surface.AmbientColor = colour
        surface.Specular = 0.3
        surface.Position = place
    look(view, direction, [0, 0, 0], 10.0)
    ResetCamera(view)
    view.CameraViewAngle = 30.0 / zoom
    Render(view)
    SaveScreenshot(path, view, ImageResolution=list(size))
    print("  picture", os.path.relpath(path))


def dressed(skeleton, **properties):
    return HybridTreeSubdivisionSkeleton(Input=skeleton, **properties)


for name, step, colour, edge in (
    ("bretzel", (3.1, 0, 0), [0.72, 0.45, 0.22], 0.04),
    ("alien", (3.6, 0, 0), [0.55, 0.72, 0.45], 0.02),
):
    skeleton = skeleton_of(name)
    shapes = [dressed(skeleton, Blending=blending, EdgeLength=edge) for blending in ("Neighbours", "Everything")]
    row(shapes, (0.25, 0.1, 1.0), colour, step, (1200, 700), 1.7, os.path.join(folder, name + ".png"))
    check_closed(shapes[0], name)
    SaveData(os.path.join(folder, name + ".vtp"), proxy=shapes[0], DataMode="Binary")

for name, step, colour, direction in (
    ("nessie", (0, -2.5, 0), [0.36, 0.53, 0.56], (0.25, 0.45, 1.0)),
    ("bat", (0, -2.5, 0), [0.45, 0.40, 0.48], (0.2, 0.25, 1.0)),
):
    skeleton = skeleton_of(name)
    shapes = [dressed(skeleton, Level=level, EdgeLength=0.025) for level in (0, 1, 2)]
    row(shapes, direction, colour, step, (900, 1000), 1.3, os.path.join(folder, name + ".png"))
    for level, shape in enumerate(shapes):
        check_closed(shape, f"{name}, level {level}")
    SaveData(os.path.join(folder, name + ".vtp"), proxy=shapes[2], DataMode="Binary")

# SPDX-License-Identifier: BSD-3-Clause
"""Virtual restoration ([HT] 6.2): a hollow of a scan is filled with implicit primitives.

    xvfb-run -a pvpython examples/python/restoration.py [output folder]

A conservator fills a cavity with cement and smooths it to its rim. Here a few segments lie along the
left eye hollow of a scanned kitten; blended locally, they rise the surface inside the region and
leave the rest of the scan as it is. Leaves before.png, cement.png, after.png and restored.vtp.
"""
import os

from scans import convert
from stage import *  # paraview.simple and our helpers

folder = output_folder("restoration")
globals().update(load_plugin())
view = make_view()
look(view, direction=(0.7, 0.3, 1.0), focus=(0.06, 0.16, 0.1), distance=1.2)

scan = XMLPolyDataReader(registrationName="scan", FileName=[convert("points_3/kitten.xyz", folder)])
kitten = HybridTreeSurfaceReconstruction(registrationName="kitten", Input=scan)
picture(view, kitten, os.path.join(folder, "before.png"))
before = check_closed(kitten, "scan")

# Cement: segments across the hollow, a little below its rim.
strokes = [
    ([0.095, 0.150, 0.215], [0.200, 0.150, 0.165]),
    ([0.095, 0.180, 0.205], [0.205, 0.180, 0.160]),
    ([0.115, 0.120, 0.210], [0.185, 0.125, 0.180]),
]
cement = HybridTreeBlend(
    registrationName="cement",
    Input=[
        HybridTreeSegment(Point1=a, Point2=b, SurfaceRadius=0.012, InfluenceRadius=0.06) for a, b in strokes
    ],
)
region = HybridTreePoint(
    registrationName="region", Center=[0.15, 0.16, 0.19], SurfaceRadius=0.09, InfluenceRadius=0.13
)
picture(
    view, kitten, os.path.join(folder, "cement.png"),
    extra=[(cement, {"DiffuseColor": GLAZE}), (region, {"Opacity": 0.25, "DiffuseColor": GLAZE})],
)

body = HybridTreeMeshField(registrationName="body", Input=kitten, InfluenceRadius=0.05)
restored = HybridTreeLocalBlend(registrationName="restored", A=body, B=cement, Region=region, EdgeLength=0.008)
picture(view, restored, os.path.join(folder, "after.png"))
after = check_closed(restored, "restored scan")
SaveData(os.path.join(folder, "restored.vtp"), proxy=restored, DataMode="Binary")

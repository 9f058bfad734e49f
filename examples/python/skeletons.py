# SPDX-License-Identifier: BSD-3-Clause
"""Every skeleton's primitive as it is meshed directly, with its triangles, on one sheet.

    xvfb-run -a -s "-screen 0 1280x1024x24 -noreset" pvpython examples/python/skeletons.py [output folder]

Leaves skeletons.png. Curves are blue, sheets green, volumes clay, as in the table of docs/skeletons.md.
"""
import math
import os

from stage import *  # paraview.simple and our helpers

folder = output_folder("skeletons")
globals().update(load_plugin())

CURVE, SHEET, VOLUME = [0.50, 0.70, 0.85], [0.62, 0.80, 0.58], [0.93, 0.82, 0.68]
COLUMNS, ROWS = 4, 4
SIZE = (1050, 950)
PITCH = 2.72  # from one primitive to the next, across
RISE = 2.45  # and down
DIRECTION = (0.55, -1.0, 0.62)  # from the middle to the camera

field = dict(SurfaceRadius=0.25, InfluenceRadius=0.6)
thin = dict(SurfaceRadius=0.16, InfluenceRadius=0.5)
axis = dict(Point1=[0, 0, -0.65], Point2=[0, 0, 0.65])
letter = [0, 0, 0, 1.7, 0, 0, 1.7, 0.6, 0, 0.6, 0.6, 0, 0.6, 1.7, 0, 0, 1.7, 0]
wire = [0.5, -0.5, -0.55, -0.5, -0.5, -0.3, -0.5, 0.5, -0.05, 0.5, 0.5, 0.2, 0.5, -0.5, 0.45, -0.4, -0.5, 0.7]
SHEETS = [  # name, colour, primitive
    ("Point", CURVE, HybridTreePoint(SurfaceRadius=0.85, InfluenceRadius=1.2)),
    ("Segment", CURVE, HybridTreeSegment(Point1=[-0.7, 0, -0.3], Point2=[0.7, 0, 0.3], SurfaceRadius=0.35)),
    ("Circle", CURVE, HybridTreeCircle(Radius=0.75, **field)),
    ("Spline", CURVE, HybridTreeSpline(
        Points=[-0.95, 0, -0.3, -0.35, 0.3, 0.4, 0.35, -0.3, -0.4, 0.95, 0, 0.3], SurfaceRadius=0.2, InfluenceRadius=0.5)),
    ("Disc", SHEET, HybridTreeDisc(Radius=0.85, **thin)),
    ("Rectangle", SHEET, HybridTreeRectangle(Origin=[-0.9, -0.6, 0], Point1=[0.7, -0.6, 0], Point2=[-0.7, 0.6, 0], **thin)),
    ("Triangle", SHEET, HybridTreeTriangle(Point1=[-0.9, -0.7, 0], Point2=[0.9, -0.7, 0], Point3=[0, 0.9, 0], **thin)),
    ("Polygon", SHEET, HybridTreePolygon(Points=[c - 0.8 if k % 3 < 2 else c for k, c in enumerate(letter)], **thin)),
    ("Box", VOLUME, HybridTreeBox(Lengths=[1.2, 1.0, 0.8], **field)),
    ("Cylinder", VOLUME, HybridTreeCylinder(Radius=0.6, SurfaceRadius=0.12, **axis)),
    ("Hollow Cylinder", VOLUME, HybridTreeHollowCylinder(OuterRadius=0.8, InnerRadius=0.6, SurfaceRadius=0.06, **axis)),
    ("Cone", VOLUME, HybridTreeCone(Radius1=0.75, Radius2=0.15, SurfaceRadius=0.12, **axis)),
    ("Cone Sphere", VOLUME, HybridTreeConeSphere(
        Point1=[0, 0, -0.4], Point2=[0, 0, 0.7], Radius1=0.55, Radius2=0.2, SurfaceRadius=0.1)),
    ("Ellipsoid", VOLUME, HybridTreeEllipsoid(Radii=[0.95, 0.5, 0.6], SurfaceRadius=0.1)),
    ("Surface of Revolution", VOLUME, HybridTreeSurfaceOfRevolution(
        Points=[0.4, 0, -0.8, 0.75, 0, -0.4, 0.3, 0, 0.3, 0.45, 0, 0.8], SurfaceRadius=0.08)),
    ("Curve Skeletons", CURVE, HybridTreeCurveSkeletons(
        Input=PolyLineSource(Points=wire), As="Segments", SurfaceRadius=0.18, InfluenceRadius=0.3)),
]


def unit(v):
    length = math.sqrt(sum(c * c for c in v))
    return [c / length for c in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


view = make_view(SIZE)
view.Background, view.Background2 = [1, 1, 1], [0.88, 0.91, 0.95]
towards = unit(DIRECTION)
right = unit(cross((0, 0, 1), towards))
up = cross(towards, right)
half_height = 0.5 * ROWS * RISE + 0.1
half_width = half_height * SIZE[0] / SIZE[1]

HideAll(view)
for number, (name, colour, primitive) in enumerate(SHEETS):
    primitive.EdgeLength = 0.1 if name in ("Spline", "Curve Skeletons") else 0.15
    check_closed(primitive, name)
    x = PITCH * (number % COLUMNS - 0.5 * (COLUMNS - 1))
    y = RISE * (0.5 * (ROWS - 1) - number // COLUMNS) + 0.14
    display = Show(primitive, view)
    display.Representation = "Surface With Edges"
    display.ColorArrayName = ["POINTS", ""]
    display.DiffuseColor = display.AmbientColor = colour
    display.EdgeColor = [0.62 * c for c in colour]
    display.Ambient = 0.25
    display.Diffuse = 0.9
    display.LineWidth = 1
    display.Specular = 0.15
    display.Position = [x * r + y * u for r, u in zip(right, up)]
    label = Show(Text(Text=name), view)
    label.WindowLocation = "Any Location"
    label.FontSize = 11
    label.Color = [0.15, 0.18, 0.22]
    # Text starts at its left end: some 0.0038 of the width for half a letter.
    label.Position = [0.5 + 0.5 * x / half_width - 0.0038 * len(name), 0.5 + 0.5 * (y - 1.27) / half_height]

Render(view)  # the first one resets the camera
view.CameraParallelProjection = 1
view.CameraFocalPoint = [0, 0, 0]
view.CameraPosition = [20 * t for t in towards]
view.CameraViewUp = [0, 0, 1]
view.CameraParallelScale = half_height
Render(view)
path = os.path.join(folder, "skeletons.png")
SaveScreenshot(path, view, ImageResolution=list(SIZE))
print("  picture", os.path.relpath(path))

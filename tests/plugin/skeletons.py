# SPDX-License-Identifier: BSD-3-Clause
"""Every primitive, alone and below each kind of operation: a closed surface, and not a word of warning."""
import math

import plugin
from paraview import simple

LINE = [-0.8, 0, -0.2, -0.2, 0.3, 0.3, 0.3, -0.2, -0.2, 0.8, 0.1, 0.2]
OUTLINE = [-0.6, -0.5, 0, 0.7, -0.5, 0, 0.7, 0.1, 0, 0, 0, 0, -0.2, 0.6, 0]


def primitives():
    """{name: proxy}, each some 1 to 2 across and around the origin, in more than one form where it has some."""
    make = {name: getattr(plugin, name) for name in plugin.PROXIES}
    ends = {"Point1": [-0.5, 0, -0.3], "Point2": [0.4, 0.1, 0.4]}
    thin = {"SurfaceRadius": 0.12, "InfluenceRadius": 0.3}
    sharp = {"SurfaceRadius": 0, "InfluenceRadius": 0.3}
    line = simple.PolyLineSource(Points=LINE)
    profile = [0.3, 0, -0.6, 0.6, 0, -0.2, 0.25, 0, 0.6]
    return {
        "point": make["HybridTreePoint"](),
        "segment": make["HybridTreeSegment"](**ends, **thin),
        "circle": make["HybridTreeCircle"](Radius=0.5, **thin),
        "spindle circle": make["HybridTreeCircle"](Radius=0.2, SurfaceRadius=0.4, InfluenceRadius=0.6),
        "disc": make["HybridTreeDisc"](Radius=0.6, **thin),
        "rectangle": make["HybridTreeRectangle"](Origin=[-0.5, -0.4, 0], Point1=[0.5, -0.4, 0], Point2=[-0.3, 0.4, 0], **thin),
        "triangle": make["HybridTreeTriangle"](Point1=[-0.6, -0.4, 0], Point2=[0.6, -0.4, 0.1], Point3=[0.2, 0.5, 0], **thin),
        "polygon": make["HybridTreePolygon"](Points=OUTLINE, **thin),
        "polygon with a slot": make["HybridTreePolygon"](
            Points=[-0.6, -0.5, 0, 0.6, -0.5, 0, 0.6, 0.5, 0, 0.05, 0.5, 0, 0.05, 0, 0, -0.05, 0, 0, -0.05, 0.5, 0, -0.6, 0.5, 0],
            **thin),
        "polygon from outline": make["HybridTreePolygonFromOutline"](Input=simple.PolyLineSource(Points=OUTLINE, Closed=1), **thin),
        "box": make["HybridTreeBox"](Lengths=[0.8, 0.6, 0.7], **thin),
        "sharp box": make["HybridTreeBox"](Lengths=[0.8, 0.6, 0.7], **sharp),
        "cylinder": make["HybridTreeCylinder"](Radius=0.4, **ends, **thin),
        "sharp cylinder": make["HybridTreeCylinder"](Radius=0.4, **ends, **sharp),
        "hollow cylinder": make["HybridTreeHollowCylinder"](
            OuterRadius=0.5, InnerRadius=0.35, SurfaceRadius=0.05, InfluenceRadius=0.2, **ends),
        "cone": make["HybridTreeCone"](Radius1=0.5, Radius2=0.1, **ends, **thin),
        "pointed cone": make["HybridTreeCone"](Radius1=0.5, Radius2=0, **ends, **sharp),
        "cone sphere": make["HybridTreeConeSphere"](Radius1=0.4, Radius2=0.15, **ends, **thin),
        "ellipsoid": make["HybridTreeEllipsoid"](Radii=[0.7, 0.4, 0.3], **thin),
        "spline": make["HybridTreeSpline"](Points=LINE, **thin),
        "closed spline": make["HybridTreeSpline"](Points=LINE, Closed=1, Kind="B-Spline", **thin),
        "solid of revolution": make["HybridTreeSurfaceOfRevolution"](Points=profile, **thin),
        "wall of revolution": make["HybridTreeSurfaceOfRevolution"](Points=profile, Solid=0, Kind="Polyline", **thin),
        "revolution from profile": make["HybridTreeSurfaceOfRevolutionFromProfile"](
            Input=simple.PolyLineSource(Points=profile), Solid=0, **thin),
        "segments": make["HybridTreeCurveSkeletons"](Input=line, As="Segments", **thin),
        "splines": make["HybridTreeCurveSkeletons"](Input=line, As="Spline", Blend="Within A Curve", **thin),
    }


def operations(node):
    """{name: proxy}"""
    ball = plugin.HybridTreePoint(Center=[0.35, 0.1, 0.25], SurfaceRadius=0.3, InfluenceRadius=0.5)
    frame = {"Axis": [1, 0, 0], "Normal": [0, 1, 0], "Range": [-0.5, 0.5]}
    return {
        "affine": plugin.HybridTreeAffineTransform(
            Input=node, Translate=[1, 2, 3], Rotate=[10, 20, 30], Scale=[1, 1.5, 0.6], EdgeLength=0.08),
        "blend": plugin.HybridTreeBlend(Input=[node, ball], EdgeLength=0.08),
        "union": plugin.HybridTreeBoolean(A=node, B=ball, Operation="Union", EdgeLength=0.08),
        "difference": plugin.HybridTreeBoolean(A=node, B=ball, Operation="Difference A - B", EdgeLength=0.08),
        "twist": plugin.HybridTreeTwist(Input=node, Angle=50, EdgeLength=0.08, **frame),
        "free-form": plugin.HybridTreeFreeFormDeformation(Input=node, EdgeLength=0.08, Displacements=[1, 1, 1, 0.2, 0.1, 0.2]),
    }


def check(name, proxy):
    with plugin.Messages() as messages:
        mesh = plugin.run(proxy)
    assert not messages.text, f"{name}: {messages.text}"
    assert mesh.GetNumberOfPolys() > 50, f"{name}: {mesh.GetNumberOfPolys()} triangles"
    assert plugin.open_edges(mesh) == 0, f"{name}: {plugin.open_edges(mesh)} open or non-manifold edges"
    assert plugin.volume(mesh) > 0, name
    return mesh


def check_outlines():
    """What Polygon From Outline reads, what it refuses, and that it follows its input."""
    source = simple.PolyLineSource(Points=OUTLINE, Closed=1)
    node = plugin.HybridTreePolygonFromOutline(Input=source)
    check("closed polyline", node)
    same = plugin.HybridTreePolygon(Points=OUTLINE)
    assert plugin.volume(plugin.run(node)) == plugin.volume(plugin.run(same))
    source.Points = [2 * c for c in OUTLINE]
    assert plugin.volume(plugin.run(node)) > plugin.volume(plugin.run(same))
    slices = simple.Slice(Input=simple.Sphere(Radius=1, ThetaResolution=32, PhiResolution=32), SliceType="Plane")
    check("slice of a sphere", plugin.HybridTreePolygonFromOutline(Input=slices))
    check("first polygon", plugin.HybridTreePolygonFromOutline(Input=simple.Plane()))
    for name, points, closed, reason in (
        ("open", OUTLINE, 0, "lines that close"),
        ("not flat", [0, 0, 0, 1, 0, 0.5, 1, 1, 0, 0, 1, 0.5], 1, "not flat"),
    ):
        with plugin.Messages() as messages:
            bad = plugin.run(plugin.HybridTreePolygonFromOutline(Input=simple.PolyLineSource(Points=points, Closed=closed)))
        assert bad.GetNumberOfPolys() == 0 and reason in messages.text, f"{name}: {messages.text}"


def check_profiles():
    """What Surface Of Revolution From Profile reads, what it refuses, and that it follows its input."""
    points = [0.3, 0, -0.6, 0.6, 0, -0.2, 0.25, 0, 0.6]
    source = simple.PolyLineSource(Points=points)
    node = plugin.HybridTreeSurfaceOfRevolutionFromProfile(Input=source)
    check("polyline", node)
    same = plugin.HybridTreeSurfaceOfRevolution(Points=points)
    assert plugin.volume(plugin.run(node)) == plugin.volume(plugin.run(same))
    source.Points = [2 * c for c in points]
    assert plugin.volume(plugin.run(node)) > plugin.volume(plugin.run(same))
    # A ring from the closed slice of a ball beside the axis: its volume by Pappus.
    slices = simple.Slice(
        Input=simple.Sphere(Center=[2, 0, 0], Radius=0.5, ThetaResolution=96, PhiResolution=96), SliceType="Plane")
    slices.SliceType.Normal = [0, 1, 0]
    ring = plugin.HybridTreeSurfaceOfRevolutionFromProfile(Input=slices, SurfaceRadius=0, EdgeLength=0.05)
    volume = plugin.volume(check("slice", ring))
    exact = 2 * math.pi**2 * 2 * 0.5**2
    assert abs(volume - exact) < 0.01 * exact, (volume, exact)
    with plugin.Messages() as messages:
        bad = plugin.run(plugin.HybridTreeSurfaceOfRevolutionFromProfile(Input=simple.PointSource()))
    assert bad.GetNumberOfPolys() == 0 and "neither lines nor a polygon" in messages.text, messages.text


if __name__ == "__main__":
    count = 0
    for name, node in primitives().items():
        node.EdgeLength = 0.08
        check(name, node)
        for operation, proxy in operations(node).items():
            check(f"{operation} of {name}", proxy)
            count += 1
            simple.Delete(proxy)
    check_outlines()
    check_profiles()
    print(f"{count} operations on {len(primitives())} primitives")

# SPDX-License-Identifier: BSD-3-Clause
"""Every label applied to real data, saved as .vtp, reloaded as a live tree, and kept by a state file."""
import os
import sys

import plugin
from paraview import simple

sys.path.insert(0, os.path.join(os.path.dirname(__file__), "..", "..", "examples", "python"))
import scans

LIVE = "HybridTree"


def pipeline(folder):
    """One proxy of each label, on a scan and on primitives: {label: proxy}."""
    make = {name: getattr(plugin, name) for name in plugin.PROXIES}
    cow = simple.XMLPolyDataReader(FileName=[scans.convert("meshes/cow.off", folder)])
    nodes = {
        "HybridTreePoint": make["HybridTreePoint"](Center=[0.3, 0.2, 0], SurfaceRadius=0.1, InfluenceRadius=0.3),
        "HybridTreeSegment": make["HybridTreeSegment"](
            Point1=[-0.4, 0, 0], Point2=[0.1, 0.3, 0], SurfaceRadius=0.06, InfluenceRadius=0.2),
        "HybridTreeCircle": make["HybridTreeCircle"](
            Center=[0.1, 0.1, 0], Normal=[0, 1, 1], Radius=0.3, SurfaceRadius=0.05, InfluenceRadius=0.15),
        "HybridTreeBox": make["HybridTreeBox"](
            Center=[-0.2, 0, 0], Lengths=[0.3, 0.2, 0.4], Rotation=[10, 20, 30], SurfaceRadius=0.02,
            InfluenceRadius=0.1),
        "HybridTreeRectangle": make["HybridTreeRectangle"](
            Origin=[0, 0, 0], Point1=[0.4, 0, 0.1], Point2=[0, 0.3, 0], SurfaceRadius=0.03, InfluenceRadius=0.1),
        "HybridTreeTriangle": make["HybridTreeTriangle"](
            Point1=[0, 0, 0], Point2=[0.4, 0, 0.1], Point3=[0, 0.3, 0], SurfaceRadius=0.03, InfluenceRadius=0.1),
        "HybridTreePolygon": make["HybridTreePolygon"](
            Points=[0, 0, 0, 0.4, 0, 0, 0.1, 0.1, 0, 0, 0.4, 0], SurfaceRadius=0.02, InfluenceRadius=0.1),
        "HybridTreeEllipsoid": make["HybridTreeEllipsoid"](
            Center=[0.1, 0, 0], Radii=[0.2, 0.1, 0.05], Rotation=[10, 20, 30], SurfaceRadius=0.02, InfluenceRadius=0.1),
        "HybridTreeMeshField": make["HybridTreeMeshField"](Input=cow, InfluenceRadius=0.1),
    }
    point, segment, circle, box = list(nodes.values())[:4]
    mesh = nodes["HybridTreeMeshField"]
    nodes["HybridTreeDisc"] = make["HybridTreeDisc"](Center=[0.1, 0, 0.2], Normal=[1, 2, 0], Radius=0.3)
    ends = {"Point1": [-0.3, 0, 0.1], "Point2": [0.3, 0.2, 0]}
    nodes["HybridTreeCylinder"] = make["HybridTreeCylinder"](Radius=0.2, SurfaceRadius=0, **ends)
    nodes["HybridTreeHollowCylinder"] = make["HybridTreeHollowCylinder"](OuterRadius=0.3, InnerRadius=0.2, **ends)
    nodes["HybridTreeCone"] = make["HybridTreeCone"](Radius1=0.3, Radius2=0, **ends)
    nodes["HybridTreeConeSphere"] = make["HybridTreeConeSphere"](Radius1=0.2, Radius2=0.1, **ends)
    nodes["HybridTreeBlend"] = make["HybridTreeBlend"](Input=[mesh, point, segment])
    nodes["HybridTreeLocalBlend"] = make["HybridTreeLocalBlend"](A=cow, B=circle, Region=point)
    nodes["HybridTreeBoolean"] = make["HybridTreeBoolean"](A=nodes["HybridTreeBlend"], B=box, Operation="Difference A - B")
    cut = nodes["HybridTreeBoolean"]
    nodes["HybridTreeTwist"] = make["HybridTreeTwist"](Input=segment, Axis=[1, 0, 0], Normal=[0, 1, 0], Angle=60)
    nodes["HybridTreeTaper"] = make["HybridTreeTaper"](Input=segment, Axis=[1, 0, 0], Normal=[0, 1, 0], Factor=0.4)
    nodes["HybridTreeBend"] = make["HybridTreeBend"](Input=cut, Axis=[1, 0, 0], Normal=[0, 1, 0], Angle=40)
    nodes["HybridTreeAffineTransform"] = make["HybridTreeAffineTransform"](
        Input=cut, Translate=[1, 2, 3], Rotate=[10, 20, 30], Scale=[1, 2, 0.5])
    if "HybridTreeFreeFormDeformation" in make:
        nodes["HybridTreeFreeFormDeformation"] = make["HybridTreeFreeFormDeformation"](
            Input=cow, Displacements=[1, 2, 1, 0, 0.2, 0, 1, 1, 1, 0.1, 0, 0])
    if "HybridTreeSurfaceReconstruction" in make:
        ball = simple.XMLPolyDataReader(FileName=[scans.convert("points_3/kitten.xyz", folder)])
        nodes["HybridTreeSurfaceReconstruction"] = make["HybridTreeSurfaceReconstruction"](Input=ball)
    nodes["HybridTreeSpline"] = make["HybridTreeSpline"](
        Points=[-0.4, 0, 0, 0, 0.3, 0, 0.3, 0, 0.2], SurfaceRadius=0.05, InfluenceRadius=0.15)
    nodes["HybridTreeSurfaceOfRevolution"] = make["HybridTreeSurfaceOfRevolution"](
        Points=[0.2, 0, -0.3, 0.3, 0, 0, 0.1, 0, 0.3], SurfaceRadius=0.05, InfluenceRadius=0.15)
    nodes["HybridTreeCurveSkeletons"] = make["HybridTreeCurveSkeletons"](
        Input=simple.PolyLineSource(Points=[0, 0, 0, 1, 0, 0, 1, 1, 0]))
    nodes["HybridTreeSkeletonEditor"] = make["HybridTreeSkeletonEditor"]()
    nodes["HybridTreeSubdivisionSkeleton"] = make["HybridTreeSubdivisionSkeleton"](
        Input=nodes["HybridTreeSkeletonEditor"], RadiusArray="Radius")
    nodes["HybridTreePolygonFromOutline"] = make["HybridTreePolygonFromOutline"](
        Input=simple.PolyLineSource(Points=[0, 0, 0, 1, 0, 0, 1, 1, 0, 0.5, 0.3, 0], Closed=1))
    nodes["HybridTreeSurfaceOfRevolutionFromProfile"] = make["HybridTreeSurfaceOfRevolutionFromProfile"](
        Input=simple.PolyLineSource(Points=[0.2, 0, -0.3, 0.3, 0, 0, 0.1, 0, 0.3]), SurfaceRadius=0.05, InfluenceRadius=0.15)
    nodes["HybridTreeProbe"] = make["HybridTreeProbe"](Tree=nodes["HybridTreeBoolean"], Points=simple.Wavelet(
        WholeExtent=[-3, 3, -3, 3, -3, 3]))
    return nodes


def check_probe(data):
    points = data.GetPointData()
    for name in ("Field", "Gradient", "Membership", "SignedDistance"):
        assert points.GetArray(name), f"the probe has no {name}"
    field, side = points.GetArray("Field"), points.GetArray("Membership")
    for k in range(data.GetNumberOfPoints()):
        if abs(field.GetValue(k) - 0.5) > 1e-6:
            assert (side.GetValue(k) > 0) == (field.GetValue(k) > 0.5)


def check_reload(name, proxy, mesh, folder):
    """The file is the tree: one more operation on what is read gives what it gives on the node."""
    path = os.path.join(folder, name + ".vtp")
    simple.SaveData(path, proxy, DataMode="Binary")
    reader = simple.XMLPolyDataReader(FileName=[path])
    again = plugin.run(reader)
    assert again.GetNumberOfPoints() == mesh.GetNumberOfPoints(), name
    assert again.GetFieldData().GetAbstractArray(LIVE), f"{name}: the file has no tree"
    move = {"Translate": [0.5, 0, 0], "Scale": [2, 2, 2], "EdgeLength": 0.05}
    direct = plugin.run(plugin.HybridTreeAffineTransform(Input=proxy, **move))
    reloaded = plugin.run(plugin.HybridTreeAffineTransform(Input=reader, **move))
    assert direct.GetNumberOfPoints() == reloaded.GetNumberOfPoints() > 0, name
    for k in range(0, direct.GetNumberOfPoints(), 97):
        assert direct.GetPoint(k) == reloaded.GetPoint(k), f"{name}: point {k} differs after the file"


def check_lattice(proxy):
    lattice = plugin.run(proxy, port=1)
    assert lattice.GetNumberOfPoints() >= 27 and lattice.GetNumberOfLines() > 0, "no lattice on output 1"
    bounds = lattice.GetBounds()
    assert bounds[3] > 0.31, f"the lattice is not deformed: {bounds}"


def check_looked_at(proxy, downstream):
    """A node that has only handed its tree on is meshed as soon as somebody else wants it."""
    downstream.EdgeLength = 0.04
    proxy.EdgeLength = 0.03
    downstream.UpdatePipeline()
    assert simple.servermanager.Fetch(proxy).GetNumberOfPolys() > 100
    proxy.EdgeLength = downstream.EdgeLength = 0


def check_state(folder, volumes):
    """A state file brings every node back, with its properties and its shape."""
    path = os.path.join(folder, "all.pvsm")
    simple.SaveState(path)
    simple.ResetSession()
    simple.LoadState(path)
    found = {}
    for (name, _), proxy in simple.GetSources().items():
        kind = proxy.GetXMLName()
        if kind in volumes:
            found[kind] = proxy
    assert set(found) == set(volumes), set(volumes) - set(found)
    for kind, proxy in found.items():
        now = plugin.volume(plugin.run(proxy))
        assert now == volumes[kind], f"{kind}: volume {volumes[kind]} before, {now} after the state file"


def main():
    folder = plugin.scratch()
    nodes = pipeline(folder)
    assert set(nodes) == set(plugin.PROXIES), set(plugin.PROXIES) ^ set(nodes)
    volumes = {}
    for name, proxy in nodes.items():
        data = plugin.run(proxy)
        if name == "HybridTreeProbe":
            check_probe(data)
            continue
        if name == "HybridTreeSkeletonEditor":  # draws a skeleton, and is no node
            assert (data.GetNumberOfLines(), data.GetNumberOfPolys()) == (2, 2)
            assert plugin.run(proxy, port=1).GetNumberOfPolys() == 32
            continue
        plugin.check_solid(data, name)
        volumes[name] = plugin.volume(data)
        check_reload(name, proxy, data, folder)
        if name == "HybridTreeFreeFormDeformation":
            check_lattice(proxy)
        print(f"{name}: {data.GetNumberOfPolys()} triangles, volume {volumes[name]:.6f}", flush=True)
    for _, proxy in list(simple.GetSources().items()):  # what only the reload test needed
        if proxy.GetXMLName() == "HybridTreeAffineTransform" and proxy is not nodes["HybridTreeAffineTransform"]:
            simple.Delete(proxy)
    check_looked_at(nodes["HybridTreeBoolean"], nodes["HybridTreeBend"])
    check_state(folder, volumes)


if __name__ == "__main__":
    main()

# SPDX-License-Identifier: BSD-3-Clause
"""What a user may type or load: each fault gets a text that names it, and the session goes on."""
import math

import plugin
from paraview import simple
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

CORNERS = ((0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1))
TRIANGLES = ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))


def source(corners=CORNERS, triangles=TRIANGLES):
    """A proxy that gives this mesh."""
    points, polygons = vtkPoints(), vtkCellArray()
    for corner in corners:
        points.InsertNextPoint(corner)
    for triangle in triangles:
        polygons.InsertNextCell(3, triangle)
    data = vtkPolyData()
    data.SetPoints(points)
    data.SetPolys(polygons)
    proxy = simple.TrivialProducer()
    proxy.SMProxy.GetClientSideObject().SetOutput(data)
    return proxy


def expect(proxy, *words):
    """Running it tells an error with all these words, and gives nothing."""
    with plugin.Messages() as messages:
        data = plugin.run(proxy)
    kind = proxy.GetXMLName()
    for word in words:
        assert word in messages.text, f'{kind}: no "{word}" in: {messages.text or "no message"}'
    assert data.GetNumberOfPoints() == 0, f"{kind}: {data.GetNumberOfPoints()} points beside {messages.text}"
    text = messages.text[messages.text.find("): ") + 3:].strip()
    print(f"{kind}: {text.splitlines()[0]}", flush=True)


def expect_mended(proxy):
    with plugin.Messages() as messages:
        data = plugin.run(proxy)
    assert "ERROR" not in messages.text, messages.text
    plugin.check_solid(data, proxy.GetXMLName())


def leaves():
    point = plugin.HybridTreePoint(SurfaceRadius=1, InfluenceRadius=1)
    expect(point, "SurfaceRadius", "InfluenceRadius", "1")
    point.SurfaceRadius = 2
    expect(point, "SurfaceRadius", "2", "InfluenceRadius", "1")
    point.SurfaceRadius = 0.5
    point.Exponent = 1
    expect(point, "Exponent", "1", "from 2 to 64")
    point.Exponent = 2
    point.Center = [0, math.nan, 0]
    expect(point, "Center", "nan")
    point.Center = [0, 0, 0]
    expect_mended(point)
    expect(plugin.HybridTreeCircle(Normal=[0, 0, 0]), "ormal")
    expect(plugin.HybridTreeCylinder(Point1=[1, 2, 3], Point2=[1, 2, 3]), "Point2 - Point1", "length")
    expect(plugin.HybridTreeHollowCylinder(InnerRadius=0.9), "InnerRadius", "0.9", "OuterRadius")
    return point


def warps(point):
    for name in ("HybridTreeTwist", "HybridTreeTaper", "HybridTreeBend"):
        warp = getattr(plugin, name)(Input=point, Axis=[0, 0, 0])
        expect(warp, "xis")
        warp.Axis, warp.Normal = [0, 0, 1], [0, 0, 1]
        if name == "HybridTreeBend":
            expect(warp, "ormal")
            warp.Normal = [1, 0, 0]
        expect_mended(warp)
    lattice = plugin.HybridTreeFreeFormDeformation(Input=point, LatticeDimensions=[1, 3, 3])
    expect(lattice, "lattice dimension", "1", "between 2 and 64")
    expect(plugin.HybridTreeAffineTransform(Input=point, Scale=[1, 0, 1]), "Scale", "0")


def edge_lengths(point):
    """Refused from an estimate, with the numbers, before any memory is asked for."""
    other = plugin.HybridTreePoint(Center=[0.5, 0, 0])
    blend = plugin.HybridTreeBlend(Input=[point, other], EdgeLength=1e-9)
    expect(blend, "edge length", "1e-09", "MiB of memory")
    blend.EdgeLength = 0.1
    expect_mended(blend)


def meshes(point):
    cloud = source(triangles=())
    for proxy in (
        plugin.HybridTreeBlend(Input=[cloud, point]),
        plugin.HybridTreeBoolean(A=point, B=cloud),
        plugin.HybridTreeMeshField(Input=cloud),
    ):
        expect(proxy, "4 points", "HybridTree Surface Reconstruction")
    for bad in (math.nan, math.inf):
        broken = source(corners=CORNERS[:3] + ((0, bad, 1),))
        expect(plugin.HybridTreeMeshField(Input=broken), "oint 3")
    expect(plugin.HybridTreeMeshField(Input=source(triangles=((0, 1, 1),))), "riangle")
    expect(plugin.HybridTreeMeshField(Input=source(corners=(), triangles=())), "empty")


def clouds():
    if not hasattr(plugin, "HybridTreeSurfaceReconstruction"):
        return
    for corners, word in (
        (CORNERS[:3] + ((0, math.nan, 1),), "oint 3"),
        (CORNERS[:3], "3"),
        ((), "point"),
        (((0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)), "plane"),
    ):
        cloud = source(corners=corners, triangles=())
        expect(plugin.HybridTreeSurfaceReconstruction(Input=cloud), word)


if __name__ == "__main__":
    ball = leaves()
    warps(ball)
    edge_lengths(ball)
    meshes(ball)
    clouds()
    expect_mended(ball)

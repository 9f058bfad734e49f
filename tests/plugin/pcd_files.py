# SPDX-License-Identifier: BSD-3-Clause
"""A PCD file as the user opens it: by its ending alone, then on to a surface."""
import math
import os
import tempfile

import plugin
from paraview import simple


def write(path, count):
    golden = math.pi * (3.0 - math.sqrt(5.0))
    with open(path, "w") as file:
        file.write("VERSION 0.7\nFIELDS x y z rgb intensity\nSIZE 4 4 4 4 4\nTYPE F F F U F\nCOUNT 1 1 1 1 1\n")
        file.write(f"WIDTH {count}\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS {count}\nDATA ascii\n")
        for k in range(count):
            z = 1.0 - (2.0 * k + 1.0) / count
            r = math.sqrt(1.0 - z * z)
            file.write(f"{r * math.cos(golden * k):.6f} {r * math.sin(golden * k):.6f} {z:.6f} 16744448 {k}\n")


if __name__ == "__main__":
    if not hasattr(plugin, "HybridTreeSurfaceReconstruction"):
        print("built without reconstruction")
        raise SystemExit(0)
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "ball.pcd")
        write(path, 2000)
        reader = simple.OpenDataFile(path)
        assert reader.SMProxy.GetXMLLabel() == "HybridTree PCD Reader", reader.SMProxy.GetXMLLabel()
        cloud = plugin.run(reader)
        assert cloud.GetNumberOfPoints() == cloud.GetNumberOfVerts() == 2000
        assert cloud.GetPointData().GetScalars().GetTuple3(7) == (255.0, 128.0, 0.0)

        surface = plugin.HybridTreeSurfaceReconstruction(Input=reader)
        surface.LevelOfDetail = "Target Vertices"
        surface.TargetVertices = 500
        mesh = plugin.run(surface)
        assert abs(mesh.GetNumberOfPoints() - 500) <= 25, mesh.GetNumberOfPoints()
        assert plugin.open_edges(mesh) == 0
        data = mesh.GetPointData()
        for k in range(mesh.GetNumberOfPoints()):
            assert data.GetArray("intensity").GetTuple1(k) == data.GetArray("PointIds").GetTuple1(k)
            assert data.GetArray("RGB").GetTuple3(k) == (255.0, 128.0, 0.0)
    print("a PCD file was opened and became a surface")

# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvbatch, alone or under mpirun: saves the surface of a tree and of a reconstruction."""
import os
import sys

import plugin
from paraview import servermanager, simple


def shapes():
    """name: proxy; a scan beside primitives, a warp on top, and a foreign filter between."""
    sphere = simple.Sphere(Radius=0.5, ThetaResolution=40, PhiResolution=40)
    mesh = plugin.HybridTreeMeshField(Input=simple.Transform(Input=sphere), InfluenceRadius=0.2)
    bar = plugin.HybridTreeSegment(Point1=[-1, 0, 0], Point2=[1, 0.1, 0], SurfaceRadius=0.15, InfluenceRadius=0.4)
    hole = plugin.HybridTreeBox(Center=[0, 0, 0.5], Lengths=[0.3, 0.3, 0.3])
    blend = plugin.HybridTreeBlend(Input=[mesh, bar])
    cut = plugin.HybridTreeBoolean(A=blend, B=hole, Operation="Difference A - B")
    made = {"tree": plugin.HybridTreeBend(Input=cut, Axis=[1, 0, 0], Normal=[0, 1, 0], Angle=30, EdgeLength=0.05)}
    if hasattr(plugin, "HybridTreeSurfaceReconstruction"):
        made["reconstruction"] = plugin.HybridTreeSurfaceReconstruction(Input=sphere)
    return made


if __name__ == "__main__":
    ranks = servermanager.vtkProcessModule.GetProcessModule().GetNumberOfLocalPartitions()
    assert ranks == int(sys.argv[2]), f"{ranks} processes instead of {sys.argv[2]}"
    for name, proxy in shapes().items():
        simple.SaveData(os.path.join(sys.argv[1], name + ".pvtp"), proxy, DataMode="Binary")

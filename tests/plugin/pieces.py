# SPDX-License-Identifier: BSD-3-Clause
"""Run by pvbatch, alone or under mpirun: saves the surface of a tree and of a reconstruction."""
import os
import sys

import plugin
from paraview import servermanager, simple


# Every process has a part, whatever piece it is asked for: what a redistributing filter leaves.
HALF = """
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkParallelCore import vtkMultiProcessController
controller = vtkMultiProcessController.GetGlobalController()
sphere = vtkSphereSource()
sphere.SetThetaResolution(30)
sphere.SetPhiResolution(30)
sphere.Update()
whole, part, cells = sphere.GetOutput(), vtkPolyData(), vtkCellArray()
for k in range(controller.GetLocalProcessId(), whole.GetNumberOfCells(), controller.GetNumberOfProcesses()):
    cells.InsertNextCell(whole.GetCell(k))
part.SetPoints(whole.GetPoints())
part.SetPolys(cells)
clean = vtkCleanPolyData()
clean.SetInputData(part)
clean.Update()
self.GetPolyDataOutput().ShallowCopy(clean.GetOutput())
"""
ANY_PIECE = "self.GetOutputInformation(0).Set(self.CAN_HANDLE_PIECE_REQUEST(), 1)"


def shapes():
    """name: proxy; a scan beside primitives, a warp on top, and a foreign filter between."""
    sphere = simple.Sphere(Radius=0.5, ThetaResolution=40, PhiResolution=40)
    mesh = plugin.HybridTreeMeshField(Input=simple.Transform(Input=sphere), InfluenceRadius=0.2)
    bar = plugin.HybridTreeSegment(Point1=[-1, 0, 0], Point2=[1, 0.1, 0], SurfaceRadius=0.15, InfluenceRadius=0.4)
    hole = plugin.HybridTreeBox(Center=[0, 0, 0.5], Lengths=[0.3, 0.3, 0.3])
    blend = plugin.HybridTreeBlend(Input=[mesh, bar])
    cut = plugin.HybridTreeBoolean(A=blend, B=hole, Operation="Difference A - B")
    made = {"tree": plugin.HybridTreeBend(Input=cut, Axis=[1, 0, 0], Normal=[0, 1, 0], Angle=30, EdgeLength=0.05)}
    parts = simple.ProgrammableSource(Script=HALF, ScriptRequestInformation=ANY_PIECE)
    made["parts"] = plugin.HybridTreeMeshField(Input=parts)
    made["grouped"] = plugin.HybridTreeMeshField(Input=simple.GroupDatasets(Input=[parts, simple.Cone(Center=[2, 0, 0], Resolution=60)]))
    if hasattr(plugin, "HybridTreeSurfaceReconstruction"):
        made["reconstructed_parts"] = plugin.HybridTreeSurfaceReconstruction(Input=parts)
        made["reconstruction"] = plugin.HybridTreeSurfaceReconstruction(Input=sphere)
    return made


if __name__ == "__main__":
    ranks = servermanager.vtkProcessModule.GetProcessModule().GetNumberOfLocalPartitions()
    assert ranks == int(sys.argv[2]), f"{ranks} processes instead of {sys.argv[2]}"
    for name, proxy in shapes().items():
        simple.SaveData(os.path.join(sys.argv[1], name + ".pvtp"), proxy, DataMode="Binary")

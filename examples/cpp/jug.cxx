// SPDX-License-Identifier: BSD-3-Clause
// The kitten jug of examples/python/kitten.py as a program without ParaView: scanned points are
// reconstructed, blended with two handles, cut by a mesh and deformed. Writes jug.vtp, which opens
// again as the live tree, and jug.stl.
//
//   jug kitten.vtp knot2.vtp [folder]
//
// The two files are points and polygons that the Python example leaves in its output folder.
#include "vtkHybridTreeAffineTransform.h"
#include "vtkHybridTreeBoolean.h"
#include "vtkHybridTreeBox.h"
#include "vtkHybridTreeCircle.h"
#include "vtkHybridTreeFreeFormDeformation.h"
#include "vtkHybridTreeLocalBlend.h"
#include "vtkHybridTreeMeshField.h"
#include "vtkHybridTreeReconstruction.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSTLWriter.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <cstdlib>
#include <iostream>
#include <string>

namespace
{

void setHandle(vtkHybridTreeCircle* handle, double x)
{
  handle->SetCenter(x, -0.02, 0.02);
  handle->SetNormal(0.0, 0.0, 1.0);
  handle->SetRadius(0.17);
  handle->SetSurfaceRadius(0.035);
  handle->SetInfluenceRadius(0.1);
}

/// The top row of control points leans over and grows.
void lean(vtkHybridTreeFreeFormDeformation* deformation)
{
  deformation->SetLatticeDimensions(3, 4, 3);
  for (int i = 0; i < 3; ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      deformation->AddDisplacement(i, 3, k, 0.18 + 0.06 * (i - 1), 0.06, 0.08 * (k - 1));
      deformation->AddDisplacement(i, 2, k, 0.05, 0.0, 0.0);
    }
  }
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 3)
  {
    std::cerr << "usage: jug points.vtp mesh.vtp [folder]\n";
    return EXIT_FAILURE;
  }
  const std::string folder = argc > 3 ? std::string(argv[3]) + "/" : "";

  vtkNew<vtkXMLPolyDataReader> scan;
  scan->SetFileName(argv[1]);
  vtkNew<vtkHybridTreeReconstruction> kitten;
  kitten->SetInputConnection(scan->GetOutputPort());

  // The scan gets a field of its own, wide enough to meet the handles.
  vtkNew<vtkHybridTreeMeshField> body;
  body->SetInputConnection(kitten->GetOutputPort());
  body->SetInfluenceRadius(0.08);
  vtkNew<vtkHybridTreeCircle> left;
  setHandle(left, -0.24);
  vtkNew<vtkHybridTreeCircle> right;
  setHandle(right, 0.26);
  vtkNew<vtkHybridTreeBoolean> handles;
  handles->SetInputConnection(0, left->GetOutputPort());
  handles->SetInputConnection(1, right->GetOutputPort());
  handles->SetOperation(vtkHybridTreeBoolean::UNION);
  vtkNew<vtkHybridTreeBox> region;
  region->SetCenter(0.0, -0.02, 0.02);
  region->SetLengths(0.56, 0.4, 0.2);
  region->SetSurfaceRadius(0.02);
  region->SetInfluenceRadius(0.08);
  vtkNew<vtkHybridTreeLocalBlend> withHandles;
  withHandles->SetInputConnection(0, body->GetOutputPort());
  withHandles->SetInputConnection(1, handles->GetOutputPort());
  withHandles->SetInputConnection(2, region->GetOutputPort());

  vtkNew<vtkXMLPolyDataReader> mesh;
  mesh->SetFileName(argv[2]);
  vtkNew<vtkHybridTreeAffineTransform> ring;
  ring->SetInputConnection(mesh->GetOutputPort());
  ring->SetScale(0.35, 0.35, 0.35);
  ring->SetRotate(0.0, 42.0, 0.0);
  ring->SetTranslate(0.14, 0.2, 0.125);
  vtkNew<vtkHybridTreeBoolean> carved;
  carved->SetInputConnection(0, withHandles->GetOutputPort());
  carved->SetInputConnection(1, ring->GetOutputPort());
  carved->SetOperation(vtkHybridTreeBoolean::DIFFERENCE);

  vtkNew<vtkHybridTreeFreeFormDeformation> jug;
  jug->SetInputConnection(carved->GetOutputPort());
  lean(jug);
  jug->SetEdgeLength(0.006);
  jug->Update();

  vtkPolyData* result = jug->GetOutput();
  if (result->GetNumberOfPolys() == 0)
  {
    return EXIT_FAILURE; // VTK has printed why
  }
  std::cout << result->GetNumberOfPoints() << " points, " << result->GetNumberOfPolys()
            << " triangles\n";

  vtkNew<vtkXMLPolyDataWriter> model;
  model->SetInputConnection(jug->GetOutputPort());
  model->SetFileName((folder + "jug.vtp").c_str());
  model->SetDataModeToBinary();
  vtkNew<vtkSTLWriter> triangles;
  triangles->SetInputConnection(jug->GetOutputPort());
  triangles->SetFileName((folder + "jug.stl").c_str());
  triangles->SetFileTypeToBinary();
  return model->Write() && triangles->Write() ? EXIT_SUCCESS : EXIT_FAILURE;
}

// SPDX-License-Identifier: BSD-3-Clause
// A cup out of primitives and a mesh: a body hollowed by a mesh, a handle that blends with the body
// at its ends only, and a rim pulled out by a free-form deformation. Writes cup.vtp, which opens
// again as the live tree, and cup.stl.
//
//   cup [folder]
#include "vtkCylinderSource.h"
#include "vtkHybridTreeAffineTransform.h"
#include "vtkHybridTreeBoolean.h"
#include "vtkHybridTreeBox.h"
#include "vtkHybridTreeCircle.h"
#include "vtkHybridTreeFreeFormDeformation.h"
#include "vtkHybridTreeLocalBlend.h"
#include "vtkHybridTreePoint.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkSTLWriter.h"
#include "vtkXMLPolyDataWriter.h"

#include <cstdlib>
#include <iostream>
#include <string>

int main(int argc, char** argv)
{
  const std::string folder = argc > 1 ? std::string(argv[1]) + "/" : "";

  // The body: a box with generously rounded edges.
  vtkNew<vtkHybridTreeBox> body;
  body->SetLengths(1.0, 1.0, 1.6);
  body->SetSurfaceRadius(0.4);
  body->SetInfluenceRadius(0.9);

  // The handle: a ring beside it. It blends with the body near its ends, here and there.
  vtkNew<vtkHybridTreeCircle> handle;
  handle->SetCenter(1.0, 0.0, 0.0);
  handle->SetNormal(0.0, 1.0, 0.0);
  handle->SetRadius(0.5);
  handle->SetSurfaceRadius(0.12);
  handle->SetInfluenceRadius(0.4);
  vtkNew<vtkHybridTreePoint> upperEnd;
  upperEnd->SetCenter(0.9, 0.0, 0.5);
  vtkNew<vtkHybridTreePoint> lowerEnd;
  lowerEnd->SetCenter(0.9, 0.0, -0.5);
  vtkNew<vtkHybridTreeLocalBlend> withHandle;
  withHandle->SetInputConnection(0, body->GetOutputPort());
  withHandle->SetInputConnection(1, handle->GetOutputPort());
  withHandle->AddInputConnection(2, upperEnd->GetOutputPort());
  withHandle->AddInputConnection(2, lowerEnd->GetOutputPort());

  // The inside: any triangle mesh will do; this one is VTK's cylinder, stood upright.
  vtkNew<vtkCylinderSource> cylinder;
  cylinder->SetRadius(0.55);
  cylinder->SetHeight(2.4);
  cylinder->SetResolution(64);
  vtkNew<vtkHybridTreeAffineTransform> inside;
  inside->SetInputConnection(cylinder->GetOutputPort());
  inside->SetRotate(90.0, 0.0, 0.0);
  inside->SetTranslate(0.0, 0.0, 0.2);
  vtkNew<vtkHybridTreeBoolean> hollow;
  hollow->SetInputConnection(0, withHandle->GetOutputPort());
  hollow->SetInputConnection(1, inside->GetOutputPort());
  hollow->SetOperation(vtkHybridTreeBoolean::DIFFERENCE);

  // The lip: control points in the middle of the lattice pull one side outwards.
  vtkNew<vtkHybridTreeFreeFormDeformation> cup;
  cup->SetInputConnection(hollow->GetOutputPort());
  cup->SetLatticeDimensions(5, 5, 5);
  for (int j = 1; j < 4; ++j)
  {
    cup->AddDisplacement(1, j, 3, -0.8, 0.0, 0.0);
  }
  cup->SetEdgeLength(0.03);
  cup->Update();

  vtkPolyData* mesh = cup->GetOutput();
  if (mesh->GetNumberOfPolys() == 0)
  {
    return EXIT_FAILURE; // VTK has printed why
  }
  std::cout << mesh->GetNumberOfPolys() << " triangles; nodes between made "
            << hollow->GetNumberOfMeshings() + withHandle->GetNumberOfMeshings() << " meshes\n";

  vtkNew<vtkXMLPolyDataWriter> model;
  model->SetInputConnection(cup->GetOutputPort());
  model->SetFileName((folder + "cup.vtp").c_str());
  model->SetDataModeToBinary();
  vtkNew<vtkSTLWriter> triangles;
  triangles->SetInputConnection(cup->GetOutputPort());
  triangles->SetFileName((folder + "cup.stl").c_str());
  triangles->SetFileTypeToBinary();
  return model->Write() && triangles->Write() ? EXIT_SUCCESS : EXIT_FAILURE;
}

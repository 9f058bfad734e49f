// SPDX-License-Identifier: BSD-3-Clause
// HybridTree Mesh Field closes the holes of a scan, and what is known of the scan stays with it.
#include "tests/filters/Support.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkHybridTreeBlend.h"
#include "vtkHybridTreeMeshField.h"
#include "vtkPointData.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree::test
{
namespace
{

/// A fine sphere without its cap, with the height of each point and each cell.
vtkSmartPointer<vtkPolyData> openSphere()
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(60);
  source->SetPhiResolution(60);
  source->SetStartPhi(40.0);
  source->Update();
  auto sphere = vtkSmartPointer<vtkPolyData>::New();
  sphere->ShallowCopy(source->GetOutput());
  for (vtkDataSetAttributes* data : { static_cast<vtkDataSetAttributes*>(sphere->GetPointData()),
         static_cast<vtkDataSetAttributes*>(sphere->GetCellData()) })
  {
    const bool points = data == sphere->GetPointData();
    vtkNew<vtkDoubleArray> height;
    height->SetName("Height");
    const vtkIdType count = points ? sphere->GetNumberOfPoints() : sphere->GetNumberOfCells();
    for (vtkIdType k = 0; k < count; ++k)
    {
      double bounds[6];
      points ? sphere->GetPoint(k, bounds) : sphere->GetCellBounds(k, bounds);
      height->InsertNextValue(points ? bounds[2] : bounds[4]);
    }
    data->AddArray(height);
  }
  return sphere;
}

TEST(CloseHoles, MakesASolidOfAScan)
{
  const auto sphere = openSphere();
  vtkNew<vtkHybridTreeMeshField> field;
  field->SetInputData(sphere);
  const Messages messages(field);
  field->Update();
  EXPECT_NE(messages.warnings.find("CloseHoles of HybridTree Mesh Field"), std::string::npos)
    << messages.warnings;
  const vtkIdType open = field->GetOutput()->GetNumberOfCells();

  field->CloseHolesOn();
  const Messages afterwards(field);
  field->Update();
  EXPECT_EQ(afterwards.warnings, "");
  vtkPolyData* closed = field->GetOutput();
  expectSolid(closed);
  EXPECT_EQ(closed->GetNumberOfCells(), open + 58); // 60 edges around
  vtkDataArray* height = closed->GetPointData()->GetArray("Height");
  ASSERT_TRUE(height);
  for (vtkIdType k = 0; k < closed->GetNumberOfPoints(); ++k)
  {
    ASSERT_NEAR(height->GetTuple1(k), closed->GetPoint(k)[2], 1e-12) << "point " << k;
  }
  vtkDataArray* lowest = closed->GetCellData()->GetArray("Height");
  ASSERT_TRUE(lowest);
  for (vtkIdType k = 0; k < closed->GetNumberOfCells(); ++k)
  {
    EXPECT_EQ(std::isnan(lowest->GetTuple1(k)), k >= open) << "cell " << k;
  }

  field->CloseHolesOff();
  field->Update();
  EXPECT_EQ(field->GetOutput()->GetNumberOfCells(), open);
}

TEST(CloseHoles, LetsBlendsKeepTheTrianglesOfAScan)
{
  vtkNew<vtkHybridTreeMeshField> field;
  field->SetInputData(openSphere());
  field->SetInfluenceRadius(0.05);
  field->CloseHolesOn();
  vtkNew<vtkHybridTreePoint> nose;
  nose->SetCenter(0.5, 0.0, 0.0);
  nose->SetSurfaceRadius(0.1);
  nose->SetInfluenceRadius(0.15);
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputConnection(field->GetOutputPort());
  blend->AddInputConnection(nose->GetOutputPort());
  const Messages messages(blend);
  blend->Update();
  EXPECT_EQ(messages.warnings, "");
  expectSolid(blend->GetOutput());
  vtkDataArray* height = blend->GetOutput()->GetPointData()->GetArray("Height");
  ASSERT_TRUE(height);
  vtkIdType kept = 0;
  for (vtkIdType k = 0; k < height->GetNumberOfTuples(); ++k)
  {
    kept += !std::isnan(height->GetTuple1(k));
  }
  EXPECT_GT(kept, 0.7 * field->GetInput()->GetNumberOfElements(vtkDataObject::POINT));
}

} // namespace
} // namespace hybridtree::test

// SPDX-License-Identifier: BSD-3-Clause
// What a blend makes anew has the values of the mesh that reaches there.
#include "tests/filters/Support.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkHybridTreeAffineTransform.h"
#include "vtkHybridTreeBlend.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkSphereSource.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree::test
{
namespace
{

/// A sphere of radius 0.5 around the origin, with the height of each point, and 1 in each cell.
vtkSmartPointer<vtkPolyData> heightSphere()
{
  vtkNew<vtkSphereSource> source;
  source->SetThetaResolution(48);
  source->SetPhiResolution(48);
  source->Update();
  auto sphere = vtkSmartPointer<vtkPolyData>::New();
  sphere->CopyStructure(source->GetOutput());
  vtkNew<vtkDoubleArray> height;
  height->SetName("Height");
  for (vtkIdType k = 0; k < sphere->GetNumberOfPoints(); ++k)
  {
    height->InsertNextValue(sphere->GetPoint(k)[2]);
  }
  vtkNew<vtkIntArray> one;
  one->SetName("One");
  one->SetNumberOfTuples(sphere->GetNumberOfCells());
  one->Fill(1.0);
  sphere->GetPointData()->AddArray(height);
  sphere->GetCellData()->AddArray(one);
  return sphere;
}

TEST(ReachedArrays, AreThoseOfTheNearestPlaceWhereverTheMeshReaches)
{
  for (const int method : { 1, 2, 3 }) // the shape and its values are the same for all
  {
    vtkNew<vtkHybridTreeAffineTransform> moved;
    moved->SetInputData(heightSphere());
    moved->SetTranslate(0.0, 0.0, 1.0);
    moved->SetScale(2.0, 2.0, 2.0);
    vtkNew<vtkHybridTreeSegment> bar; // reaches all of the sphere, and far out of it
    bar->SetPoint1(0.0, 0.0, 1.0);
    bar->SetPoint2(6.0, 0.0, 1.0);
    bar->SetSurfaceRadius(0.4);
    bar->SetInfluenceRadius(2.0);
    vtkNew<vtkHybridTreeBlend> blend;
    blend->AddInputConnection(bar->GetOutputPort());
    blend->AddInputConnection(moved->GetOutputPort());
    blend->SetMethod(method);
    blend->Update();
    vtkPolyData* output = blend->GetOutput();
    vtkDataArray* height = output->GetPointData()->GetArray("Height");
    ASSERT_TRUE(height);
    vtkIdType known = 0;
    for (vtkIdType k = 0; k < output->GetNumberOfPoints(); ++k)
    {
      const Vec3 p(output->GetPoint(k));
      const Vec3 fromCenter = p - Vec3(0.0, 0.0, 1.0);
      const double reach = fromCenter.norm() - 1.0; // ends at a tenth of the diagonal, 0.35
      if (reach < 0.33)
      {
        ASSERT_NEAR(height->GetTuple1(k), 0.5 * fromCenter.z() / fromCenter.norm(), 0.01)
          << "method " << method << ", point " << p.transpose();
        ++known;
      }
      if (reach > 0.36)
      {
        ASSERT_TRUE(std::isnan(height->GetTuple1(k))) << p.transpose();
      }
    }
    EXPECT_GT(known, 500);
    EXPECT_LT(known, output->GetNumberOfPoints());
    vtkDataArray* one = output->GetCellData()->GetArray("One");
    ASSERT_TRUE(one);
    for (vtkIdType k = 0; k < output->GetNumberOfCells(); ++k)
    {
      double box[6];
      output->GetCellBounds(k, box);
      ASSERT_TRUE(box[1] > 0.9 || one->GetTuple1(k) == 1.0) << "cell " << k;
      ASSERT_TRUE(box[0] < 2.0 || one->GetTuple1(k) == 0.0) << "cell " << k;
    }
  }
}

} // namespace
} // namespace hybridtree::test

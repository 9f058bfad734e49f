// SPDX-License-Identifier: BSD-3-Clause
// Ranges and bounds of the outputs' arrays, which are found at once (vtkHybridTreeRangedArray.h),
// are those that VTK finds.
#include "tests/filters/Support.h"

#include "core/base/Parallel.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkHybridTreeBlend.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkTypeInt32Array.h"

#include <gtest/gtest.h>

#include <array>

namespace hybridtree::test
{
namespace
{

/// More points than one thread looks at.
vtkSmartPointer<vtkPolyData> fineBlend()
{
  vtkNew<vtkHybridTreeBlend> blend;
  const auto a = ball();
  const auto b = rod();
  blend->AddInputConnection(a->GetOutputPort());
  blend->AddInputConnection(b->GetOutputPort());
  blend->SetEdgeLength(0.006);
  blend->Update();
  return blend->GetOutput();
}

/// Copied value by value: an array of VTK's own that knows nothing of its ranges.
vtkSmartPointer<vtkDataArray> plain(vtkDataArray* array)
{
  const vtkSmartPointer<vtkDataArray> copy = vtk::TakeSmartPointer(array->NewInstance());
  copy->SetNumberOfComponents(array->GetNumberOfComponents());
  copy->InsertTuples(0, array->GetNumberOfTuples(), 0, array);
  return copy;
}

using Range = std::array<double, 2>;

Range rangeOf(vtkDataArray* array, int component)
{
  Range range{};
  array->GetRange(range.data(), component);
  return range;
}

Range finiteRangeOf(vtkDataArray* array, int component)
{
  Range range{};
  array->GetFiniteRange(range.data(), component);
  return range;
}

void expectRangesOfVtk(vtkDataArray* array)
{
  SCOPED_TRACE(array->GetName());
  const vtkSmartPointer<vtkDataArray> other = plain(array);
  for (int c = 0; c < array->GetNumberOfComponents(); ++c)
  {
    EXPECT_EQ(rangeOf(array, c), rangeOf(other, c)) << "component " << c;
    EXPECT_EQ(finiteRangeOf(array, c), finiteRangeOf(other, c)) << "component " << c;
  }
  for (int k = 0; k < 2; ++k)
  {
    EXPECT_DOUBLE_EQ(rangeOf(array, -1)[k], rangeOf(other, -1)[k]);
    EXPECT_DOUBLE_EQ(finiteRangeOf(array, -1)[k], finiteRangeOf(other, -1)[k]);
  }
}

vtkDataArray* sourceIdOf(vtkPolyData* data)
{
  return data->GetCellData()->GetArray("SourceId");
}

TEST(Ranges, AreThoseOfVtk)
{
  for (const int threads : { 1, 2 })
  {
    setThreadCount(threads);
    const auto mesh = fineBlend();
    ASSERT_GT(mesh->GetNumberOfPoints(), 40000);
    expectRangesOfVtk(mesh->GetPoints()->GetData());
    expectRangesOfVtk(mesh->GetPointData()->GetNormals());
    expectRangesOfVtk(sourceIdOf(mesh));
  }
  setThreadCount(0);
}

TEST(Ranges, BoundsAreThoseOfVtk)
{
  const auto mesh = fineBlend();
  vtkNew<vtkPoints> points;
  points->SetData(plain(mesh->GetPoints()->GetData()));
  for (int k = 0; k < 6; ++k)
  {
    EXPECT_EQ(mesh->GetBounds()[k], points->GetBounds()[k]);
  }
}

TEST(Ranges, FollowWhatChanges)
{
  const auto mesh = fineBlend();
  vtkDataArray* const normals = mesh->GetPointData()->GetNormals();
  const Range before = rangeOf(normals, 2);
  normals->SetNumberOfTuples(5);
  normals->Modified();
  EXPECT_NE(rangeOf(normals, 2), before);
  expectRangesOfVtk(normals);
  normals->SetNumberOfTuples(0);
  normals->Modified();
  EXPECT_EQ(rangeOf(normals, 0), rangeOf(plain(normals), 0));
}

TEST(Ranges, CopiesAreArraysOfVtk)
{
  const auto mesh = fineBlend();
  EXPECT_STREQ(mesh->GetPointData()->GetNormals()->GetClassName(), "vtkDoubleArray");
  EXPECT_STREQ(sourceIdOf(mesh)->GetClassName(), vtkNew<vtkTypeInt32Array>()->GetClassName());
  vtkNew<vtkPolyData> copy;
  copy->DeepCopy(mesh);
  copy->GetPointData()->GetNormals()->SetComponent(0, 0, 17.0);
  copy->GetPointData()->GetNormals()->Modified();
  EXPECT_EQ(rangeOf(copy->GetPointData()->GetNormals(), 0)[1], 17.0);
  EXPECT_LE(rangeOf(mesh->GetPointData()->GetNormals(), 0)[1], 1.0);
  expectRangesOfVtk(copy->GetPoints()->GetData());
}

} // namespace
} // namespace hybridtree::test

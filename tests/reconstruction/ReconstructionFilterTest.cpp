// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeReconstruction.h"

#include "core/nodes/Node.h"
#include "tests/reconstruction/Samples.h"
#include "vtkCommand.h"
#include "vtkDataArray.h"
#include "vtkExecutive.h"
#include "vtkFloatArray.h"
#include "vtkHybridTreeArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTestErrorObserver.h"

#include <gtest/gtest.h>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

void fill(vtkPointSet* data, const std::vector<Vec3>& source, int type)
{
  vtkNew<vtkPoints> points;
  points->SetDataType(type);
  vtkNew<vtkFloatArray> number;
  number->SetName("Number");
  for (const Vec3& p : source)
  {
    number->InsertNextValue(static_cast<float>(points->InsertNextPoint(p.data())));
  }
  data->SetPoints(points);
  data->GetPointData()->AddArray(number);
}

TEST(ReconstructionFilter, MakesALiveMeshOfThePoints)
{
  for (const int type : { VTK_FLOAT, VTK_DOUBLE })
  {
    vtkNew<vtkPolyData> input;
    fill(input, randomTorus(1.0, 0.4, 4000, 1), type);
    vtkNew<vtkHybridTreeReconstruction> filter;
    filter->SetInputData(input);
    filter->Update();
    vtkPolyData* output = filter->GetOutput();
    ASSERT_GT(output->GetNumberOfPolys(), 7000);
    EXPECT_EQ(output->GetPoints()->GetDataType(), type);
    auto* ids = vtkIdTypeArray::SafeDownCast(output->GetPointData()->GetArray("PointIds"));
    auto* numbers = output->GetPointData()->GetArray("Number");
    ASSERT_TRUE(ids && numbers && output->GetPointData()->GetNormals());
    for (vtkIdType k = 0; k < output->GetNumberOfPoints(); ++k)
    {
      double here[3];
      double there[3];
      output->GetPoint(k, here);
      input->GetPoint(ids->GetValue(k), there);
      ASSERT_TRUE(std::equal(here, here + 3, there)) << "vertex " << k;
      ASSERT_EQ(numbers->GetTuple1(k), ids->GetValue(k));
    }
    EXPECT_NE(vtkHybridTreeArray::FindTree(output), nullptr);
  }
}

TEST(ReconstructionFilter, ThinsAndCleans)
{
  std::vector<Vec3> points = randomSphere(5000, 2);
  points.push_back({ 0.0, 0.0, 30.0 });
  vtkNew<vtkPolyData> input;
  fill(input, points, VTK_DOUBLE);
  vtkNew<vtkHybridTreeReconstruction> filter;
  filter->SetInputData(input);
  filter->SetSpacing(0.1);
  filter->RemoveOutliersOn();
  filter->Update();
  EXPECT_LT(filter->GetOutput()->GetNumberOfPoints(), 2000);
  EXPECT_GT(filter->GetOutput()->GetNumberOfPoints(), 500);
  EXPECT_LT(filter->GetOutput()->GetBounds()[5], 2.0);
}

TEST(ReconstructionFilter, TakesAnyDataSet)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(5, 5, 5);
  vtkNew<vtkHybridTreeReconstruction> filter;
  filter->SetInputData(image);
  filter->Update();
  EXPECT_GT(filter->GetOutput()->GetNumberOfPolys(), 0);
}

TEST(ReconstructionFilter, SaysWhatIsWrong)
{
  vtkNew<vtkPolyData> input;
  fill(input, { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } }, VTK_DOUBLE);
  vtkNew<vtkHybridTreeReconstruction> filter;
  vtkNew<vtkTest::ErrorObserver> errors;
  vtkNew<vtkTest::ErrorObserver> executive;
  filter->AddObserver(vtkCommand::ErrorEvent, errors);
  filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, executive);
  filter->SetInputData(input);
  filter->Update();
  EXPECT_NE(errors->GetErrorMessage().find("at least 4"), std::string::npos);
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
  errors->Clear();
  fill(input, randomSphere(100, 3), VTK_DOUBLE);
  filter->SetSpacing(-1.0);
  filter->Update();
  EXPECT_NE(errors->GetErrorMessage().find("Spacing"), std::string::npos);
}

} // namespace

// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHybridTreeProbe.h"

#include "tests/filters/Support.h"

#include "vtkAppendFilter.h"
#include "vtkDataSet.h"
#include "vtkHybridTreeBlend.h"
#include "vtkImageAlgorithm.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSphereSource.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree::test
{
namespace
{

/// Expects the four arrays to be those of a ball of radius 0.5 around the origin.
void expectBall(vtkDataSet* data)
{
  vtkPointData* values = data->GetPointData();
  vtkDataArray* field = values->GetArray("Field");
  vtkDataArray* gradient = values->GetArray("Gradient");
  vtkDataArray* membership = values->GetArray("Membership");
  vtkDataArray* distance = values->GetArray("SignedDistance");
  ASSERT_TRUE(field && gradient && membership && distance);
  const double top = kThreshold / std::pow(1.0 - 0.25, 2);
  for (vtkIdType k = 0; k < data->GetNumberOfPoints(); ++k)
  {
    const Vec3 p(data->GetPoint(k));
    const double r = p.norm();
    const double inside = std::max(0.0, 1.0 - r * r);
    ASSERT_NEAR(field->GetTuple1(k), top * inside * inside, 1e-12);
    ASSERT_NEAR((Vec3(gradient->GetTuple3(k)) + 4.0 * top * inside * p).norm(), 0.0, 1e-9);
    ASSERT_NEAR(distance->GetTuple1(k), r - 0.5, 1e-12);
    if (std::abs(r - 0.5) > 1e-9)
    {
      ASSERT_EQ(membership->GetTuple1(k), r < 0.5 ? 1.0 : -1.0);
    }
  }
}

vtkNew<vtkImageData> grid()
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(13, 12, 11);
  image->SetOrigin(-1.2, -1.2, -1.2);
  image->SetSpacing(0.2, 0.21, 0.22);
  return image;
}

TEST(Probe, AnswersOnImageData)
{
  const auto a = ball();
  const auto image = grid();
  vtkNew<vtkHybridTreeProbe> probe;
  probe->SetInputConnection(0, a->GetOutputPort());
  probe->SetInputData(1, image);
  probe->Update();
  ASSERT_TRUE(vtkImageData::SafeDownCast(probe->GetOutputDataObject(0)));
  EXPECT_EQ(a->GetNumberOfMeshings(), 0) << "a probe needs no mesh";
  expectBall(vtkDataSet::SafeDownCast(probe->GetOutputDataObject(0)));
}

TEST(Probe, AnswersOnUnstructuredGridsAndPolyData)
{
  const auto a = ball();
  const auto image = grid();
  vtkNew<vtkAppendFilter> unstructured;
  unstructured->AddInputData(image);
  vtkNew<vtkHybridTreeProbe> probe;
  probe->SetInputConnection(0, a->GetOutputPort());
  probe->SetInputConnection(1, unstructured->GetOutputPort());
  probe->Update();
  ASSERT_TRUE(vtkUnstructuredGrid::SafeDownCast(probe->GetOutputDataObject(0)));
  expectBall(vtkDataSet::SafeDownCast(probe->GetOutputDataObject(0)));

  vtkNew<vtkSphereSource> sphere; // another type of output from the same filter
  probe->SetInputConnection(1, sphere->GetOutputPort());
  probe->Update();
  ASSERT_TRUE(vtkPolyData::SafeDownCast(probe->GetOutputDataObject(0)));
  expectBall(vtkDataSet::SafeDownCast(probe->GetOutputDataObject(0)));
}

/// A source that makes the part of a grid that is asked of it.
class GridSource : public vtkImageAlgorithm
{
public:
  static GridSource* New();
  vtkTypeMacro(GridSource, vtkImageAlgorithm);

protected:
  GridSource() { this->SetNumberOfInputPorts(0); }
  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    const int extent[6] = { -4, 4, -3, 3, -2, 2 };
    outputs->GetInformationObject(0)->Set(
      vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), extent, 6);
    return 1;
  }
  void ExecuteDataWithInformation(vtkDataObject* output, vtkInformation* info) override
  {
    vtkImageData* image = vtkImageData::SafeDownCast(output);
    image->SetExtent(vtkStreamingDemandDrivenPipeline::GetUpdateExtent(info));
    image->SetSpacing(0.25, 0.25, 0.25);
  }
};
vtkStandardNewMacro(GridSource);

TEST(Probe, AnImageSourceKeepsItsExtent)
{
  vtkNew<GridSource> source;
  const auto a = ball();
  vtkNew<vtkHybridTreeProbe> probe;
  probe->SetInputConnection(0, a->GetOutputPort());
  probe->SetInputConnection(1, source->GetOutputPort());
  probe->Update();
  auto* image = vtkImageData::SafeDownCast(probe->GetOutputDataObject(0));
  ASSERT_TRUE(image);
  EXPECT_EQ(image->GetNumberOfPoints(), 9 * 7 * 5);
  expectBall(image);
}

TEST(Probe, FollowsItsTree)
{
  const auto a = ball();
  const auto image = grid();
  vtkNew<vtkHybridTreeProbe> probe;
  probe->SetInputConnection(0, a->GetOutputPort());
  probe->SetInputData(1, image);
  a->SetCenter(0.3, 0.0, 0.0);
  probe->Update();
  a->SetCenter(0.0, 0.0, 0.0);
  probe->Update();
  expectBall(vtkDataSet::SafeDownCast(probe->GetOutputDataObject(0)));
}

TEST(Probe, SaysWhatItCannotTake)
{
  vtkNew<vtkPolyData> cloud;
  vtkNew<vtkPoints> points;
  points->InsertNextPoint(0.0, 0.0, 0.0);
  cloud->SetPoints(points);
  const auto image = grid();
  vtkNew<vtkHybridTreeProbe> probe;
  const Messages messages(probe);
  probe->SetInputData(0, cloud);
  probe->SetInputData(1, image);
  probe->Update();
  EXPECT_NE(messages.errors.find("Surface Reconstruction"), std::string::npos) << messages.errors;
}

} // namespace
} // namespace hybridtree::test

// SPDX-License-Identifier: BSD-3-Clause
// Inputs that change in time, whichever of them it is.
#include "tests/filters/Support.h"

#include "vtkHybridTreeBlend.h"
#include "vtkHybridTreeBoolean.h"
#include "vtkHybridTreeProbe.h"
#include "vtkHybridTreeTwist.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSphereSource.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hybridtree::test
{
namespace
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

/// A ball that grows: at times First, First + 1 and First + 2 of radius 0.3, 0.4 and 0.5.
class GrowingBall : public vtkPolyDataAlgorithm
{
public:
  static GrowingBall* New();
  vtkTypeMacro(GrowingBall, vtkPolyDataAlgorithm);
  double First = 0.0;

protected:
  GrowingBall() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(
    vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    const double steps[3] = { this->First, this->First + 1.0, this->First + 2.0 };
    const double range[2] = { steps[0], steps[2] };
    outputs->GetInformationObject(0)->Set(Pipeline::TIME_STEPS(), steps, 3);
    outputs->GetInformationObject(0)->Set(Pipeline::TIME_RANGE(), range, 2);
    return 1;
  }

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs) override
  {
    vtkInformation* info = outputs->GetInformationObject(0);
    const double time = info->Get(Pipeline::UPDATE_TIME_STEP());
    vtkNew<vtkSphereSource> sphere;
    sphere->SetThetaResolution(24);
    sphere->SetPhiResolution(24);
    sphere->SetRadius(0.3 + 0.1 * std::min(std::max(time - this->First, 0.0), 2.0));
    sphere->Update();
    vtkPolyData::GetData(info)->ShallowCopy(sphere->GetOutput());
    return 1;
  }
};
vtkStandardNewMacro(GrowingBall);

std::vector<double> stepsOf(vtkAlgorithm* filter)
{
  filter->UpdateInformation();
  vtkInformation* info = filter->GetOutputInformation(0);
  const double* steps = info->Get(Pipeline::TIME_STEPS());
  return std::vector<double>(steps, steps + info->Length(Pipeline::TIME_STEPS()));
}

/// Whether the point at 0.45 from the ball's middle is inside, at the beginning and at the end.
void expectGrowth(vtkHybridTreeAlgorithm* filter)
{
  const Vec3 place(0.0, 0.45, 0.0);
  for (const double time : { 0.0, 2.0, 1.0, 2.0, 0.0 })
  {
    filter->UpdateTimeStep(time);
    ASSERT_TRUE(filter->GetTree());
    EXPECT_EQ(fieldAt(*filter->GetTree(), place) > kThreshold, time == 2.0) << "at " << time;
  }
}

TEST(Time, EveryInputMayChange)
{
  vtkNew<GrowingBall> growing;
  const auto aside = ball(5.0);
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputConnection(aside->GetOutputPort());
  blend->AddInputConnection(growing->GetOutputPort());
  expectGrowth(blend);
  vtkNew<vtkHybridTreeBoolean> both;
  both->SetInputConnection(0, aside->GetOutputPort());
  both->SetInputConnection(1, growing->GetOutputPort());
  expectGrowth(both);
  vtkNew<vtkHybridTreeTwist> twist;
  twist->SetInputConnection(both->GetOutputPort());
  twist->SetAngle(0.0);
  expectGrowth(twist);
}

TEST(Time, StepsOfAllInputsAreTheOutputs)
{
  vtkNew<GrowingBall> early;
  vtkNew<GrowingBall> late;
  late->First = 1.5;
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputConnection(ball()->GetOutputPort());
  EXPECT_TRUE(stepsOf(blend).empty());
  blend->AddInputConnection(late->GetOutputPort());
  blend->AddInputConnection(early->GetOutputPort());
  EXPECT_EQ(stepsOf(blend), (std::vector<double>{ 0.0, 1.0, 1.5, 2.0, 2.5, 3.5 }));
  const double* range = blend->GetOutputInformation(0)->Get(Pipeline::TIME_RANGE());
  EXPECT_EQ(range[0], 0.0);
  EXPECT_EQ(range[1], 3.5);
}

TEST(Time, AProbeFollowsItsTree)
{
  vtkNew<GrowingBall> growing;
  vtkNew<vtkSphereSource> points;
  points->SetRadius(0.45);
  vtkNew<vtkHybridTreeProbe> probe;
  probe->SetInputConnection(0, growing->GetOutputPort());
  probe->SetInputConnection(1, points->GetOutputPort());
  for (const double time : { 0.0, 2.0, 0.0 })
  {
    probe->UpdateTimeStep(time);
    auto* output = vtkDataSet::SafeDownCast(probe->GetOutputDataObject(0));
    double range[2];
    output->GetPointData()->GetArray("Membership")->GetRange(range);
    EXPECT_EQ(range[0], time == 2.0 ? 1.0 : -1.0) << "at " << time;
  }
}

} // namespace
} // namespace hybridtree::test

// SPDX-License-Identifier: BSD-3-Clause
// What is known of the points of a scan stays known in the nodes above it.
#include "vtkHybridTreeReconstruction.h"

#include "tests/reconstruction/Samples.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkHybridTreeAffineTransform.h"
#include "vtkHybridTreeBlend.h"
#include "vtkHybridTreeBoolean.h"
#include "vtkHybridTreePoint.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkXMLPolyDataReader.h"
#include "vtkXMLPolyDataWriter.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

/// A torus with the height of each point, and a colour that is active.
vtkSmartPointer<vtkPolyData> colouredScan()
{
  auto scan = vtkSmartPointer<vtkPolyData>::New();
  vtkNew<vtkPoints> points;
  vtkNew<vtkFloatArray> height;
  height->SetName("Height");
  vtkNew<vtkUnsignedCharArray> colour;
  colour->SetName("RGB");
  colour->SetNumberOfComponents(3);
  for (const Vec3& p : randomTorus(1.0, 0.4, 3000, 1))
  {
    points->InsertNextPoint(p.data());
    height->InsertNextValue(static_cast<float>(p.z()));
    colour->InsertNextTuple3(p.z() > 0.0 ? 255.0 : 1.0, 2.0, 3.0);
  }
  scan->SetPoints(points);
  scan->GetPointData()->AddArray(height);
  scan->GetPointData()->SetScalars(colour);
  return scan;
}

vtkNew<vtkHybridTreeReconstruction> reconstructed()
{
  vtkNew<vtkHybridTreeReconstruction> surface;
  surface->SetInputData(colouredScan());
  return surface;
}

TEST(ReconstructedArrays, FollowThePointsThroughNodesAndFiles)
{
  const auto surface = reconstructed();
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetInputConnection(surface->GetOutputPort());
  writer->WriteToOutputStringOn();
  writer->SetDataModeToBinary();
  writer->Write();
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->ReadFromInputStringOn();
  reader->SetInputString(writer->GetOutputString());
  for (vtkAlgorithm* source :
    { static_cast<vtkAlgorithm*>(surface), static_cast<vtkAlgorithm*>(reader) })
  {
    vtkNew<vtkHybridTreeAffineTransform> move;
    move->SetInputConnection(source->GetOutputPort());
    move->SetTranslate(0.0, 0.0, 2.0);
    move->Update();
    vtkPolyData* output = move->GetOutput();
    vtkDataArray* height = output->GetPointData()->GetArray("Height");
    vtkDataArray* colour = output->GetPointData()->GetScalars();
    ASSERT_TRUE(height && colour);
    EXPECT_STREQ(colour->GetName(), "RGB");
    EXPECT_EQ(output->GetPointData()->GetArray("PointIds"), nullptr);
    for (vtkIdType k = 0; k < output->GetNumberOfPoints(); ++k)
    {
      ASSERT_NEAR(height->GetTuple1(k), output->GetPoint(k)[2] - 2.0, 1e-6) << "point " << k;
      ASSERT_EQ(colour->GetComponent(k, 0), height->GetTuple1(k) > 0.0 ? 255.0 : 1.0);
    }
  }
}

TEST(ReconstructedArrays, AreThereAfterACut)
{
  const auto surface = reconstructed();
  vtkNew<vtkHybridTreePoint> ball;
  ball->SetCenter(1.0, 0.0, 0.0);
  vtkNew<vtkHybridTreeBoolean> cut;
  cut->SetInputConnection(0, surface->GetOutputPort());
  cut->SetInputConnection(1, ball->GetOutputPort());
  cut->SetOperation(vtkHybridTreeBoolean::DIFFERENCE);
  cut->Update();
  vtkPolyData* output = cut->GetOutput();
  vtkDataArray* height = output->GetPointData()->GetArray("Height");
  ASSERT_TRUE(height);
  vtkIdType known = 0;
  for (vtkIdType k = 0; k < output->GetNumberOfPoints(); ++k)
  {
    if (!std::isnan(height->GetTuple1(k)))
    {
      ASSERT_NEAR(height->GetTuple1(k), output->GetPoint(k)[2], 1e-3)
        << "point " << k; // those of the cut are moved onto both surfaces
      ++known;
    }
  }
  EXPECT_GT(known, 2000); // all of the scan but what the ball has taken
}

} // namespace

// SPDX-License-Identifier: BSD-3-Clause
// What users type and connect: each fault gets an error that names it, and an empty output, or a
// stated repair.
#include "tests/filters/Support.h"

#include "vtkHybridTreeAffineTransform.h"
#include "vtkHybridTreeBend.h"
#include "vtkHybridTreeBlend.h"
#include "vtkHybridTreeBoolean.h"
#include "vtkHybridTreeBox.h"
#include "vtkHybridTreeCircle.h"
#include "vtkHybridTreeCurveSkeletons.h"
#include "vtkHybridTreeFreeFormDeformation.h"
#include "vtkHybridTreePoint.h"
#include "vtkHybridTreeSurfaceOfRevolution.h"
#include "vtkHybridTreeTaper.h"
#include "vtkHybridTreeTwist.h"
#include "vtkImageData.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <limits>

namespace hybridtree::test
{
namespace
{

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(BadInput, WhatIsNoMeshIsToldHowToBecomeOne)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 3);
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputDataObject(0, image);
  expectError(blend, { "Input", "vtkImageData", "Contour", "Extract Surface" });
  vtkNew<vtkHybridTreeCurveSkeletons> curves;
  curves->SetInputDataObject(0, image);
  expectError(curves, { "vtkImageData", "Extract Surface" });

  vtkNew<vtkTable> table;
  vtkNew<vtkHybridTreeBlend> two;
  two->AddInputConnection(ball()->GetOutputPort());
  two->AddInputDataObject(0, table);
  expectError(two, { "Input 2", "vtkTable", "Table To Points" });
  curves->SetInputDataObject(0, table);
  expectError(curves, { "vtkTable", "Table To Points" });
}

TEST(BadInput, Parameters)
{
  const auto a = ball();
  a->SetSurfaceRadius(1.0); // R = r_T
  expectError(a, { "SurfaceRadius", "1", "InfluenceRadius" });
  a->SetSurfaceRadius(0.5);
  a->SetExponent(1);
  expectError(a, { "Exponent", "1", "from 2 to 64" });
  a->SetExponent(2);
  a->SetInfluenceRadius(kNaN);
  expectError(a, { "InfluenceRadius" });
  a->SetInfluenceRadius(1.0);
  a->SetCenter(0.0, kNaN, 0.0);
  expectError(a, { "Center", "nan", "finite" });
  a->SetCenter(0.0, 0.0, 0.0);
  a->SetFieldMode(vtkHybridTreeFieldAlgorithm::MAXIMUM_FIELD);
  a->SetMaximumField(-1.0);
  expectError(a, { "MaximumField", "-1", "Negative" });
  a->SetMaximumField(1.0);
  a->Update();
  expectSolid(a->GetOutput()); // and everything is well again

  vtkNew<vtkHybridTreeCircle> circle;
  circle->SetNormal(0.0, 0.0, 0.0);
  expectError(circle, { "ormal", "direction" });
}

TEST(BadInput, AnEdgeLengthTooSmallNamesTheMemory)
{
  const auto a = ball();
  const auto b = rod();
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputConnection(a->GetOutputPort());
  blend->AddInputConnection(b->GetOutputPort());
  blend->SetEdgeLength(1e-9);
  expectError(blend, { "edge length", "MiB of memory" });
  blend->SetEdgeLength(kNaN);
  expectError(blend, { "EdgeLength", "finite" });
}

TEST(BadInput, FramesAndMaps)
{
  const auto a = ball();
  vtkNew<vtkHybridTreeTwist> twist;
  twist->SetInputConnection(a->GetOutputPort());
  twist->SetAxis(0.0, 0.0, 0.0);
  expectError(twist, { "xis" });
  twist->SetAxis(1.0, 0.0, 0.0); // along the normal, which a twist has no use for
  twist->Update();
  expectSolid(twist->GetOutput());
  twist->SetAxis(0.0, 0.0, 1.0);
  twist->SetRange(1.0, -1.0);
  expectError(twist, { "ange" });

  vtkNew<vtkHybridTreeTaper> taper;
  taper->SetInputConnection(a->GetOutputPort());
  taper->SetFactor(0.0);
  expectError(taper, { "actor", "0" });

  vtkNew<vtkHybridTreeBend> bend;
  bend->SetInputConnection(a->GetOutputPort());
  bend->SetAngle(400.0);
  expectError(bend, { "ngle" });
  bend->SetAngle(45.0);
  bend->SetAxis(1.0, 0.0, 0.0);
  expectError(bend, { "ormal", "parallel" });

  vtkNew<vtkHybridTreeAffineTransform> map;
  map->SetInputConnection(a->GetOutputPort());
  map->SetScale(1.0, 0.0, 1.0);
  expectError(map, { "Scale", "0" });
  map->SetScale(1.0, kNaN, 1.0);
  expectError(map, { "finite" });
}

TEST(BadInput, Lattices)
{
  const auto a = ball();
  vtkNew<vtkHybridTreeFreeFormDeformation> ffd;
  ffd->SetInputConnection(a->GetOutputPort());
  ffd->SetLatticeDimensions(1, 3, 3);
  expectError(ffd, { "lattice dimension", "1", "between 2 and 64" });
  ffd->SetLatticeDimensions(3, 3, 3);
  ffd->AddDisplacement(0, 3, 0, 1, 1, 1);
  expectError(ffd, { "Index j of row 0", "3", "from 0 to 2" });
  ffd->ClearDisplacements();
  ffd->FitLatticeOff();
  const double flat[9] = { 1, 0, 0, 0, 1, 0, 1, 1, 0 };
  ffd->SetLatticeAxes(flat);
  expectError(ffd, { "lattice box is flat" });
}

TEST(BadInput, ControlPointsThatDoNotExist)
{
  const auto a = ball();
  vtkNew<vtkHybridTreeFreeFormDeformation> ffd;
  ffd->SetInputConnection(a->GetOutputPort());
  for (const double index : { 0.5, -1.0, 3.0, 1e300, kNaN })
  {
    ffd->ClearDisplacements();
    ffd->AddDisplacement(1, 1, 1, 0.1, 0, 0);
    ffd->AddDisplacement(1, 1, index, 0.1, 0, 0);
    expectError(ffd, { "Index k of row 1", "whole number from 0 to 2" });
  }
  ffd->SetNumberOfDisplacements(3);
  ffd->SetDisplacement(1, 1, 1, 1, 0.1, 0, 0);
  expectError(ffd, { "row 2", "six numbers" });
  ffd->SetDisplacement(2, 1, 1, 1, kNaN, 0, 0);
  expectError(ffd, { "not finite" });
  ffd->SetDisplacement(2, 1, 1, 1, 0.1, 0, 0);
  ffd->Update();
  expectSolid(ffd->GetOutput());
}

TEST(BadInput, ChoicesThatDoNotExist)
{
  const auto a = ball();
  const auto b = rod();
  a->SetFieldMode(2);
  expectError(a, { "FieldMode", "2", "0 (by the surface) or 1 (by MaximumField)" });
  a->SetFieldMode(0);
  a->SetEdgeLength(-1.0);
  expectError(a, { "EdgeLength", "-1", "> 0" });
  a->SetEdgeLength(0.0);

  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputConnection(a->GetOutputPort());
  blend->AddInputConnection(b->GetOutputPort());
  blend->SetMethod(4);
  expectError(blend, { "Method", "4", "3 (global)" });
  blend->SetMethod(0);
  blend->SetOverlapThreshold(1.5);
  expectError(blend, { "OverlapThreshold", "1.5", "[0, 1]" });

  vtkNew<vtkHybridTreeBoolean> boolean;
  boolean->SetInputConnection(0, a->GetOutputPort());
  boolean->SetInputConnection(1, b->GetOutputPort());
  boolean->SetOperation(3);
  expectError(boolean, { "Operation", "3", "2 (difference)" });
  boolean->SetOperation(0);
  boolean->SetForm(-1);
  expectError(boolean, { "Form", "-1", "0 (automatic)" });

  vtkNew<vtkHybridTreeFreeFormDeformation> ffd;
  ffd->SetInputConnection(a->GetOutputPort());
  ffd->SetFieldFrom(2);
  expectError(ffd, { "FieldFrom", "2", "1 (inverseMap)" });
}

TEST(BadInput, PrimitivesTooSmallForTheirBlendAreTold)
{
  const auto large = ball();
  vtkNew<vtkHybridTreePoint> small;
  small->SetCenter(0.0, 0.0, 0.6);
  small->SetSurfaceRadius(0.004);
  small->SetInfluenceRadius(0.008);
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputConnection(large->GetOutputPort());
  blend->AddInputConnection(small->GetOutputPort());
  Messages messages(blend);
  blend->Update();
  EXPECT_EQ(messages.warnings.find("Input 1"), std::string::npos) << messages.warnings;
  for (const char* word : { "Input 2", "0.008 across", "larger radii", "EdgeLength" })
  {
    EXPECT_NE(messages.warnings.find(word), std::string::npos) << messages.warnings;
  }
  messages.warnings.clear();
  blend->SetEdgeLength(0.005);
  blend->Update();
  small->SetSurfaceRadius(0.05);
  small->SetInfluenceRadius(0.1);
  blend->SetEdgeLength(0.0);
  blend->Update();
  EXPECT_EQ(messages.warnings, "");
}

// In an animation the number in the message is another at each step.
TEST(BadInput, ShapesThatComeOutEmptyAreTold)
{
  vtkNew<vtkHybridTreeSurfaceOfRevolution> ring; // 1 across, 1e6 from the axis
  ring->SetNumberOfPoints(3);
  ring->SetPoint(0, 1e6, 0.0, 0.0);
  ring->SetPoint(1, 1e6 + 1.0, 0.0, 0.5);
  ring->SetPoint(2, 1e6, 0.0, 1.0);
  ring->SetSolid(false);
  ring->SetKind(2); // straight
  ring->SetSurfaceRadius(0.1);
  const Messages ofRing(ring);
  ring->Update();
  ASSERT_EQ(ring->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_NE(ofRing.warnings.find("thinner than their edges"), std::string::npos);

  const auto a = ball();
  const auto far = ball(5.0);
  vtkNew<vtkHybridTreeBoolean> nothing;
  nothing->SetInputConnection(0, a->GetOutputPort());
  nothing->SetInputConnection(1, far->GetOutputPort());
  nothing->SetOperation(vtkHybridTreeBoolean::INTERSECTION);
  const Messages ofNothing(nothing);
  nothing->Update();
  ASSERT_EQ(nothing->GetOutput()->GetNumberOfPoints(), 0);
  EXPECT_EQ(ofNothing.warnings, "") << "as it has to be";
}

TEST(BadInput, AWarningThatChangesOnlyItsNumbersIsToldOnce)
{
  vtkNew<vtkHybridTreeBox> box;
  box->SetLengths(8.0, 8.0, 1.0);
  vtkNew<vtkHybridTreeBend> bend;
  bend->SetInputConnection(box->GetOutputPort());
  Messages messages(bend);
  bend->SetAngle(120.0);
  bend->Update();
  EXPECT_NE(messages.warnings.find("centre line"), std::string::npos) << messages.warnings;
  messages.warnings.clear();
  bend->SetAngle(121.0);
  bend->Update();
  EXPECT_EQ(messages.warnings, "");
  bend->SetAngle(1.0);
  bend->Update();
  EXPECT_EQ(messages.warnings, "");
  bend->SetAngle(120.0);
  bend->Update();
  EXPECT_NE(messages.warnings, "") << "it had been mended in between";
}

} // namespace
} // namespace hybridtree::test

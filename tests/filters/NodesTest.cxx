// SPDX-License-Identifier: BSD-3-Clause
// Each filter by itself: what it makes by default, and what its properties mean.
#include "tests/filters/Support.h"

#include "vtkCell.h"
#include "vtkHybridTreeAffineTransform.h"
#include "vtkHybridTreeBend.h"
#include "vtkHybridTreeBlend.h"
#include "vtkHybridTreeBoolean.h"
#include "vtkHybridTreeBox.h"
#include "vtkHybridTreeCircle.h"
#include "vtkHybridTreeCone.h"
#include "vtkHybridTreeConeSphere.h"
#include "vtkHybridTreeCylinder.h"
#include "vtkHybridTreeDisc.h"
#include "vtkHybridTreeEllipsoid.h"
#include "vtkHybridTreeFreeFormDeformation.h"
#include "vtkHybridTreeHollowCylinder.h"
#include "vtkHybridTreeLocalBlend.h"
#include "vtkHybridTreeMeshField.h"
#include "vtkHybridTreePolygon.h"
#include "vtkHybridTreeRectangle.h"
#include "vtkHybridTreeTaper.h"
#include "vtkHybridTreeTriangle.h"
#include "vtkHybridTreeTwist.h"
#include "vtkMath.h"
#include "vtkSphereSource.h"
#include "vtkTransform.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

namespace hybridtree::test
{
namespace
{

TEST(Nodes, SourcesAreSolidByDefault)
{
  vtkNew<vtkHybridTreePoint> point;
  vtkNew<vtkHybridTreeSegment> segment;
  vtkNew<vtkHybridTreeCircle> circle;
  vtkNew<vtkHybridTreeBox> box;
  vtkNew<vtkHybridTreeDisc> disc;
  vtkNew<vtkHybridTreeCylinder> cylinder;
  vtkNew<vtkHybridTreeHollowCylinder> tube;
  vtkNew<vtkHybridTreeCone> cone;
  vtkNew<vtkHybridTreeConeSphere> limb;
  vtkNew<vtkHybridTreeRectangle> rectangle;
  vtkNew<vtkHybridTreeTriangle> triangle;
  vtkNew<vtkHybridTreePolygon> polygon;
  vtkNew<vtkHybridTreeEllipsoid> ellipsoid;
  for (vtkHybridTreeAlgorithm* source :
    { static_cast<vtkHybridTreeAlgorithm*>(point), static_cast<vtkHybridTreeAlgorithm*>(segment),
      static_cast<vtkHybridTreeAlgorithm*>(circle), static_cast<vtkHybridTreeAlgorithm*>(box),
      static_cast<vtkHybridTreeAlgorithm*>(disc), static_cast<vtkHybridTreeAlgorithm*>(cylinder),
      static_cast<vtkHybridTreeAlgorithm*>(tube), static_cast<vtkHybridTreeAlgorithm*>(cone),
      static_cast<vtkHybridTreeAlgorithm*>(limb), static_cast<vtkHybridTreeAlgorithm*>(rectangle),
      static_cast<vtkHybridTreeAlgorithm*>(triangle), static_cast<vtkHybridTreeAlgorithm*>(polygon),
      static_cast<vtkHybridTreeAlgorithm*>(ellipsoid) })
  {
    SCOPED_TRACE(source->GetClassName());
    source->Update();
    expectSolid(source->GetOutput());
    EXPECT_EQ(source->GetOutput()->GetPoints()->GetDataType(), VTK_DOUBLE);
  }
}

TEST(Nodes, PlatesAndEllipsoidsAreWhatTheirPropertiesSay)
{
  const double r = 0.1;
  const auto expectVolume = [](vtkHybridTreeAlgorithm* source, double volume)
  {
    source->SetEdgeLength(0.03);
    source->Update();
    EXPECT_NEAR(signedVolume(trianglesOf(source->GetOutput())), volume, 0.01 * volume)
      << source->GetClassName();
  };
  const auto plate = [r](double area, double outline)
  { return 2.0 * r * area + 0.5 * EIGEN_PI * r * r * outline + 4.0 / 3.0 * EIGEN_PI * r * r * r; };
  vtkNew<vtkHybridTreeRectangle> rectangle;
  rectangle->SetOrigin(1.0, 2.0, 3.0);
  rectangle->SetPoint1(3.0, 2.0, 3.0);
  rectangle->SetPoint2(1.0, 2.0, 4.0);
  expectVolume(rectangle, plate(2.0, 6.0));
  vtkNew<vtkHybridTreeTriangle> triangle;
  triangle->SetPoint1(0.0, 0.0, 1.0);
  triangle->SetPoint2(0.3, 0.0, 1.0);
  triangle->SetPoint3(0.0, 0.4, 1.0);
  expectVolume(triangle, plate(0.06, 1.2));
  vtkNew<vtkHybridTreePolygon> polygon;
  EXPECT_EQ(polygon->GetNumberOfPoints(), 6);
  polygon->SetNumberOfPoints(4);
  polygon->SetPoint(2, 0.5, 0.5, 0.0);
  polygon->SetPoint(3, -0.5, 0.5, 0.0);
  expectVolume(polygon, plate(1.0, 4.0));
  vtkNew<vtkHybridTreeEllipsoid> ellipsoid;
  ellipsoid->SetRadii(0.5, 0.3, 0.8);
  ellipsoid->SetRotation(10.0, 20.0, 30.0);
  ellipsoid->SetSurfaceRadius(0.0);
  expectVolume(ellipsoid, 4.0 / 3.0 * EIGEN_PI * 0.5 * 0.3 * 0.8);
}

TEST(Nodes, APolygonThatMeetsItselfIsAnErrorThatSaysSo)
{
  vtkNew<vtkHybridTreePolygon> polygon;
  polygon->SetNumberOfPoints(4);
  polygon->SetPoint(2, -0.5, 0.5, 0.0);
  polygon->SetPoint(3, 0.4, 0.5, 0.0);
  const Messages messages(polygon);
  polygon->Update();
  EXPECT_NE(messages.errors.find("does not meet itself"), std::string::npos) << messages.errors;
  EXPECT_EQ(polygon->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(Nodes, OperatorsAndWarpsAreSolidByDefaultAtAnySizeAndPlace)
{
  for (const double size : { 1e-3, 1.0, 1e4 })
  {
    SCOPED_TRACE(size);
    vtkNew<vtkSphereSource> a;
    a->SetRadius(size);
    a->SetCenter(20.0 * size, 0.0, 5.0 * size);
    vtkNew<vtkSphereSource> b;
    b->SetRadius(size);
    b->SetCenter(20.0 * size, size, 5.0 * size);
    vtkNew<vtkHybridTreeMeshField> field;
    vtkNew<vtkHybridTreeBlend> blend;
    vtkNew<vtkHybridTreeLocalBlend> local;
    vtkNew<vtkHybridTreeBoolean> both;
    vtkNew<vtkHybridTreeTwist> twist;
    vtkNew<vtkHybridTreeTaper> taper;
    vtkNew<vtkHybridTreeBend> bend;
    vtkNew<vtkHybridTreeAffineTransform> map;
    vtkNew<vtkHybridTreeFreeFormDeformation> ffd;
    for (vtkHybridTreeAlgorithm* filter : { static_cast<vtkHybridTreeAlgorithm*>(field),
           static_cast<vtkHybridTreeAlgorithm*>(blend), static_cast<vtkHybridTreeAlgorithm*>(local),
           static_cast<vtkHybridTreeAlgorithm*>(both), static_cast<vtkHybridTreeAlgorithm*>(twist),
           static_cast<vtkHybridTreeAlgorithm*>(taper), static_cast<vtkHybridTreeAlgorithm*>(bend),
           static_cast<vtkHybridTreeAlgorithm*>(map), static_cast<vtkHybridTreeAlgorithm*>(ffd) })
    {
      SCOPED_TRACE(filter->GetClassName());
      for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
      {
        filter->SetInputConnection(port, (port == 1 ? b : a)->GetOutputPort());
      }
      filter->SetEdgeLength(0.15 * size);
      const Messages messages(filter);
      filter->Update();
      EXPECT_EQ(messages.errors + messages.warnings, "");
      expectSolid(filter->GetOutput());
    }
  }
}

TEST(Nodes, NegativeOnesCarve)
{
  const auto a = ball();
  const auto b = ball(0.5);
  b->SetSurfaceRadius(0.3);
  b->NegativeOn();
  b->Update();
  EXPECT_EQ(b->GetOutput()->GetNumberOfPoints(), 0);
  vtkNew<vtkHybridTreeBlend> blend;
  blend->AddInputConnection(a->GetOutputPort());
  blend->AddInputConnection(b->GetOutputPort());
  blend->SetEdgeLength(0.05);
  blend->Update();
  a->Update();
  EXPECT_LT(signedVolume(trianglesOf(blend->GetOutput())),
    0.95 * signedVolume(trianglesOf(a->GetOutput())));
}

TEST(Nodes, BlendTakesAnyNumberOfInputs)
{
  vtkNew<vtkHybridTreeBlend> blend;
  for (int k = 0; k < 5; ++k)
  {
    blend->AddInputConnection(ball(0.6 * k)->GetOutputPort());
    blend->SetEdgeLength(0.15);
    blend->Update();
    EXPECT_EQ(blend->GetTree()->leafCount(), k + 1);
    expectSolid(blend->GetOutput());
  }
  blend->RemoveInputConnection(0, blend->GetInputConnection(0, 4));
  blend->Update();
  EXPECT_EQ(blend->GetTree()->leafCount(), 4);
}

TEST(Nodes, RegionsOfALocalBlendAreUnited)
{
  const auto a = ball(0.0);
  const auto b = ball(1.1);
  const auto nowhere = ball(50.0);
  const auto between = ball(0.55);
  vtkNew<vtkHybridTreeLocalBlend> local;
  local->SetInputConnection(0, a->GetOutputPort());
  local->SetInputConnection(1, b->GetOutputPort());
  local->SetInputConnection(2, nowhere->GetOutputPort());
  local->SetEdgeLength(0.1);
  const Vec3 middle(0.55, 0.0, 0.0);
  local->Update();
  EXPECT_LT(fieldAt(*local->GetTree(), middle), kThreshold);
  local->AddInputConnection(2, between->GetOutputPort());
  local->Update();
  EXPECT_GT(fieldAt(*local->GetTree(), middle), kThreshold);
}

TEST(Nodes, BooleanOperations)
{
  const auto a = ball(0.0);
  const auto b = ball(0.6);
  vtkNew<vtkHybridTreeBoolean> both;
  both->SetInputConnection(0, a->GetOutputPort());
  both->SetInputConnection(1, b->GetOutputPort());
  both->SetEdgeLength(0.05);
  // Volume of the lens of two balls of radius r at distance d.
  const double r = 0.5;
  const double d = 0.6;
  const double full = 4.0 / 3.0 * vtkMath::Pi() * r * r * r;
  const double lens = vtkMath::Pi() * (4.0 * r + d) * (2.0 * r - d) * (2.0 * r - d) / 12.0;
  const double expected[3] = { 2.0 * full - lens, lens, full - lens };
  for (int operation = 0; operation < 3; ++operation)
  {
    both->SetOperation(operation);
    both->Update();
    EXPECT_NEAR(signedVolume(trianglesOf(both->GetOutput())), expected[operation], 0.02 * full);
  }
  b->SetCenter(9.0, 0.0, 0.0);
  both->SetOperation(vtkHybridTreeBoolean::INTERSECTION);
  const Messages messages(both);
  both->Update();
  EXPECT_EQ(messages.errors, "") << "an empty intersection is an answer";
  EXPECT_EQ(both->GetOutput()->GetNumberOfPoints(), 0);
}

/// Two balls cross in one circle, of a known radius in a known plane.
TEST(Nodes, BooleanShowsTheCurvesOfTheCut)
{
  const auto a = ball(0.0);
  const auto b = ball(0.6);
  vtkNew<vtkHybridTreeBoolean> both;
  both->SetInputConnection(0, a->GetOutputPort());
  both->SetInputConnection(1, b->GetOutputPort());
  both->SetEdgeLength(0.05);
  both->Update();
  vtkPolyData* curves = both->GetOutput(1);
  ASSERT_EQ(curves->GetNumberOfLines(), 1);
  ASSERT_GT(curves->GetNumberOfPoints(), 20);
  vtkCell* line = curves->GetCell(0);
  EXPECT_EQ(line->GetPointId(0), line->GetPointId(line->GetNumberOfPoints() - 1)) << "closed";
  for (vtkIdType k = 0; k < curves->GetNumberOfPoints(); ++k)
  {
    double p[3];
    curves->GetPoint(k, p);
    EXPECT_NEAR(p[0], 0.3, 1e-6);
    EXPECT_NEAR(std::hypot(p[1], p[2]), 0.4, 1e-6);
  }
}

/// Five balls in a row, one after the other in B.
TEST(Nodes, BooleanTakesAnyNumberOfOperands)
{
  vtkNew<vtkHybridTreeBoolean> all;
  all->SetEdgeLength(0.05);
  all->SetInputConnection(0, ball(0.0)->GetOutputPort());
  for (int k = 1; k < 5; ++k)
  {
    all->AddInputConnection(1, ball(0.6 * k)->GetOutputPort());
  }
  all->Update();
  const double pi = std::acos(-1.0);
  const double whole = 4.0 / 3.0 * pi * 0.125;
  const double lens = pi / 12.0 * (4.0 * 0.5 + 0.6) * (2.0 * 0.5 - 0.6) * (2.0 * 0.5 - 0.6);
  EXPECT_NEAR(signedVolume(trianglesOf(all->GetOutput())), 5.0 * whole - 4.0 * lens, 0.02 * whole);
  EXPECT_EQ(all->GetTree()->leafCount(), 5);
  EXPECT_EQ(all->GetOutput(1)->GetNumberOfLines(), 4) << "a circle between each two";
  all->SetOperation(vtkHybridTreeBoolean::DIFFERENCE);
  all->Update();
  EXPECT_NEAR(signedVolume(trianglesOf(all->GetOutput())), whole - lens, 0.02 * whole);
  all->SetOperation(vtkHybridTreeBoolean::INTERSECTION);
  all->Update();
  EXPECT_EQ(all->GetOutput()->GetNumberOfPoints(), 0);
}

/// The map of an affine filter applied to a ball's centre is where the image's field peaks.
TEST(Nodes, AffineMapsInParaViewsOrder)
{
  vtkNew<vtkTransform> expected; // as ParaView's Transform puts it together
  expected->Translate(1.0, 2.0, 3.0);
  expected->RotateZ(50.0);
  expected->RotateX(20.0);
  expected->RotateY(-70.0);
  expected->Scale(2.0, 0.5, -1.5);
  const double from[3] = { 0.3, -0.2, 0.4 };
  double to[3];
  expected->TransformPoint(from, to);

  vtkNew<vtkHybridTreePoint> point;
  point->SetCenter(from);
  vtkNew<vtkHybridTreeAffineTransform> map;
  map->SetInputConnection(point->GetOutputPort());
  map->SetTranslate(1.0, 2.0, 3.0);
  map->SetRotate(20.0, -70.0, 50.0);
  map->SetScale(2.0, 0.5, -1.5);
  map->Update();
  point->Update();
  EXPECT_NEAR(fieldAt(*map->GetTree(), Vec3(to)), fieldAt(*point->GetTree(), Vec3(from)), 1e-12);
  expectSolid(map->GetOutput());

  vtkNew<vtkHybridTreeAffineTransform> pinned; // its centre stays
  pinned->SetInputConnection(point->GetOutputPort());
  pinned->SetRotate(20.0, -70.0, 50.0);
  pinned->SetScale(2.0, 0.5, -1.5);
  pinned->SetCenter(const_cast<double*>(from));
  pinned->Update();
  EXPECT_NEAR(
    fieldAt(*pinned->GetTree(), Vec3(from)), fieldAt(*point->GetTree(), Vec3(from)), 1e-12);
}

TEST(Nodes, WarpsFitTheirInput)
{
  vtkNew<vtkHybridTreeBox> box;
  box->SetCenter(30.0, 0.0, 0.0);
  box->SetLengths(1.0, 1.0, 4.0);
  box->SetSurfaceRadius(0.1);
  box->SetInfluenceRadius(0.5);
  box->SetEdgeLength(0.2);
  vtkNew<vtkHybridTreeTaper> taper;
  taper->SetInputConnection(box->GetOutputPort());
  taper->SetEdgeLength(0.2);
  taper->Update();
  double bounds[6];
  taper->GetOutput()->GetBounds(bounds);
  EXPECT_NEAR(0.5 * (bounds[0] + bounds[1]), 30.0, 0.05) << "the axis runs through the box";
  expectSolid(taper->GetOutput());
  const double whole = 1.2 * 1.2 * 4.2;
  EXPECT_NEAR(signedVolume(trianglesOf(taper->GetOutput())), whole * 7.0 / 12.0, 0.06 * whole);

  taper->FitToInputOff(); // the axis through the world's origin draws the box towards it
  taper->Update();
  taper->GetOutput()->GetBounds(bounds);
  EXPECT_LT(bounds[0], 20.0);
}

TEST(Nodes, FreeFormMovesWithItsControlPoints)
{
  const auto a = ball();
  vtkNew<vtkHybridTreeFreeFormDeformation> ffd;
  ffd->SetInputConnection(a->GetOutputPort());
  ffd->SetEdgeLength(0.1);
  ffd->SetFieldFrom(vtkHybridTreeFreeFormDeformation::INVERSE_MAP);
  ffd->SetLatticeDimensions(3, 3, 3);
  ffd->Update();
  EXPECT_EQ(vtkPolyData::SafeDownCast(ffd->GetOutputDataObject(1))->GetNumberOfPoints(), 27);
  EXPECT_EQ(vtkPolyData::SafeDownCast(ffd->GetOutputDataObject(1))->GetNumberOfLines(), 54);
  a->Update();
  expectSameField(*ffd->GetTree(), *a->GetTree());

  for (const int from : { 0, 1 })
  {
    ffd->SetFieldFrom(from);
    ffd->ClearDisplacements();
    ffd->AddDisplacement(1, 1, 1, 0.0, 0.0, 0.2);
    ffd->AddDisplacement(1, 1, 1, 0.0, 0.0, 0.2); // rows add up
    ffd->Update();
    expectSolid(ffd->GetOutput());
    double bounds[6];
    ffd->GetOutput()->GetBounds(bounds);
    // The middle control point of 3 x 3 x 3 has weight 1/8 in the middle, less towards the poles.
    EXPECT_GT(bounds[4] + bounds[5], 0.0);
    double x[3];
    vtkPolyData::SafeDownCast(ffd->GetOutputDataObject(1))->GetPoint(13, x);
    EXPECT_NEAR(x[2], 0.4, 1e-12);
  }
}

TEST(Nodes, AnExplicitLatticeIsUsed)
{
  const auto a = ball();
  vtkNew<vtkHybridTreeFreeFormDeformation> ffd;
  ffd->SetInputConnection(a->GetOutputPort());
  ffd->SetEdgeLength(0.1);
  ffd->FitLatticeOff();
  ffd->SetLatticeOrigin(-2.0, -2.0, -2.0);
  const double axes[9] = { 4, 0, 0, 0, 4, 0, 0, 0, 4 };
  ffd->SetLatticeAxes(axes);
  ffd->SetLatticeDimensions(2, 3, 4);
  ffd->Update();
  auto* lattice = vtkPolyData::SafeDownCast(ffd->GetOutputDataObject(1));
  ASSERT_EQ(lattice->GetNumberOfPoints(), 24);
  double x[3];
  lattice->GetPoint(23, x);
  EXPECT_EQ(Vec3(x), Vec3(2.0, 2.0, 2.0));
  lattice->GetPoint(1, x);
  EXPECT_EQ(Vec3(x), Vec3(2.0, -2.0, -2.0)) << "i is fastest";
  expectSolid(ffd->GetOutput());
}

TEST(Nodes, MeshFieldsReachAsFarAsTold)
{
  vtkNew<vtkSphereSource> sphere;
  sphere->SetThetaResolution(30);
  sphere->SetPhiResolution(30);
  vtkNew<vtkHybridTreeMeshField> field;
  field->SetInputConnection(sphere->GetOutputPort());
  field->SetInfluenceRadius(0.25);
  field->SetFieldMode(vtkHybridTreeMeshField::MAXIMUM_FIELD);
  field->SetMaximumField(0.6);
  field->Update();
  double onMesh[3];
  field->GetOutput()->GetPoint(17, onMesh);
  EXPECT_NEAR(fieldAt(*field->GetTree(), Vec3(onMesh)), kThreshold, 1e-9);
  EXPECT_NEAR(fieldAt(*field->GetTree(), Vec3(0.7, 0.0, 0.0)), 0.0, 0.1);
  EXPECT_EQ(fieldAt(*field->GetTree(), Vec3(0.76, 0.0, 0.0)), 0.0);
  EXPECT_NEAR(fieldAt(*field->GetTree(), Vec3::Zero()), 0.6, 1e-9);
}

TEST(Nodes, PrintEveryProperty)
{
  vtkNew<vtkHybridTreeFreeFormDeformation> ffd;
  vtkNew<vtkHybridTreeBend> bend;
  vtkNew<vtkHybridTreeBox> box;
  std::ostringstream text;
  ffd->Print(text);
  bend->Print(text);
  box->Print(text);
  for (const char* name : { "EdgeLength", "LatticeDimensions", "LatticeOrigin", "LatticeAxes",
         "FitLattice", "Displacements", "FieldFrom", "Origin", "Axis", "Normal", "Range", "Angle",
         "FieldMode", "SurfaceRadius", "MaximumField", "InfluenceRadius", "Exponent", "Negative",
         "Center", "Lengths", "Rotation" })
  {
    EXPECT_NE(text.str().find(std::string(name) + ":"), std::string::npos) << name;
  }
}

} // namespace
} // namespace hybridtree::test

// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/nodes/NodeCases.h"

#include "core/nodes/Barr.h"
#include "core/nodes/Blend.h"
#include "core/nodes/Boolean.h"
#include "core/nodes/FreeForm.h"
#include "core/nodes/LocalBlend.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/nodes/SubdivisionSkeleton.h"
#include "core/skeletons/Box.h"
#include "core/skeletons/Circle.h"
#include "core/skeletons/Cone.h"
#include "core/skeletons/ConeSphere.h"
#include "core/skeletons/Cylinder.h"
#include "core/skeletons/Disc.h"
#include "core/skeletons/Ellipsoid.h"
#include "core/skeletons/HollowCylinder.h"
#include "core/skeletons/Point.h"
#include "core/skeletons/Polygon.h"
#include "core/skeletons/Rectangle.h"
#include "core/skeletons/Revolution.h"
#include "core/skeletons/Segment.h"
#include "core/skeletons/Spline.h"
#include "core/skeletons/Triangle.h"

#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <cmath>

namespace hybridtree::test
{
namespace
{

Potential potential(double surfaceRadius, double influenceRadius, int exponent = 2)
{
  return Potential::bySurfaceRadius(surfaceRadius, influenceRadius, exponent);
}

NodePtr ball(const Vec3& center, double radius = 0.4, double influence = 0.8)
{
  return makePrimitive(std::make_shared<PointSkeleton>(center), potential(radius, influence));
}

NodePtr hole(const Vec3& center)
{
  return makePrimitive(
    std::make_shared<PointSkeleton>(center), Potential::bySurfaceRadius(0.25, 0.5, 2, true));
}

NodePtr capsule()
{
  return makePrimitive(
    std::make_shared<SegmentSkeleton>(Vec3(-0.5, 0.1, 0.0), Vec3(0.6, -0.2, 0.3)),
    potential(0.25, 0.5, 3));
}

NodePtr ring()
{
  return makePrimitive(
    std::make_shared<CircleSkeleton>(Vec3(0.1, 0.0, 0.0), Vec3(0.3, 0.2, 1.0), 0.6),
    potential(0.15, 0.35));
}

NodePtr block()
{
  const Mat3 turned = Eigen::AngleAxisd(0.5, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  return makePrimitive(
    std::make_shared<BoxSkeleton>(Vec3(0.0, 0.1, -0.1), Vec3(0.8, 0.5, 0.6), turned),
    potential(0.1, 0.4));
}

NodePtr tube()
{
  return makePrimitive(makeSpline(SplineCurve{ { Vec3(-0.6, -0.2, 0), Vec3(-0.2, 0.3, 0.1),
                                                 Vec3(0.3, -0.2, -0.1), Vec3(0.6, 0.3, 0.2) },
                         {}, SplineKind::CatmullRom, false }),
    potential(0.12, 0.3));
}

NodePtr tail()
{
  return makePrimitive(makeSpline(SplineCurve{ { Vec3(-0.6, 0.1, 0), Vec3(-0.2, 0.2, 0.1),
                                                 Vec3(0.3, -0.1, 0), Vec3(0.5, -0.4, 0.2) },
                         { 0.15, 0.1, 0.03, 0.0 }, SplineKind::BSpline, false }),
    potential(0.1, 0.3));
}

NodePtr vase(bool solid)
{
  return makePrimitive(
    std::make_shared<RevolutionSkeleton>(RevolutionShape{ Vec3(0.1, 0, -0.1), Vec3(0.1, 0.2, 1),
      { { Vec3(0.2, -0.5, 0), Vec3(0.4, -0.3, 0), Vec3(0.3, 0.1, 0), Vec3(0.25, 0.5, 0) } },
      solid }),
    potential(0.08, 0.25));
}

Affine3 shear()
{
  Affine3 map = Affine3::Identity();
  map.linear() << 1.2, 0.4, 0.0, 0.0, 0.7, -0.2, 0.1, 0.0, -1.1;
  map.translation() = Vec3(0.2, -0.1, 0.3);
  return map;
}

NodePtr snake()
{
  std::vector<NodePtr> parts;
  const auto at = [](int k)
  { return Vec3(0.05 * k - 0.5, 0.3 * std::sin(0.4 * k), 0.3 * std::cos(0.4 * k)); };
  for (int k = 0; k < 20; ++k)
  {
    parts.push_back(
      makePrimitive(std::make_shared<SegmentSkeleton>(at(k), at(k + 1)), potential(0.06, 0.15, 2)));
  }
  return makeBlend(parts);
}

void addRound(std::vector<NodeCase>& cases)
{
  const Vec3 a(-0.4, 0.1, -0.3);
  const Vec3 b(0.3, -0.2, 0.4);
  const auto add = [&](const char* name, SkeletonPtr skeleton, double surface, double influence) {
    cases.push_back({ name, makePrimitive(std::move(skeleton), potential(surface, influence)) });
  };
  add("SpindleTorus", std::make_shared<CircleSkeleton>(a, b, 0.2), 0.3, 0.6);
  add("Disc", std::make_shared<DiscSkeleton>(a, b, 0.6), 0.15, 0.4);
  add("Cylinder", std::make_shared<CylinderSkeleton>(a, b, 0.3), 0.1, 0.4);
  add("SharpCylinder", std::make_shared<CylinderSkeleton>(a, b, 0.4), 0.0, 0.3);
  add("HollowCylinder", std::make_shared<HollowCylinderSkeleton>(a, b, 0.6, 0.4), 0.1, 0.3);
  add("FilledHollowCylinder", std::make_shared<HollowCylinderSkeleton>(a, b, 0.5, 0.2), 0.3, 0.6);
  add("Cone", std::make_shared<ConeSkeleton>(a, b, 0.4, 0.2), 0.1, 0.4);
  add("PointedCone", std::make_shared<ConeSkeleton>(a, b, 0.0, 0.5), 0.0, 0.4);
  add("ConeSphere", std::make_shared<ConeSphereSkeleton>(a, b, 0.3, 0.1), 0.1, 0.4);
  cases.push_back({ "ShearedHollowCylinder",
    makePrimitive(std::make_shared<HollowCylinderSkeleton>(a, b, 0.6, 0.4), potential(0.1, 0.3))
      ->affine(shear()) });
}

NodePtr meshLeaf(TriangleMesh mesh, double maximumField = 1.0)
{
  return makeMeshNode(std::make_shared<const TriangleMesh>(std::move(mesh)), maximumField, 0.3, 2);
}

void addMeshes(std::vector<NodeCase>& cases)
{
  cases.push_back({ "MeshBox", meshLeaf(box(Vec3(-0.5, -0.4, -0.3), Vec3(0.5, 0.4, 0.3))) });
  cases.push_back({ "MeshBumpy", meshLeaf(bumpySphere(0.6, 2), 0.9) });
  cases.push_back({ "MeshTorus", meshLeaf(torus(0.6, 0.25, 24, 12)) });
  cases.push_back({ "ShearedMesh", meshLeaf(bumpySphere(0.6, 2))->affine(shear()) });
  cases.push_back({ "MeshHole", meshLeaf(icosphere(0.5, 1), -1.0) });
  cases.push_back({ "BlendOfMeshes",
    makeBlend({ meshLeaf(torus(0.6, 0.25, 24, 12)), meshLeaf(icosphere(0.4, 2, Vec3(0.6, 0, 0))),
      hole(Vec3(-0.6, 0, 0.2)) }) });
  cases.push_back({ "MeshMinusPrimitive",
    makeBoolean(BooleanOperation::Difference, meshLeaf(icosphere(0.6, 2)), capsule()) });
}

void addBooleans(std::vector<NodeCase>& cases)
{
  const NodePtr a = ball(Vec3(-0.2, 0.0, 0.0), 0.5, 0.9);
  const NodePtr b = block();
  const std::pair<BooleanOperation, const char*> operations[] = {
    { BooleanOperation::Union, "Union" },
    { BooleanOperation::Intersection, "Intersection" },
    { BooleanOperation::Difference, "Difference" },
  };
  const std::pair<BooleanForm, const char*> forms[] = {
    { BooleanForm::Automatic, "Automatic" },
    { BooleanForm::Smooth, "Smooth" },
    { BooleanForm::Paper, "Paper" },
  };
  for (const auto& [operation, operationName] : operations)
  {
    for (const auto& [form, formName] : forms)
    {
      cases.push_back(
        { std::string(operationName) + formName, makeBoolean(operation, a, b, form) });
    }
    cases.push_back({ std::string(operationName) + "OfSumWithHole",
      makeBoolean(operation, makeBlend({ a, hole(Vec3(-0.5, 0.1, 0.2)) }), ring()) });
  }
}

void addBlends(std::vector<NodeCase>& cases)
{
  const NodePtr sum =
    makeBlend({ ball(Vec3(-0.4, 0, 0)), ball(Vec3(0.4, 0.1, 0)), capsule(), ring() });
  cases.push_back({ "Blend", sum });
  cases.push_back(
    { "BlendWithHole", makeBlend({ ball(Vec3::Zero(), 0.6, 1.0), hole(Vec3(0.5, 0, 0)) }) });
  cases.push_back(
    { "NestedBlend", makeBlend({ sum, makeBlend({ block(), hole(Vec3(0, 0, 0.4)) }) }) });
  cases.push_back({ "Snake", snake() });
  const NodePtr cut = makeBoolean(BooleanOperation::Difference, block(), ball(Vec3(0.3, 0.3, 0)));
  cases.push_back({ "BlendOfBoolean", makeBlend({ cut, ball(Vec3(-0.6, 0, 0)) }) });
  cases.push_back(
    { "LocalBlend", makeLocalBlend(capsule(), ring(), ball(Vec3(0.6, 0, 0), 0.4, 0.7)) });
  cases.push_back({ "LocalBlendOfCarved",
    makeLocalBlend(makeBlend({ block(), hole(Vec3(0.3, 0.2, 0)) }), hole(Vec3(-0.4, 0.1, 0)),
      ball(Vec3(-0.3, 0, 0), 0.4, 0.7)) });
  cases.push_back(
    { "LocalBlendInNegativeRegion", makeLocalBlend(capsule(), ring(), hole(Vec3(0.6, 0, 0))) });
}

BarrFrame barrFrame()
{
  BarrFrame frame;
  frame.origin = Vec3(0.1, -0.2, 0.0);
  frame.axis = Vec3(2.0, 0.4, 0.3);
  frame.normal = Vec3(0.1, 0.2, 1.0);
  frame.begin = -0.4;
  frame.end = 0.5;
  return frame;
}

void addBarr(std::vector<NodeCase>& cases)
{
  const NodePtr sum = makeBlend({ capsule(), ball(Vec3(0.1, 0.1, 0), 0.3, 0.5) });
  // Split vertices are brought onto the surface; those of the child are there to 1e-3 already.
  const double tolerance = 5e-3;
  cases.push_back({ "Twist", makeTwist(block(), barrFrame(), 1.5), tolerance });
  cases.push_back({ "TwistOfBlend", makeTwist(sum, barrFrame(), -2.0), tolerance });
  cases.push_back({ "Taper", makeTaper(sum, barrFrame(), 0.4), tolerance });
  cases.push_back({ "Bend", makeBend(capsule(), barrFrame(), 0.9), tolerance });
  cases.push_back({ "ShearedBend", makeBend(sum, barrFrame(), -0.8)->affine(shear()), tolerance });
  cases.push_back({ "TwistOfBend",
    makeTwist(makeBend(capsule(), barrFrame(), 0.7), barrFrame(), 1.0), tolerance });
  cases.push_back({ "TwistedMesh",
    makeTwist(meshLeaf(box(Vec3(-0.5, -0.4, -0.3), Vec3(0.5, 0.4, 0.3))), barrFrame(), 1.0),
    tolerance });
  cases.push_back({ "TaperedHole", makeTaper(hole(Vec3(0.1, 0.1, 0.0)), barrFrame(), 2.0) });
}

// A lattice around the shapes here, its inner control points displaced by up to `share` of a cell.
FreeFormLattice lattice(double share)
{
  FreeFormLattice result;
  result.dimensions = { 4, 5, 4 };
  result.origin = Vec3(-1.2, -1.3, -1.1);
  result.axes << 2.4, 0.1, 0.0, 0.0, 2.6, 0.0, 0.1, 0.0, 2.3;
  Random random(17);
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j < 5; ++j)
    {
      for (int i = 0; i < 4; ++i)
      {
        const bool inner = i % 3 != 0 && j % 4 != 0 && k % 3 != 0;
        result.displacements.push_back(
          inner ? Vec3(0.7 * share * random.direction()) : Vec3(Vec3::Zero()));
      }
    }
  }
  return result;
}

void addFreeForms(std::vector<NodeCase>& cases)
{
  const NodePtr sum = makeBlend({ capsule(), ring() });
  const double tolerance = 5e-3;
  const double edge = 0.05;
  cases.push_back(
    { "FreeFormMesh", makeFreeForm(capsule(), lattice(0.4), FieldFrom::DeformedMesh, edge) });
  cases.push_back({ "FreeFormMeshOfBlend",
    makeFreeForm(sum, lattice(0.4), FieldFrom::DeformedMesh, 2.0 * edge) });
  cases.push_back({ "ShearedFreeFormMesh",
    makeFreeForm(meshLeaf(bumpySphere(0.6, 2)), lattice(0.4), FieldFrom::DeformedMesh, edge)
      ->affine(shear()) });
  cases.push_back({ "FreeFormHole",
    makeFreeForm(hole(Vec3(0.1, 0.2, 0.3)), lattice(0.4), FieldFrom::DeformedMesh, edge) });
  cases.push_back(
    { "FreeFormInverse", makeFreeForm(sum, lattice(0.4), FieldFrom::InverseMap), tolerance });
  cases.push_back({ "ShearedFreeFormInverse",
    makeFreeForm(block(), lattice(0.4), FieldFrom::InverseMap)->affine(shear()), tolerance });
}

void addPlates(std::vector<NodeCase>& cases)
{
  const auto add = [&](const std::string& name, SkeletonPtr skeleton)
  {
    const NodePtr node = makePrimitive(std::move(skeleton), potential(0.12, 0.35));
    cases.push_back({ name, node });
    cases.push_back({ "Sheared" + name, node->affine(shear()) });
  };
  const Vec3 a(-0.5, -0.3, 0.1);
  const Vec3 b(0.6, -0.4, 0.2);
  const Vec3 c(-0.2, 0.5, -0.1);
  add("Rectangle", std::make_shared<RectangleSkeleton>(a, b, c));
  add("Triangle", std::make_shared<TriangleSkeleton>(a, b, c));
  const auto place = [&](double u, double v) { return Vec3(a + u * (b - a) + v * (c - a)); };
  add("Polygon",
    std::make_shared<PolygonSkeleton>(std::vector<Vec3>{
      place(0, 0), place(1, 0), place(1, 0.4), place(0.4, 0.4), place(0.4, 1), place(0, 1) }));
  const Mat3 turned = Eigen::AngleAxisd(0.8, Vec3(2, -1, 1).normalized()).toRotationMatrix();
  add("Ellipsoid",
    std::make_shared<EllipsoidSkeleton>(Vec3(0.1, 0.0, -0.1), Vec3(0.5, 0.3, 0.2), turned));
}

// Three limbs of different thickness.
SkeletonGraph branches()
{
  SkeletonGraph graph;
  graph.points = { Vec3(-0.7, 0, 0), Vec3(-0.2, 0.1, 0.1), Vec3(0.2, 0, 0), Vec3(0.6, 0.4, -0.1),
    Vec3(0.5, -0.5, 0.2) };
  graph.radii = { 0.1, 0.15, 0.2, 0.08, 0.12 };
  graph.segments = { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 2, 4 } };
  return graph;
}

// A bent sheet with a limb at one corner.
SkeletonGraph sheet()
{
  SkeletonGraph graph;
  graph.points = { Vec3(-0.5, -0.4, 0), Vec3(0.3, -0.5, 0.1), Vec3(-0.4, 0.4, 0.1),
    Vec3(0.4, 0.3, -0.2), Vec3(0.9, 0.5, 0) };
  graph.radii = { 0.15, 0.1, 0.12, 0.1, 0.1 };
  graph.segments = { { 3, 4 } };
  graph.triangles = { { 0, 1, 2 }, { 1, 3, 2 } };
  return graph;
}

// Limbs that come back to where they started.
SkeletonGraph folded()
{
  SkeletonGraph graph;
  graph.points = { Vec3(-0.6, 0, 0), Vec3(0.1, 0.1, 0), Vec3(0.6, 0.2, 0.1), Vec3(0.2, 0.4, 0.2),
    Vec3(-0.4, 0.35, 0.1), Vec3(0.8, -0.4, 0) };
  graph.radii = { 0.12, 0.1, 0.12, 0.1, 0.12, 0.1 };
  graph.segments = { { 0, 1 }, { 1, 2 }, { 2, 3 }, { 3, 4 } };
  graph.triangles = { { 1, 5, 2 } };
  return graph;
}

void addSkeletons(std::vector<NodeCase>& cases)
{
  SubdivisionSkeletonOptions options;
  options.level = 2;
  const NodePtr curves = makeSubdivisionSkeleton(branches(), options);
  cases.push_back({ "SkeletonCurves", curves });
  cases.push_back({ "ShearedSkeletonCurves", curves->affine(shear()) });
  options.scheme = SubdivisionScheme::Interpolating;
  options.kernel.exponent = 3;
  options.kernel.influenceRatio = 1.6;
  cases.push_back({ "SkeletonSheet", makeSubdivisionSkeleton(sheet(), options) });
  options.radius = SkeletonRadius::Constant;
  options.level = 0;
  options.kernel.exponent = 5;
  cases.push_back({ "SkeletonOfConstantRadii", makeSubdivisionSkeleton(sheet(), options) });
  options.blending.kind = BlendingKind::Neighbours;
  options.kernel.exponent = 3;
  cases.push_back({ "SkeletonOfNeighbours", makeSubdivisionSkeleton(folded(), options) });
  options.kernel.kind = KernelKind::Cauchy;
  cases.push_back({ "SkeletonOfCauchyNeighbours", makeSubdivisionSkeleton(branches(), options) });
  options.blending.kind = BlendingKind::All;
  cases.push_back({ "SkeletonOfCauchyKernels", makeSubdivisionSkeleton(sheet(), options) });
  options.kernel.kind = KernelKind::Compact;
  options.blending.kind = BlendingKind::Paper;
  cases.push_back({ "SkeletonAsInThePaper", makeSubdivisionSkeleton(branches(), options) });
  options.blending.kind = BlendingKind::All;
  options.negative = true;
  cases.push_back({ "SkeletonHole", makeSubdivisionSkeleton(branches(), options) });
  cases.push_back({ "BlendWithSkeletons",
    makeBlend({ curves, makeSubdivisionSkeleton(sheet()), ball(Vec3(-0.5, 0.3, 0)),
      makeSubdivisionSkeleton(branches(), options)->affine(shear()) }) });
}

} // namespace

std::vector<NodeCase> nodeCases()
{
  std::vector<NodeCase> cases;
  cases.push_back({ "Point", ball(Vec3(0.1, 0.2, 0.3)) });
  cases.push_back({ "Segment", capsule() });
  cases.push_back({ "Circle", ring() });
  cases.push_back({ "Box", block() });
  cases.push_back({ "Spline", tube() });
  cases.push_back({ "TaperedSpline", tail() });
  cases.push_back({ "ShearedSpline", tube()->affine(shear()) });
  cases.push_back({ "SheetOfRevolution", vase(false) });
  cases.push_back({ "SolidOfRevolution", vase(true) });
  cases.push_back({ "ShearedPoint", ball(Vec3(0.1, 0.2, 0.3))->affine(shear()) });
  cases.push_back({ "ShearedSegment", capsule()->affine(shear()) });
  cases.push_back({ "ShearedCircle", ring()->affine(shear()) });
  cases.push_back({ "ShearedBox", block()->affine(shear()) });
  cases.push_back({ "Hole", hole(Vec3(0.1, 0.2, 0.3)) });
  addPlates(cases);
  addRound(cases);
  addSkeletons(cases);
  addMeshes(cases);
  addBlends(cases);
  addBooleans(cases);
  addBarr(cases);
  addFreeForms(cases);
  return cases;
}

} // namespace hybridtree::test

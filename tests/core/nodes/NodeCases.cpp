// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/nodes/NodeCases.h"

#include "core/nodes/Barr.h"
#include "core/nodes/Blend.h"
#include "core/nodes/Boolean.h"
#include "core/nodes/FreeForm.h"
#include "core/nodes/LocalBlend.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Box.h"
#include "core/skeletons/Circle.h"
#include "core/skeletons/Point.h"
#include "core/skeletons/Segment.h"

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

void addWarps(std::vector<NodeCase>& cases)
{
  const BarrFrame frame{ Vec3(0.1, 0.0, -0.1), Vec3(1.0, 0.2, 0.1), Vec3(0.0, 1.0, 0.3), -0.4,
    0.5 };
  const NodePtr sum = makeBlend({ block(), ball(Vec3(0.6, 0.1, 0.0), 0.3, 0.6) });
  cases.push_back({ "TwistedBox", makeTwist(block(), frame, 1.2) });
  cases.push_back({ "TaperedBlend", makeTaper(sum, frame, 0.6) });
  cases.push_back({ "BentBlend", makeBend(sum, frame, 0.5) });
  cases.push_back({ "BentTwist", makeBend(makeTwist(capsule(), frame, 0.8), frame, -0.4) });

  FreeFormLattice lattice;
  lattice.dimensions = { 4, 4, 4 };
  lattice.origin = Vec3(-1.5, -1.5, -1.5);
  lattice.axes = 3.0 * Mat3::Identity();
  lattice.displacements.assign(64, Vec3::Zero());
  lattice.displacements[21] = Vec3(0.3, 0.1, -0.2);
  lattice.displacements[42] = Vec3(-0.1, 0.4, 0.2);
  cases.push_back({ "FreeFormByInverse", makeFreeForm(sum, lattice, FieldFrom::InverseMap) });
  cases.push_back(
    { "FreeFormByMesh", makeFreeForm(block(), lattice, FieldFrom::DeformedMesh, 0.1) });
}

} // namespace

std::vector<NodeCase> nodeCases()
{
  std::vector<NodeCase> cases;
  cases.push_back({ "Point", ball(Vec3(0.1, 0.2, 0.3)) });
  cases.push_back({ "Segment", capsule() });
  cases.push_back({ "Circle", ring() });
  cases.push_back({ "Box", block() });
  cases.push_back({ "ShearedPoint", ball(Vec3(0.1, 0.2, 0.3))->affine(shear()) });
  cases.push_back({ "ShearedSegment", capsule()->affine(shear()) });
  cases.push_back({ "ShearedCircle", ring()->affine(shear()) });
  cases.push_back({ "ShearedBox", block()->affine(shear()) });
  cases.push_back({ "Hole", hole(Vec3(0.1, 0.2, 0.3)) });
  addMeshes(cases);
  addBlends(cases);
  addBooleans(cases);
  addWarps(cases);
  return cases;
}

} // namespace hybridtree::test

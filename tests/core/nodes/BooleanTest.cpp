// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/Boolean.h"

#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/Blend.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"
#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hybridtree::test
{
namespace
{

constexpr double kPi = 3.14159265358979323846;
constexpr double kEdge = 0.04;

constexpr BooleanOperation kUnion = BooleanOperation::Union;
constexpr BooleanOperation kIntersection = BooleanOperation::Intersection;
constexpr BooleanOperation kDifference = BooleanOperation::Difference;
constexpr BooleanOperation kOperations[] = { kUnion, kIntersection, kDifference };
constexpr BooleanForm kForms[] = { BooleanForm::MinMax, BooleanForm::Smooth, BooleanForm::Paper };

NodePtr ball(const Vec3& center, double radius, bool negative = false)
{
  return makePrimitive(std::make_shared<PointSkeleton>(center),
    Potential::bySurfaceRadius(radius, 1.8 * radius, 2, negative));
}

NodePtr brick(const Vec3& lower, const Vec3& upper)
{
  return makeMeshNode(std::make_shared<const TriangleMesh>(box(lower, upper)), 1.0, 0.2, 2);
}

double ballVolume(double radius)
{
  return 4.0 / 3.0 * kPi * radius * radius * radius;
}

// What two balls of one radius have in common.
double lensVolume(double radius, double distance)
{
  return kPi / 12.0 * (4.0 * radius + distance) * (2.0 * radius - distance) *
    (2.0 * radius - distance);
}

// Closed, and of that volume within 1%.
void expectSolid(const NodePtr& node, double volume, std::size_t components = 1)
{
  const MeshPtr mesh = node->mesh(kEdge);
  const MeshReport report = checkMesh(*mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.components, components);
  EXPECT_NEAR(signedVolume(*mesh), volume, 0.01 * volume);
}

std::vector<double> fieldAt(const Node& node, PointBatch points)
{
  std::vector<double> value(points.size);
  node.field(points, value.data());
  return value;
}

void expectSameField(const Node& a, const Node& b, const Box3& where)
{
  Random random(1);
  const PointList points = randomPoints(random, where, 2000);
  EXPECT_EQ(fieldAt(a, points), fieldAt(b, points));
}

TEST(Boolean, BallsHaveTheVolumesOfTheExactSolids)
{
  const double radius = 0.5;
  const double distance = 0.6;
  const NodePtr a = ball(Vec3::Zero(), radius);
  const NodePtr b = ball(distance * Vec3(1.0, 2.0, -2.0) / 3.0, radius);
  const double lens = lensVolume(radius, distance);
  for (const BooleanForm form : kForms)
  {
    SCOPED_TRACE(static_cast<int>(form));
    expectSolid(makeBoolean(kUnion, a, b, form), 2.0 * ballVolume(radius) - lens);
    expectSolid(makeBoolean(kIntersection, a, b, form), lens);
    expectSolid(makeBoolean(kDifference, a, b, form), ballVolume(radius) - lens);
  }
}

TEST(Boolean, DisjointOperands)
{
  const NodePtr a = ball(Vec3::Zero(), 0.5);
  for (const double distance : { 1.2, 5.0 }) // influences overlap, and not
  {
    const NodePtr b = ball(Vec3(distance, 0.0, 0.0), 0.4);
    for (const BooleanForm form : { BooleanForm::MinMax, BooleanForm::Smooth })
    {
      expectSolid(makeBoolean(kUnion, a, b, form), ballVolume(0.5) + ballVolume(0.4), 2);
      expectSolid(makeBoolean(kDifference, a, b, form), ballVolume(0.5));
      EXPECT_TRUE(makeBoolean(kIntersection, a, b, form)->mesh(kEdge)->empty());
    }
  }
}

TEST(Boolean, NestedOperands)
{
  const NodePtr outer = ball(Vec3::Zero(), 0.6);
  const NodePtr inner = ball(Vec3(0.1, 0.0, 0.0), 0.3);
  for (const BooleanForm form : kForms)
  {
    SCOPED_TRACE(static_cast<int>(form));
    expectSolid(makeBoolean(kUnion, outer, inner, form), ballVolume(0.6));
    expectSolid(makeBoolean(kIntersection, outer, inner, form), ballVolume(0.3));
    // A cavity: a second component, turned inward.
    expectSolid(makeBoolean(kDifference, outer, inner, form), ballVolume(0.6) - ballVolume(0.3), 2);
    EXPECT_TRUE(makeBoolean(kDifference, inner, outer, form)->mesh(kEdge)->empty());
  }
}

TEST(Boolean, TouchingBricks)
{
  const NodePtr a = brick(Vec3(-0.5, -0.5, -0.5), Vec3(0.0, 0.5, 0.5));
  const Vec3 lower[] = { { 0.0, -0.5, -0.5 }, { 0.0, 0.5, -0.5 }, { 0.0, 0.5, 0.5 } };
  for (const Vec3& corner : lower) // by a face, an edge, a corner
  {
    SCOPED_TRACE(corner.transpose());
    const NodePtr b = brick(corner, Vec3(corner + Vec3(0.5, 1.0, 1.0)));
    const MeshPtr sum = makeBoolean(kUnion, a, b)->mesh(kEdge);
    EXPECT_TRUE(isClosedManifold(*sum)) << checkMesh(*sum).describe();
    EXPECT_NEAR(signedVolume(*sum), 1.0, 0.02);
    expectSolid(makeBoolean(kDifference, a, b), 0.5);
    const MeshPtr common = makeBoolean(kIntersection, a, b)->mesh(kEdge);
    EXPECT_TRUE(isClosedManifold(*common));
    EXPECT_LT(signedVolume(*common), 2e-3);
  }
}

TEST(Boolean, EqualOperands)
{
  const NodePtr a = ball(Vec3(0.1, 0.2, 0.3), 0.5);
  for (const BooleanForm form : kForms)
  {
    SCOPED_TRACE(static_cast<int>(form));
    expectSolid(makeBoolean(kUnion, a, a, form), ballVolume(0.5));
    expectSolid(makeBoolean(kIntersection, a, a, form), ballVolume(0.5));
    const NodePtr nothing = makeBoolean(kDifference, a, a, form);
    EXPECT_TRUE(isClosedManifold(*nothing->mesh(kEdge)));
    EXPECT_LT(std::abs(signedVolume(*nothing->mesh(kEdge))), 1e-3);
    Random random(2);
    const PointList points = randomPoints(random, a->influenceBounds(), 3000);
    std::vector<std::int8_t> side(points.size());
    nothing->membership(points, side.data());
    EXPECT_EQ(std::count(side.begin(), side.end(), std::int8_t(1)), 0);
  }
}

TEST(Boolean, OrderMattersToTheDifferenceAlone)
{
  const NodePtr a = ball(Vec3::Zero(), 0.5);
  const NodePtr b = brick(Vec3(0.1, -0.3, -0.2), Vec3(0.8, 0.3, 0.4));
  const Box3 where(Vec3(-1.0, -1.0, -1.0), Vec3(1.1, 1.0, 1.0));
  Random random(3);
  const PointList points = randomPoints(random, where, 2000);
  for (const BooleanForm form : kForms)
  {
    for (const BooleanOperation operation : { kUnion, kIntersection })
    {
      const std::vector<double> one = fieldAt(*makeBoolean(operation, a, b, form), points);
      const std::vector<double> other = fieldAt(*makeBoolean(operation, b, a, form), points);
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        ASSERT_NEAR(one[k], other[k], 1e-14) << points[k].transpose();
      }
    }
    EXPECT_NE(fieldAt(*makeBoolean(kDifference, a, b, form), points),
      fieldAt(*makeBoolean(kDifference, b, a, form), points));
  }
}

TEST(Boolean, NegativeOperandsCountAsEmpty)
{
  const NodePtr a = ball(Vec3::Zero(), 0.5);
  const NodePtr hole = ball(Vec3(0.3, 0.0, 0.0), 0.4, true);
  const Box3 where(Vec3(-1.2, -1.2, -1.2), Vec3(1.2, 1.2, 1.2));
  for (const BooleanForm form : { BooleanForm::MinMax, BooleanForm::Smooth })
  {
    expectSameField(*makeBoolean(kUnion, a, hole, form), *a, where);
    expectSameField(*makeBoolean(kUnion, hole, a, form), *a, where);
    expectSolid(makeBoolean(kDifference, a, hole, form), ballVolume(0.5));
    for (const NodePtr& empty :
      { makeBoolean(kIntersection, a, hole, form), makeBoolean(kDifference, hole, a, form) })
    {
      EXPECT_TRUE(empty->influenceBounds().isEmpty());
      EXPECT_TRUE(empty->mesh(kEdge)->empty());
    }
    EXPECT_TRUE(makeBoolean(kUnion, hole, hole, form)->isNegative());
  }
}

TEST(Boolean, AutomaticFormIsSharpAloneAndSmoothUnderABlend)
{
  const NodePtr a = ball(Vec3::Zero(), 0.5);
  const NodePtr b = ball(Vec3(0.5, 0.1, 0.0), 0.4);
  Random random(4);
  for (const BooleanOperation operation : kOperations)
  {
    const NodePtr automatic = makeBoolean(operation, a, b);
    const NodePtr smooth = makeBoolean(operation, a, b, BooleanForm::Smooth);
    const NodePtr sharp = makeBoolean(operation, a, b, BooleanForm::MinMax);
    const Box3 where = makeBoolean(kUnion, a, b)->influenceBounds();
    expectSameField(*automatic, *sharp, where);
    expectSameField(*automatic->underBlend(), *smooth, where);
    EXPECT_EQ(smooth->underBlend(), smooth);
    EXPECT_EQ(sharp->underBlend(), sharp);
    const NodePtr once = automatic->underBlend();
    EXPECT_EQ(once->underBlend(), once);
    // Deeper ones too, and the surface stays where it was.
    const NodePtr deep = makeBoolean(kUnion, automatic, b, BooleanForm::MinMax);
    expectSameField(
      *deep->underBlend(), *makeBoolean(kUnion, smooth, b, BooleanForm::MinMax), where);
    const PointList points = randomPoints(random, where, 3000);
    const std::vector<double> before = fieldAt(*automatic, points);
    const std::vector<double> after = fieldAt(*automatic->underBlend(), points);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      ASSERT_EQ(before[k] > kThreshold, after[k] > kThreshold) << points[k].transpose();
    }
    const NodePtr far = ball(Vec3(9.0, 0.0, 0.0), 0.3);
    expectSameField(*makeBlend({ automatic, far }), *smooth, where);
  }
}

TEST(Boolean, SourceLeavesNameTheOperandOfTheSurface)
{
  const NodePtr a = ball(Vec3::Zero(), 0.5);
  const NodePtr b = ball(Vec3(0.6, 0.0, 0.0), 0.5);
  for (const BooleanOperation operation : kOperations)
  {
    const MeshPtr mesh = makeBoolean(operation, a, b)->mesh(kEdge);
    int counts[2] = { 0, 0 };
    int unclear = 0;
    for (std::size_t t = 0; t < mesh->triangles.size(); ++t)
    {
      const Triangle& corners = mesh->triangles[t];
      const Vec3 center =
        (mesh->points[corners[0]] + mesh->points[corners[1]] + mesh->points[corners[2]]) / 3.0;
      const double toA = std::abs(center.norm() - 0.5);
      const double toB = std::abs((center - Vec3(0.6, 0.0, 0.0)).norm() - 0.5);
      if (std::abs(toA - toB) < kEdge) // the crease
      {
        ++unclear;
        continue;
      }
      ASSERT_EQ(mesh->sourceLeaf[t], toA < toB ? 0 : 1) << center.transpose();
      ++counts[mesh->sourceLeaf[t]];
    }
    EXPECT_GT(counts[0], 100);
    EXPECT_GT(counts[1], 100);
    EXPECT_LT(unclear, counts[0] + counts[1]);
  }
}

TEST(Boolean, OperandsMustBeThere)
{
  const NodePtr a = ball(Vec3::Zero(), 0.5);
  EXPECT_THROW(makeBoolean(kUnion, nullptr, a), InvalidParameter);
  EXPECT_THROW(makeBoolean(kUnion, a, nullptr), InvalidParameter);
}

} // namespace
} // namespace hybridtree::test

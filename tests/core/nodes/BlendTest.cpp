// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/Blend.h"

#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/Boolean.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"
#include "core/skeletons/Segment.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree::test
{
namespace
{

NodePtr ball(const Vec3& center, double radius = 0.4, bool negative = false)
{
  return makePrimitive(std::make_shared<PointSkeleton>(center),
    Potential::bySurfaceRadius(radius, 2.0 * radius, 2, negative));
}

std::vector<double> fieldAt(const Node& node, PointBatch points)
{
  std::vector<double> value(points.size);
  node.field(points, value.data());
  return value;
}

std::vector<NodePtr> manyParts(std::uint64_t seed, int count)
{
  Random random(seed);
  const Box3 room(Vec3(-2.0, -2.0, -2.0), Vec3(2.0, 2.0, 2.0));
  std::vector<NodePtr> parts;
  for (int k = 0; k < count; ++k)
  {
    const bool negative = k > 0 && random.chance(0.3);
    parts.push_back(ball(random.inBox(room), random.uniform(0.1, 0.6), negative));
  }
  return parts;
}

TEST(Blend, FieldIsTheSumOverAllChildren)
{
  for (const int count : { 2, 7, 60, 500 })
  {
    const std::vector<NodePtr> parts = manyParts(static_cast<std::uint64_t>(count), count);
    const NodePtr blend = makeBlend(parts);
    EXPECT_EQ(blend->leafCount(), count);
    Random random(1);
    const PointList points = randomPoints(random, blend->influenceBounds(), 1000);
    std::vector<double> sum(points.size(), 0.0);
    for (const NodePtr& part : parts)
    {
      const std::vector<double> value = fieldAt(*part, points);
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        sum[k] += value[k];
      }
    }
    const std::vector<double> value = fieldAt(*blend, points);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      ASSERT_NEAR(value[k], sum[k], 1e-12) << points[k].transpose();
    }
  }
}

TEST(Blend, NestingAndOrderDoNotMatter)
{
  std::vector<NodePtr> parts = manyParts(5, 12);
  const NodePtr flat = makeBlend(parts);
  const NodePtr left = makeBlend(std::vector<NodePtr>(parts.begin(), parts.begin() + 5));
  const NodePtr right = makeBlend(std::vector<NodePtr>(parts.begin() + 5, parts.end()));
  const NodePtr nested = makeBlend({ left, right });
  std::reverse(parts.begin(), parts.end());
  const NodePtr reversed = makeBlend(parts);
  Random random(2);
  const PointList points = randomPoints(random, flat->influenceBounds(), 2000);
  const std::vector<double> expected = fieldAt(*flat, points);
  const std::vector<double> a = fieldAt(*nested, points);
  const std::vector<double> b = fieldAt(*reversed, points);
  std::vector<std::int32_t> leaf(points.size());
  std::vector<std::int32_t> nestedLeaf(points.size());
  flat->sourceLeaf(points, leaf.data());
  nested->sourceLeaf(points, nestedLeaf.data());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    ASSERT_NEAR(a[k], expected[k], 1e-12);
    ASSERT_NEAR(b[k], expected[k], 1e-12);
    ASSERT_EQ(nestedLeaf[k], leaf[k]) << points[k].transpose();
  }
}

TEST(Blend, SourceLeafIsTheOnlyOneThatReaches)
{
  const NodePtr blend = makeBlend({ ball(Vec3::Zero()), ball(Vec3(0.9, 0, 0)), ball(Vec3(9, 0, 0)),
    ball(Vec3(0, 9, 0), 0.3, true) });
  const PointList points({ Vec3(-0.3, 0, 0), Vec3(0.45, 0, 0), Vec3(1.3, 0, 0), Vec3(9, 0.2, 0),
    Vec3(0, 9, 0.1), Vec3(5, 5, 5) });
  std::vector<std::int32_t> leaf(points.size());
  blend->sourceLeaf(points, leaf.data());
  EXPECT_EQ(leaf, (std::vector<std::int32_t>{ 0, -1, 1, 2, 3, -1 }));
}

TEST(Blend, DisjointChildrenKeepTheirVolumes)
{
  const double pi = 3.14159265358979323846;
  const NodePtr blend = makeBlend({ ball(Vec3::Zero()), ball(Vec3(2.0, 0, 0), 0.5) });
  const MeshPtr mesh = blend->mesh(0.04);
  const MeshReport report = checkMesh(*mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.components, 2u);
  const double exact = 4.0 / 3.0 * pi * (0.064 + 0.125);
  EXPECT_NEAR(signedVolume(*mesh), exact, 0.01 * exact);
}

TEST(Blend, NearChildrenMergeAndAHoleCarves)
{
  const NodePtr a = ball(Vec3(-0.42, 0, 0));
  const NodePtr b = ball(Vec3(0.42, 0, 0)); // the solids don't touch
  const NodePtr both = makeBlend({ a, b });
  EXPECT_EQ(checkMesh(*makeBoolean(BooleanOperation::Union, a, b)->mesh(0.02)).components, 2u);
  EXPECT_EQ(checkMesh(*both->mesh(0.04)).components, 1u);
  const NodePtr carved = makeBlend({ both, ball(Vec3::Zero(), 0.3, true) });
  EXPECT_EQ(checkMesh(*carved->mesh(0.04)).components, 2u);
  EXPECT_LT(signedVolume(*carved->mesh(0.04)), signedVolume(*both->mesh(0.04)));
  const NodePtr gone = makeBlend({ a, ball(Vec3(-0.42, 0, 0), 0.8, true) });
  EXPECT_TRUE(gone->mesh(0.04)->empty());
  EXPECT_FALSE(gone->isNegative());
  EXPECT_TRUE(
    makeBlend({ ball(Vec3::Zero(), 0.3, true), ball(Vec3::Ones(), 0.3, true) })->isNegative());
}

TEST(Blend, SurfaceBoundsHoldTheSurfaceOfManyParts)
{
  for (std::uint64_t seed = 0; seed < 10; ++seed)
  {
    const NodePtr blend = makeBlend(manyParts(seed, 20));
    const MeshPtr mesh = blend->mesh(0.1);
    EXPECT_TRUE(isClosedManifold(*mesh)) << seed;
    const Box3 bounds = blend->surfaceBounds();
    Random random(seed);
    const PointList points = randomPoints(random, blend->influenceBounds(), 5000);
    const std::vector<double> value = fieldAt(*blend, points);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      ASSERT_TRUE(value[k] <= kThreshold || bounds.contains(points[k])) << points[k].transpose();
    }
  }
}

TEST(Blend, OneChildIsItself)
{
  const NodePtr a = ball(Vec3::Zero());
  EXPECT_EQ(makeBlend({ a }), a);
}

TEST(Blend, BadArgumentsAreRefused)
{
  const NodePtr a = ball(Vec3::Zero());
  EXPECT_THROW(makeBlend({}), InvalidParameter);
  EXPECT_THROW(makeBlend({ a, nullptr }), InvalidParameter);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double ratio : { -0.1, 1.1, nan })
  {
    EXPECT_THROW(makeBlend({ a, a }, { BlendMethod::Automatic, ratio }), InvalidParameter);
  }
}

} // namespace
} // namespace hybridtree::test

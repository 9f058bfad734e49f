// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/LocalBlend.h"

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

namespace hybridtree::test
{
namespace
{

NodePtr ball(const Vec3& center, double radius, bool negative = false)
{
  return makePrimitive(std::make_shared<PointSkeleton>(center),
    Potential::bySurfaceRadius(radius, 2.0 * radius, 2, negative));
}

NodePtr bar(const Vec3& from, const Vec3& to)
{
  return makePrimitive(
    std::make_shared<SegmentSkeleton>(from, to), Potential::bySurfaceRadius(0.2, 0.4, 2));
}

// Two bars side by side, close enough to merge, with a region at one end of them.
class LocalBlendOfBars : public testing::Test
{
protected:
  NodePtr a = bar(Vec3(-1.5, 0.23, 0), Vec3(1.5, 0.23, 0));
  NodePtr b = bar(Vec3(-1.5, -0.23, 0), Vec3(1.5, -0.23, 0));
  NodePtr region = ball(Vec3(1.2, 0, 0), 0.5);
  NodePtr blend = makeLocalBlend(a, b, region);
  NodePtr united = makeBoolean(BooleanOperation::Union, a, b, BooleanForm::Smooth);
};

std::vector<double> fieldAt(const Node& node, PointBatch points)
{
  std::vector<double> value(points.size);
  node.field(points, value.data());
  return value;
}

TEST_F(LocalBlendOfBars, FieldIsTheFormula)
{
  Random random(1);
  const PointList points = randomPoints(random, blend->influenceBounds(), 4000);
  const std::vector<double> f = fieldAt(*blend, points);
  const std::vector<double> fa = fieldAt(*a, points);
  const std::vector<double> fb = fieldAt(*b, points);
  const std::vector<double> fu = fieldAt(*united, points);
  const std::vector<double> fc = fieldAt(*region, points);
  int mixed = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const double c = std::clamp(fc[k], 0.0, 1.0);
    ASSERT_NEAR(f[k], c * (fa[k] + fb[k]) + (1.0 - c) * fu[k], 1e-14);
    mixed += c > 0.0 && c < 1.0 && fa[k] > 0.0 && fb[k] > 0.0;
  }
  EXPECT_GT(mixed, 30);
}

TEST_F(LocalBlendOfBars, BlendsInTheRegionAlone)
{
  EXPECT_EQ(checkMesh(*united->mesh(0.03)).components, 2u);
  const MeshPtr mesh = blend->mesh(0.03);
  const MeshReport report = checkMesh(*mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.components, 1u);
  EXPECT_GT(signedVolume(*mesh), signedVolume(*united->mesh(0.03)));

  // Between the bars: joined in the middle of the region, apart where it ends.
  const PointList between({ Vec3(1.2, 0, 0), Vec3(0, 0, 0), Vec3(-1.2, 0, 0) });
  std::vector<std::int8_t> side(between.size());
  blend->membership(between, side.data());
  EXPECT_EQ(side, (std::vector<std::int8_t>{ 1, -1, -1 }));
}

TEST_F(LocalBlendOfBars, RegionThatReachesNothingLeavesTheUnion)
{
  Random random(2);
  const PointList points = randomPoints(random, united->influenceBounds(), 2000);
  for (const NodePtr& elsewhere : { ball(Vec3(9, 9, 9), 0.5), ball(Vec3(1.2, 0, 0), 0.5, true) })
  {
    const NodePtr node = makeLocalBlend(a, b, elsewhere);
    EXPECT_EQ(fieldAt(*node, points), fieldAt(*united, points));
    EXPECT_EQ(checkMesh(*node->mesh(0.03)).components, 2u);
  }
}

TEST_F(LocalBlendOfBars, OperandOrderDoesNotMatter)
{
  Random random(3);
  const PointList points = randomPoints(random, blend->influenceBounds(), 2000);
  const std::vector<double> one = fieldAt(*blend, points);
  const std::vector<double> other = fieldAt(*makeLocalBlend(b, a, region), points);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    ASSERT_NEAR(one[k], other[k], 1e-14);
  }
}

// c (fA + fB) + (1 - c) max(fA, 0): a hole is felt as far as the region is.
TEST_F(LocalBlendOfBars, HoleCarvesInTheRegionAlone)
{
  const NodePtr nearHole = makeLocalBlend(a, ball(Vec3(1.2, 0.4, 0), 0.3, true), region);
  const NodePtr farHole = makeLocalBlend(a, ball(Vec3(-1.0, 0.4, 0), 0.3, true), region);
  const double whole = signedVolume(*makeLocalBlend(a, a, ball(Vec3(9, 9, 9), 0.5))->mesh(0.03));
  EXPECT_TRUE(isClosedManifold(*nearHole->mesh(0.03)));
  EXPECT_LT(signedVolume(*nearHole->mesh(0.03)), 0.98 * whole);
  EXPECT_NEAR(signedVolume(*farHole->mesh(0.03)), whole, 0.003 * whole);
}

TEST_F(LocalBlendOfBars, BooleansBelowAreSmooth)
{
  const NodePtr cut = makeBoolean(BooleanOperation::Difference, a, ball(Vec3(0.5, 0.4, 0), 0.3));
  Random random(4);
  const PointList points = randomPoints(random, a->influenceBounds(), 2000);
  EXPECT_EQ(fieldAt(*makeLocalBlend(cut, b, region), points),
    fieldAt(*makeLocalBlend(cut->underBlend(), b, region), points));
  EXPECT_NE(fieldAt(*cut, points), fieldAt(*cut->underBlend(), points));
}

TEST_F(LocalBlendOfBars, BadArgumentsAreRefused)
{
  EXPECT_THROW(makeLocalBlend(nullptr, b, region), InvalidParameter);
  EXPECT_THROW(makeLocalBlend(a, nullptr, region), InvalidParameter);
  EXPECT_THROW(makeLocalBlend(a, b, nullptr), InvalidParameter);
  EXPECT_THROW(makeLocalBlend(a, b, region, { BlendMethod::Automatic, 2.0 }), InvalidParameter);
}

} // namespace
} // namespace hybridtree::test

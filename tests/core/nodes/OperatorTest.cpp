// SPDX-License-Identifier: BSD-3-Clause
// Trees with shared subtrees, and trees that are too large: work grows with the nodes, not with the
// paths to them, and what would be too much is refused with its number.
#include "core/nodes/Operator.h"

#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/Barr.h"
#include "core/nodes/Blend.h"
#include "core/nodes/Boolean.h"
#include "core/nodes/FreeForm.h"
#include "core/nodes/LocalBlend.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"
#include "core/tree/Serialize.h"
#include "tests/support/CancelAt.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <functional>

namespace hybridtree::test
{
namespace
{

NodePtr ball(const Vec3& center = Vec3::Zero())
{
  return makePrimitive(
    std::make_shared<PointSkeleton>(center), Potential::bySurfaceRadius(0.5, 1.0, 2, false));
}

using Combine = std::function<NodePtr(const NodePtr&)>;

NodePtr chain(NodePtr node, int length, const Combine& combine)
{
  for (int k = 0; k < length; ++k)
  {
    node = combine(node);
  }
  return node;
}

// Each takes its child more than once.
const std::pair<const char*, Combine> kDoublings[] = {
  { "blend",
    [](const NodePtr& node) {
      return makeBlend({ node, node });
    } },
  { "union", [](const NodePtr& node) { return makeBoolean(BooleanOperation::Union, node, node); } },
  { "intersection",
    [](const NodePtr& node) { return makeBoolean(BooleanOperation::Intersection, node, node); } },
  { "smooth difference",
    [](const NodePtr& node)
    { return makeBoolean(BooleanOperation::Difference, node, node, BooleanForm::Smooth); } },
};

VectorList gradients(const Node& node, const PointList& points, std::vector<double>& value)
{
  VectorList gradient(points.size());
  value.resize(points.size());
  node.fieldAndGradient(points, value.data(), gradient);
  return gradient;
}

// Every query and every pass; by paths each would take 2^19 steps per point or node.
TEST(Operator, NodesThatTakeTheirChildTwiceCostAsManyStepsAsNodes)
{
  Random random(1);
  const PointList points = randomPoints(random, Box3(Vec3(-2, -2, -2), Vec3(2, 2, 2)), 1000);
  for (const auto& [name, combine] : kDoublings)
  {
    SCOPED_TRACE(name);
    const NodePtr node = chain(ball(), 19, combine);
    EXPECT_EQ(node->leafCount(), 1 << 19);
    EXPECT_EQ(node->depth(), 20);
    std::vector<double> value;
    gradients(*node, points, value);
    std::vector<std::int8_t> side(points.size());
    node->membership(points, side.data());
    std::vector<std::int32_t> leaf(points.size());
    node->sourceLeaf(points, leaf.data());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      EXPECT_EQ(side[k] > 0, value[k] > kThreshold) << points[k].transpose();
      EXPECT_LT(leaf[k], node->leafCount());
    }
    const Affine3 map(Eigen::Translation3d(1.0, 2.0, 3.0));
    const NodePtr image = makeBlend({ node->affine(map), ball() });
    // Shared still: the text names each node once.
    EXPECT_LT(toText(*image).size(), 10000u);
    const NodePtr read = fromText(toText(*image));
    EXPECT_EQ(read->leafCount(), image->leafCount());
    EXPECT_TRUE(isClosedManifold(*read->mesh(0.1)));
  }
}

TEST(Operator, AChildTakenOftenCountsOften)
{
  Random random(2);
  const PointList points = randomPoints(random, Box3(Vec3(-1, -1, -1), Vec3(1, 1, 1)), 500);
  const NodePtr a = ball();
  const NodePtr b = ball(Vec3(0.4, 0.1, 0.0));
  const NodePtr shared = makeBlend({ a, makeBlend({ b, a }), a });
  const NodePtr apart = makeBlend({ ball(), makeBlend({ b, ball() }), ball() });
  std::vector<double> value, expected;
  const VectorList gradient = gradients(*shared, points, value);
  const VectorList expectedGradient = gradients(*apart, points, expected);
  std::vector<std::int32_t> leaf(points.size()), expectedLeaf(points.size());
  shared->sourceLeaf(points, leaf.data());
  apart->sourceLeaf(points, expectedLeaf.data());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    EXPECT_NEAR(value[k], expected[k], 1e-14);
    EXPECT_LT((gradient[k] - expectedGradient[k]).norm(), 1e-13);
    EXPECT_EQ(leaf[k], expectedLeaf[k]);
    const Box3 box(points[k], Vec3(points[k].array() + 0.2));
    const Interval range = shared->range(box);
    EXPECT_LE(range.min, value[k]);
    EXPECT_GE(range.max, value[k]);
    const FieldSourcePtr part = shared->restrictedTo(box);
    double inPart = 0.0;
    if (part)
    {
      PointList one;
      one.add(points[k]);
      part->field(one, &inPart);
    }
    EXPECT_NEAR(inPart, value[k], 1e-14);
  }
  EXPECT_TRUE(shared->surfaceBounds().contains(Box3(Vec3(-0.7, -0.7, -0.7), Vec3(0.7, 0.7, 0.7))))
    << "three balls in one place are larger than one";
}

TEST(Operator, TooManyLeavesAreRefusedWithTheirNumber)
{
  const NodePtr node = chain(ball(), 19, kDoublings[0].second);
  for (const auto& [name, combine] : kDoublings)
  {
    SCOPED_TRACE(name);
    try
    {
      combine(node);
      ADD_FAILURE() << "2^20 leaves were accepted";
    }
    catch (const TooLarge& error)
    {
      EXPECT_NE(std::string(error.what()).find("1048576 leaves"), std::string::npos)
        << error.what();
    }
  }
}

// The longest chain that is allowed must be safe to ask, rebuild, write and destroy.
TEST(Operator, TheDeepestTreeWorksAndADeeperOneIsRefused)
{
  const BarrFrame frame;
  const Combine steps[] = {
    [](const NodePtr& node)
    { return makeBoolean(BooleanOperation::Union, node, ball(Vec3(0.2, 0.0, 0.0))); },
    [&](const NodePtr& node) { return makeTwist(node, frame, 1e-4); },
    [](const NodePtr& node) {
      return makeBlend({ node, ball(Vec3(3.0, 0.0, 0.0)) });
    },
    [](const NodePtr& node) { return makeLocalBlend(node, ball(), ball()); },
  };
  NodePtr node = ball();
  for (int k = 1; k < kLargestDepth; ++k)
  {
    // Few twists: their bounds take time.
    node = steps[k % 2 == 0 ? 0 : k % 101 == 0 ? 1 : k % 3 == 0 ? 2 : 3](node);
  }
  EXPECT_EQ(node->depth(), kLargestDepth);
  PointList points;
  points.add(Vec3(0.1, 0.2, 0.0));
  double value = 0.0;
  node->field(points, &value);
  EXPECT_GT(value, kThreshold);
  std::int8_t side = 0;
  node->membership(points, &side);
  EXPECT_EQ(side, 1);
  std::int32_t leaf = 0;
  node->sourceLeaf(points, &leaf);
  EXPECT_EQ(node->affine(Affine3(Eigen::Translation3d(1.0, 0.0, 0.0)))->depth(), kLargestDepth);
  EXPECT_EQ(node->underBlend()->depth(), kLargestDepth);
  EXPECT_EQ(fromText(toText(*node))->depth(), kLargestDepth);
  for (const Combine& step : steps)
  {
    EXPECT_THROW(step(node), TooLarge);
  }
  EXPECT_THROW(makeFreeForm(node, FreeFormLattice{}, FieldFrom::DeformedMesh), TooLarge);
}

// The mesh below a blend is made while the blend's is: it has to hear of the stop too.
TEST(Operator, ShapesThatMakeAMeshForTheirFieldListenToo)
{
  FreeFormLattice lattice;
  lattice.origin = Vec3(-1, -1, -1);
  lattice.axes = 2.0 * Mat3::Identity();
  for (int looks = 0; looks < 40; looks += 13)
  {
    const NodePtr deformed = makeFreeForm(ball(), lattice, FieldFrom::DeformedMesh);
    const NodePtr blend = makeBlend({ deformed, ball(Vec3(0.5, 0.0, 0.0)) });
    const CancelAt stop(looks);
    EXPECT_THROW(blend->mesh(0.1, stop), Cancelled) << looks;
    EXPECT_FALSE(blend->mesh(0.1)->empty()) << "the next one must find everything in order";
  }
}

} // namespace
} // namespace hybridtree::test

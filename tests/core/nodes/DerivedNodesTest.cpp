// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/DerivedNodes.h"

#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"

#include <gtest/gtest.h>

namespace hybridtree::test
{
namespace
{

NodePtr ball(double x)
{
  return makePrimitive(
    std::make_shared<PointSkeleton>(Vec3(x, 0, 0)), Potential::bySurfaceRadius(0.5, 1.0, 2));
}

TEST(DerivedNodes, AreTheSameObjectWhileAnyoneHoldsIt)
{
  DerivedNodes nodes;
  int made = 0;
  const NodePtr a = ball(1.0);
  const NodePtr b = ball(2.0);
  const Affine3 up(Eigen::Translation3d(0, 0, 1));
  const auto image = [&](const NodePtr& node, const Affine3& map)
  {
    return nodes.of({ { node, 0.0, 0 } }, map,
      [&]
      {
        ++made;
        return node->affine(map);
      });
  };
  NodePtr first = image(a, up);
  EXPECT_EQ(image(a, up), first);
  EXPECT_EQ(made, 1);
  EXPECT_NE(image(b, up), first);
  EXPECT_NE(image(a, Affine3(Eigen::Translation3d(0, 0, 2))), first);
  EXPECT_EQ(made, 3);
  EXPECT_EQ(image(a, up), first);
  first = nullptr;
  EXPECT_EQ(image(a, up)->influenceBounds().center(), Vec3(1, 0, 1));
  EXPECT_EQ(made, 4); // it was gone
}

TEST(DerivedNodes, AFailureLeavesNothing)
{
  DerivedNodes nodes;
  const NodePtr a = ball(1.0);
  const auto fail = []() -> NodePtr { throw std::runtime_error("no"); };
  EXPECT_THROW(nodes.of({ { a, 0.0, 0 } }, Affine3::Identity(), fail), std::runtime_error);
  EXPECT_EQ(nodes.of({ { a, 0.0, 0 } }, Affine3::Identity(), [&] { return a; }), a);
}

} // namespace
} // namespace hybridtree::test

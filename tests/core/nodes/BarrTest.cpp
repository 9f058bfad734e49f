// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/Barr.h"

#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Box.h"
#include "core/skeletons/Point.h"
#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

using test::PointList;
using test::Random;

NodePtr bar()
{
  return makePrimitive(
    std::make_shared<BoxSkeleton>(Vec3(0, 0, 1), Vec3(0.4, 0.3, 2.0), Mat3::Identity()),
    Potential::bySurfaceRadius(0.05, 0.2, 2));
}

BarrFrame along(double begin, double end)
{
  BarrFrame frame;
  frame.begin = begin;
  frame.end = end;
  return frame;
}

double volume(const Node& node)
{
  return signedVolume(*node.mesh(0.04));
}

TEST(Barr, TwistKeepsTheVolume)
{
  const NodePtr straight = bar();
  const NodePtr twisted = makeTwist(straight, along(0.2, 1.7), 2.5);
  EXPECT_NEAR(volume(*twisted), volume(*straight), 0.01 * volume(*straight));
}

TEST(Barr, BendKeepsTheVolumeOfWhatIsSymmetricAboutTheAxis)
{
  const NodePtr straight = bar();
  const NodePtr bent = makeBend(straight, along(0.2, 1.7), 2.0);
  EXPECT_NEAR(volume(*bent), volume(*straight), 0.01 * volume(*straight));
  EXPECT_TRUE(bent->warnings().empty());
}

TEST(Barr, TaperScalesTheVolumeBeyondItsRange)
{
  // All of the bar lies beyond the range: |J| = factor^2.
  const NodePtr straight = bar();
  const NodePtr tapered = makeTaper(straight, along(-3.0, -2.0), 0.5);
  EXPECT_NEAR(volume(*tapered), 0.25 * volume(*straight), 0.01 * volume(*straight));
}

TEST(Barr, ZeroAnglesAndUnitFactorsLeaveTheFieldAlone)
{
  const NodePtr straight = bar();
  Random random(1);
  const PointList points = test::randomPoints(random, straight->influenceBounds(), 300);
  std::vector<double> expected(points.size());
  straight->field(points, expected.data());
  BarrFrame frame = along(0.0, 1.0);
  frame.origin = Vec3(0.3, 0.1, 0.2);
  frame.axis = Vec3(1, 2, 3);
  for (const NodePtr& node : { makeTwist(straight, frame, 0.0), makeTaper(straight, frame, 1.0),
         makeBend(straight, frame, 0.0), makeBend(straight, frame, 1e-12) })
  {
    std::vector<double> value(points.size());
    node->field(points, value.data());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      ASSERT_NEAR(value[k], expected[k], 1e-10) << node->kind();
    }
  }
}

TEST(Barr, CoarseMeshesAreRefinedWhereTheyTwist)
{
  const NodePtr block = makeMeshNode(
    std::make_shared<const TriangleMesh>(test::box(Vec3(-0.2, -0.15, 0), Vec3(0.2, 0.15, 2))), 1.0,
    0.2, 2);
  const NodePtr twisted = makeTwist(block, along(0.0, 2.0), 3.0);
  const MeshPtr mesh = twisted->mesh(0.05);
  const MeshReport report = checkMesh(*mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_NEAR(signedVolume(*mesh), 0.4 * 0.3 * 2.0, 0.01 * 0.24);
  const PointList points(mesh->points);
  std::vector<double> value(points.size());
  twisted->field(points, value.data());
  for (const double f : value)
  {
    ASSERT_NEAR(f, kThreshold, 1e-6);
  }
  // Where vertices come from on the leaf: mapped forward again, they are the vertices.
  ASSERT_EQ(mesh->vertexOrigin.size(), mesh->points.size());
  const MeshPtr leaf = block->leafMesh();
  std::size_t known = 0;
  for (std::size_t k = 0; k < mesh->points.size(); ++k)
  {
    const VertexOrigin& origin = mesh->vertexOrigin[k];
    if (origin.leaf < 0)
    {
      continue;
    }
    ++known;
    const Triangle& corner = leaf->triangles[origin.triangle];
    const Vec3 q = (1.0 - origin.u - origin.v) * leaf->points[corner[0]] +
      origin.u * leaf->points[corner[1]] + origin.v * leaf->points[corner[2]];
    const Vec3 p = Eigen::AngleAxisd(1.5 * q[2], Vec3::UnitZ()) * q;
    ASSERT_LT((p - mesh->points[k]).norm(), 1e-9) << "vertex " << k;
  }
  EXPECT_GT(known, mesh->points.size() * 9 / 10);
}

TEST(Barr, WhatReachesPastTheAxisOfABendIsCutAndStaysClosed)
{
  const NodePtr ball = makePrimitive(
    std::make_shared<PointSkeleton>(Vec3(0, 0, 0.5)), Potential::bySurfaceRadius(0.5, 0.8, 2));
  const NodePtr bent = makeBend(ball, along(0.0, 1.0), 3.5); // radius 0.29
  EXPECT_EQ(bent->warnings().size(), 1u);
  const MeshPtr mesh = bent->mesh(0.05);
  const MeshReport report = checkMesh(*mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_FALSE(mesh->empty());
}

std::string errorOf(const std::function<void()>& action)
{
  try
  {
    action();
  }
  catch (const InvalidParameter& error)
  {
    return error.what();
  }
  return "";
}

TEST(Barr, RefusesWhatHasNoMeaning)
{
  const NodePtr node = bar();
  const auto names = [](const std::string& text, const char* part)
  { return text.find(part) != std::string::npos; };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  BarrFrame frame;
  EXPECT_TRUE(names(errorOf([&] { makeBend(node, frame, 4.6); }), "between -4.5 and 4.5"));
  EXPECT_TRUE(names(errorOf([&] { makeBend(node, frame, nan); }), "bend angle"));
  EXPECT_TRUE(names(errorOf([&] { makeTwist(node, frame, nan); }), "twist angle"));
  EXPECT_TRUE(names(errorOf([&] { makeTaper(node, frame, 0.0); }), "taper factor"));
  EXPECT_TRUE(names(errorOf([&] { makeTaper(node, frame, -1.0); }), "taper factor"));
  frame.axis = Vec3::Zero();
  EXPECT_TRUE(names(errorOf([&] { makeTwist(node, frame, 1.0); }), "axis is of length 0"));
  frame.axis = Vec3(0, 0, 2);
  frame.normal = Vec3(0, 0, -3);
  EXPECT_TRUE(names(errorOf([&] { makeTwist(node, frame, 1.0); }), "parallel to the axis"));
  frame.normal = Vec3(1, 0, nan);
  EXPECT_TRUE(names(errorOf([&] { makeTwist(node, frame, 1.0); }), "normal is not finite"));
  frame.normal = Vec3(1, 0, 5);
  frame.begin = 1.0;
  EXPECT_TRUE(names(errorOf([&] { makeTwist(node, frame, 1.0); }), "begin of the range"));
  frame.begin = -std::numeric_limits<double>::infinity();
  EXPECT_TRUE(names(errorOf([&] { makeTwist(node, frame, 1.0); }), "range"));
}

} // namespace
} // namespace hybridtree

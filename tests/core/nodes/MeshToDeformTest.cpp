// SPDX-License-Identifier: BSD-3-Clause
// The meshes that automatic blends give to maps (Node::meshToDeform).
#include "core/base/Parallel.h"
#include "core/mesh/ContentHash.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/Barr.h"
#include "core/nodes/BlendMesh.h"
#include "core/nodes/Deformation.h"
#include "core/nodes/FramedWarp.h"
#include "core/nodes/LocalBlend.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"
#include "core/skeletons/Segment.h"

#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace hybridtree::test
{
namespace
{

constexpr double kEdge = 0.025;

NodePtr ball(const Vec3& center, double radius)
{
  return makePrimitive(
    std::make_shared<PointSkeleton>(center), Potential::bySurfaceRadius(radius, 1.5 * radius, 2));
}

NodePtr limb(const Vec3& a, const Vec3& b, double radius)
{
  return makePrimitive(
    std::make_shared<SegmentSkeleton>(a, b), Potential::bySurfaceRadius(radius, 1.5 * radius, 2));
}

/// Balls and limbs that overlap more or less; made anew at each call.
NodePtr blendOf(std::uint64_t seed)
{
  Random random(seed);
  std::vector<NodePtr> children{ ball(Vec3::Zero(), 0.5) };
  const double distance = 0.85 + 0.04 * static_cast<double>(seed % 10);
  const Vec3 place = distance * random.direction();
  children.push_back(seed % 2 == 0 ? ball(place, 0.4) : limb(place, 1.6 * place, 0.3));
  if (seed % 3 == 0)
  {
    return makeLocalBlend(children[0], children[1], ball(0.5 * place, 0.3));
  }
  return makeBlend(std::move(children), { BlendMethod::Automatic, 1.0 });
}

using Map = std::function<NodePtr(NodePtr)>;

Map mapOf(std::uint64_t seed)
{
  Random random(100 + seed);
  BarrFrame frame;
  frame.axis = random.direction();
  frame.normal = frame.axis.unitOrthogonal();
  frame.begin = random.uniform(-0.8, -0.1);
  frame.end = random.uniform(0.1, 0.8);
  const double angle = random.uniform(0.5, 1.2);
  const Map twist = [=](NodePtr node) { return makeTwist(std::move(node), frame, angle); };
  const Map taper = [=](NodePtr node) { return makeTaper(std::move(node), frame, 0.5 * angle); };
  const Map bend = [=](NodePtr node) { return makeBend(std::move(node), frame, 0.4 * angle); };
  switch (seed % 4)
  {
    case 0:
      return twist;
    case 1:
      return taper;
    case 2:
      return bend;
    default:
      return [=](NodePtr node) { return bend(twist(std::move(node))); };
  }
}

/// Twists about an axis through the first ball.
FramedWarp<TwistMap> twistBy(double angle)
{
  return { TwistMap{ -0.5, 0.5, angle }, Affine3::Identity() };
}

/// What a twist gets from a blend; null where that is the mesh that all others get.
MeshPtr otherMesh(const NodePtr& node, double angle)
{
  const FramedWarp<TwistMap> twist = twistBy(angle);
  return node->otherMeshToDeform(kEdge, Deformation(twist, Deformation::If::OneToOne));
}

std::uint64_t hashOf(const MeshPtr& mesh)
{
  return contentHash(*mesh);
}

void expectSound(const NodePtr& node, const MeshPtr& mesh)
{
  const MeshReport report = checkMesh(*mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  ASSERT_EQ(mesh->normals.size(), mesh->points.size());
  PointList points(mesh->points);
  std::vector<double> value(points.size());
  node->field(points, value.data());
  double worst = 0.0;
  for (const double v : value)
  {
    worst = std::max(worst, std::abs(v - kThreshold));
  }
  EXPECT_LT(worst, 0.01);
}

// In a fresh tree on one thread; and on three, after all that hangs together has been asked for.
TEST(MeshToDeform, IsTheSameWhateverWasAskedBefore)
{
  for (std::uint64_t seed = 0; seed < 12; ++seed)
  {
    SCOPED_TRACE(seed);
    setThreadCount(1);
    forgetBlends();
    const NodePtr alone = mapOf(seed)(blendOf(seed));
    const MeshPtr expected = alone->mesh(kEdge);
    expectSound(alone, expected);
    forgetBlends();
    const std::uint64_t plain = hashOf(blendOf(seed)->mesh(kEdge));

    setThreadCount(3);
    forgetBlends();
    const NodePtr below = blendOf(seed);
    const NodePtr last = mapOf(seed)(below);
    if (seed % 2 == 0)
    {
      EXPECT_EQ(hashOf(below->mesh(kEdge)), plain);
    }
    mapOf(seed + 1)(below)->mesh(kEdge);
    mapOf(seed + 3)(last)->mesh(kEdge);
    EXPECT_EQ(hashOf(last->mesh(kEdge)), hashOf(expected));
    EXPECT_EQ(hashOf(below->mesh(kEdge)), plain);
  }
  setThreadCount(0);
}

// Both ways are taken; where the other one is not, there is one mesh for all who ask.
TEST(MeshToDeform, IsThePlainOneWhereThatIsCheaper)
{
  std::array<int, 2> others{};
  for (std::uint64_t seed = 0; seed < 12; ++seed)
  {
    SCOPED_TRACE(seed);
    const NodePtr node = blendOf(seed);
    const FramedWarp<TwistMap> twist = twistBy(1.5);
    const Deformation deformation(twist, Deformation::If::OneToOne);
    const MeshPtr other = node->otherMeshToDeform(kEdge, deformation);
    const MeshPtr mesh = node->meshToDeform(kEdge, deformation);
    ++others[other ? 1 : 0];
    if (other)
    {
      EXPECT_EQ(mesh, other); // kept as well
      EXPECT_NE(mesh, node->mesh(kEdge));
      expectSound(node, other);
    }
    else
    {
      EXPECT_EQ(mesh, node->mesh(kEdge));
    }
  }
  EXPECT_GT(others[0], 1);
  EXPECT_GT(others[1], 1);
}

// A map that leaves triangles as they are costs the same over any mesh.
TEST(MeshToDeform, MapsThatChangeLittleGetThePlainMesh)
{
  for (std::uint64_t seed = 0; seed < 12; ++seed)
  {
    EXPECT_EQ(otherMesh(blendOf(seed), 0.02), nullptr) << seed;
  }
}

TEST(MeshToDeform, OnlyAutomaticBlendsChoose)
{
  const std::vector<NodePtr> balls{ ball(Vec3::Zero(), 0.5), ball(Vec3(1.2, 0, 0), 0.4) };
  for (const BlendMethod method :
    { BlendMethod::Global, BlendMethod::NodeBased, BlendMethod::PrimitiveBased })
  {
    EXPECT_EQ(otherMesh(makeBlend(balls, { method, 1.0 }), 1.5), nullptr);
  }
  EXPECT_EQ(otherMesh(balls[0], 1.5), nullptr);
}

} // namespace
} // namespace hybridtree::test

// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BooleanNest.h"

#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"
#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

namespace hybridtree
{
namespace
{

using namespace test;

constexpr auto kUnion = BooleanOperation::Union;
constexpr auto kIntersection = BooleanOperation::Intersection;
constexpr auto kDifference = BooleanOperation::Difference;

std::vector<NodePtr> scatteredSolids(Random& random, int count)
{
  std::vector<NodePtr> solids;
  for (int k = 0; k < count; ++k)
  {
    const Mat3 turn = random.rotation();
    const Vec3 shift = 1.3 * random.unit() * random.direction();
    TriangleMesh mesh = k % 2 == 0 ? icosphere(0.5, 2) : torus(0.5, 0.2, 20, 10);
    for (Vec3& point : mesh.points)
    {
      point = turn * point + shift;
    }
    solids.push_back(makeMeshNode(std::make_shared<const TriangleMesh>(mesh), 1.0, 0.2, 2));
  }
  return solids;
}

NodePtr chainOf(BooleanOperation operation, const std::vector<NodePtr>& operands)
{
  NodePtr chain = operands.front();
  for (std::size_t k = 1; k < operands.size(); ++k)
  {
    chain = makeBoolean(operation, chain, operands[k]);
  }
  return chain;
}

TEST(BooleanNest, IsThatOfOneAfterTheOther)
{
  Random random(31);
  for (const int count : { 2, 3, 6, 13 })
  {
    const std::vector<NodePtr> solids = scatteredSolids(random, count);
    for (const BooleanOperation operation : { kUnion, kIntersection, kDifference })
    {
      const NodePtr all = BooleanNest().make(operation, solids);
      const MeshPtr mesh = all->mesh(0.1);
      EXPECT_TRUE(isClosedManifold(*mesh)) << checkMesh(*mesh).describe();
      EXPECT_NEAR(signedVolume(*mesh), signedVolume(*chainOf(operation, solids)->mesh(0.1)), 1e-9);
      EXPECT_EQ(all->leafCount(), count);
    }
  }
}

TEST(BooleanNest, NestsAsDeepAsTheLogarithm)
{
  const std::vector<NodePtr> solids(100,
    makePrimitive(
      std::make_shared<PointSkeleton>(Vec3::Zero()), Potential::bySurfaceRadius(1.0, 2.0, 2)));
  EXPECT_EQ(BooleanNest().make(kUnion, { solids.front() }), solids.front());
  EXPECT_LE(BooleanNest().make(kUnion, solids)->depth(), 8);
  EXPECT_LE(BooleanNest().make(kDifference, solids)->depth(), 9);
  EXPECT_THROW(BooleanNest().make(kUnion, {}), InvalidParameter);
}

TEST(BooleanNest, KeepsWhatIsNotAboveAChange)
{
  Random random(5);
  std::vector<NodePtr> solids = scatteredSolids(random, 8);
  BooleanNest nest;
  const NodePtr before = nest.make(kUnion, solids);
  EXPECT_EQ(nest.make(kUnion, solids), before);
  solids[6] = scatteredSolids(random, 1).front();
  const NodePtr after = nest.make(kUnion, solids);
  EXPECT_NE(after, before);
  EXPECT_EQ(after->children()[0], before->children()[0]);
  EXPECT_NE(after->children()[1], before->children()[1]);
  EXPECT_EQ(after->children()[1]->children()[0], before->children()[1]->children()[0]);
  EXPECT_NE(nest.make(kIntersection, solids)->children()[0], after->children()[0]);
}

} // namespace
} // namespace hybridtree

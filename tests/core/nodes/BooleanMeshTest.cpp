// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BooleanMesh.h"

#include "core/mesh/MeshChecks.h"
#include "core/nodes/BooleanNest.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/skeletons/Point.h"
#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace hybridtree
{
namespace
{

using namespace test;

constexpr auto kUnion = BooleanOperation::Union;
constexpr auto kIntersection = BooleanOperation::Intersection;
constexpr auto kDifference = BooleanOperation::Difference;

NodePtr leafOf(const TriangleMesh& mesh)
{
  return makeMeshNode(std::make_shared<const TriangleMesh>(mesh), 1.0, 0.2, 2);
}

NodePtr ball(const Vec3& center, double radius)
{
  return makePrimitive(
    std::make_shared<PointSkeleton>(center), Potential::bySurfaceRadius(radius, 2.0 * radius, 2));
}

void gatherLeaves(const NodePtr& node, std::vector<MeshPtr>& leaves)
{
  if (node->children().empty())
  {
    leaves.push_back(node->leafMesh());
  }
  for (const NodePtr& child : node->children())
  {
    gatherLeaves(child, leaves);
  }
}

// Points and triangles of a mesh made of nothing but mesh leaves are where they say they are.
void expectProvenance(const NodePtr& tree)
{
  std::vector<MeshPtr> leaves;
  gatherLeaves(tree, leaves);
  const MeshPtr mesh = tree->mesh(0.1);
  ASSERT_FALSE(mesh->empty());
  ASSERT_EQ(mesh->vertexOrigin.size(), mesh->points.size());
  ASSERT_EQ(mesh->sourceTriangle.size(), mesh->triangles.size());
  for (std::size_t k = 0; k < mesh->points.size(); ++k)
  {
    const VertexOrigin& origin = mesh->vertexOrigin[k];
    ASSERT_GE(origin.leaf, 0);
    const TriangleMesh& leaf = *leaves[std::size_t(origin.leaf)];
    const Triangle& corner = leaf.triangles[std::size_t(origin.triangle)];
    const Vec3 place = (1.0 - origin.u - origin.v) * leaf.points[std::size_t(corner[0])] +
      origin.u * leaf.points[std::size_t(corner[1])] +
      origin.v * leaf.points[std::size_t(corner[2])];
    EXPECT_LT((place - mesh->points[k]).norm(), 1e-12);
  }
  for (std::size_t t = 0; t < mesh->triangles.size(); ++t)
  {
    const TriangleMesh& leaf = *leaves[std::size_t(mesh->sourceLeaf[t])];
    const std::size_t source = std::size_t(mesh->sourceTriangle[t]);
    const Vec3 normal = areaNormal(leaf, source).normalized();
    const Vec3& origin = leaf.points[std::size_t(leaf.triangles[source][0])];
    for (const std::int32_t vertex : mesh->triangles[t])
    {
      EXPECT_NEAR(normal.dot(mesh->points[std::size_t(vertex)] - origin), 0.0, 1e-12);
    }
  }
}

TEST(BooleanMesh, ProvenanceFollowsThroughNestedCuts)
{
  const NodePtr a = leafOf(bumpySphere(1.0, 3));
  const NodePtr b = leafOf(torus(0.9, 0.3, 30, 12));
  const NodePtr c = leafOf(box(Vec3(-0.2, -2.0, -0.3), Vec3(0.31, 2.0, 0.29)));
  expectProvenance(makeBoolean(kUnion, a, b));
  expectProvenance(makeBoolean(kDifference, makeBoolean(kUnion, a, b), c));
  expectProvenance(makeBoolean(kIntersection, c, makeBoolean(kDifference, a, b)));
}

// A plate less balls, one after the other.
NodePtr drilledInTurn(int holes, FacetMerging merging)
{
  NodePtr plate = leafOf(box(Vec3(0.0, 0.0, 0.0), Vec3(4.0, 3.0, 0.3)));
  for (int k = 0; k < holes; ++k)
  {
    const Vec3 center(0.5 + 0.7 * (k % 4), 0.5 + 0.7 * (k / 4), 0.15);
    plate = makeBoolean(
      kDifference, plate, leafOf(icosphere(0.4, 2, center)), BooleanForm::Automatic, merging);
  }
  return plate;
}

TEST(BooleanMesh, CutsInTurnLeaveTheRestOfATriangleInOnePiece)
{
  const NodePtr merged = drilledInTurn(12, FacetMerging::Parts);
  const NodePtr plain = drilledInTurn(12, FacetMerging::None);
  const MeshPtr mesh = merged->mesh(0.1);
  EXPECT_TRUE(checkMesh(*mesh).closedManifold()) << checkMesh(*mesh).describe();
  EXPECT_NEAR(signedVolume(*mesh), signedVolume(*plain->mesh(0.1)), 1e-12);
  EXPECT_LT(mesh->points.size(), plain->mesh(0.1)->points.size());
  expectProvenance(merged);
  const MeshPtr again = drilledInTurn(12, FacetMerging::Parts)->mesh(0.1);
  EXPECT_EQ(mesh->points, again->points);
  EXPECT_EQ(mesh->triangles, again->triangles);
}

TEST(BooleanMesh, MergingIsAParameter)
{
  const NodePtr plain = drilledInTurn(1, FacetMerging::None);
  EXPECT_EQ(plain->parameters().getString("merging"), "none");
  const NodePtr read = booleanFromParameters(plain->parameters(), plain->children(), {});
  EXPECT_EQ(read->parameters().entries(), plain->parameters().entries());
  EXPECT_FALSE(drilledInTurn(1, FacetMerging::Parts)->parameters().has("merging"));
}

TEST(BooleanMesh, PointsAwayFromTheCutAreTheLeavesOwn)
{
  const TriangleMesh a = bumpySphere(1.0, 4);
  const TriangleMesh b = icosphere(0.5, 4, Vec3(1.0, 0.2, 0.1));
  std::set<std::array<double, 3>> own;
  for (const TriangleMesh* mesh : { &a, &b })
  {
    for (const Vec3& p : mesh->points)
    {
      own.insert({ p.x(), p.y(), p.z() });
    }
  }
  const NodePtr tree = makeBoolean(kUnion, leafOf(a), leafOf(b));
  const MeshPtr mesh = tree->mesh(0.1);
  std::size_t made = 0;
  for (const Vec3& p : mesh->points)
  {
    made += own.count({ p.x(), p.y(), p.z() }) == 0;
  }
  std::size_t onCurves = 0;
  for (const std::vector<Vec3>& curve : intersectionCurves(*tree, 0.1))
  {
    onCurves += curve.size() - (curve.front() == curve.back());
  }
  EXPECT_GT(made, 0u);
  EXPECT_EQ(made, onCurves);
}

TEST(BooleanMesh, EdgesOfBoxesAreExact)
{
  const NodePtr a = leafOf(box(Vec3(0, 0, 0), Vec3(1, 1, 1)));
  const NodePtr b = leafOf(box(Vec3(0.25, 0.5, 0.5), Vec3(0.75, 2.0, 2.0)));
  const std::array<double, 3> volume = { 1.0 + 0.5 * 1.5 * 1.5 - 0.125, 0.125, 0.875 };
  for (const BooleanOperation operation : { kUnion, kIntersection, kDifference })
  {
    const NodePtr tree = makeBoolean(operation, a, b);
    EXPECT_NEAR(signedVolume(*tree->mesh(0.5)), volume[std::size_t(operation)], 1e-14);
    EXPECT_TRUE(tree->warnings().empty());
  }
}

TEST(BooleanMesh, CutOfImplicitBallsLiesOnBoth)
{
  const double edge = 0.1;
  const Vec3 center(0.9, 0.3, 0.2);
  for (const BooleanOperation operation : { kUnion, kIntersection, kDifference })
  {
    const NodePtr tree = makeBoolean(operation, ball(Vec3::Zero(), 1.0), ball(center, 0.7));
    EXPECT_TRUE(isClosedManifold(*tree->mesh(edge)));
    const auto curves = intersectionCurves(*tree, edge);
    ASSERT_EQ(curves.size(), 1u);
    EXPECT_EQ(curves[0].front(), curves[0].back());
    EXPECT_GT(curves[0].size(), 20u);
    const auto off = std::count_if(curves[0].begin(), curves[0].end(),
      [&](const Vec3& p)
      {
        return std::abs(p.norm() - 1.0) > 1e-6 * edge ||
          std::abs((p - center).norm() - 0.7) > 1e-6 * edge;
      });
    EXPECT_EQ(off, 0);
  }
}

TEST(BooleanMesh, AChildThatCrossesItselfAtTheCutIsMeshedOnTheLattice)
{
  const NodePtr twice = leafOf(joined(icosphere(1.0, 3), icosphere(1.0, 3, Vec3(0.5, 0.1, 0.2))));
  const NodePtr bar = leafOf(box(Vec3(-2, -0.3, -0.31), Vec3(2, 0.32, 0.33)));
  const NodePtr tree = makeBoolean(kUnion, bar, twice);
  const MeshPtr mesh = tree->mesh(0.1);
  EXPECT_TRUE(isClosedManifold(*mesh));
  EXPECT_GT(signedVolume(*mesh), 4.0);
  const std::vector<std::string> warnings = tree->warnings();
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_NE(warnings[1].find("lattice"), std::string::npos);
  EXPECT_TRUE(intersectionCurves(*tree, 0.1).empty());
}

double lengthOf(const std::vector<std::vector<Vec3>>& curves)
{
  double length = 0.0;
  for (const std::vector<Vec3>& curve : curves)
  {
    for (std::size_t k = 1; k < curve.size(); ++k)
    {
      length += (curve[k] - curve[k - 1]).norm();
    }
  }
  return length;
}

// Bricks across a beam: each outlines its ends on it, and a further cut takes from the outlines
// what it takes from the solid.
TEST(BooleanCurves, GoOnThroughFurtherCuts)
{
  const NodePtr beam = leafOf(box(Vec3(-3.0, -0.5, -0.5), Vec3(3.0, 0.5, 0.5)));
  const NodePtr first = leafOf(box(Vec3(-1.0, -1.0, -1.0), Vec3(-0.5, 1.0, 1.0)));
  const NodePtr second = leafOf(box(Vec3(0.5, -1.0, -1.0), Vec3(1.0, 1.0, 1.0)));
  const NodePtr all = BooleanNest().make(kUnion, { beam, first, second });
  const auto curves = intersectionCurves(*all, 0.1);
  EXPECT_EQ(curves.size(), 4u);
  EXPECT_NEAR(lengthOf(curves), 16.0, 1e-9);
  for (const auto& curve : curves)
  {
    EXPECT_EQ(curve.front(), curve.back());
  }
  // The upper half goes: half of every outline, and a new one around each of the pieces.
  const NodePtr upper = leafOf(box(Vec3(-5.0, -5.0, 0.0), Vec3(5.0, 5.0, 5.0)));
  const auto halves = intersectionCurves(*makeBoolean(kDifference, all, upper), 0.1);
  EXPECT_NEAR(lengthOf(halves), 4 * 2.0 + (2.0 * 6.0 + 2.0 * 1.0 + 4.0 * 0.5 * 2.0), 1e-9);
}

} // namespace
} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/FreeForm.h"

#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/Blend.h"
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

using test::PointList;
using test::Random;

NodePtr ball(const Vec3& center = Vec3::Zero())
{
  return makePrimitive(
    std::make_shared<PointSkeleton>(center), Potential::bySurfaceRadius(0.5, 0.9, 2));
}

// Around the unit ball, with nothing displaced.
FreeFormLattice lattice(const std::array<int, 3>& dimensions = { 4, 4, 4 })
{
  FreeFormLattice result;
  result.dimensions = dimensions;
  result.origin = Vec3(-1, -1, -1);
  result.axes = 2.0 * Mat3::Identity();
  result.displacements.assign(
    std::size_t(dimensions[0] * dimensions[1] * dimensions[2]), Vec3::Zero());
  return result;
}

std::vector<double> fieldAt(const Node& node, const PointList& points)
{
  std::vector<double> value(points.size());
  node.field(points, value.data());
  return value;
}

TEST(FreeForm, LatticeAtRestLeavesTheFieldUnchanged)
{
  Random random(1);
  const NodePtr child = makeBlend({ ball(), ball(Vec3(0.3, 0.2, 0.1)) });
  const NodePtr exact = makeFreeForm(child, lattice({ 3, 2, 5 }), FieldFrom::InverseMap);
  const PointList points = test::randomPoints(random, child->influenceBounds(), 500);
  EXPECT_EQ(fieldAt(*exact, points), fieldAt(*child, points));
  EXPECT_TRUE(exact->warnings().empty());
}

TEST(FreeForm, DeformedMeshKeepsTheFieldOfASinglePrimitive)
{
  Random random(2);
  const NodePtr child = ball();
  const NodePtr meshed = makeFreeForm(child, lattice(), FieldFrom::DeformedMesh, 0.03);
  const PointList points = test::randomPoints(random, child->influenceBounds(), 500);
  const std::vector<double> expected = fieldAt(*child, points);
  const std::vector<double> value = fieldAt(*meshed, points);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    ASSERT_NEAR(value[k], expected[k], 5e-3) << "at " << points[k].transpose();
  }
}

TEST(FreeForm, AffineDisplacementsAreTheAffineImage)
{
  Random random(3);
  const NodePtr child = ball(Vec3(0.1, 0, 0));
  Affine3 map = Affine3::Identity();
  map.linear() << 1.2, 0.3, 0.0, -0.1, 0.9, 0.2, 0.0, 0.1, 1.1;
  map.translation() = Vec3(0.2, -0.1, 0.3);
  FreeFormLattice grid = lattice({ 3, 4, 2 });
  std::size_t at = 0;
  for (int k = 0; k < 2; ++k)
  {
    for (int j = 0; j < 4; ++j)
    {
      for (int i = 0; i < 3; ++i)
      {
        const Vec3 rest = grid.origin + grid.axes * Vec3(i / 2.0, j / 3.0, k / 1.0);
        grid.displacements[at++] = map * rest - rest;
      }
    }
  }
  // The child's field ends within the lattice, so all of it is carried along.
  const NodePtr exact = makeFreeForm(child, grid, FieldFrom::InverseMap);
  EXPECT_TRUE(exact->warnings().empty());
  const NodePtr image = child->affine(map);
  const PointList points = test::randomPoints(random, image->influenceBounds(), 1000);
  const std::vector<double> expected = fieldAt(*image, points);
  const std::vector<double> value = fieldAt(*exact, points);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    // Beyond the image of the box the child at rest shows through: outside of its influence only.
    ASSERT_NEAR(value[k], expected[k], 1e-10) << "at " << points[k].transpose();
  }
}

TEST(FreeForm, DeformedMeshIsTheSurfaceOfItsField)
{
  Random random(4);
  FreeFormLattice grid = lattice();
  for (const int at : { 21, 22, 25, 42 }) // inner control points
  {
    grid.displacements[std::size_t(at)] = 0.5 * random.direction();
  }
  const NodePtr children[] = { ball(),
    makeBlend({ ball(Vec3(-0.2, 0, 0)), ball(Vec3(0.3, 0.2, 0.1)) }),
    makeMeshNode(std::make_shared<const TriangleMesh>(test::bumpySphere(0.6, 3)), 1.0, 0.2, 2) };
  for (const NodePtr& child : children)
  {
    const NodePtr node = makeFreeForm(child, grid, FieldFrom::DeformedMesh, 0.05);
    const MeshPtr mesh = node->mesh();
    EXPECT_TRUE(isClosedManifold(*mesh)) << checkMesh(*mesh).describe();
    EXPECT_GT(signedVolume(*mesh), 0.0);
    for (const double f : fieldAt(*node, PointList(mesh->points)))
    {
      ASSERT_NEAR(f, kThreshold, 1e-9);
    }
    // An affine image reuses the mesh, vertex by vertex.
    Affine3 map = Affine3::Identity();
    map.linear() << 0.0, -2.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, -2.0; // mirrors
    const MeshPtr image = node->affine(map)->mesh();
    ASSERT_EQ(image->points.size(), mesh->points.size());
    for (std::size_t k = 0; k < mesh->points.size(); ++k)
    {
      ASSERT_EQ(image->points[k], map * mesh->points[k]);
    }
    EXPECT_NEAR(signedVolume(*image), 8.0 * signedVolume(*mesh), 1e-9);
  }
}

TEST(FreeForm, BothFormsHaveTheSameSurface)
{
  FreeFormLattice grid = lattice();
  grid.displacements[21] = Vec3(0.3, 0.2, -0.3);
  grid.displacements[42] = Vec3(-0.1, 0.4, 0.2);
  const NodePtr meshed = makeFreeForm(ball(), grid, FieldFrom::DeformedMesh, 0.03);
  const NodePtr exact = makeFreeForm(ball(), grid, FieldFrom::InverseMap);
  EXPECT_TRUE(exact->warnings().empty());
  const PointList points(meshed->mesh()->points);
  for (const double f : fieldAt(*exact, points))
  {
    ASSERT_NEAR(f, kThreshold, 2e-3);
  }
}

TEST(FreeForm, MeshLeafOutsideOfTheDeformationKeepsItsVertices)
{
  const auto leaf = std::make_shared<const TriangleMesh>(test::bumpySphere(0.6, 3));
  FreeFormLattice grid = lattice();
  grid.origin = Vec3(0.2, -1, -1); // only the part x > 0.2
  for (const int at : { 21, 22, 25, 26, 37, 38, 41, 42 })
  {
    grid.displacements[std::size_t(at)] = Vec3(0.1, 0.05, 0.0);
  }
  const NodePtr node =
    makeFreeForm(makeMeshNode(leaf, 1.0, 0.2, 2), grid, FieldFrom::DeformedMesh, 0.2);
  const MeshPtr mesh = node->mesh();
  ASSERT_EQ(mesh->vertexOrigin.size(), mesh->points.size());
  std::size_t kept = 0;
  std::size_t moved = 0;
  for (const Vec3& p : leaf->points)
  {
    const bool there = std::find(mesh->points.begin(), mesh->points.end(), p) != mesh->points.end();
    kept += p[0] < 0.2 && there;
    moved += p[0] > 0.3 && !there;
    if (p[0] < 0.0)
    {
      ASSERT_TRUE(there) << p.transpose();
    }
  }
  EXPECT_GT(kept, leaf->points.size() / 4);
  EXPECT_GT(moved, 0u);
}

TEST(FreeForm, FoldsWarnAndTheInverseMapFallsBackOnTheMesh)
{
  FreeFormLattice grid = lattice();
  grid.displacements[21] = Vec3(12.0, 0, 0);
  const NodePtr node = makeFreeForm(ball(), grid, FieldFrom::InverseMap, 0.1);
  ASSERT_EQ(node->warnings().size(), 1u);
  EXPECT_NE(node->warnings()[0].find("folds"), std::string::npos);
  EXPECT_NE(node->warnings()[0].find("deformed mesh instead"), std::string::npos);
  EXPECT_FALSE(node->mesh()->empty());
  EXPECT_EQ(node->parameters().getString("fieldFrom"), "inverseMap");
}

TEST(FreeForm, WarnsOnlyWhereAShapeReachesThroughDisplacedFaces)
{
  const NodePtr child = makePrimitive(
    std::make_shared<PointSkeleton>(Vec3::Zero()), Potential::bySurfaceRadius(0.5, 1.0, 2));
  for (const double half : { 0.6, 0.4 })
  {
    FreeFormLattice grid;
    grid.dimensions = { 2, 2, 2 };
    grid.origin = Vec3::Constant(-half);
    grid.axes = 2.0 * half * Mat3::Identity();
    grid.displacements.assign(8, Vec3(0.0, 0.0, 0.1));
    const NodePtr moved = makeFreeForm(child, grid, FieldFrom::DeformedMesh, 0.1);
    EXPECT_EQ(moved->warnings().size(), half > 0.5 ? 0u : 1u) << "half " << half;
  }
}

TEST(FreeForm, ControlLatticeFollowsTheNode)
{
  FreeFormLattice grid = lattice({ 2, 3, 4 });
  grid.displacements[5] = Vec3(0.1, 0.2, 0.3);
  const ControlLattice drawn = controlLattice(grid);
  EXPECT_EQ(drawn.points.size(), 24u);
  EXPECT_EQ(drawn.edges.size(), 1u * 3 * 4 + 2u * 2 * 4 + 2u * 3 * 3);
  EXPECT_LT((drawn.points[5] - Vec3(1.1, 1.2, -0.7)).norm(), 1e-14);
  Affine3 map = Affine3::Identity();
  map.linear() << 1, 0.5, 0, 0, 2, 0, 0, 0, -1;
  map.translation() = Vec3(1, 2, 3);
  for (const FieldFrom from : { FieldFrom::DeformedMesh, FieldFrom::InverseMap })
  {
    const auto image = controlLattice(*makeFreeForm(ball(), grid, from)->affine(map));
    ASSERT_TRUE(image.has_value());
    for (std::size_t k = 0; k < drawn.points.size(); ++k)
    {
      EXPECT_LT((image->points[k] - map * drawn.points[k]).norm(), 1e-13);
    }
  }
  EXPECT_FALSE(controlLattice(*ball()).has_value());
}

TEST(FreeForm, RefusesWhatHasNoMeaning)
{
  const auto make = [](const FreeFormLattice& grid, double edgeLength = 0.0)
  { makeFreeForm(ball(), grid, FieldFrom::DeformedMesh, edgeLength); };
  FreeFormLattice grid = lattice();
  EXPECT_THROW(make(grid, -1.0), InvalidParameter);
  grid.displacements.pop_back();
  EXPECT_THROW(make(grid), InvalidParameter);
  grid = lattice();
  grid.displacements[3][1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(make(grid), InvalidParameter);
  grid = lattice();
  grid.axes.col(2) = grid.axes.col(0) - grid.axes.col(1);
  EXPECT_THROW(make(grid), InvalidParameter);
  for (const int bad : { 1, 0, -3, 65 })
  {
    grid = lattice();
    grid.dimensions[1] = bad;
    EXPECT_THROW(make(grid), InvalidParameter) << bad;
  }
}

} // namespace
} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/SkeletonMesh.h"

#include "core/base/Parallel.h"
#include "core/mesh/MeshChecks.h"
#include "core/mesh/MeshDistance.h"
#include "core/nodes/LatticeMesh.h"
#include "tests/core/subdivision/SkeletonFieldCase.h"
#include "tests/support/CancelAt.h"
#include "tests/support/Random.h"
#include "tests/support/SkeletonShapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace hybridtree
{
namespace
{

using test::SkeletonFieldCase;

double farthest(const TriangleMesh& from, const TriangleMesh& to)
{
  const MeshDistance distance(std::make_shared<TriangleMesh>(to));
  const test::PointList points(from.points);
  std::vector<double> off(points.size());
  distance.distance(points, std::numeric_limits<double>::infinity(), off.data());
  return *std::max_element(off.begin(), off.end());
}

/// The smallest angle that all but one in a hundred triangles have, degrees.
double commonSmallestAngle(const TriangleMesh& mesh)
{
  std::vector<double> angles;
  for (const Triangle& t : mesh.triangles)
  {
    double least = 180.0;
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 u = mesh.points[t[(k + 1) % 3]] - mesh.points[t[k]];
      const Vec3 v = mesh.points[t[(k + 2) % 3]] - mesh.points[t[k]];
      least = std::min(least, std::atan2(u.cross(v).norm(), u.dot(v)) * 180.0 / std::acos(-1.0));
    }
    angles.push_back(least);
  }
  std::sort(angles.begin(), angles.end());
  return angles[angles.size() / 100];
}

void expectOnSurface(const SkeletonFieldCase& shape, const TriangleMesh& mesh, double cell)
{
  std::vector<Vec3> gradient;
  const std::vector<double> value = fieldAt(*shape.node, mesh.points, &gradient);
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    ASSERT_LT(std::abs(value[k] - kThreshold) / gradient[k].norm(), 1e-3 * cell);
  }
}

/// Any tree of limbs, some with a triangle at their end.
SkeletonGraph randomSkeleton(std::uint64_t seed)
{
  test::Random random(seed);
  SkeletonGraph graph;
  const auto add = [&](const Vec3& at, double radius)
  {
    graph.points.push_back(at);
    graph.radii.push_back(radius);
    return std::int32_t(graph.points.size() - 1);
  };
  std::vector<std::int32_t> joints{ add(Vec3::Zero(), random.uniform(0.2, 0.4)) };
  const int count = random.integer(4, 12);
  for (int k = 1; k <= count; ++k)
  {
    const std::int32_t from = joints[std::size_t(random.integer(std::max(0, k - 4), k - 1))];
    const Vec3 at = graph.points[from] + random.uniform(0.7, 1.6) * random.direction();
    joints.push_back(add(at, random.uniform(0.15, 0.4)));
    graph.segments.push_back({ from, joints.back() });
    if (random.chance(0.3))
    {
      const Vec3 way = random.direction();
      const std::int32_t a = add(at + way, random.uniform(0.15, 0.3));
      const std::int32_t b = add(at + way + 0.9 * way.unitOrthogonal(), random.uniform(0.15, 0.3));
      graph.triangles.push_back({ joints.back(), a, b });
    }
  }
  return graph;
}

TEST(SkeletonMesh, IsOneClosedManifoldWithTheTopologyAndThePlaceOfTheLattice)
{
  const std::pair<SkeletonGraph, double> cases[] = { { test::bretzel(), 0.15 },
    { test::figure7(), 0.12 }, { test::alien(), 0.1 }, { test::fan(5, true), 0.07 },
    { test::chain(5), 0.1 } };
  for (const auto& [graph, cell] : cases)
  {
    const SkeletonFieldCase shape(graph);
    SkeletonMeshOptions options;
    options.edgeLength = cell;
    const std::optional<StitchedMesh> made = skeletonMesh(shape.field(), options);
    ASSERT_TRUE(made.has_value());
    const TriangleMesh& mesh = made->mesh;
    const TriangleMesh lattice = latticeMesh(*shape.node, cell, Progress::none());
    const MeshReport report = checkMesh(mesh);
    EXPECT_TRUE(report.closedManifold()) << report.describe();
    EXPECT_EQ(report.eulerCharacteristic, checkMesh(lattice).eulerCharacteristic);
    EXPECT_EQ(report.components, checkMesh(lattice).components);
    EXPECT_LT(farthest(mesh, lattice), 0.5 * cell);
    EXPECT_LT(farthest(lattice, mesh), 0.5 * cell);
    EXPECT_NEAR(signedVolume(mesh), signedVolume(lattice), 0.03 * signedVolume(lattice));
    EXPECT_GT(made->keptTriangles, 0u);
    EXPECT_GT(commonSmallestAngle(mesh), 10.0);
    EXPECT_GT(commonSmallestAngle(mesh), 3.0 * commonSmallestAngle(lattice));
    expectOnSurface(shape, mesh, cell);
  }
}

void expectLikeTheLattice(const SkeletonFieldCase& shape, double cell, double tolerance)
{
  SkeletonMeshOptions options;
  options.edgeLength = cell;
  const std::optional<StitchedMesh> made = skeletonMesh(shape.field(), options);
  ASSERT_TRUE(made.has_value());
  const TriangleMesh lattice = latticeMesh(*shape.node, cell, Progress::none());
  const MeshReport report = checkMesh(made->mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.eulerCharacteristic, checkMesh(lattice).eulerCharacteristic);
  EXPECT_LT(farthest(made->mesh, lattice), tolerance);
  EXPECT_LT(farthest(lattice, made->mesh), tolerance);
}

TEST(SkeletonMesh, RandomSkeletonsHaveTheTopologyOfTheLattice)
{
  for (std::uint64_t seed = 1; seed <= 7; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expectLikeTheLattice(SkeletonFieldCase(randomSkeleton(seed), 1), 0.1, 0.05);
  }
}

// Parts that do not blend meet in creases, which both meshes cut off, each within a cell.
TEST(SkeletonMesh, RandomSkeletonsWithBlendingControlHaveTheTopologyOfTheLattice)
{
  for (std::uint64_t seed = 1; seed <= 2; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expectLikeTheLattice(SkeletonFieldCase(randomSkeleton(seed), 1,
                           SubdivisionScheme::Approximating, BlendingKind::Neighbours),
      0.1, 0.1);
  }
}

// A triangle that stands alone has a surface from some size on; just there it is hardly inside.
TEST(SkeletonMesh, SmallSheetsAreThereAsSoonAsTheyHaveASurface)
{
  bool before = false;
  for (double side = 0.9; side < 1.6; side += 0.02)
  {
    SkeletonGraph graph;
    graph.points = { { 0, 0, 0 }, { side, 0, 0 }, { 0.3 * side, 0.8 * side, 0 } };
    graph.radii = { 0.5, 0.4, 0.45 };
    graph.triangles = { { 0, 1, 2 } };
    const SkeletonFieldCase shape(graph, 1);
    SkeletonMeshOptions options;
    options.edgeLength = 0.05;
    const std::optional<StitchedMesh> made = skeletonMesh(shape.field(), options);
    ASSERT_TRUE(made.has_value());
    const TriangleMesh lattice = latticeMesh(*shape.node, options.edgeLength, Progress::none());
    if (lattice.triangles.size() > 50) // or less than a few cells
    {
      EXPECT_FALSE(made->mesh.empty()) << "side " << side;
      EXPECT_TRUE(isClosedManifold(made->mesh));
    }
    EXPECT_TRUE(!before || !made->mesh.empty());
    before = !made->mesh.empty();
  }
  EXPECT_TRUE(before);
}

/// A point that is moved, or made thicker.
void editOne(SkeletonGraph& graph, test::Random& random)
{
  const int last = static_cast<int>(graph.points.size()) - 1;
  const auto point = static_cast<std::size_t>(random.integer(0, last));
  graph.points[point] += random.uniform(0.0, 0.1) * random.direction();
  graph.radii[point] *= random.chance(0.2) ? random.uniform(0.9, 1.1) : 1.0;
}

// What is kept of earlier meshes does not show: after each of many edits the mesh is the one that
// is made when nothing is remembered.
TEST(SkeletonMesh, AfterEditsIsTheMeshOfAColdStart)
{
  SkeletonMeshOptions options;
  options.edgeLength = 0.17;
  for (const BlendingKind blending :
    { BlendingKind::All, BlendingKind::Neighbours, BlendingKind::Paper })
  {
    test::Random random(11);
    SkeletonGraph graph = test::alien();
    std::vector<SkeletonFieldCase> shapes;
    std::vector<TriangleMesh> cold;
    for (int edit = 0; edit < 5; ++edit)
    {
      shapes.emplace_back(graph, 1, SubdivisionScheme::Approximating, blending);
      forgetIslands();
      const std::optional<StitchedMesh> made = skeletonMesh(shapes.back().field(), options);
      ASSERT_TRUE(made);
      EXPECT_EQ(made->remembered, 0u);
      cold.push_back(made->mesh);
      editOne(graph, random);
    }
    forgetIslands();
    PieceMeshCache cache;
    std::size_t remembered = 0;
    for (std::size_t edit = 0; edit < shapes.size(); ++edit)
    {
      SCOPED_TRACE("edit " + std::to_string(edit));
      const std::optional<StitchedMesh> warm = skeletonMesh(shapes[edit].field(), options, &cache);
      ASSERT_TRUE(warm);
      EXPECT_TRUE(isClosedManifold(warm->mesh));
      EXPECT_EQ(warm->mesh.points, cold[edit].points);
      EXPECT_EQ(warm->mesh.normals, cold[edit].normals);
      EXPECT_EQ(warm->mesh.triangles, cold[edit].triangles);
      EXPECT_EQ(warm->mesh.sourceLeaf, cold[edit].sourceLeaf);
      remembered += warm->remembered;
    }
    EXPECT_GE(remembered, shapes.size());
  }
}

TEST(SkeletonMesh, CanBeCancelled)
{
  const SkeletonFieldCase shape(test::figure7());
  SkeletonMeshOptions options;
  options.edgeLength = 0.15;
  for (const int looks : { 0, 3, 12 })
  {
    EXPECT_THROW(skeletonMesh(shape.field(), options, nullptr, test::CancelAt(looks)), Cancelled);
  }
}

TEST(SkeletonMesh, IsTheSameForAnyNumberOfThreads)
{
  const SkeletonFieldCase shape(test::figure7());
  SkeletonMeshOptions options;
  options.edgeLength = 0.15;
  std::optional<StitchedMesh> meshes[2];
  for (int k = 0; k < 2; ++k)
  {
    setThreadCount(1 + 2 * k);
    meshes[k] = skeletonMesh(shape.field(), options);
  }
  setThreadCount(0);
  ASSERT_TRUE(meshes[0] && meshes[1]);
  EXPECT_EQ(meshes[0]->mesh.points, meshes[1]->mesh.points);
  EXPECT_EQ(meshes[0]->mesh.triangles, meshes[1]->mesh.triangles);
}

} // namespace
} // namespace hybridtree

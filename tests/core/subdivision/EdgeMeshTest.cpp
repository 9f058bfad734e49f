// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/EdgeMesh.h"

#include "core/mesh/MeshChecks.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <map>

namespace hybridtree::test
{
namespace
{

struct Octahedron
{
  std::vector<Vec3> points = { Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0),
    Vec3(0, 0, 1), Vec3(0, 0, -1) };
  std::vector<Triangle> triangles = { { 0, 2, 4 }, { 2, 1, 4 }, { 1, 3, 4 }, { 3, 0, 4 },
    { 2, 0, 5 }, { 1, 2, 5 }, { 3, 1, 5 }, { 0, 3, 5 } };
  std::vector<std::int32_t> elements = { 0, 1, 2, 3, 4, 5, 6, 7 };
};

Vec3 areaVector(const std::vector<Vec3>& points, const Triangle& t)
{
  return 0.5 * (points[t[1]] - points[t[0]]).cross(points[t[2]] - points[t[0]]);
}

// Points in the middles of random edges.
void splitSome(EdgeMesh& mesh, std::vector<Vec3>& points, Random& random, double share)
{
  std::map<std::int32_t, bool> edges;
  for (const std::array<std::int32_t, 3>& of : mesh.edgesOf())
  {
    for (const std::int32_t edge : of)
    {
      edges.try_emplace(edge, random.uniform(0.0, 1.0) < share);
    }
  }
  for (const auto& [edge, isSplit] : edges)
  {
    if (isSplit)
    {
      const EdgeMesh::Edge whole = mesh.edges()[edge];
      points.push_back(0.5 * (points[whole.a] + points[whole.b]));
      mesh.split(edge, static_cast<std::int32_t>(points.size() - 1));
    }
  }
  mesh.divide(points);
}

TEST(EdgeMesh, StaysClosedAndInPlaceWhicheverEdgesAreSplit)
{
  Random random(1);
  for (const double share : { 0.05, 0.3, 0.7, 1.0 })
  {
    const Octahedron start;
    std::vector<Vec3> points = start.points;
    EdgeMesh mesh(start.triangles, start.elements);
    for (int round = 0; round < 4; ++round)
    {
      splitSome(mesh, points, random, share);
      TriangleMesh whole;
      whole.points = points;
      whole.triangles = mesh.triangles();
      ASSERT_TRUE(isClosedManifold(whole));
    }
    // Parts of one face lie in it, and together have its area.
    std::vector<Vec3> area(8, Vec3::Zero());
    for (std::size_t t = 0; t < mesh.triangles().size(); ++t)
    {
      const Vec3 part = areaVector(points, mesh.triangles()[t]);
      area[mesh.elements()[t]] += part;
      EXPECT_GT(part.dot(areaVector(start.points, start.triangles[mesh.elements()[t]])), 0.0);
    }
    for (std::size_t face = 0; face < 8; ++face)
    {
      EXPECT_LT((area[face] - areaVector(start.points, start.triangles[face])).norm(), 1e-12);
    }
  }
}

TEST(EdgeMesh, TrianglesKnowTheirEdges)
{
  Random random(2);
  const Octahedron start;
  std::vector<Vec3> points = start.points;
  EdgeMesh mesh(start.triangles, start.elements);
  for (int round = 0; round < 5; ++round)
  {
    splitSome(mesh, points, random, 0.4);
    std::map<std::int32_t, int> sides;
    for (std::size_t t = 0; t < mesh.triangles().size(); ++t)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        const EdgeMesh::Edge& edge = mesh.edges()[mesh.edgesOf()[t][k]];
        const std::int32_t a = mesh.triangles()[t][k];
        const std::int32_t b = mesh.triangles()[t][(k + 1) % 3];
        ASSERT_TRUE((edge.a == a && edge.b == b) || (edge.a == b && edge.b == a));
        ASSERT_EQ(edge.middle, EdgeMesh::kWhole);
        ++sides[mesh.edgesOf()[t][k]];
      }
    }
    for (const auto& [edge, count] : sides)
    {
      ASSERT_EQ(count, 2) << edge;
    }
  }
}

} // namespace
} // namespace hybridtree::test

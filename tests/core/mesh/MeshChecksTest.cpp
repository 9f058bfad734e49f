// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/MeshChecks.h"

#include <gtest/gtest.h>

namespace hybridtree
{
namespace
{

TriangleMesh tetrahedron(const Vec3& at = Vec3::Zero())
{
  TriangleMesh mesh;
  mesh.points = { at, at + Vec3::UnitX(), at + Vec3::UnitY(), at + Vec3::UnitZ() };
  mesh.triangles = { { 0, 2, 1 }, { 0, 1, 3 }, { 0, 3, 2 }, { 1, 2, 3 } };
  return mesh;
}

void append(TriangleMesh& mesh, const TriangleMesh& other)
{
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), other.points.begin(), other.points.end());
  for (const Triangle& c : other.triangles)
  {
    mesh.triangles.push_back({ c[0] + first, c[1] + first, c[2] + first });
  }
}

/// n x m quadrilaterals, split, closed to a torus.
TriangleMesh torus(int n, int m)
{
  TriangleMesh mesh;
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; j < m; ++j)
    {
      const double a = 2.0 * 3.141592653589793 * i / n;
      const double b = 2.0 * 3.141592653589793 * j / m;
      const double r = 2.0 + std::cos(b);
      mesh.points.emplace_back(r * std::cos(a), r * std::sin(a), std::sin(b));
      const auto at = [&](int p, int q) { return (p % n) * m + q % m; };
      mesh.triangles.push_back({ at(i, j), at(i + 1, j), at(i + 1, j + 1) });
      mesh.triangles.push_back({ at(i, j), at(i + 1, j + 1), at(i, j + 1) });
    }
  }
  return mesh;
}

TEST(MeshChecks, ClosedSurfaces)
{
  const MeshReport one = checkMesh(tetrahedron());
  EXPECT_TRUE(one.closedManifold()) << one.describe();
  EXPECT_EQ(one.eulerCharacteristic, 2);
  EXPECT_EQ(one.genus(), 0);
  EXPECT_EQ(one.edges, 6u);

  TriangleMesh mesh = torus(20, 9);
  append(mesh, tetrahedron());
  append(mesh, tetrahedron(Vec3::UnitX())); // touches the other, but shares no point
  const MeshReport three = checkMesh(mesh);
  EXPECT_TRUE(three.closedManifold()) << three.describe();
  EXPECT_EQ(three.components, 3u);
  EXPECT_EQ(three.eulerCharacteristic, 4);
  EXPECT_EQ(three.genus(), 1);
  EXPECT_NE(three.describe().find("closed 2-manifold"), std::string::npos);
}

TEST(MeshChecks, EmptyMeshIsClosed)
{
  EXPECT_TRUE(isClosedManifold(TriangleMesh()));
  EXPECT_EQ(checkMesh(TriangleMesh()).components, 0u);
}

TEST(MeshChecks, Holes)
{
  TriangleMesh mesh = torus(20, 9);
  mesh.triangles.erase(mesh.triangles.begin());
  const MeshReport report = checkMesh(mesh);
  EXPECT_FALSE(report.closed());
  EXPECT_TRUE(report.oriented() && report.edgeManifold() && report.vertexManifold());
  EXPECT_EQ(report.boundaryEdges, 3u);
  EXPECT_EQ(report.firstBoundaryEdge, (std::array<std::int32_t, 2>{ 0, 9 }));
  EXPECT_NE(report.describe().find("3 boundary edges (first: 0 9)"), std::string::npos);
}

TEST(MeshChecks, Orientation)
{
  TriangleMesh mesh = torus(20, 9);
  std::swap(mesh.triangles[40][0], mesh.triangles[40][1]);
  const MeshReport report = checkMesh(mesh);
  EXPECT_FALSE(report.oriented());
  EXPECT_TRUE(report.closed() && report.edgeManifold() && report.vertexManifold());
  EXPECT_EQ(report.misorientedEdges, 3u);
}

TEST(MeshChecks, CrowdedEdge)
{
  TriangleMesh mesh = tetrahedron();
  mesh.points.emplace_back(-1.0, -1.0, -1.0);
  mesh.triangles.push_back({ 0, 1, 4 });
  const MeshReport report = checkMesh(mesh);
  EXPECT_FALSE(report.edgeManifold());
  EXPECT_EQ(report.crowdedEdges, 1u);
  EXPECT_EQ(report.firstCrowdedEdge, (std::array<std::int32_t, 2>{ 0, 1 }));
}

TEST(MeshChecks, TwoFansAtAPoint)
{
  TriangleMesh mesh = tetrahedron();
  append(mesh, tetrahedron(Vec3::UnitX()));
  for (Triangle& c : mesh.triangles)
  {
    for (std::int32_t& p : c)
    {
      p = p == 4 ? 1 : p;
    }
  }
  const MeshReport report = checkMesh(mesh);
  EXPECT_TRUE(report.closed() && report.oriented() && report.edgeManifold());
  EXPECT_FALSE(report.vertexManifold());
  EXPECT_FALSE(report.closedManifold());
  EXPECT_EQ(report.crowdedPoints, 1u);
  EXPECT_EQ(report.firstCrowdedPoint, 1);
  EXPECT_EQ(report.unusedPoints, 1u);
  EXPECT_EQ(report.components, 1u);
}

TEST(MeshChecks, BadTriangles)
{
  TriangleMesh mesh = tetrahedron();
  mesh.triangles.push_back({ 0, 0, 1 });
  mesh.triangles.push_back({ 0, 1, 99 });
  mesh.triangles.push_back({ -1, 1, 2 });
  mesh.points[3] = mesh.points[1];
  const MeshReport report = checkMesh(mesh);
  EXPECT_EQ(report.invalidTriangles, 3u);
  EXPECT_EQ(report.firstInvalidTriangle, 4);
  EXPECT_EQ(report.degenerateTriangles, 2u); // those with both points
  EXPECT_EQ(report.firstDegenerateTriangle, 1);
  EXPECT_FALSE(report.closedManifold());
  EXPECT_EQ(report.edges, 6u);
}

} // namespace
} // namespace hybridtree

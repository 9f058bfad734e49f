// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/SplitSharp.h"

#include "core/mesh/MeshChecks.h"
#include "core/mesh/RepairMesh.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree
{
namespace
{

using namespace test;

MeshPtr withNormals(TriangleMesh mesh)
{
  mesh.normals.clear();
  for (const Vec3& p : mesh.points)
  {
    mesh.normals.push_back(p.normalized());
  }
  return std::make_shared<const TriangleMesh>(std::move(mesh));
}

TEST(SplitSharp, CornersOfABoxAreThree)
{
  const MeshPtr cube = withNormals(box(Vec3(-1, -1, -1), Vec3(1, 1, 1)));
  const MeshPtr split = splitAtSharpEdges(cube);
  EXPECT_EQ(split->points.size(), 24u);
  EXPECT_EQ(split->normals.size(), 24u);
  ASSERT_EQ(split->triangles.size(), cube->triangles.size());
  for (std::size_t t = 0; t < split->triangles.size(); ++t)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const std::size_t now = std::size_t(split->triangles[t][k]);
      EXPECT_EQ(split->points[now], cube->points[std::size_t(cube->triangles[t][k])]);
      EXPECT_NEAR(split->normals[now].dot(areaNormal(*cube, t).normalized()), 1.0, 1e-12);
    }
  }
  const RepairedMesh welded = repairMesh(split->points, split->triangles);
  EXPECT_EQ(welded.mesh->points.size(), 8u);
  EXPECT_TRUE(checkMesh(*welded.mesh).closedManifold());
}

TEST(SplitSharp, SmoothMeshesStayTheSameObject)
{
  const MeshPtr ball = withNormals(icosphere(1.0, 3));
  EXPECT_EQ(splitAtSharpEdges(ball), ball);
  const auto bare = std::make_shared<const TriangleMesh>(box(Vec3(0, 0, 0), Vec3(1, 1, 1)));
  EXPECT_EQ(splitAtSharpEdges(bare), bare) << "without normals";
}

// The rim of half a ball: away from it nothing changes, at it the flat side is flat.
TEST(SplitSharp, AwayFromSharpEdgesNormalsStay)
{
  TriangleMesh half = icosphere(1.0, 4);
  for (Vec3& p : half.points)
  {
    p.z() = std::max(p.z(), 0.0);
  }
  const RepairedMesh closed = repairMesh(half.points, half.triangles);
  const MeshPtr mesh = withNormals(*closed.mesh);
  const MeshPtr split = splitAtSharpEdges(mesh);
  ASSERT_GT(split->points.size(), mesh->points.size());
  std::size_t above = 0;
  for (std::size_t k = 0; k < mesh->points.size(); ++k)
  {
    EXPECT_EQ(split->points[k], mesh->points[k]);
    if (mesh->points[k].z() > 0.1)
    {
      EXPECT_EQ(split->normals[k], mesh->normals[k]);
      ++above;
    }
  }
  EXPECT_GT(above, 0u);
  for (std::size_t k = mesh->points.size(); k < split->points.size(); ++k)
  {
    EXPECT_NEAR(split->points[k].z(), 0.0, 1e-12);
  }
}

} // namespace
} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/SharpShare.h"

#include "core/base/Parallel.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

namespace hybridtree
{
namespace
{

using namespace test;

// Points have the mean normal of the triangles around, as shared points do.
TriangleMesh withNormals(TriangleMesh mesh)
{
  mesh.normals.assign(mesh.points.size(), Vec3::Zero());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    for (const std::int32_t point : mesh.triangles[t])
    {
      mesh.normals[std::size_t(point)] += areaNormal(mesh, t);
    }
  }
  for (Vec3& normal : mesh.normals)
  {
    normal.normalize();
  }
  return mesh;
}

TEST(SharpShare, IsAllOfABoxAndNothingOfABall)
{
  EXPECT_EQ(sharpShare(withNormals(box(Vec3(0, 0, 0), Vec3(1, 1, 1)))), 1.0);
  EXPECT_EQ(sharpShare(withNormals(icosphere(1.0, 3))), 0.0);
  EXPECT_EQ(sharpShare(icosphere(1.0, 3)), 0.0) << "without normals";
  EXPECT_EQ(sharpShare({}), 0.0);
}

// A box beside a ball counts by its area.
TEST(SharpShare, IsOfTheArea)
{
  const TriangleMesh ball = icosphere(1.0, 4);
  const TriangleMesh cube = box(Vec3(3, 0, 0), Vec3(4, 1, 1));
  double area = 0.0;
  for (std::size_t t = 0; t < ball.triangles.size(); ++t)
  {
    area += 0.5 * areaNormal(ball, t).norm();
  }
  EXPECT_NEAR(sharpShare(withNormals(joined(ball, cube))), 6.0 / (6.0 + area), 1e-12);
}

TEST(SharpShare, SameBitsForAnyNumberOfThreads)
{
  const TriangleMesh mesh =
    withNormals(joined(bumpySphere(1.0, 6), box(Vec3(3, 0, 0), Vec3(4, 1, 1))));
  setThreadCount(1);
  const double one = sharpShare(mesh);
  setThreadCount(2);
  const double two = sharpShare(mesh);
  setThreadCount(0);
  EXPECT_EQ(one, two);
  EXPECT_GT(one, 0.0);
}

} // namespace
} // namespace hybridtree

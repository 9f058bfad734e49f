// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/SmoothNormals.h"

#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree
{
namespace
{

double angle(const Vec3& a, const Vec3& b)
{
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

TEST(SmoothNormals, NoiseBelowTheCreaseAngleIsEvenedOut)
{
  TriangleMesh mesh = test::icosphere(1.0, 4);
  test::Random random(5);
  double before = 0.0;
  mesh.normals.clear();
  for (const Vec3& point : mesh.points)
  {
    const Vec3 noise(
      random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15), random.uniform(-0.15, 0.15));
    mesh.normals.push_back((point.normalized() + noise).normalized());
    before += angle(mesh.normals.back(), point);
  }
  smoothNormals(mesh);
  double after = 0.0;
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    EXPECT_NEAR(mesh.normals[k].norm(), 1.0, 1e-12);
    after += angle(mesh.normals[k], mesh.points[k]);
  }
  EXPECT_LT(after, 0.35 * before);
}

TEST(SmoothNormals, CreasesStay)
{
  // Two half planes that meet at a right angle, each point with the normal of its own side.
  TriangleMesh mesh;
  mesh.points = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 }, { 0, 2, 0 }, { 1, 2, 0 } };
  mesh.triangles = { { 0, 1, 3 }, { 0, 3, 2 }, { 2, 3, 5 }, { 2, 5, 4 } };
  const Vec3 up = Vec3::UnitZ();
  const Vec3 side = Vec3::UnitY();
  mesh.normals = { up, up, up, up, side, side };
  smoothNormals(mesh);
  const std::vector<Vec3> expected = { up, up, up, up, side, side };
  for (std::size_t k = 0; k < expected.size(); ++k)
  {
    EXPECT_LT(angle(mesh.normals[k], expected[k]), 1e-12) << "point " << k;
  }
}

} // namespace
} // namespace hybridtree

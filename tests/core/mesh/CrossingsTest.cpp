// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/Crossings.h"

#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

namespace hybridtree::test
{
namespace
{

/// By solving for the point where a side meets the plane.
bool sidesMeet(const TriangleMesh& mesh, const Triangle& a, const Triangle& b)
{
  const Vec3& o = mesh.points[b[0]];
  for (int k = 0; k < 3; ++k)
  {
    const Vec3& p = mesh.points[a[k]];
    Mat3 matrix;
    matrix << mesh.points[b[1]] - o, mesh.points[b[2]] - o, p - mesh.points[a[(k + 1) % 3]];
    const Vec3 place = matrix.inverse() * (p - o);
    if (place.minCoeff() > 0.0 && place[0] + place[1] < 1.0 && place[2] < 1.0)
    {
      return true;
    }
  }
  return false;
}

TEST(Crossings, AsByBruteForce)
{
  Random random(3);
  std::size_t found = 0;
  for (int n = 0; n < 20; ++n)
  {
    TriangleMesh mesh;
    const double size = random.uniform(0.05, 0.6);
    for (std::int32_t t = 0; t < 120; ++t)
    {
      const Vec3 center = random.inBox({ Vec3::Zero(), Vec3::Ones() });
      for (int k = 0; k < 3; ++k)
      {
        mesh.points.push_back(center + size * random.unit() * random.direction());
      }
      mesh.triangles.push_back({ 3 * t, 3 * t + 1, 3 * t + 2 });
    }
    const std::size_t firstNew = 80;
    std::vector<bool> removed(firstNew, false);
    removed[3] = removed[40] = true;
    std::vector<std::pair<std::size_t, std::size_t>> expected;
    for (std::size_t t = firstNew; t < 120; ++t)
    {
      for (std::size_t s = 0; s < t; ++s)
      {
        const Triangle& a = mesh.triangles[s];
        const Triangle& b = mesh.triangles[t];
        if ((s >= firstNew || !removed[s]) && (sidesMeet(mesh, a, b) || sidesMeet(mesh, b, a)))
        {
          expected.emplace_back(s, t);
        }
      }
    }
    found += expected.size();
    EXPECT_EQ(newCrossings(mesh, firstNew, removed, 0.1), expected);
  }
  EXPECT_GT(found, 100u);
}

TEST(Crossings, NeighboursDoNotCross)
{
  EXPECT_TRUE(newCrossings(bumpySphere(1.0, 4), 0, {}, 0.1).empty());
  EXPECT_TRUE(newCrossings(box(Vec3::Zero(), Vec3::Ones()), 0, {}, 0.01).empty());
}

TEST(Crossings, TrianglesThatShareAPointMayCross)
{
  TriangleMesh mesh;
  mesh.points = { Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0, 2, 0), Vec3(1, 0.5, 1), Vec3(0.5, 1, -1) };
  mesh.triangles = { { 0, 1, 2 }, { 0, 3, 4 } };
  EXPECT_EQ(newCrossings(mesh, 1, { false }, 1.0).size(), 1u);
  mesh.points[4].z() = 1.0;
  EXPECT_TRUE(newCrossings(mesh, 1, { false }, 1.0).empty());
}

} // namespace
} // namespace hybridtree::test

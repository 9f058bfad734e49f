// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Tetrahedralization.h"

#include "tests/reconstruction/Samples.h"

#include <gtest/gtest.h>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

std::vector<Vec3> cloud(std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  std::vector<Vec3> points(count);
  std::generate(
    points.begin(), points.end(), [&] { return random.inBox(Box3(Vec3::Zero(), Vec3::Ones())); });
  return points;
}

TEST(Tetrahedralization, NeighboursMirrorEachOther)
{
  const std::vector<Vec3> points = cloud(300, 1);
  const Tetrahedralization tetrahedra(points, Progress::none());
  for (std::int32_t cell = 0; cell < tetrahedra.cellCount(); ++cell)
  {
    for (int facet = 0; facet < 4; ++facet)
    {
      const std::int32_t beyond = tetrahedra.neighbor(cell, facet);
      const int back = tetrahedra.mirror(cell, facet);
      ASSERT_EQ(tetrahedra.neighbor(beyond, back), cell);
      ASSERT_EQ(tetrahedra.indexOf(beyond, tetrahedra.cell(cell)[facet]), -1);
    }
  }
}

TEST(Tetrahedralization, FacetsFaceOutward)
{
  const std::vector<Vec3> points = cloud(300, 2);
  const Tetrahedralization tetrahedra(points, Progress::none());
  for (std::int32_t cell = 0; cell < tetrahedra.finiteCellCount(); ++cell)
  {
    for (int facet = 0; facet < 4; ++facet)
    {
      const auto v = tetrahedra.facet(cell, facet);
      const Vec3 normal = (points[v[1]] - points[v[0]]).cross(points[v[2]] - points[v[0]]);
      ASSERT_LE(normal.dot(points[tetrahedra.cell(cell)[facet]] - points[v[0]]), 0.0);
    }
  }
}

// The one vertex tested stands for all points: brute force over the half-ball.
TEST(Tetrahedralization, OrientedGabrielMeansAnEmptyHalfBall)
{
  const std::vector<Vec3> points = cloud(200, 3);
  const Tetrahedralization tetrahedra(points, Progress::none());
  int gabriel = 0;
  for (std::int32_t cell = 0; cell < tetrahedra.finiteCellCount(); ++cell)
  {
    for (int facet = 0; facet < 4; ++facet)
    {
      const auto v = tetrahedra.facet(cell, facet);
      const Vec3 a = points[v[1]] - points[v[0]];
      const Vec3 b = points[v[2]] - points[v[0]];
      const Vec3 normal = a.cross(b); // away from the cell
      const Vec3 center = (a.squaredNorm() * b.cross(normal) + b.squaredNorm() * normal.cross(a)) /
        (2.0 * normal.squaredNorm());
      bool empty = true;
      for (const Vec3& point : points)
      {
        const Vec3 p = point - points[v[0]];
        empty = empty &&
          !((p - center).squaredNorm() < center.squaredNorm() * (1.0 - 1e-9) &&
            p.dot(normal) < -1e-9 * normal.norm());
      }
      ASSERT_EQ(tetrahedra.isOrientedGabriel(cell, facet), empty) << cell << ", " << facet;
      gabriel += empty;
    }
  }
  EXPECT_GT(gabriel, 100);
  EXPECT_LT(gabriel, 4 * tetrahedra.finiteCellCount() - 100);
}

TEST(Tetrahedralization, StarsHoldAllCellsOfAVertex)
{
  const std::vector<Vec3> points = cloud(100, 4);
  const Tetrahedralization tetrahedra(points, Progress::none());
  std::size_t corners = 0;
  for (std::int32_t vertex = 0; vertex < 100; ++vertex)
  {
    for (const std::int32_t cell : tetrahedra.star(vertex))
    {
      EXPECT_GE(tetrahedra.indexOf(cell, vertex), 0);
    }
    corners += tetrahedra.star(vertex).size();
  }
  const std::size_t infinite = tetrahedra.cellCount() - tetrahedra.finiteCellCount();
  EXPECT_EQ(corners, 4u * tetrahedra.cellCount() - infinite);
}

} // namespace

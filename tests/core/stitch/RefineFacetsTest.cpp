// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/RefineFacets.h"

#include "core/stitch/FillPolygon.h"
#include "core/stitch/TriangleShape.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace hybridtree
{
namespace
{

using Side = std::pair<std::int32_t, std::int32_t>;

/// Two large quadrangles that share a side, folded there by an angle; each with a side of many
/// short pieces, as a cut leaves it.
FacetMesh foldedSheet(test::Random& random, int pieces, double angle)
{
  std::vector<Eigen::Vector2d> place{ { 0.0, 0.0 }, { random.uniform(1.0, 2.0), 0.0 } };
  std::vector<std::int32_t> borders[2] = { { 0, 1 }, { 1, 0 } };
  for (int half = 0; half < 2; ++half)
  {
    const double way = half == 0 ? 1.0 : -1.0;
    std::vector<Eigen::Vector2d> more{ { random.uniform(1.0, 2.0), way * random.uniform(0.8, 1.2) },
      { random.uniform(-0.1, 0.1), way } };
    for (int k = 1; k < pieces; ++k)
    {
      more.emplace_back(random.uniform(-0.01, 0.01), way * (1.0 - double(k) / pieces));
    }
    if (half == 1)
    {
      std::reverse(more.begin(), more.end());
    }
    for (const Eigen::Vector2d& p : more)
    {
      borders[half].push_back(static_cast<std::int32_t>(place.size()));
      place.push_back(p);
    }
  }
  FacetMesh mesh;
  for (const Eigen::Vector2d& p : place)
  {
    const double away = std::min(p.y(), 0.0); // the second half is turned down
    mesh.points.emplace_back(
      p.x(), std::max(p.y(), 0.0) + away * std::cos(angle), away * std::sin(angle));
  }
  for (std::int32_t half = 0; half < 2; ++half)
  {
    for (const Triangle& c : fillPolygon({ borders[half] }, place))
    {
      mesh.triangles.push_back(c);
      mesh.facet.push_back(half);
    }
  }
  mesh.normals = { Vec3::UnitZ(), Vec3(0.0, -std::sin(angle), std::cos(angle)) };
  return mesh;
}

int sliversOf(const FacetMesh& mesh)
{
  return int(std::count_if(mesh.triangles.begin(), mesh.triangles.end(),
    [&](const Triangle& c)
    { return shapeOf(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]) > 0.9848; }));
}

/// Sides without a twin.
std::map<Side, int> borderOf(const std::vector<Triangle>& triangles)
{
  std::map<Side, int> sides;
  for (const Triangle& c : triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      ++sides[{ c[k], c[(k + 1) % 3] }];
    }
  }
  std::map<Side, int> border;
  for (const auto& [side, count] : sides)
  {
    EXPECT_EQ(count, 1);
    if (sides.count({ side.second, side.first }) == 0)
    {
      border[side] = count;
    }
  }
  return border;
}

/// Of both facets; every triangle has to look as its facet does.
std::array<double, 2> areasOf(const FacetMesh& mesh)
{
  std::array<double, 2> sums{};
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Triangle& c = mesh.triangles[t];
    const Vec3 area =
      0.5 * (mesh.points[c[1]] - mesh.points[c[0]]).cross(mesh.points[c[2]] - mesh.points[c[0]]);
    const double along = area.dot(mesh.normals[mesh.facet[t]]);
    EXPECT_GT(along, 0.0);
    EXPECT_NEAR(along, area.norm(), 1e-12);
    sums[mesh.facet[t]] += along;
  }
  return sums;
}

TEST(RefineFacets, KeepsBorderAndAreaAndLeavesFewNeedles)
{
  for (std::uint64_t seed = 0; seed < 20; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Random random(seed);
    const int pieces = random.integer(15, 60);
    const FacetMesh before = foldedSheet(random, pieces, random.uniform(0.0, 3.0));
    FacetMesh after = before;
    refineFacets(after, 0.3 / pieces);
    EXPECT_GT(after.points.size(), before.points.size());
    EXPECT_TRUE(std::equal(before.points.begin(), before.points.end(), after.points.begin()));
    EXPECT_LT(sliversOf(after), sliversOf(before) / 4);
    EXPECT_EQ(borderOf(after.triangles), borderOf(before.triangles));
    const std::array<double, 2> areas[2] = { areasOf(before), areasOf(after) };
    EXPECT_NEAR(areas[0][0], areas[1][0], 1e-12);
    EXPECT_NEAR(areas[0][1], areas[1][1], 1e-12);
  }
}

// A side that two facets share gets points of both: no triangle along it is a needle.
TEST(RefineFacets, PartsTheSideBetweenFacets)
{
  test::Random random(3);
  FacetMesh mesh = foldedSheet(random, 40, 1.0);
  refineFacets(mesh, 0.3 / 40);
  const auto onFold = std::count_if(mesh.points.begin(), mesh.points.end(),
    [](const Vec3& p) { return p.y() == 0.0 && p.z() == 0.0; });
  EXPECT_GT(onFold, 6);
}

TEST(RefineFacets, LeavesGoodTrianglesAlone)
{
  FacetMesh mesh;
  mesh.points = { Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0) };
  mesh.triangles = { { 0, 1, 2 }, { 0, 2, 3 } };
  mesh.facet = { 0, 0 };
  mesh.normals = { Vec3::UnitZ() };
  const std::vector<Triangle> before = mesh.triangles;
  refineFacets(mesh, 0.01);
  EXPECT_EQ(mesh.triangles, before);
  EXPECT_EQ(mesh.points.size(), 4u);
}

} // namespace
} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/RefinePolygon.h"

#include "core/stitch/FillPolygon.h"
#include "core/stitch/TriangleShape.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace hybridtree
{
namespace
{

using Places = std::vector<Eigen::Vector2d>;
using Side = std::pair<std::int32_t, std::int32_t>;

double areaOf(const Triangle& c, const Places& place)
{
  const Eigen::Vector2d a = place[c[1]] - place[c[0]];
  const Eigen::Vector2d b = place[c[2]] - place[c[0]];
  return 0.5 * (a.x() * b.y() - a.y() * b.x());
}

int sliversOf(const std::vector<Triangle>& triangles, const Places& place)
{
  const auto at = [&](std::int32_t v) { return Vec3(place[v].x(), place[v].y(), 0.0); };
  return int(std::count_if(triangles.begin(), triangles.end(),
    [&](const Triangle& c) { return shapeOf(at(c[0]), at(c[1]), at(c[2])) > 0.9848; }));
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

/// A large quadrangle with a side of many short pieces, as a cut leaves it.
Places cutQuadrangle(test::Random& random, int pieces)
{
  Places place;
  for (int k = 0; k < pieces; ++k)
  {
    place.emplace_back(random.uniform(-0.01, 0.01), 1.0 - double(k) / pieces);
  }
  place.emplace_back(0.0, 0.0);
  place.emplace_back(random.uniform(0.6, 1.5), random.uniform(-0.2, 0.2));
  place.emplace_back(random.uniform(0.6, 1.5), random.uniform(0.8, 1.2));
  return place;
}

TEST(RefinePolygon, KeepsBorderAndAreaAndLeavesFewNeedles)
{
  for (std::uint64_t seed = 0; seed < 20; ++seed)
  {
    SCOPED_TRACE("seed " + std::to_string(seed));
    test::Random random(seed);
    Places place = cutQuadrangle(random, random.integer(15, 60));
    const std::size_t points = place.size();
    std::vector<std::int32_t> border;
    for (std::size_t k = 0; k < points; ++k)
    {
      border.push_back(std::int32_t(k));
    }
    const std::vector<Triangle> before = fillPolygon({ border }, place);
    const int needles = sliversOf(before, place);
    std::vector<Triangle> after = before;
    refinePolygon(after, place);
    EXPECT_GT(place.size(), points);
    EXPECT_LT(sliversOf(after, place), needles / 2) << "of " << needles;
    EXPECT_EQ(borderOf(after), borderOf(before));
    double area = 0.0;
    for (const Triangle& c : before)
    {
      area += areaOf(c, place);
    }
    for (const Triangle& c : after)
    {
      EXPECT_GT(areaOf(c, place), 0.0);
      area -= areaOf(c, place);
    }
    EXPECT_NEAR(area, 0.0, 1e-12);
  }
}

TEST(RefinePolygon, LeavesGoodTrianglesAlone)
{
  Places place{ { 0.0, 0.0 }, { 1.0, 0.0 }, { 1.0, 1.0 }, { 0.0, 1.0 } };
  std::vector<Triangle> triangles = fillPolygon({ { 0, 1, 2, 3 } }, place);
  const std::vector<Triangle> before = triangles;
  refinePolygon(triangles, place);
  EXPECT_EQ(triangles, before);
  EXPECT_EQ(place.size(), 4u);
}

} // namespace
} // namespace hybridtree

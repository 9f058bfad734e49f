// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/HalfEdges.h"

#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace hybridtree
{
namespace
{

/// Corners from so few points that edges have one, two and more triangles, either way round; enough
/// points for more than one thread.
std::vector<Triangle> randomTriangles(std::uint64_t seed, int points, std::size_t count)
{
  test::Random random(seed);
  std::vector<Triangle> triangles;
  while (triangles.size() < count)
  {
    const int a = random.integer(0, points - 1);
    const int b = std::min(a + random.integer(1, 3), points - 1);
    const int c = random.integer(std::max(0, a - 2), std::min(b + 2, points - 1));
    if (a != b && b != c && c != a)
    {
      triangles.push_back({ a, b, c });
    }
  }
  return triangles;
}

TEST(HalfEdges, AreThoseThatASearchFinds)
{
  for (const int points : { 3, 20, 20000 })
  {
    const std::vector<Triangle> triangles =
      randomTriangles(7, points, static_cast<std::size_t>(points));
    std::map<std::pair<int, int>, std::vector<std::int32_t>> byEdge;
    const auto from = [&](std::int32_t h) { return triangles[h / 3][h % 3]; };
    const auto to = [&](std::int32_t h) { return triangles[h / 3][(h % 3 + 1) % 3]; };
    const auto halves = static_cast<std::int32_t>(3 * triangles.size());
    for (std::int32_t h = 0; h < halves; ++h)
    {
      byEdge[std::minmax({ from(h), to(h) })].push_back(h);
    }
    const HalfEdges found = halfEdges(triangles);
    std::size_t open = 0;
    std::size_t nonManifold = 0;
    std::size_t flipped = 0;
    for (const auto& [edge, all] : byEdge)
    {
      open += all.size() == 1;
      nonManifold += all.size() > 2;
      flipped += all.size() == 2 && from(all[0]) == from(all[1]);
      for (const std::int32_t h : all)
      {
        const std::int32_t expected = all.size() == 1 ? HalfEdges::kOpen
          : all.size() > 2                            ? HalfEdges::kNonManifold
                                                      : all[0] + all[1] - h;
        ASSERT_EQ(found.opposite[static_cast<std::size_t>(h)], expected) << h;
      }
    }
    EXPECT_EQ(found.openEdges, open);
    EXPECT_EQ(found.nonManifoldEdges, nonManifold);
    EXPECT_EQ(found.flippedEdges, flipped);
  }
}

TEST(HalfEdges, OfNothingAreNone)
{
  EXPECT_TRUE(halfEdges({}).opposite.empty());
}

} // namespace
} // namespace hybridtree

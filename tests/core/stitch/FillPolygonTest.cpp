// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/FillPolygon.h"

#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace hybridtree::test
{
namespace
{

using Place = Eigen::Vector2d;

double twiceArea(const Place& a, const Place& b, const Place& c)
{
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

/// Around `center`, its distance from there going up and down.
std::vector<std::int32_t> star(Random& random, const Place& center, double radius, int count,
  bool clockwise, std::vector<Place>& place)
{
  std::vector<std::int32_t> border;
  for (int k = 0; k < count; ++k)
  {
    const double angle = (clockwise ? -1.0 : 1.0) * 2.0 * std::acos(-1.0) * k / count;
    const double r = radius * random.uniform(0.4, 1.0);
    border.push_back(static_cast<std::int32_t>(place.size()));
    place.emplace_back(center + r * Place(std::cos(angle), std::sin(angle)));
  }
  return border;
}

// Every side of the borders once, every other edge twice in opposite directions, all triangles
// counter-clockwise, and their areas add up.
void expectFilled(
  const std::vector<std::vector<std::int32_t>>& borders, const std::vector<Place>& place)
{
  const std::vector<Triangle> triangles = fillPolygon(borders, place);
  std::map<std::pair<int, int>, int> sides;
  double area = 0.0;
  for (const Triangle& c : triangles)
  {
    const double own = twiceArea(place[c[0]], place[c[1]], place[c[2]]);
    EXPECT_GT(own, 0.0);
    area += own;
    for (int k = 0; k < 3; ++k)
    {
      ++sides[{ c[k], c[(k + 1) % 3] }];
    }
  }
  double expected = 0.0;
  for (const std::vector<std::int32_t>& border : borders)
  {
    for (std::size_t k = 0; k < border.size(); ++k)
    {
      const std::int32_t a = border[k];
      const std::int32_t b = border[(k + 1) % border.size()];
      expected += place[a].x() * place[b].y() - place[a].y() * place[b].x();
      EXPECT_EQ((sides[{ a, b }]), 1);
      EXPECT_EQ((sides[{ b, a }]), 0);
      sides.erase({ a, b });
      sides.erase({ b, a });
    }
  }
  for (const auto& [side, count] : sides)
  {
    EXPECT_EQ(count, 1);
    EXPECT_EQ((sides[{ side.second, side.first }]), 1);
  }
  EXPECT_NEAR(area, expected, 1e-12);
}

TEST(FillPolygon, BordersWithoutHoles)
{
  Random random(4);
  for (const int count : { 3, 4, 7, 20, 25, 60 })
  {
    std::vector<Place> place;
    expectFilled({ star(random, Place::Zero(), 1.0, count, false, place) }, place);
  }
}

TEST(FillPolygon, HolesAndIslandsInThem)
{
  Random random(5);
  for (int round = 0; round < 20; ++round)
  {
    std::vector<Place> place;
    std::vector<std::vector<std::int32_t>> borders;
    borders.push_back({ 0, 1, 2, 3 });
    place = { { -4, -3 }, { 4, -3 }, { 4, 3 }, { -4, 3 } };
    for (const double x : { -2.0, 2.0 })
    {
      borders.push_back(star(random, Place(x, 0.1), 1.5, 8 + round, true, place));
    }
    borders.push_back(star(random, Place(2.0, 0.1), 0.3, 5, false, place));
    expectFilled(borders, place);
  }
}

// Sides that go straight on, as cuts through a triangle leave them.
TEST(FillPolygon, PointsOnStraightSides)
{
  std::vector<Place> place;
  std::vector<std::int32_t> border;
  for (int k = 0; k < 40; ++k)
  {
    const double t = (k % 10) / 10.0;
    const Place corners[5] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { 0, 0 } };
    place.emplace_back((1.0 - t) * corners[k / 10] + t * corners[k / 10 + 1]);
    border.push_back(k);
  }
  expectFilled({ border }, place);
  expectFilled({ { 0, 5, 10, 15, 20, 25, 30 } }, place);
}

} // namespace
} // namespace hybridtree::test

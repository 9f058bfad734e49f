// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/PerturbedPredicates.h"

#include "core/geometry/Predicates.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace hybridtree
{
namespace
{

using test::Random;

// Points of a coarse grid are in special position most of the time.
Site gridSite(Random& random, std::int32_t index, bool second)
{
  const Vec3 p(random.integer(0, 2), random.integer(0, 2), random.integer(0, 2));
  return { p, index, second };
}

PerturbedPredicates upward()
{
  return PerturbedPredicates([](std::int32_t) { return Vec3(0, 0, 1 << 20); }, 1);
}

TEST(PerturbedPredicates, SideIsThatOfThePointsWhereTheyTell)
{
  const PerturbedPredicates predicates = upward();
  Random random(3);
  for (int round = 0; round < 5000; ++round)
  {
    std::array<Site, 4> s;
    for (std::int32_t k = 0; k < 4; ++k)
    {
      s[std::size_t(k)] = gridSite(random, k, k > 0 && random.chance(0.5));
    }
    const int side = predicates.side(s[0], s[1], s[2], s[3]);
    ASSERT_NE(side, 0);
    const int plain = -orientation3d(s[0].position, s[1].position, s[2].position, s[3].position);
    if (plain != 0)
    {
      EXPECT_EQ(side, plain);
    }
  }
}

TEST(PerturbedPredicates, SideChangesWithEveryExchange)
{
  const PerturbedPredicates predicates = upward();
  Random random(4);
  for (int round = 0; round < 2000; ++round)
  {
    std::array<Site, 4> s;
    for (std::int32_t k = 0; k < 4; ++k)
    {
      s[std::size_t(k)] = gridSite(random, k, k != 1 && random.chance(0.6));
    }
    const int side = predicates.side(s[0], s[1], s[2], s[3]);
    const std::size_t i = std::size_t(random.integer(0, 3));
    const std::size_t j = (i + std::size_t(random.integer(1, 3))) % 4;
    std::swap(s[i], s[j]);
    EXPECT_EQ(predicates.side(s[0], s[1], s[2], s[3]), -side);
  }
}

// What lies in the plane of a triangle of A goes the way it is pushed.
TEST(PerturbedPredicates, TiesGoTheWayOfTheDirection)
{
  const PerturbedPredicates predicates = upward();
  const Site a{ Vec3(0, 0, 0), 0, false }, b{ Vec3(1, 0, 0), 1, false },
    c{ Vec3(0, 1, 0), 2, false };
  Random random(5);
  for (std::int32_t k = 0; k < 100; ++k)
  {
    const Site d{ Vec3(random.uniform(-2, 2), random.uniform(-2, 2), 0.0), k, true };
    EXPECT_EQ(predicates.side(a, b, c, d), 1);
  }
}

TEST(PerturbedPredicates, OrderFollowsTheParameter)
{
  const PerturbedPredicates predicates = upward();
  Random random(6);
  const auto triangleAt = [&](double x, std::int32_t index)
  {
    const auto corner = [&](double y, double z, std::int32_t k) {
      return Site{ Vec3(x + random.uniform(-0.05, 0.05), y, z), 3 * index + k, true };
    };
    return std::array<Site, 3>{ corner(-1, -1, 0), corner(2, -1, 1), corner(-1, 2, 2) };
  };
  const Site p{ Vec3(0, 0, 0), 0, false }, q{ Vec3(1, 0, 0), 1, false };
  for (std::int32_t round = 0; round < 1000; ++round)
  {
    const auto first = triangleAt(random.uniform(0.1, 0.9), 2 * round);
    const auto second = triangleAt(random.uniform(0.1, 0.9), 2 * round + 1);
    const int order = predicates.order(p, q, first, second);
    const double s = predicates.parameter(p, q, first);
    const double t = predicates.parameter(p, q, second);
    EXPECT_EQ(order, s < t ? -1 : 1);
    EXPECT_EQ(predicates.order(p, q, second, first), -order);
    EXPECT_EQ(predicates.order(q, p, first, second), -order);
  }
}

// Triangles around a vertex that the edge runs through: ordered somehow, but as one order.
TEST(PerturbedPredicates, OrderIsTransitiveInTies)
{
  const PerturbedPredicates predicates = upward();
  Random random(7);
  const Site p{ Vec3(0, 0, 0), 0, false }, q{ Vec3(2, 0, 0), 1, false };
  const Site hub{ Vec3(1, 0, 0), 0, true };
  std::vector<std::array<Site, 3>> crossed;
  for (std::int32_t k = 1; crossed.size() < 12; k += 2)
  {
    const auto rim = [&](std::int32_t index)
    {
      return Site{ Vec3(random.integer(0, 2), random.integer(-1, 1), random.integer(-1, 1)), index,
        true };
    };
    const std::array<Site, 3> t = { hub, rim(k), rim(k + 1) };
    if (predicates.side(t[0], t[1], t[2], p) != predicates.side(t[0], t[1], t[2], q))
    {
      crossed.push_back(t);
    }
  }
  std::sort(crossed.begin(), crossed.end(),
    [&](const auto& s, const auto& t) { return &s != &t && predicates.order(p, q, s, t) < 0; });
  for (std::size_t i = 0; i < crossed.size(); ++i)
  {
    for (std::size_t j = i + 1; j < crossed.size(); ++j)
    {
      EXPECT_EQ(predicates.order(p, q, crossed[i], crossed[j]), -1);
    }
  }
}

} // namespace
} // namespace hybridtree

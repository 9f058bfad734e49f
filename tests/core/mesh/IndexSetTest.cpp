// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/IndexSet.h"

#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

namespace hybridtree
{
namespace
{

TEST(IndexSet, IsASetInAscendingOrder)
{
  test::Random random(3);
  for (const std::size_t size : { 1u, 63u, 64u, 65u, 1000u })
  {
    IndexSet set;
    set.resize(size / 2);
    set.resize(size);
    std::set<std::size_t> expected;
    for (int step = 0; step < 300; ++step)
    {
      const auto k = static_cast<std::size_t>(random.integer(0, static_cast<int>(size) - 1));
      const bool in = random.chance(0.4);
      set.set(k, in);
      in ? static_cast<void>(expected.insert(k)) : static_cast<void>(expected.erase(k));
      EXPECT_EQ(set.contains(k), in);
    }
    std::set<std::size_t> found;
    for (std::size_t k = set.next(0); k < set.size(); k = set.next(k + 1))
    {
      EXPECT_TRUE(found.empty() || *found.rbegin() < k);
      found.insert(k);
    }
    EXPECT_EQ(found, expected) << size;
  }
}

TEST(IndexSet, EmptyOnesHaveNothing)
{
  IndexSet set;
  EXPECT_EQ(set.next(0), 0u);
  set.resize(100);
  EXPECT_EQ(set.next(0), 100u);
  EXPECT_EQ(set.next(100), 100u);
}

// What is put in ahead is met, what is put in behind is left for the next time.
TEST(IndexSet, MayGrowWhileItIsVisited)
{
  IndexSet set;
  set.resize(200);
  set.insert(70);
  std::vector<std::size_t> visited;
  for (std::size_t k = set.next(0); k < set.size(); k = set.next(k + 1))
  {
    visited.push_back(k);
    set.erase(k);
    if (k == 70)
    {
      set.insert(10);
      set.insert(71);
      set.insert(199);
    }
  }
  EXPECT_EQ(visited, (std::vector<std::size_t>{ 70, 71, 199 }));
  EXPECT_EQ(set.next(0), 10u);
}

} // namespace
} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/CellIslands.h"

#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <map>
#include <queue>

namespace hybridtree::test
{
namespace
{

// Against a flood from cell to cell: the same parts, complete, none twice.
TEST(CellIslands, AreThePartsThatDoNotTouch)
{
  Random random(5);
  for (const double share : { 0.01, 0.04, 0.1, 0.3 })
  {
    CellSet cells;
    for (int k = 0; k < 30 * 30 * 30; ++k)
    {
      if (random.chance(share))
      {
        cells.insert({ k % 30 - 17, k / 30 % 30 - 3, k / 900 - 20 });
      }
    }
    cells.sort();
    std::map<Index3, int> label;
    int count = 0;
    cells.forEach(
      [&](const Index3& start)
      {
        if (label.count(start) != 0)
        {
          return;
        }
        label[start] = count;
        std::queue<Index3> open;
        for (open.push(start); !open.empty(); open.pop())
        {
          for (int n = 0; n < 27; ++n)
          {
            const Index3 at = open.front();
            const Index3 next{ at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1 };
            if (cells.contains(next) && label.emplace(next, count).second)
            {
              open.push(next);
            }
          }
        }
        ++count;
      });
    const std::vector<CellSet> islands = islandsOf(cells);
    ASSERT_EQ(islands.size(), static_cast<std::size_t>(count));
    std::size_t size = 0;
    for (const CellSet& island : islands)
    {
      int own = -1;
      island.forEach(
        [&](const Index3& cell)
        {
          ASSERT_EQ(label.count(cell), 1u);
          own = own < 0 ? label[cell] : own;
          ASSERT_EQ(label[cell], own);
        });
      size += island.size();
    }
    EXPECT_EQ(size, label.size());
  }
}

} // namespace
} // namespace hybridtree::test

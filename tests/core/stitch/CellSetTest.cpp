// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/CellSet.h"

#include "tests/support/Random.h"

#include <gtest/gtest.h>

namespace hybridtree::test
{
namespace
{

CellSet randomCells(Random& random, double share)
{
  CellSet cells;
  for (int n = 0; n < 20 * 20 * 20; ++n)
  {
    if (random.chance(share))
    {
      cells.insert({ n % 20 - 11, n / 20 % 20 - 3, n / 400 - 16 });
    }
  }
  return cells;
}

TEST(CellSet, BorderCellsAreThoseBesideOthers)
{
  Random random(41);
  for (const double share : { 0.0, 0.02, 0.5, 0.9, 1.0 })
  {
    const CellSet cells = randomCells(random, share);
    std::size_t border = 0;
    cells.forEach(
      [&](const Index3& cell)
      {
        bool inner = true;
        for (int side = 0; side < 6; ++side)
        {
          Index3 beside = cell;
          beside[side / 2] += side % 2 == 0 ? 1 : -1;
          inner = inner && cells.contains(beside);
        }
        border += inner ? 0 : 1;
      });
    EXPECT_EQ(cells.borderCount(), border);
  }
}

TEST(CellSet, BoxesHoldTheirCellsTightly)
{
  Random random(42);
  CellGrid grid;
  grid.cellSize = 0.1;
  grid.origin = Vec3(0.03, -0.2, 7.0);
  const CellSet cells = randomCells(random, 0.003);
  const std::vector<Box3> boxes = cells.boxes(grid, 0.0);
  ASSERT_EQ(boxes.size(), cells.bricks().size());
  for (std::size_t k = 0; k < boxes.size(); ++k)
  {
    CellSet brick;
    brick.insertBrick(cells.bricks()[k]);
    Box3 all;
    brick.forEach([&](const Index3& cell) { all.extend(grid.boxOf(cell, 1.0)); });
    EXPECT_TRUE(all.isApprox(boxes[k], 1e-12));
  }
}

} // namespace
} // namespace hybridtree::test

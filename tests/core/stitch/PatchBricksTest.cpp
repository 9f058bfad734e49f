// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/PatchBricks.h"

#include "core/polygonize/EdgeRoots.h"
#include "core/stitch/BorderSigns.h"
#include "tests/support/FunctionField.h"

#include <gtest/gtest.h>

namespace hybridtree::test
{
namespace
{

constexpr double kRadius = 0.9;
constexpr double kCell = 0.05;

FunctionField ball()
{
  return FunctionField([](const Vec3& p) { return kThreshold + kRadius - p.norm(); }, 1.0);
}

/// Those whose middle is within so many cells of the surface of the ball.
CellSet shell(const CellGrid& grid, double thickness)
{
  CellSet cells;
  const std::int64_t last = std::int64_t(1.5 * kRadius / kCell);
  for (std::int64_t z = -last; z <= last; ++z)
  {
    for (std::int64_t y = -last; y <= last; ++y)
    {
      for (std::int64_t x = -last; x <= last; ++x)
      {
        const Vec3 center = grid.boxOf({ x, y, z }, 1.0).center();
        if (std::abs(center.norm() - kRadius) < thickness * kCell)
        {
          cells.insert({ x, y, z });
        }
      }
    }
  }
  cells.fillDiagonals();
  return cells;
}

class PatchBricksOfBall : public ::testing::Test
{
protected:
  PatchBricksOfBall()
    : grid_(CellGrid::ofLevel(kCell, 2))
    , field_(ball())
    , cells_(shell(grid_, 2.0))
    , lattice_(grid_.lattice(cells_.low(), cells_.high()))
    , bricks_(field_, cells_, lattice_, Progress::none())
  {
  }

  /// visit(brick, place in it, f - T there)
  template <class Visit>
  void forEachPoint(Visit&& visit)
  {
    for (const PatchBrick& brick : bricks_.all())
    {
      PatchBrick::forEachCell(brick.points,
        [&](const std::array<int, 3>& at)
        {
          const Vec3 point = lattice_.point({ kBrickSide * brick.index[0] + at[0],
            kBrickSide * brick.index[1] + at[1], kBrickSide * brick.index[2] + at[2] });
          visit(brick, at, field_(point) - kThreshold);
        });
    }
  }

  static bool has(const BrickBits& bits, const std::array<int, 3>& at)
  {
    return PatchBrick::has(bits, at[0], at[1], at[2]);
  }

  CellGrid grid_;
  FunctionField field_;
  CellSet cells_;
  Lattice lattice_;
  PatchBricks bricks_;
};

TEST_F(PatchBricksOfBall, FewSamplesTellTheSidesOfTheBorder)
{
  const BorderCrossings none({});
  EXPECT_TRUE(alignBorderSigns(bricks_, none, Progress::none()).empty());
  std::size_t border = 0;
  std::size_t asked = 0;
  this->forEachPoint(
    [&](const PatchBrick& brick, const std::array<int, 3>& at, double excess)
    {
      EXPECT_EQ(has(brick.inside, at), isInside(excess));
      border += has(brick.border, at);
      asked += has(brick.border, at) && has(brick.known, at);
    });
  EXPECT_GT(border, 1000u);
  EXPECT_LT(20 * asked, border);
}

TEST_F(PatchBricksOfBall, TheFieldIsKnownWhereVerticesComeToBe)
{
  alignBorderSigns(bricks_, BorderCrossings({}), Progress::none());
  std::size_t crossed = 0;
  for (PatchBrick& brick : bricks_.all())
  {
    bricks_.findCrossed(brick);
  }
  bricks_.askAtCrossed(Progress::none());
  for (const PatchBrick& brick : bricks_.all())
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      PatchBrick::forEachCell(brick.crossed[axis],
        [&](std::array<int, 3> at)
        {
          for (int end = 0; end < 2; ++end, ++at[axis])
          {
            const PatchBricks::Place place = bricks_.locate(brick, at[0], at[1], at[2]);
            ASSERT_TRUE(PatchBrick::has(place.brick->known, place.x, place.y, place.z));
          }
          ++crossed;
        });
    }
  }
  EXPECT_GT(crossed, 1000u);
  this->forEachPoint(
    [&](const PatchBrick& brick, const std::array<int, 3>& at, double excess)
    {
      if (has(brick.known, at))
      {
        const int n = (at[2] * kBrickSide + at[1]) * kBrickSide + at[0];
        EXPECT_EQ(brick.values[n], static_cast<float>(excess));
      }
    });
}

/// The ends of crossed edges may be on the border, where layers are thin.
TEST(PatchBricks, EndsOnTheBorderAreAsked)
{
  const CellGrid grid = CellGrid::ofLevel(kCell, 2);
  const FunctionField field = ball();
  const CellSet cells = shell(grid, 0.9);
  const Lattice lattice = grid.lattice(cells.low(), cells.high());
  PatchBricks bricks(field, cells, lattice, Progress::none());
  alignBorderSigns(bricks, BorderCrossings({}), Progress::none());
  const auto askedOnBorder = [&]
  {
    std::size_t count = 0;
    for (const PatchBrick& brick : bricks.all())
    {
      for (int z = 0; z < kBrickSide; ++z)
      {
        count += bitCount(brick.border[z] & brick.known[z]);
      }
    }
    return count;
  };
  const std::size_t before = askedOnBorder();
  for (PatchBrick& brick : bricks.all())
  {
    bricks.findCrossed(brick);
  }
  bricks.askAtCrossed(Progress::none());
  EXPECT_GT(askedOnBorder(), 2 * before);
}

} // namespace
} // namespace hybridtree::test

// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/UncoveredCells.h"

#include "core/base/Parallel.h"
#include "core/base/Types.h"

#include <array>

namespace hybridtree
{
namespace
{

constexpr int kCorners = kBrickSide + 1; // of a brick's cells, along an axis
constexpr std::size_t kTogether = 64;

/// The sides of the corners of some cells of a brick.
class CornerSides
{
public:
  CornerSides(const CellSet::Brick& brick, const FieldSource& field, const CellGrid& grid)
    : brick_(brick), field_(field), grid_(grid)
  {
  }

  CellSet::Brick crossed()
  {
    CellSet::Brick result{ brick_.index, {} };
    const FieldSourcePtr near = field_.restrictedTo(grid_.boxOf(this->pointAt({}), kBrickSide));
    if (!near)
    {
      return result; // f = 0
    }
    this->findCorners();
    this->ask(*near);
    this->forEachCell(
      [&](const Index3& at)
      {
        int count = 0;
        for (int k = 0; k < 8; ++k)
        {
          count += sides_[placeOf(corner(at, k))] == kInside ? 1 : 0;
        }
        if (count != 0 && count != 8)
        {
          result.bits[std::size_t(at[2])] |= bitOf(at);
        }
      });
    return result;
  }

private:
  enum Side : char
  {
    kUnknown,
    kAsked,
    kInside
  };

  static std::uint64_t bitOf(const Index3& at)
  {
    return std::uint64_t(1) << (kBrickSide * at[1] + at[0]);
  }
  static Index3 corner(const Index3& at, int k)
  {
    return { at[0] + (k & 1), at[1] + (k >> 1 & 1), at[2] + (k >> 2) };
  }
  static std::size_t placeOf(const Index3& at)
  {
    return std::size_t((at[2] * kCorners + at[1]) * kCorners + at[0]);
  }
  Index3 pointAt(const Index3& at) const
  {
    return { kBrickSide * brick_.index[0] + at[0], kBrickSide * brick_.index[1] + at[1],
      kBrickSide * brick_.index[2] + at[2] };
  }

  template <typename Visit>
  void forEachCell(Visit&& visit) const
  {
    for (int z = 0; z < kBrickSide; ++z)
    {
      for (std::uint64_t word = brick_.bits[std::size_t(z)]; word != 0; word &= word - 1)
      {
        const int bit = CellSet::lowestBit(word);
        visit(Index3{ bit % kBrickSide, bit / kBrickSide, z });
      }
    }
  }

  void findCorners()
  {
    this->forEachCell(
      [this](const Index3& at)
      {
        for (int k = 0; k < 8; ++k)
        {
          const Index3 of = corner(at, k);
          Side& side = sides_[placeOf(of)];
          if (side == kUnknown)
          {
            side = kAsked;
            asked_.push_back(of);
          }
        }
      });
  }

  void ask(const FieldSource& near)
  {
    std::array<double, kTogether> x, y, z, value;
    for (std::size_t first = 0; first < asked_.size(); first += kTogether)
    {
      const std::size_t count = std::min(kTogether, asked_.size() - first);
      for (std::size_t k = 0; k < count; ++k)
      {
        const Index3 at = this->pointAt(asked_[first + k]);
        x[k] = grid_.plane(0, at[0]);
        y[k] = grid_.plane(1, at[1]);
        z[k] = grid_.plane(2, at[2]);
      }
      near.field({ x.data(), y.data(), z.data(), count }, value.data());
      for (std::size_t k = 0; k < count; ++k)
      {
        sides_[placeOf(asked_[first + k])] = value[k] >= kThreshold ? kInside : kAsked;
      }
    }
  }

  const CellSet::Brick& brick_;
  const FieldSource& field_;
  const CellGrid& grid_;
  std::array<Side, kCorners * kCorners * kCorners> sides_{};
  std::vector<Index3> asked_;
};

/// Cells that share a face with one of the set.
CellSet besideFaces(const CellSet& cells)
{
  CellSet beside;
  for (const CellSet::Brick& brick : cells.bricks())
  {
    constexpr std::uint64_t kFirst = 0x0101010101010101u;
    constexpr std::uint64_t kLast = kFirst << (kBrickSide - 1);
    constexpr int kEnd = kBrickSide - 1;
    constexpr int kTop = kBrickSide * kEnd; // bits below the last row
    CellSet::Brick own{ brick.index, {} };
    std::array<CellSet::Brick, 6> others;
    for (int side = 0; side < 6; ++side)
    {
      others[std::size_t(side)] = { brick.index, {} };
      others[std::size_t(side)].index[std::size_t(side / 2)] += side % 2 ? 1 : -1;
    }
    for (std::size_t z = 0; z < kBrickSide; ++z)
    {
      const std::uint64_t word = brick.bits[z];
      own.bits[z] |=
        (word & ~kFirst) >> 1 | (word & ~kLast) << 1 | word << kBrickSide | word >> kBrickSide;
      others[0].bits[z] = (word & kFirst) << kEnd;
      others[1].bits[z] = (word & kLast) >> kEnd;
      others[2].bits[z] = word << kTop;
      others[3].bits[z] = word >> kTop;
      if (z > 0)
      {
        own.bits[z - 1] |= word;
      }
      if (z < kEnd)
      {
        own.bits[z + 1] |= word;
      }
    }
    others[4].bits[kEnd] = brick.bits[0];
    others[5].bits[0] = brick.bits[kEnd];
    beside.insertBrick(own);
    for (const CellSet::Brick& other : others)
    {
      if (other.size() > 0)
      {
        beside.insertBrick(other);
      }
    }
  }
  return beside;
}

CellSet without(const CellSet& cells, std::initializer_list<const CellSet*> taken)
{
  CellSet rest;
  for (CellSet::Brick brick : cells.bricks())
  {
    for (const CellSet* set : taken)
    {
      if (const BrickBits* bits = set->find(brick.index))
      {
        for (std::size_t z = 0; z < kBrickSide; ++z)
        {
          brick.bits[z] &= ~(*bits)[z];
        }
      }
    }
    if (brick.size() > 0)
    {
      rest.insertBrick(brick);
    }
  }
  return rest;
}

} // namespace

CellSet crossedCells(const CellSet& cells, const FieldSource& field, const CellGrid& grid)
{
  std::vector<CellSet::Brick> found(cells.bricks().size());
  parallelFor(found.size(), 1,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = begin; k < end; ++k)
      {
        found[k] = CornerSides(cells.bricks()[k], field, grid).crossed();
      }
    });
  CellSet crossed;
  for (const CellSet::Brick& brick : found)
  {
    if (brick.size() > 0)
    {
      crossed.insertBrick(brick);
    }
  }
  return crossed;
}

void addUncovered(
  const CellSet& covered, const FieldSource& field, const CellGrid& grid, CellSet& marked)
{
  CellSet asked;
  for (CellSet front = marked; !front.empty();)
  {
    const CellSet next = without(besideFaces(front), { &covered, &marked, &asked });
    asked.insert(next);
    front = crossedCells(next, field, grid);
    marked.insert(front);
  }
}

} // namespace hybridtree

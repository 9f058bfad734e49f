// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/CellSet.h"

#include <algorithm>
#include <limits>

namespace hybridtree
{
namespace
{

std::uint64_t bitOf(std::int64_t x, std::int64_t y)
{
  return std::uint64_t(1) << (kBrickSide * y + x);
}

int highestBit(std::uint64_t word)
{
  int bit = 0;
  while ((word >>= 1) != 0)
  {
    ++bit;
  }
  return bit;
}

} // namespace

Index3 brickOf(const Index3& index)
{
  Index3 brick{};
  for (int axis = 0; axis < 3; ++axis)
  {
    // Rounds down for negative ones too.
    brick[axis] = index[axis] >= 0 ? index[axis] / kBrickSide : ~(~index[axis] / kBrickSide);
  }
  return brick;
}

int CellSet::lowestBit(std::uint64_t word)
{
  return static_cast<int>(bitCount(~word & (word - 1))); // the zeros below it
}

std::size_t CellSet::Brick::size() const
{
  std::size_t count = 0;
  for (std::uint64_t word : bits)
  {
    for (; word != 0; word &= word - 1)
    {
      ++count;
    }
  }
  return count;
}

std::size_t CellSet::size() const
{
  std::size_t count = 0;
  for (const Brick& brick : bricks_)
  {
    count += brick.size();
  }
  return count;
}

const BrickBits* CellSet::find(const Index3& brick) const
{
  const auto found = index_.find(brick);
  return found == index_.end() ? nullptr : &bricks_[found->second].bits;
}

bool CellSet::contains(const Index3& cell) const
{
  const Index3 brick = brickOf(cell);
  const BrickBits* bits = this->find(brick);
  return bits &&
    ((*bits)[cell[2] - kBrickSide * brick[2]] &
      bitOf(cell[0] - kBrickSide * brick[0], cell[1] - kBrickSide * brick[1])) != 0;
}

BrickBits& CellSet::bitsOf(const Index3& brick)
{
  const auto [found, isNew] = index_.try_emplace(brick, bricks_.size());
  if (isNew)
  {
    bricks_.push_back({ brick, {} });
  }
  return bricks_[found->second].bits;
}

void CellSet::insert(const Index3& cell)
{
  this->insertBlock(cell, 1);
}

void CellSet::insertBlock(const Index3& low, int side)
{
  const Index3 brick = brickOf(low);
  BrickBits& bits = this->bitsOf(brick);
  std::uint64_t word = 0;
  for (int y = 0; y < side; ++y)
  {
    for (int x = 0; x < side; ++x)
    {
      word |= bitOf(low[0] - kBrickSide * brick[0] + x, low[1] - kBrickSide * brick[1] + y);
    }
  }
  for (int z = 0; z < side; ++z)
  {
    bits[low[2] - kBrickSide * brick[2] + z] |= word;
  }
}

void CellSet::insert(const CellSet& other)
{
  for (const Brick& brick : other.bricks_)
  {
    this->insertBrick(brick);
  }
}

void CellSet::insertBrick(const Brick& brick)
{
  BrickBits& bits = this->bitsOf(brick.index);
  for (int z = 0; z < kBrickSide; ++z)
  {
    bits[z] |= brick.bits[z];
  }
}

void CellSet::sort()
{
  std::sort(bricks_.begin(), bricks_.end(),
    [](const Brick& a, const Brick& b)
    {
      return std::lexicographical_compare(
        a.index.rbegin(), a.index.rend(), b.index.rbegin(), b.index.rend());
    });
  for (std::size_t k = 0; k < bricks_.size(); ++k)
  {
    index_[bricks_[k].index] = k;
  }
}

Index3 CellSet::low() const
{
  Index3 low = bricks_.front().index;
  for (const Brick& brick : bricks_)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      low[axis] = std::min(low[axis], brick.index[axis]);
    }
  }
  return { kBrickSide * low[0], kBrickSide * low[1], kBrickSide * low[2] };
}

Index3 CellSet::high() const
{
  Index3 high = bricks_.front().index;
  for (const Brick& brick : bricks_)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      high[axis] = std::max(high[axis], brick.index[axis]);
    }
  }
  constexpr int kLast = kBrickSide - 1;
  return { kBrickSide * high[0] + kLast, kBrickSide * high[1] + kLast,
    kBrickSide * high[2] + kLast };
}

std::vector<Box3> CellSet::boxes(const CellGrid& grid, double margin) const
{
  std::vector<Box3> boxes;
  for (const Brick& brick : bricks_)
  {
    Index3 low{ kBrickSide, kBrickSide, kBrickSide };
    Index3 high{ -1, -1, -1 };
    for (int z = 0; z < kBrickSide; ++z)
    {
      for (int y = 0; y < kBrickSide; ++y)
      {
        const std::uint64_t row = brick.bits[z] >> (kBrickSide * y) & 0xffu;
        if (row != 0)
        {
          low = { std::min<std::int64_t>(low[0], lowestBit(row)), std::min<std::int64_t>(low[1], y),
            std::min<std::int64_t>(low[2], z) };
          high = { std::max<std::int64_t>(high[0], highestBit(row)),
            std::max<std::int64_t>(high[1], y), z };
        }
      }
    }
    if (high[2] < 0)
    {
      continue; // no cell at all
    }
    Box3 box;
    for (const Index3& cell : { low, high })
    {
      box.extend(
        grid.boxOf({ kBrickSide * brick.index[0] + cell[0], kBrickSide * brick.index[1] + cell[1],
                     kBrickSide * brick.index[2] + cell[2] },
          1.0, margin));
    }
    boxes.push_back(box);
  }
  return boxes;
}

CellSet::Share CellSet::shareOf(const Index3& low, const Index3& high) const
{
  bool some = false;
  bool all = true;
  const Index3 first = brickOf(low);
  const Index3 last = brickOf(high);
  for (std::int64_t bz = first[2]; bz <= last[2]; ++bz)
  {
    for (std::int64_t by = first[1]; by <= last[1]; ++by)
    {
      for (std::int64_t bx = first[0]; bx <= last[0]; ++bx)
      {
        const BrickBits* bits = this->find({ bx, by, bz });
        if (!bits)
        {
          all = false;
          continue;
        }
        const auto from = [&](int axis, std::int64_t brick)
        { return std::max<std::int64_t>(low[axis] - kBrickSide * brick, 0); };
        const auto to = [&](int axis, std::int64_t brick)
        { return std::min<std::int64_t>(high[axis] - kBrickSide * brick, kBrickSide - 1); };
        std::uint64_t mask = 0;
        for (std::int64_t y = from(1, by); y <= to(1, by); ++y)
        {
          for (std::int64_t x = from(0, bx); x <= to(0, bx); ++x)
          {
            mask |= bitOf(x, y);
          }
        }
        for (std::int64_t z = from(2, bz); z <= to(2, bz); ++z)
        {
          some = some || ((*bits)[z] & mask) != 0;
          all = all && ((*bits)[z] & mask) == mask;
        }
      }
    }
    if (some && !all)
    {
      return Share::Some;
    }
  }
  return !some ? Share::None : all ? Share::All : Share::Some;
}

CellSet CellSet::grown() const
{
  CellSet result = *this;
  this->forEach(
    [&](const Index3& cell)
    {
      for (int n = 0; n < 27; ++n)
      {
        result.insert({ cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1 });
      }
    });
  result.sort();
  return result;
}

namespace
{

constexpr int kHalo = kBrickSide + 2;

/// The cells of a brick and of those one cell around it: bit x + 1 of row (y + 1, z + 1).
struct Halo
{
  std::uint16_t rows[kHalo][kHalo] = {};

  Halo(const CellSet& cells, const Index3& brick)
  {
    const BrickBits* near[27];
    for (int n = 0; n < 27; ++n)
    {
      near[n] =
        cells.find({ brick[0] + n % 3 - 1, brick[1] + n / 3 % 3 - 1, brick[2] + n / 9 - 1 });
    }
    for (int z = -1; z <= kBrickSide; ++z)
    {
      for (int y = -1; y <= kBrickSide; ++y)
      {
        const int first = 3 * ((y + kBrickSide) / kBrickSide + 3 * ((z + kBrickSide) / kBrickSide));
        const auto row = [&](int nx) -> unsigned
        {
          const BrickBits* bits = near[first + nx];
          return bits ? static_cast<unsigned>((*bits)[(z + kBrickSide) % kBrickSide] >>
                            (kBrickSide * ((y + kBrickSide) % kBrickSide)) &
                          0xffu)
                      : 0u;
        };
        rows[z + 1][y + 1] =
          static_cast<std::uint16_t>(row(0) >> (kBrickSide - 1) | row(1) << 1 | (row(2) & 1u) << 9);
      }
    }
  }

  bool has(const std::array<int, 3>& cell) const
  {
    return (rows[cell[2] + 1][cell[1] + 1] >> (cell[0] + 1) & 1u) != 0;
  }
};

/// Whether forEachDiagonal() has anything to visit: a row of cells at a time.
bool hasDiagonal(const Halo& halo)
{
  unsigned found = 0;
  for (int z = 1; z <= kBrickSide; ++z)
  {
    for (int y = 1; y <= kBrickSide; ++y)
    {
      const unsigned row = halo.rows[z][y];
      const unsigned next = halo.rows[z][y + 1];
      const unsigned above = halo.rows[z + 1][y];
      const auto meet = [](unsigned a, unsigned across, unsigned first, unsigned second)
      { return a & across & ~first & ~second; };
      for (const int step : { -1, 1 })
      {
        const unsigned beside = halo.rows[z][y + step];
        const auto shifted = [step](unsigned r) { return step > 0 ? r >> 1 : r << 1; };
        found |= meet(row, halo.rows[z + step][y + 1], next, halo.rows[z + step][y]);
        found |= meet(row, shifted(above), above, shifted(row));
        found |= meet(row, beside >> 1, row >> 1, beside);
      }
    }
  }
  return (found & 0x1feu) != 0;
}

/// Visits the contacts of a brick's cells across edges, without a third cell: with a cell that
/// mends them. Two of the four diagonals; the others are seen from the other cell.
template <typename Visit>
void forEachDiagonal(const CellSet& cells, const CellSet::Brick& brick, Visit&& visit)
{
  const Halo halo(cells, brick.index);
  if (!hasDiagonal(halo))
  {
    return;
  }
  for (int n = 0; n < kBrickPoints; ++n)
  {
    const std::array<int, 3> cell{ n % kBrickSide, n / kBrickSide % kBrickSide,
      n / (kBrickSide * kBrickSide) };
    if (!halo.has(cell))
    {
      continue;
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      std::array<int, 3> first = cell;
      first[(axis + 1) % 3] += 1;
      if (halo.has(first))
      {
        continue;
      }
      for (const int step : { -1, 1 })
      {
        std::array<int, 3> second = cell;
        std::array<int, 3> across = first;
        second[(axis + 2) % 3] += step;
        across[(axis + 2) % 3] += step;
        if (halo.has(across) && !halo.has(second))
        {
          visit(Index3{ kBrickSide * brick.index[0] + first[0],
            kBrickSide * brick.index[1] + first[1], kBrickSide * brick.index[2] + first[2] });
        }
      }
    }
  }
}

} // namespace

std::size_t CellSet::borderCount() const
{
  std::size_t count = 0;
  for (const Brick& brick : bricks_)
  {
    const Halo halo(*this, brick.index);
    for (int z = 0; z < kBrickSide; ++z)
    {
      for (int y = 0; y < kBrickSide; ++y)
      {
        const unsigned row = halo.rows[z + 1][y + 1];
        const unsigned inner = row & row << 1 & row >> 1 & halo.rows[z + 1][y] &
          halo.rows[z + 1][y + 2] & halo.rows[z][y + 1] & halo.rows[z + 2][y + 1];
        for (unsigned border = row & ~inner & 0x1feu; border != 0; border &= border - 1)
        {
          ++count;
        }
      }
    }
  }
  return count;
}

void CellSet::fillDiagonals()
{
  std::vector<Index3> added;
  do
  {
    added.clear();
    for (const Brick& brick : bricks_)
    {
      forEachDiagonal(*this, brick, [&](const Index3& cell) { added.push_back(cell); });
    }
    for (const Index3& cell : added)
    {
      this->insert(cell);
    }
  } while (!added.empty());
  this->sort();
}

} // namespace hybridtree

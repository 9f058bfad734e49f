// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/CellIslands.h"

#include "core/base/DisjointSets.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr int kLast = kBrickSide - 1;

/// Cells of a brick as rows along x: bit x of row (y, z).
unsigned row(const BrickBits& bits, int y, int z)
{
  return static_cast<unsigned>(bits[z] >> (kBrickSide * y) & 0xffu);
}

/// The cells of a word and those beside them in its layer.
std::uint64_t widened(std::uint64_t word)
{
  constexpr std::uint64_t kNotFirst = 0xfefefefefefefefeu;
  constexpr std::uint64_t kNotLast = 0x7f7f7f7f7f7f7f7fu;
  word |= (word << 1 & kNotFirst) | (word >> 1 & kNotLast);
  return word | word << kBrickSide | word >> kBrickSide;
}

/// Takes one part whose cells touch out of a brick.
BrickBits takePart(BrickBits& bits)
{
  BrickBits part{};
  int z = 0;
  while (bits[z] == 0)
  {
    ++z;
  }
  part[z] = bits[z] & (~bits[z] + 1);
  for (bool grows = true; grows;)
  {
    grows = false;
    for (z = 0; z < kBrickSide; ++z)
    {
      const std::uint64_t near =
        part[z] | (z > 0 ? part[z - 1] : 0) | (z < kLast ? part[z + 1] : 0);
      const std::uint64_t more = widened(near) & bits[z] & ~part[z];
      part[z] |= more;
      grows = grows || more != 0;
    }
  }
  for (z = 0; z < kBrickSide; ++z)
  {
    bits[z] &= ~part[z];
  }
  return part;
}

/// Whether cells of a brick touch cells of the brick at an offset from it.
bool touch(const BrickBits& a, const BrickBits& b, const std::array<int, 3>& offset)
{
  for (int z = 0; z < kBrickSide; ++z)
  {
    for (int y = 0; y < kBrickSide; ++y)
    {
      const unsigned cells = row(a, y, z);
      if (cells == 0)
      {
        continue;
      }
      for (int n = 0; n < 9; ++n)
      {
        // The row as the other brick counts.
        const int otherY = y + n % 3 - 1 - kBrickSide * offset[1];
        const int otherZ = z + n / 3 - 1 - kBrickSide * offset[2];
        if (otherY < 0 || otherY > kLast || otherZ < 0 || otherZ > kLast)
        {
          continue;
        }
        const unsigned other = row(b, otherY, otherZ);
        const unsigned near = cells | cells << 1 | cells >> 1;
        if ((offset[0] == 0 && (near & other) != 0) ||
          (offset[0] == 1 && (cells >> kLast & other & 1u) != 0) ||
          (offset[0] == -1 && (other >> kLast & cells & 1u) != 0))
        {
          return true;
        }
      }
    }
  }
  return false;
}

struct Part
{
  CellSet::Brick cells;
  std::size_t brick = 0;
};

std::vector<Part> partsOf(const CellSet& cells)
{
  std::vector<Part> parts;
  for (std::size_t b = 0; b < cells.bricks().size(); ++b)
  {
    BrickBits left = cells.bricks()[b].bits;
    while (std::any_of(left.begin(), left.end(), [](std::uint64_t word) { return word != 0; }))
    {
      parts.push_back({ { cells.bricks()[b].index, takePart(left) }, b });
    }
  }
  return parts;
}

DisjointSets joinParts(const CellSet& cells, const std::vector<Part>& parts)
{
  std::vector<std::uint32_t> first(cells.bricks().size() + 1);
  std::unordered_map<Index3, std::size_t, Index3Hash> number;
  for (std::size_t b = 0; b < cells.bricks().size(); ++b)
  {
    number.emplace(cells.bricks()[b].index, b);
  }
  for (const Part& part : parts)
  {
    ++first[part.brick + 1];
  }
  for (std::size_t b = 1; b < first.size(); ++b)
  {
    first[b] += first[b - 1];
  }
  DisjointSets sets(parts.size());
  for (std::uint32_t k = 0; k < parts.size(); ++k)
  {
    const Index3& index = parts[k].cells.index;
    for (int n = 0; n < 13; ++n) // the others look this way
    {
      const std::array<int, 3> offset{ n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1 };
      const auto found =
        number.find({ index[0] + offset[0], index[1] + offset[1], index[2] + offset[2] });
      if (found == number.end())
      {
        continue;
      }
      for (std::uint32_t other = first[found->second]; other < first[found->second + 1]; ++other)
      {
        if (sets.find(other) != sets.find(k) &&
          touch(parts[k].cells.bits, parts[other].cells.bits, offset))
        {
          sets.join(other, k);
        }
      }
    }
  }
  return sets;
}

} // namespace

std::vector<CellSet> islandsOf(const CellSet& cells)
{
  const std::vector<Part> parts = partsOf(cells);
  DisjointSets sets = joinParts(cells, parts);
  std::vector<CellSet> islands;
  std::vector<std::size_t> number(parts.size());
  for (std::uint32_t k = 0; k < parts.size(); ++k)
  {
    const std::uint32_t leader = sets.find(k); // the first
    if (leader == k)
    {
      number[k] = islands.size();
      islands.emplace_back();
    }
    islands[number[leader]].insertBrick(parts[k].cells);
  }
  return islands;
}

} // namespace hybridtree

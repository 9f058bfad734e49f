// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/polygonize/Brick.h"
#include "core/polygonize/Lattice.h"
#include "core/stitch/CellGrid.h"

#include <unordered_map>
#include <vector>

namespace hybridtree
{

struct Index3Hash
{
  std::size_t operator()(const Index3& index) const
  {
    std::uint64_t hash = 0;
    for (const std::int64_t i : index)
    {
      hash = (hash ^ static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15u;
      hash ^= hash >> 29;
    }
    return hash;
  }
};

/// The brick that owns a lattice point or cell.
Index3 brickOf(const Index3& index);

/// Some of the cells of a lattice: one bit each, in bricks of 8^3, so that memory grows with what
/// is in the set and not with the box around it. Cell c spans the lattice points c to c + 1.
class CellSet
{
public:
  struct Brick
  {
    Index3 index{};
    BrickBits bits{}; ///< cell (x, y, z): bit 8 y + x of word z

    std::size_t size() const;
    bool operator==(const Brick& other) const { return index == other.index && bits == other.bits; }
  };

  bool empty() const { return bricks_.empty(); }
  std::size_t size() const;

  /// How many have a face in common with a cell that is not in the set.
  std::size_t borderCount() const;

  /// In the order of insertion, until sort().
  const std::vector<Brick>& bricks() const { return bricks_; }
  const BrickBits* find(const Index3& brick) const;
  bool contains(const Index3& cell) const;

  void insert(const Index3& cell);
  /// Cells low .. low + side - 1. \pre they lie in one brick.
  void insertBlock(const Index3& low, int side);
  void insert(const CellSet& other);
  void insertBrick(const Brick& brick);

  /// Bricks in the order of z, y, x: the same for the same cells, however they came in.
  void sort();

  ///@{ Bounds of whole bricks, cells. \pre not empty.
  Index3 low() const;
  Index3 high() const; ///< included
  ///@}

  /// Of the cells in each brick, and `margin` cells around.
  std::vector<Box3> boxes(const CellGrid& grid, double margin) const;

  /// Some, all or none of the cells of a box (both ends included) are in the set.
  enum class Share
  {
    None,
    Some,
    All
  };
  Share shareOf(const Index3& low, const Index3& high) const;

  /// With every cell next to one of the set, also across edges and corners.
  CellSet grown() const;

  /// Adds cells until no two of the set share an edge without sharing a face with a third at that
  /// edge: then the border of the set is a manifold along its edges.
  void fillDiagonals();

  template <typename Visit>
  void forEach(Visit&& visit) const
  {
    for (const Brick& brick : bricks_)
    {
      for (int z = 0; z < kBrickSide; ++z)
      {
        for (std::uint64_t word = brick.bits[z]; word != 0; word &= word - 1)
        {
          const int bit = lowestBit(word);
          visit(Index3{ kBrickSide * brick.index[0] + bit % kBrickSide,
            kBrickSide * brick.index[1] + bit / kBrickSide, kBrickSide * brick.index[2] + z });
        }
      }
    }
  }

  /// Number of the lowest bit of a word that is not 0.
  static int lowestBit(std::uint64_t word);

private:
  BrickBits& bitsOf(const Index3& brick);

  std::vector<Brick> bricks_;
  std::unordered_map<Index3, std::size_t, Index3Hash> index_;
};

} // namespace hybridtree

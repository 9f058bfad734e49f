// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/polygonize/Lattice.h"

#include <cstdint>

namespace hybridtree
{

/// As floor(), of numbers that fit; several times as fast where the processor cannot round.
inline std::int64_t roundedDown(double value)
{
  const auto truncated = static_cast<std::int64_t>(value);
  return truncated - (value < static_cast<double>(truncated) ? 1 : 0);
}

/// Cells of side `cellSize` over the whole world, the same for all that is made at one level of a
/// tree.
///
/// The meshes that are cut along its planes have often been made on such a grid themselves, or have
/// faces at round coordinates. So that nothing meets a plane but where it crosses it, each level
/// has a grid shifted against those of all others and against the lattice of polygonize().
struct CellGrid
{
  double cellSize = 1.0;
  Vec3 origin = Vec3::Zero(); ///< of cell 0, 0, 0

  /// \param level of the node, >= 1; the depth of the tree below it will do. 0: not shifted.
  static CellGrid ofLevel(double cellSize, int level);

  /// Of the planes across an axis. Always this sum, so that equal indices are equal numbers.
  double plane(int axis, std::int64_t index) const
  {
    return origin[axis] + static_cast<double>(index) * cellSize;
  }

  /// The cell in which a coordinate lies; one in a plane is in the cell above.
  std::int64_t slab(int axis, double coordinate) const
  {
    std::int64_t index = roundedDown((coordinate - origin[axis]) / cellSize);
    index -= this->plane(axis, index) > coordinate ? 1 : 0;
    index += this->plane(axis, index + 1) <= coordinate ? 1 : 0;
    return index;
  }
  Index3 cellAt(const Vec3& point) const
  {
    return { this->slab(0, point[0]), this->slab(1, point[1]), this->slab(2, point[2]) };
  }

  /// Of cells low .. low + side - 1, and `margin` cells around them.
  Box3 boxOf(const Index3& low, double side, double margin = 0.0) const;

  bool operator==(const CellGrid& other) const
  {
    return cellSize == other.cellSize && origin == other.origin;
  }

  /// The grid's part from cell `low` to cell `high`.
  Lattice lattice(const Index3& low, const Index3& high) const;
};

} // namespace hybridtree

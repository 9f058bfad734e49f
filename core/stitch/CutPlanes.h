// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/CellGrid.h"
#include "core/stitch/CellSet.h"

#include <array>
#include <vector>

namespace hybridtree
{

/// The planes of a grid along which a triangle has to be cut: those at slabs in which cells of a
/// set touch it. Between them nothing changes from cell to cell, however many there are: a triangle
/// as large as the mesh is cut into the few cells that are in the set.
///
/// All triangles at a side have the planes at which that side enters or leaves cells of the set.
class CutPlanes
{
public:
  /// \param cells have to outlive this; not empty.
  CutPlanes(const CellSet& cells, const CellGrid& grid);

  /// For the triangle a, b, c.
  void choose(const Vec3& a, const Vec3& b, const Vec3& c);

  /// Whether the plane below slab `index` is one of them, of those that the triangle crosses.
  bool has(int axis, std::int64_t index) const
  {
    return all_ || chosen_[axis][static_cast<std::size_t>(index - low_[axis])] != 0;
  }

  /// Whether a cell lies between planes of all axes. Pieces elsewhere extend beyond their cell.
  bool areAround(const Index3& cell) const
  {
    return this->has(0, cell[0]) && this->has(0, cell[0] + 1) && this->has(1, cell[1]) &&
      this->has(1, cell[1] + 1) && this->has(2, cell[2]) && this->has(2, cell[2] + 1);
  }

private:
  void addSlabs(const CellSet::Brick& brick);

  const CellSet& cells_;
  const CellGrid grid_;
  Index3 low_{}; ///< the first plane
  bool all_ = true;
  std::array<std::vector<char>, 3> chosen_; ///< per axis and plane
};

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/CellGrid.h"

#include <cmath>

namespace hybridtree
{

CellGrid CellGrid::ofLevel(double cellSize, int level)
{
  // Multiples of powers of the positive root of x^4 = x + 1: as far from each other, and from whole
  // numbers, as a sequence can be.
  constexpr double kRoot = 1.2207440846057596;
  CellGrid grid;
  grid.cellSize = cellSize;
  double share = 1.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    share /= kRoot;
    grid.origin[axis] = cellSize * (level * share - std::floor(level * share));
  }
  return grid;
}

Box3 CellGrid::boxOf(const Index3& low, double side, double margin) const
{
  Box3 box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto first = static_cast<double>(low[axis]);
    box.min()[axis] = origin[axis] + (first - margin) * cellSize;
    box.max()[axis] = origin[axis] + (first + side + margin) * cellSize;
  }
  return box;
}

Lattice CellGrid::lattice(const Index3& low, const Index3& high) const
{
  Lattice lattice;
  lattice.cellSize = cellSize;
  lattice.origin = origin;
  lattice.low = low;
  lattice.high = { high[0] + 1, high[1] + 1, high[2] + 1 };
  return lattice;
}

} // namespace hybridtree

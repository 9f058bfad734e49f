// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/polygonize/Brick.h"
#include "core/polygonize/MarchingCubesTable.h"

#include <array>

namespace hybridtree
{

/// A cell of a brick that the surface crosses.
struct CrossedCell
{
  const MarchingCubesTable::Case& way;
  unsigned signs; ///< of its corners, the number of the case
  std::array<unsigned, 3> at;
};

/// Calls body(const CrossedCell&) for those of a brick, always in the same order.
template <class Body>
void forEachCrossedCell(const CornerSigns& signs, Body&& body)
{
  const MarchingCubesTable& table = MarchingCubesTable::instance();
  for (unsigned z = 0; z < kBrickSide; ++z)
  {
    for (unsigned y = 0; y < kBrickSide; ++y)
    {
      const unsigned crossed = signs.crossedCells(y, z);
      for (unsigned x = 0; crossed >> x != 0; ++x)
      {
        if ((crossed >> x & 1u) != 0)
        {
          const unsigned number = signs.cellCase(x, y, z);
          body(CrossedCell{ table[number], number, { x, y, z } });
        }
      }
    }
  }
}

} // namespace hybridtree

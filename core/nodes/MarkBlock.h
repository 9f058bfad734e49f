// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/polygonize/FieldSource.h"
#include "core/stitch/CellSet.h"

#include <array>
#include <vector>

namespace hybridtree
{

// What markedCells() walks over the lattice with.

/// A term that may reach a block.
struct MarkReach
{
  int term = 0;
  bool certain = false;                ///< not 0 anywhere in the block
  const FieldSource* source = nullptr; ///< valid in the block
};

struct MarkBlock
{
  Index3 low{};
  std::int64_t side = 1;
  std::vector<MarkReach> reach;
};

/// What the search in one unit goes on with, so that nothing is allocated for a block.
struct MarkSearch
{
  static constexpr std::size_t kLevels = 5; ///< of halving a unit down to cells

  std::vector<FieldSourcePtr> sources;   ///< that blocks refer to
  std::array<MarkBlock, kLevels> blocks; ///< the one at hand on each level below the unit
  std::vector<int> possible;             ///< terms that may not be 0
  std::vector<int> certain;
  std::vector<Interval> ranges;
  CellSet cells; ///< the marks
};

} // namespace hybridtree

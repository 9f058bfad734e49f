// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/polygonize/FieldSource.h"
#include "core/polygonize/Lattice.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

// What CellMarker walks over the lattice with.

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

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/MarkBlock.h"
#include "core/nodes/MarkedCells.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace hybridtree
{

/// Cells along the side of what is marked, and remembered, as one.
inline constexpr std::int64_t kUnit = 4 * kBrickSide;

/// A surface is looked for a bit beyond blocks, in cells: meshes are off the surfaces they stand
/// for.
inline constexpr double kSurfaceMargin = 0.5;

/// One of the eight parts of a block, with all that may reach the block.
void setChild(const MarkBlock& block, int n, MarkBlock& child);

/// Blocks of side kUnit in which terms may interact, by influence boxes alone. They are at
/// multiples of their side: a unit is the same wherever the terms begin and end.
/// \param check called with their number as it grows, and now and then: may throw.
std::vector<MarkBlock> markUnits(const std::vector<MarkTerm>& terms, const Interaction& interaction,
  const CellGrid& grid, const std::function<void(std::size_t)>& check);

} // namespace hybridtree

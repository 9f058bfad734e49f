// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

namespace hybridtree
{

/// The memory that one polygonization may take.
struct MemoryBudget
{
  std::size_t maxBytes = 0;
  double cellSize = 1.0;

  /// \param bytes estimated, for `cells` cells.
  /// \throws TooLarge naming both, the limit, and an edge length that would do.
  void check(double bytes, double cells) const;
};

} // namespace hybridtree

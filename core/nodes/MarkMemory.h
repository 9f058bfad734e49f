// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Dependency.h"
#include "core/base/RecentStore.h"
#include "core/stitch/CellSet.h"

#include <vector>

namespace hybridtree
{

/// All that the marks in one unit of the lattice depend on.
struct UnitKey
{
  CellGrid grid;
  Index3 low{};
  int interaction = 0;
  std::int64_t share = 1; ///< one in so many blocks is looked at
  std::vector<Dependency> terms;

  bool operator==(const UnitKey& other) const
  {
    return grid == other.grid && low == other.low && interaction == other.interaction &&
      share == other.share && terms == other.terms;
  }

  bool isExpired() const { return anyExpired(terms); }

  std::uint64_t hash() const
  {
    HashSum sum;
    sum.add(Index3Hash()(low));
    for (const Dependency& term : terms)
    {
      term.addTo(sum);
    }
    return sum.value();
  }
};

using UnitMarks = std::vector<CellSet::Brick>;

///@{ What was found in units before, while what it depends on is there. Thread-safe.
RecentStore<UnitKey, UnitMarks>& unitMarks();
/// How many cells are marked in the blocks of a unit that are taken as a sample.
RecentStore<UnitKey, std::size_t>& sampledCounts();
///@}

} // namespace hybridtree

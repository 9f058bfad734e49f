// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

namespace hybridtree::benchmark
{

/// How the methods of a blend compare on random shapes: does the automatic one take the faster way,
/// and what does choosing cost?
///
/// Processor times on one thread. All methods are measured in turns, in an order that is drawn anew
/// each round, since what ran before leaves caches and the heap in a state. Medians of these are
/// what the figure shows. Whether automatic loses is measured apart: the faster way, automatic and
/// the faster way once more, in turns; the ratio is the median of those of the rounds. The third
/// one tells how far two measurements of the very same way are apart. There are more rounds, up to
/// eight times as many, until 95% of tosses of a coin would split on the same side of the ratio
/// 1.1: the rule is the same for both sides, so it favours none.
///
/// Writes a table as CSV, and prints how many were lost by more than 10%.
/// \param kind balls: pairs as in [HT] Fig. 15. primitives: six points and segments at once.
///   meshes: a scan or a coarse mesh and a ball. warps: as the first two kinds, under twists,
///   tapers and bends, below or above the blend.
/// \param seed of the shapes.
/// \return false when there is no such kind.
bool compareOnPairs(
  const std::string& file, int count, int rounds, const std::string& kind, std::uint64_t seed);

} // namespace hybridtree::benchmark

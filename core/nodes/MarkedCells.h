// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"
#include "core/polygonize/MemoryBudget.h"
#include "core/stitch/CellGrid.h"
#include "core/stitch/CellSet.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace hybridtree
{

/// One field of those that make a node.
struct MarkTerm
{
  const Node* node = nullptr;
  /// Its own mesh stands where it is alone. Otherwise every cell it reaches is marked.
  bool kept = false;
  double weight = 1.0;  ///< by which its field counts, > 0
  double overlap = 1.0; ///< share of its influence box that lies in those of others
};

/// Which fields have to meet in a cell for it to be marked.
class Interaction
{
public:
  virtual ~Interaction() = default;

  /// A number that tells it from all others.
  virtual int kind() const = 0;

  /// \param present terms whose fields are not 0. More of them never mark less.
  virtual bool marks(const std::vector<MarkTerm>& terms, const std::vector<int>& present) const = 0;

  /// Bounds of the combined field, by those of the terms at `present`; the others are 0.
  virtual Interval range(
    const std::vector<int>& present, const std::vector<Interval>& ranges) const = 0;
};

/// The lattice cells in which the surface has to be made anew ([HT] 5.2.1): where the fields that
/// are not 0 interact, and a surface passes, of the whole or of a kept term.
///
/// Influence boxes are where the search begins; what counts is the range of each field over blocks
/// of the lattice, halved down to single cells where that is open, so that a limb that lies slant
/// does not mark its box. Sorted; the same for any number of threads. Blocks of the lattice that
/// the same terms reach as in an earlier call are not looked at again.
/// \param mostCells the search ends where there are more.
/// \return nothing when there are more. \throws TooLarge when the marked bricks pass the budget;
/// Cancelled.
std::optional<CellSet> markedCells(const std::vector<MarkTerm>& terms,
  const Interaction& interaction, const CellGrid& grid, const MemoryBudget& budget,
  std::size_t mostCells, const Progress& progress = Progress::none());

/// Whether far more than `mostCells` cells would be marked, by a sample: some blocks of cells,
/// evenly spread, so that two hundred cells or so tell. Takes a fraction of the time of marking; an
/// estimate, the less certain the nearer to `mostCells` their number is. The same for any number of
/// threads, and whatever is remembered. \throws TooLarge, Cancelled.
bool seemFarMoreMarked(const std::vector<MarkTerm>& terms, const Interaction& interaction,
  const CellGrid& grid, const MemoryBudget& budget, std::size_t mostCells,
  const Progress& progress = Progress::none());

/// Forgets the earlier calls; for tests and benchmarks.
void forgetMarks();

} // namespace hybridtree

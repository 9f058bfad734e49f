// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"
#include "core/polygonize/MemoryBudget.h"
#include "core/stitch/CellGrid.h"
#include "core/stitch/CellSet.h"

#include <cstddef>
#include <memory>
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

/// Finds the lattice cells in which the surface has to be made anew ([HT] 5.2.1): where the fields
/// that are not 0 interact, and a surface passes, of the whole or of a kept term.
///
/// Influence boxes are where the search begins; what counts is the range of each field over blocks
/// of the lattice, halved down to single cells where that is open, so that a limb that lies slant
/// does not mark its box. All answers are the same for any number of threads, and whatever is
/// remembered: blocks of the lattice that the same terms reach as in an earlier search are not
/// looked at again. One at a time may be asked; terms, interaction and progress have to live as
/// long.
class CellMarker
{
public:
  CellMarker(const std::vector<MarkTerm>& terms, const Interaction& interaction,
    const CellGrid& grid, const MemoryBudget& budget, const Progress& progress = Progress::none());
  ~CellMarker();
  CellMarker(const CellMarker&) = delete;
  CellMarker& operator=(const CellMarker&) = delete;

  /// Whether more than `count` cells would be marked, by a sample of blocks of cells, which grows
  /// until some hundred marked cells make it clear, or all but clear. An estimate. Takes a small
  /// part of the time of marking where `count` is large or far less than there are; and
  /// mark() takes over what was found. Where few are marked it ends early, and says no.
  /// \throws TooLarge, Cancelled.
  bool seemMoreThan(std::size_t count);

  /// All of them, sorted. The search ends where there are more than `most`.
  /// \return nothing when there are more. \throws TooLarge when the marked bricks pass the budget;
  /// Cancelled.
  std::optional<CellSet> mark(std::size_t most);

private:
  class Units;
  const std::unique_ptr<Units> units_;
};

/// Forgets the earlier searches; for tests and benchmarks.
void forgetMarks();

} // namespace hybridtree

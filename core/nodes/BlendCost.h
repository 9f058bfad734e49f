// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/CellSet.h"

#include <cstddef>
#include <functional>

namespace hybridtree
{

/// What the ways to mesh a blend cost, by counting what they do: to choose the cheapest. Costs are
/// microseconds of one processor; only their ratios matter. The counts are those of the case; what
/// one of each costs was fitted to blends of skeletons and on meshes where both ways are about as
/// fast (docs/figures.md).
class BlendCost
{
public:
  /// What one value of the field costs.
  struct Sample
  {
    double onSurface; ///< on average
    double inCell;    ///< where terms meet
  };

  /// What is meshed.
  struct Surface
  {
    double kept;          ///< area of parts that keep their meshes, in squared cells
    double givenUp;       ///< of others
    double creases = 0.0; ///< length of the sharp edges of the first, in cells
  };

  /// \param faceted whether meshes are blended (Node::isFaceted()).
  BlendCost(const Sample& sample, bool faceted) : sample_(sample), faceted_(faceted) {}

  /// Whether a patch over cells that have been marked, and the copy of what is kept, cost less than
  /// the whole lattice.
  bool isLocalCheaper(const CellSet& cells, const Surface& surface) const;

  /// With more cells than this to mark it is not, with a border as is usual.
  std::size_t mostCells(const Surface& surface) const;

  ///@{
  /// Of the whole lattice, and of a patch and what is kept.
  /// \param border of the cells: those with a neighbour that is not marked.
  double global(const Surface& surface) const;
  double local(double cells, double border, const Surface& surface) const;
  ///@}

  /// As is usual for so many cells.
  static double usualBorder(double cells);
  /// The largest number of cells for which rising costs are at most `most`.
  static std::size_t mostCells(const std::function<double(double)>& costOfCells, double most);

private:
  Sample sample_;
  bool faceted_;
};

} // namespace hybridtree

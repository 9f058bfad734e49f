// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/CellSet.h"

#include <cstddef>

namespace hybridtree
{

/// What the ways to mesh a blend cost, by counting what they do: to choose the cheapest. Costs are
/// microseconds of one processor; only their ratios matter. The counts are those of the case; what
/// one of each costs was fitted to pairs of balls and to blends on meshes.
class BlendCost
{
public:
  /// What one value of the field costs.
  struct Sample
  {
    double onSurface; ///< on average
    double inCell;    ///< where terms meet
  };

  explicit BlendCost(const Sample& sample) : sample_(sample) {}

  /// Whether a patch over marked cells, and the copy of what is kept, cost less than the whole
  /// lattice. \param kept, givenUp area of the surface in squared cells, of parts that keep their
  /// meshes and of others.
  bool isLocalCheaper(const CellSet& cells, double kept, double givenUp) const;

  /// With more marked cells than this it hardly ever is: no need to find them all.
  std::size_t mostCells(double kept, double givenUp) const;

private:
  double global(double squares) const;
  double local(double cells, double border, double kept) const;

  Sample sample_;
};

} // namespace hybridtree

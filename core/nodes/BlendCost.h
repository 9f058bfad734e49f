// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/CellSet.h"

#include <cstddef>

namespace hybridtree
{

/// What the ways to mesh a blend cost, by counting what they do: to choose the cheapest. Costs are
/// microseconds of one processor; only their ratios matter. The counts are those of the case; what
/// one of each costs was fitted to pairs of balls and to blends on a scan.
class BlendCost
{
public:
  /// \param faceted some field is that of a mesh, which takes much longer to ask.
  explicit BlendCost(bool faceted);

  /// Of the whole lattice. \param squares area of the surface in squared cells.
  double global(double squares) const;

  /// Of a patch over marked cells, and the copy of what is kept.
  double local(const CellSet& cells, double squares) const;

  /// More marked cells than this, and local is hardly ever cheaper: no need to find them all.
  std::size_t mostCells(double squares) const;

private:
  double perSample_;
};

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Boundary of a set of cells: half-facets, 4 * cell + facet, of cells in the set whose neighbours
/// are not, in rising order, but for those that reach to infinity. In parallel.
/// \param inside per cell: not 0 in the set.
/// \throws Cancelled.
std::vector<std::int32_t> boundaryFacets(const Tetrahedralization& tetrahedra,
  const std::vector<std::uint8_t>& inside, const Progress& progress);

/// The vertices at which this boundary is no 2-manifold, in rising order. In parallel.
/// \throws Cancelled.
std::vector<std::int32_t> pinchedVertices(const Tetrahedralization& tetrahedra,
  const std::vector<std::uint8_t>& inside, const Progress& progress);

} // namespace hybridtree

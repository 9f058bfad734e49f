// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/FacetSize.h"
#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Where the wide tetrahedra of a Delaunay tetrahedralization belong.
enum class Region : std::uint8_t
{
  Surface, ///< not wide: part of the layer along the surface, undecided
  Outside, ///< hangs together with the outside through wide facets
  Inside   ///< does not
};

/// Tells the empty space around an object from that inside it, by a watershed over the facets.
///
/// Facets are taken from the widest to the narrowest that is wide at all; each joins the regions on
/// its two sides, unless it is narrow against both (a place of thin sampling in a wall, rather than
/// a passage) and narrower than any mouth of a pocket. So which side a tetrahedron falls to is
/// decided by its widest ways out, not by who comes first.
/// \param wide size of facets from which they are wide.
/// \param mouth size from which a facet is a passage, whatever lies behind it; >= wide.
/// \returns one region per cell.
/// \throws Cancelled.
std::vector<Region> findRegions(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  double wide, double mouth, const Progress& progress = Progress::none());

} // namespace hybridtree

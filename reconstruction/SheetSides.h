// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/FacetSize.h"
#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"
#include "core/base/Types.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Tells the two sides of a surface that may be open by all empty balls at once, as
/// findSidesByBalls (BallSides.h) does around a solid, but nothing is known of the hull: infinite
/// cells, as half-spaces, have sides like all others. For landscapes, and what was seen from one
/// side only.
///
/// Cells are linked by EmptyBalls::weight, those with a common facet as alike, the poles of each
/// point as opposite. Links are taken from the surest to the least sure; each joins two groups of
/// cells, unless they are one (greedy signed clustering, as in Sides.h). Balls that roll around the
/// rim of a sheet overlap less than those on one side of it, so the two sides are told before they
/// could be joined there. Then all links together decide (SignedHarmonic.h), pulled softly towards
/// that: so noise and slivers do not roughen the surface, and the border runs smoothly through the
/// infinite cells.
///
/// \param normals per point, outward, any length, 0 where unknown; null: none are known. Each
/// counts like one more link of the point's poles; together they say which side is out. Without, it
/// is where more of the hull is. \returns per cell, infinite ones too: 1 on the inner side, else 0.
/// No manifold yet (SolidRepair.h). The same bytes for any number of threads. \throws Cancelled.
std::vector<std::uint8_t> findSheetByBalls(const Tetrahedralization& tetrahedra,
  const FacetSize& sizes, const std::vector<Vec3>* normals,
  const Progress& progress = Progress::none());

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/FacetSize.h"
#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Tetrahedra told apart by where their empty balls lie.
struct BallSides
{
  std::vector<std::uint8_t> inside; ///< per cell 1 or 0; infinite ones 0. No manifold yet.
  /// Share of the points, by how much they say, that still have the balls of both their sides on
  /// one: up to some 0.001 where the points tell the surface, more where walls or gaps are as thin
  /// as the points are far apart.
  double contradicted = 0.0;
};

/// Tells outside from inside by all empty balls at once: better than sizes of facets (Regions.h,
/// Sides.h) in walls, holes and gaps two to four points wide, where facets across are no larger
/// than those along the surface, but slower, so for where these leave points hidden.
///
/// Two tetrahedra with a common facet are alike as much as their balls overlap: seen from a corner,
/// by the angle between the ways to their centres. The largest ball at a point and the largest on
/// the far side of it (its poles, Amenta and Bern 1999) are opposite as much as they only touch.
/// The outside of the hull is held at 1, and all others get the values that fulfil these wishes
/// best (SignedHarmonic.h): what is negative is inside. Weights as in Kolluri, Shewchuk and
/// O'Brien, Spectral surface reconstruction from noisy point clouds, SGP 2004; departs from it
/// by holding the hull, which turns an eigenvector into a system that is solved once, and by
/// taking all tetrahedra, not poles first.
/// \throws Cancelled.
BallSides findSidesByBalls(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  const Progress& progress = Progress::none());

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "reconstruction/FacetSize.h"
#include "reconstruction/Regions.h"
#include "reconstruction/Tetrahedralization.h"

#include "core/base/Progress.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Tells outside from inside a second time, by the points' own votes, where a first solid hides
/// points that should be on its surface: in walls, holes and gaps two to four points wide, facets
/// across are no larger than facets along the surface, so sizes alone (Regions.h, Sides.h) say
/// little, but where its empty circumscribed ball lies still tells the side of a tetrahedron.
///
/// Each point takes the way to the largest ball that touches it, in or out, for its normal (its
/// pole, as in Poles.h). Each tetrahedron is voted on by its four corners: outside if its ball
/// lies along the normal, inside if against. Neighbours whose balls overlap deeply add to each
/// other, those whose balls but touch contradict (the angle that Kolluri, Shewchuk and O'Brien 2004
/// weigh by). A few rounds; then the normals are taken anew.
/// Tetrahedra much larger than the sampling keep their side.
///
/// \param inside the first solid, per cell.
/// \returns one region per cell: those no larger than `wide` spacings are of the surface.
/// \throws Cancelled.
std::vector<Region> voteOnRegions(const Tetrahedralization& tetrahedra, const FacetSize& sizes,
  const std::vector<std::uint8_t>& inside, double wide,
  const Progress& progress = Progress::none());

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/subdivision/SkeletonTopology.h"
#include "core/subdivision/Subdivide.h"

namespace hybridtree
{

/// Places and radii after one step of subdivision: those of the points, then one for each edge.
/// `points` and `radii` of the result are filled, nothing else.
SkeletonGraph subdividedPoints(
  const SkeletonGraph& graph, const SkeletonTopology& topology, SubdivisionScheme scheme);

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <vector>

namespace hybridtree::benchmark
{

/// Surfaces of a point set by CGAL, that ours stands beside, with the settings its manual shows.
/// They throw what CGAL throws. One at a time.

/// Advancing front: greedy, over the Delaunay tetrahedralization; may have holes.
TriangleMesh advancingFront(const std::vector<Vec3>& points);

/// Scale space of four iterations.
TriangleMesh scaleSpace(const std::vector<Vec3>& points);

/// Poisson, with normals from jets of 18 neighbours and oriented along a minimum spanning tree.
TriangleMesh poisson(const std::vector<Vec3>& points);

} // namespace hybridtree::benchmark

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <Eigen/Core>

#include <vector>

namespace hybridtree
{

/// Adds points in the midst of a triangulated polygon and flips its edges, so that triangles grow
/// gradually from a border of short sides to far corners, instead of reaching them as needles
/// (Delaunay refinement, after Chew 1993).
///
/// The border stays as it is, with all its points, so angles there may stay small; points go only
/// where they do not make small angles at the border themselves. All is left as it was unless fewer
/// triangles have an angle below 10 degrees then, and where triangles are turned over or there are
/// very many.
///
/// \param triangles counter-clockwise, of the places. \param place new points come last.
void refinePolygon(std::vector<Triangle>& triangles, std::vector<Eigen::Vector2d>& place);

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/PlanarTriangulation.h"

#include <vector>

namespace hybridtree
{

/// Triangles of the flat face of a plate.
struct PlateFace
{
  /// First the outline in order around: corner 0, the points of its side, corner 1, ...
  std::vector<Vec2> points;
  std::vector<Triangle> triangles; ///< counter-clockwise
  double longest = 0.0;            ///< edge
};

/// How many edges each side of the outline gets, of about `spacing` and not more.
std::vector<int> sideCounts(const std::vector<Vec2>& corners, double spacing);

/// Near-uniform triangles of edges about `spacing`, and of at most `longest` where the outline's
/// own edges allow. Parallelograms and triangles of good angles are regular grids, as symmetric as
/// they are; other outlines are filled with a triangular lattice, which is smoothed towards the
/// outline, and mirrored where they are. \param counts of sideCounts for that spacing. \pre corners
/// are as PlanarTriangulation has them.
PlateFace meshFace(
  const std::vector<Vec2>& corners, const std::vector<int>& counts, double spacing, double longest);

} // namespace hybridtree

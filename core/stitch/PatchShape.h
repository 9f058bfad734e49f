// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/Stitch.h"

namespace hybridtree
{

/// Gives the new triangles of a stitched mesh a better shape: collapses short sides of slivers and
/// flips edges, where that makes the smallest angle larger.
///
/// No point moves. Points of the parts stay, and so do all triangles that are kept; only cut
/// vertices and points of the patch may go. What a collapse takes away lies within 5 % of a cell of
/// what replaces it, so creases stay. A closed 2-manifold stays one, of the same genus. Triangles
/// that change lose their sourceTriangle.
///
/// \param firstOwn the first point that may go. \param cellSize of the patch.
void improveShapes(StitchedMesh& stitched, std::size_t firstOwn, double cellSize);

} // namespace hybridtree

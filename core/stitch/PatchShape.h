// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/Stitch.h"

namespace hybridtree
{

/// Gives the new triangles of a stitched mesh a better shape: collapses short sides of slivers,
/// flips edges and moves points along the surface, where that makes the smallest angles larger.
///
/// Points of the parts stay, and so do all triangles that are kept; only cut vertices and points of
/// the patch move or go. What a collapse takes away lies within 5 % of a cell of what replaces it,
/// and points at creases do not move, so creases stay. A closed 2-manifold stays one, of the same
/// genus. Triangles that change lose their sourceTriangle, points that move their origin.
void improveShapes(const FieldSource& field, StitchedMesh& stitched, double cellSize);

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"
#include "core/polygonize/FieldSource.h"

#include <cstddef>
#include <vector>

namespace hybridtree
{

/// What becomes of triangles that are turned over in the end.
enum class Folds
{
  Stay,
  Unfold ///< more of them go, by steps that pass through worse ones (UnfoldPatch.h)
};

/// Gives the triangles of an island a better shape: collapses short sides of slivers, flips edges
/// and moves points along the surface, where that makes the smallest angles larger. Triangles that
/// are turned over go too, if they can.
///
/// Points before `keptPoints` stay; the others may move or go. What a collapse takes away lies
/// within 5 % of a cell of what replaces it, and points at creases do not move, so creases stay. A
/// 2-manifold stays one, of the same genus and border. Triangles that change lose their
/// sourceTriangle, points that move their origin.
/// \param onCrease per point: known to be on one. Nothing farther than 1 % of a cell is taken away
/// there. The same of the points that are left when it returns.
void improveShapes(const FieldSource& field, TriangleMesh& mesh, std::size_t keptPoints,
  std::vector<bool>& onCrease, double cellSize, Folds folds);

} // namespace hybridtree

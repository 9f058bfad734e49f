// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/MeshLinks.h"
#include "core/mesh/TriangleMesh.h"

#include <cstddef>
#include <vector>

namespace hybridtree
{

/// Takes small folds out of a patch: triangles that are turned against the normals of their points
/// (CheckPatch.h), as where a point in the midst of a polygon has come to lie outside of it.
///
/// Of all collapses and flips at such a triangle the one is taken that leaves the least area
/// turned, as long as it is less than before, so it ends. Unlike those of improveShapes(), single
/// steps may leave other triangles turned, or slivers. Folds of more than a quarter of a cell stay.
/// A 2-manifold stays one, of the same genus and border; points do not move, those before
/// `keptPoints` and at creases do not go, and what goes was within 10 % of a cell of what replaces
/// it.
///
/// \param links of the triangles; mesh.triangles is not looked at.
/// \return the triangles that have changed, some of which may be removed; none twice, rising.
std::vector<std::size_t> unfoldTriangles(MeshLinks& links, const TriangleMesh& mesh,
  std::size_t keptPoints, const std::vector<bool>& onCrease, double cellSize);

} // namespace hybridtree

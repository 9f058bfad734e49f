// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/MeshLinks.h"
#include "core/mesh/TriangleMesh.h"

#include <cstddef>
#include <vector>

namespace hybridtree
{

/// Takes the triangles of `links` over into the mesh they were made of, and leaves out what was
/// removed and points of no triangle. The order of the rest stays, and so do points before
/// `keptPoints`, used or not.
///
/// \param touched per triangle: it is not what it was, and loses its sourceTriangle.
/// \param onCrease per point of the mesh, before and after. \pre mesh.sourceLeaf is full.
void dropRemoved(const MeshLinks& links, const std::vector<bool>& touched, std::size_t keptPoints,
  TriangleMesh& mesh, std::vector<bool>& onCrease);

} // namespace hybridtree

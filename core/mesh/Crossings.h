// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <utility>
#include <vector>

namespace hybridtree
{

/// Pairs of triangles that cross one another, the second of which is one of the last of the mesh.
/// By rising second, then first.
///
/// Exact. Triangles that share an edge do not count, those that share a point only where they meet
/// elsewhere, and those in one plane not at all.
/// \param firstNew of the triangles to be tested against each other and all before.
/// \param removed per triangle before: it does not count. \param cellSize about the size of the new
/// triangles. Expected time goes with the new triangles, but for one glance at each of the others.
std::vector<std::pair<std::size_t, std::size_t>> newCrossings(const TriangleMesh& mesh,
  std::size_t firstNew, const std::vector<bool>& removed, double cellSize);

} // namespace hybridtree

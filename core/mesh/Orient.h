// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <cstddef>

namespace hybridtree
{

/// What orientTriangles() found and did.
struct Orientation
{
  std::size_t flippedTriangles = 0; ///< turned to agree with their neighbours
  std::size_t flippedShells = 0;    ///< closed shells that were inside out
  std::size_t cavities = 0;         ///< closed shells inside an odd number of others
  std::size_t oneSidedShells = 0;   ///< cannot be oriented (a Moebius strip)
  std::size_t openEdges = 0;
  std::size_t nonManifoldEdges = 0;
};

/// Turns triangles so that neighbours across edges of two triangles agree; then closed shells so
/// that they point outward, or inward where they bound a cavity (inside an odd number of others).
/// Open shells keep the side that most of their triangles show.
/// \pre triangles are in range and repeat no corner.
Orientation orientTriangles(TriangleMesh& mesh);

} // namespace hybridtree

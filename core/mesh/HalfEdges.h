// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Which triangles meet at each edge. Half-edge 3 t + k runs from corner k to corner k + 1 of
/// triangle t.
struct HalfEdges
{
  static constexpr std::int32_t kOpen = -1;
  static constexpr std::int32_t kNonManifold = -2;

  /// Per half-edge: the other half-edge of an edge of exactly two triangles, whichever way it runs;
  /// kOpen at an edge of one triangle, kNonManifold at an edge of more than two.
  std::vector<std::int32_t> opposite;

  /// Edges, each counted once.
  std::size_t openEdges = 0;
  std::size_t nonManifoldEdges = 0;
  /// Edges of two triangles that run along them in the same direction.
  std::size_t flippedEdges = 0;

  bool closedAndOriented() const
  {
    return openEdges == 0 && nonManifoldEdges == 0 && flippedEdges == 0;
  }
};

/// By sorting, O(n log n). \pre indices are in range; no triangle repeats a corner.
HalfEdges halfEdges(const std::vector<Triangle>& triangles);

} // namespace hybridtree

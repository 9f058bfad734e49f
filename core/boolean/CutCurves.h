// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/TriangleCrossings.h"

#include <array>
#include <vector>

namespace hybridtree
{

/// Point where an edge of one mesh crosses a triangle of the other. Three triangles meet there, or
/// one more pair for every further pair of triangles at the edge, each pair with a point of its
/// own.
struct Crossing
{
  std::int32_t low, high; ///< ends of the edge
  std::int32_t other;     ///< triangle of the other mesh
  std::int32_t row;       ///< which pair of triangles at the edge; 0 where there are but two
  std::int8_t mesh;       ///< of the edge: 0 for A, 1 for B
  bool lowOutside;        ///< the side of `low` is the outer one
  double parameter;       ///< 0 at low, 1 at high
  Vec3 position;
};

/// The curves in which two surfaces cross: segments joined at crossings.
struct CutCurves
{
  /// The triangles of one mesh that are cut, and the segments in each.
  struct Cuts
  {
    std::vector<std::int32_t> triangles; ///< in order
    std::vector<std::int32_t> first;     ///< per triangle, and one more: into segments
    std::vector<std::int32_t> segments;
  };

  std::vector<Segment> segments;
  /// Per segment: crossings at its start and end.
  std::vector<std::array<std::int32_t, 2>> ends;
  /// Those on edges of A first; those on one edge stand together, row by row, each in order from
  /// low to high.
  std::vector<Crossing> crossings;
  std::array<Cuts, 2> cuts;
};

/// From the nearer end, so that the ends are met exactly.
Vec3 pointOnEdge(const Vec3& low, const Vec3& high, double parameter);

/// \throws Cancelled; InvalidGeometry where the predicates fail to tell.
CutCurves cutCurves(const MeshOperand& a, const MeshOperand& b,
  const PerturbedPredicates& predicates, std::vector<Segment> segments);

/// The curves as chains of crossings; closed ones end where they begin.
std::vector<std::vector<std::int32_t>> chainsOf(const CutCurves& curves);

} // namespace hybridtree

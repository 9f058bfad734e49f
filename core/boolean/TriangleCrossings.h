// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/boolean/MeshOperand.h"
#include "core/boolean/PerturbedPredicates.h"

#include <array>
#include <vector>

namespace hybridtree
{

/// One end of the segment in which two triangles cross: where an edge of one (its `own`) meets the
/// other.
struct SegmentEnd
{
  std::int32_t low, high;  ///< ends of the edge, by index
  std::int32_t own, other; ///< triangles
  std::int8_t mesh;        ///< of the edge: 0 for A, 1 for B
  std::int8_t corner;      ///< of `own`, where the edge starts
  bool forward;            ///< `own` runs along the edge from low to high
  bool lowOutside;         ///< `low` lies on the outer side of `other`
};

/// The segment in which a triangle of A and one of B cross. Seen from outside of A, the outside of
/// B lies to its left; seen from outside of B, the outside of A lies to its right.
struct Segment
{
  std::int32_t triangle[2]; ///< of A, of B
  SegmentEnd start;
  SegmentEnd end;
};

/// How the triangles of two meshes meet.
struct TriangleCrossings
{
  std::vector<Segment> segments;
  /// Per mesh: its triangles, not each but once, that lie on one of the other mesh but for rounding
  /// (MeshOperand::rounding()).
  std::array<std::vector<std::int32_t>, 2> touching;
};

/// All of them, in an order that depends on the meshes alone.
///
/// Sides of vertices and of edges decide (Guigue and Devillers 2003); no point is constructed.
/// \throws Cancelled; InvalidGeometry where the predicates fail to tell.
TriangleCrossings triangleCrossings(const MeshOperand& a, const MeshOperand& b,
  const PerturbedPredicates& predicates, const Progress& progress);

Site siteOf(const MeshOperand& operand, std::int32_t vertex, bool second);

} // namespace hybridtree

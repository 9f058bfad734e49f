// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/CutCurves.h"
#include "core/boolean/MeshSides.h"

#include <vector>

namespace hybridtree
{

/// What is kept of one mesh.
struct Keep
{
  bool outside; ///< what lies outside of the other mesh, else what lies inside
  bool flip;    ///< turned around: the walls of what is taken away

  /// How often a part is kept that the other mesh goes around so often: once, or not at all; below
  /// 0 or more often where that one crosses itself, turned around below 0. What is kept of both is
  /// closed for any winding numbers: the boundary of w_A + w_B - w_A w_B, w_A w_B, w_A - w_A w_B.
  int copies(std::int8_t winding) const
  {
    return winding == MeshSides::kUnused ? 0 : outside ? 1 - winding : int(winding);
  }
};

/// The kept parts of the cut triangles of one mesh, as triangles.
struct CutFaces
{
  /// Corners: v + k n >= 0 is copy k of vertex v of the n of the mesh, -1 - c is crossing c; from
  /// crossings.size() on, the added point c - crossings.size().
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> source; ///< per triangle: the cut triangle it is a part of
  std::vector<Vec3> addedPoints;
};

/// Follows the curves and the borders of each cut triangle around its kept parts, by crossings
/// alone: neighbouring parts fit whatever rounding does to the points.
///
/// Along an edge, the pieces kept run from where copies begin to where they end, the first to the
/// first (Smith 2009, Towards robust inexact geometric computation): the triangles on both sides
/// make the same pieces for any number of copies, each with ends of its own. So the result is a
/// closed 2-manifold, whatever the operands cross.
/// \throws TooLarge for too many copies; InvalidGeometry where begins and ends are not as many, as
/// with a mesh that is not oriented.
CutFaces cutFaces(const MeshOperand& operand, int mesh, const Keep& keep, const CutCurves& curves,
  const MeshSides& sides);

} // namespace hybridtree

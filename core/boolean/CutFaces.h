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
};

/// The kept parts of the cut triangles of one mesh, as triangles.
struct CutFaces
{
  /// Corners: v >= 0 is a vertex of the mesh, -1 - c is crossing c; from crossings.size() on, the
  /// added point c - crossings.size().
  std::vector<Triangle> triangles;
  std::vector<std::int32_t> source; ///< per triangle: the cut triangle it is a part of
  std::vector<Vec3> addedPoints;
};

/// Follows the curves and the borders of each cut triangle around its kept parts, by crossings
/// alone: neighbouring parts fit whatever rounding does to the points.
/// \param contradictory set where a part has a corner of the other side.
CutFaces cutFaces(const MeshOperand& operand, int mesh, const Keep& keep, const CutCurves& curves,
  const MeshSides& sides, bool& contradictory);

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/AxisFrame.h"
#include "core/mesh/TriangleMesh.h"
#include "core/skeletons/Meridian.h"

#include <vector>

namespace hybridtree
{

/// Where a surface of revolution stands: the first point of an unshifted ring is towards `side`.
using RevolvedFrame = AxisFrame;

/// One ring of points around the axis. Point k stands at the angle (2k + shift) pi / count. A ring
/// on the axis is one point.
struct Ring
{
  MeridianPoint place;
  int count = 0;
  int shift = 0; ///< 0 or 1
};

/// The mesh between rings that follow each other, the outside on the right of their order; `closed`
/// joins the last to the first. Each strip advances on the ring that gives the shorter diagonal, in
/// integers, so that the pattern repeats around the axis.
/// \pre at least three rings, or two if one of them is on the axis; only the first and the last may
/// be there.
TriangleMesh meshRings(const std::vector<Ring>& rings, bool closed, const RevolvedFrame& frame);

/// The same with a frame for each ring, in which its place is meant.
TriangleMesh meshRings(
  const std::vector<Ring>& rings, bool closed, const std::vector<RevolvedFrame>& frames);

/// Longest edge of a mesh from meshRings(). Each triangle leads from one ring to the other between
/// its first point and its last, and each edge between rings is that of one.
double longestEdge(const TriangleMesh& mesh, const std::vector<Ring>& rings);

/// Largest distance of two joined points of neighbouring rings around one axis.
double longestAcross(const Ring& a, const Ring& b);

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

namespace hybridtree
{

/// Nearest point of a triangle, and which of its features holds it.
struct NearestOnTriangle
{
  static constexpr int kFace = 6;

  Vec3 point;
  double squaredDistance;
  int
    feature; ///< 0, 1, 2: that corner; 3 + k: the edge from corner k to k + 1; kFace: the interior
};

/// Nearest point of triangle a, b, c to p. Well conditioned for slivers too: the three edges as
/// segments, and the plane only where the projection falls inside, of a triangle wide enough to
/// have a plane (height over length above 1e-8; below that the edges are as near to rounding).
NearestOnTriangle nearestOnTriangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

} // namespace hybridtree

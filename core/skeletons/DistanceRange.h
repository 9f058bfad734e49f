// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/skeletons/Skeleton.h"

namespace hybridtree
{

/// [min, max] of the distance to a convex skeleton over a box. The distance is then a convex
/// function: its maximum is at a corner (exact), and it lies above its tangent plane at the centre
/// of the box (exact to second order in the size of the box). \pre the box is not empty.
Interval convexDistanceRange(const Skeleton& skeleton, const Box3& box);

/// Heights along an axis and distances from it that a box has.
struct AxisRange
{
  Interval height;
  Interval radial;
};

/// Exact in height and in the largest radius; the smallest radius to second order in the size of
/// the box. \param axis unit vector. \pre the box is not empty.
AxisRange axisRange(const Box3& box, const Vec3& origin, const Vec3& axis);

/// A range of the distance made no wider than it can be: the distance at the centre of the box,
/// give or take the half diagonal. Widened by rounding as below.
Interval withinReach(Interval distance, const Skeleton& skeleton, const Box3& box);

/// The interval widened by the rounding that distances at such coordinates carry; not below 0.
Interval widenedByRounding(Interval distance, const Box3& box, const Box3& skeletonBounds);

} // namespace hybridtree

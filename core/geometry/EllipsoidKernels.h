// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/SkeletonKernels.h"

namespace hybridtree
{

/// The full ellipsoid, not its surface.
struct EllipsoidShape
{
  Vec3 center;
  Mat3 axes;  ///< orthonormal columns
  Vec3 radii; ///< along the columns, each > 0, the last the smallest
};

/// The nearest point is the root of the secular equation of Eberly, "Distance from a Point to an
/// Ellipse, an Ellipsoid, or a Hyperellipsoid" (2013), in the form 1 / sqrt(G) = 1, which is
/// increasing and concave: Newton's method climbs to the root from the left and cannot overshoot.
/// Exact to rounding everywhere, on the axes and focal curves too, for any ratio of the radii up to
/// 1e8.
const SkeletonKernels<EllipsoidShape>& kernelsFor(const EllipsoidShape&);

} // namespace hybridtree

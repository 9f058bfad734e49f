// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/SkeletonKernels.h"

#include <vector>

namespace hybridtree
{

/// A flat plate without thickness: the inside of a simple polygon, convex or not.
struct PlateShape
{
  /// One side of the outline, from `start` to the start of the next, in the plate's plane.
  struct Side
  {
    double x, y;                 ///< start
    double dx, dy;               ///< to the end
    double inverseSquaredLength; ///< 1 / (dx^2 + dy^2)
    double slope;                ///< dx / dy; not used where dy is 0
  };

  Vec3 origin;
  Mat3 axes; ///< orthonormal, right-handed: the plane's x and y, and its normal
  /// Counter-clockwise, no two corners at the same place.
  std::vector<Side> sides;
};

/// A plate from its corners in its plane. \pre simple, counter-clockwise, 3 corners or more.
PlateShape makePlate(
  const Vec3& origin, const Mat3& axes, const std::vector<Eigen::Vector2d>& corners);

/// Time grows with the number of sides.
const SkeletonKernels<PlateShape>& kernelsFor(const PlateShape&);

} // namespace hybridtree

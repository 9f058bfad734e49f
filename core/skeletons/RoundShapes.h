// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/AxisFrame.h"
#include "core/skeletons/Meridian.h"

#include <string>
#include <vector>

namespace hybridtree
{

// What the skeletons of revolution share.

/// With the direction of `axis`, which need not be of unit length, and some side.
/// \param name of the parameter that gives the axis. \throws InvalidParameter without direction.
AxisFrame frameAlong(const std::string& name, const Vec3& origin, const Vec3& axis);

/// Between two points; the origin is in the middle.
/// \throws InvalidParameter where they coincide or are not finite.
AxisFrame frameBetween(const Vec3& point1, const Vec3& point2);

/// Bounds of a disc, or of its rim. \param normal of unit length.
Box3 discBounds(const Vec3& center, const Vec3& normal, double radius);

/// Meridian of the offset of a convex solid: the corners (radial, height) of its half section from
/// the lower end of the axis to the upper one, drawn apart by arcs of the given radius; creases for
/// 0. Corners that coincide count once.
Meridian roundedMeridian(const std::vector<Vec2>& corners, double radius, bool symmetric);

} // namespace hybridtree

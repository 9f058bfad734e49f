// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace hybridtree
{

/// A plane that touches the surface f = T: where the field would be T if it were linear.
struct TouchingPlane
{
  Vec3 normal = Vec3::Zero(); ///< unit length, outward
  Vec3 at = Vec3::Zero();     ///< the field was asked here
  double ahead = 0.0;         ///< from there to the plane, along the normal
  double slope = 0.0;         ///< |grad f|

  static TouchingPlane of(const Vec3& at, double value, const Vec3& gradient);

  double distance(const Vec3& p) const { return normal.dot(p - at) - ahead; }
};

using TouchingPlanes = std::vector<TouchingPlane>;

/// Where planes meet.
struct Meeting
{
  bool found = false;
  Vec3 point = Vec3::Zero();
  Vec3 edge = Vec3::Zero(); ///< its direction, unit length; 0 at a corner
};

/// The point with the least squared distances to all planes (Kobbelt et al. 2001); where they meet
/// in an edge the one next to `near`. Not found where they meet in no edge, or beyond `reach`.
Meeting meetingOf(const TouchingPlanes& planes, const Vec3& near, double reach);

/// Two of some planes, and the angle between their normals, radians.
struct PlanePair
{
  std::size_t first = 0;
  std::size_t second = 0;
  double angle = 0.0;
};

/// Those whose normals are furthest apart. \pre at least two planes.
PlanePair widestPair(const TouchingPlanes& planes);
inline double widestAngle(const TouchingPlanes& planes)
{
  return widestPair(planes).angle;
}

/// Sum of the normals of the faces that meet, each once: normals within `leastAngle` are of one
/// face. \pre at least two planes.
Vec3 middleNormal(const TouchingPlanes& planes, double leastAngle);

/// Part of a straight line, by the distance from its point.
struct LinePart
{
  double begin = -std::numeric_limits<double>::infinity();
  double end = std::numeric_limits<double>::infinity();

  bool empty() const { return begin > end; }
  double middle() const { return 0.5 * (begin + end); }
  double nearest(double t) const { return std::clamp(t, begin, end); }

  /// Keeps where height + slope t >= 0.
  void clip(double height, double slope);
};

} // namespace hybridtree

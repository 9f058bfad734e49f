// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{

// How well shaped triangles are and how far they turn, for remeshStretched.

/// Of the cosine of a smallest angle: beyond it a normal means nothing.
inline constexpr double kSliver = 0.99;

/// Squared lengths of the sides of a triangle. The same bits for any order of the corners.
struct SquaredSides
{
  SquaredSides(const Vec3& a, const Vec3& b, const Vec3& c)
  {
    const double ab = (b - a).squaredNorm();
    const double bc = (c - b).squaredNorm();
    const double ca = (a - c).squaredNorm();
    const double low = std::min(ab, bc);
    const double high = std::max(ab, bc);
    shortest = std::min(low, ca);
    middle = std::max(low, std::min(high, ca));
    longest = std::max(high, ca);
  }

  double shortest;
  double middle;
  double longest;
};

/// Cosine of the smallest angle: 0.5 at best, 1 without area.
inline double shapeOf(const SquaredSides& sides)
{
  const double scale = 2.0 * std::sqrt(sides.middle) * std::sqrt(sides.longest);
  return scale > 0.0 ? (sides.middle + sides.longest - sides.shortest) / scale : 1.0;
}

inline double shapeOf(const Vec3& a, const Vec3& b, const Vec3& c)
{
  return shapeOf(SquaredSides(a, b, c));
}

/// Twice the area long.
inline Vec3 normalOf(const Vec3& a, const Vec3& b, const Vec3& c)
{
  return (b - a).cross(c - a);
}

/// By more than 60 degrees, or to nothing.
inline bool turnsTooFar(const Vec3& before, const Vec3& after)
{
  constexpr double kLargestTurn = 0.5; // cosine
  return !(before.dot(after) >= kLargestTurn * before.norm() * after.norm()) ||
    !(after.squaredNorm() > 0.0);
}

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{

/// Cosine of the smallest angle: 0.5 at best, 1 without area.
inline double shapeOf(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const double ab = (b - a).squaredNorm();
  const double bc = (c - b).squaredNorm();
  const double ca = (a - c).squaredNorm();
  const double shortest = std::min(std::min(ab, bc), ca);
  const double longest = std::max(std::max(ab, bc), ca);
  const double middle = std::max(std::min(std::max(ab, bc), ca), std::min(ab, bc));
  const double scale = 2.0 * std::sqrt(middle) * std::sqrt(longest);
  return scale > 0.0 ? (middle + longest - shortest) / scale : 1.0;
}

/// Of such a cosine: 1 without area, 0 from a smallest angle of 30 degrees on. What improves shapes
/// makes the sum of it over all triangles smaller.
inline double badness(double shape)
{
  constexpr double kGood = 0.866;
  const double over = std::max(shape - kGood, 0.0) / (1.0 - kGood);
  return over * over;
}

} // namespace hybridtree

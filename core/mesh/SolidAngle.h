// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <cmath>

namespace hybridtree
{

inline constexpr double kFullSolidAngle = 12.566370614359172; // 4 pi

/// Signed solid angle of triangle a, b, c seen from p, in (-2 pi, 2 pi]: positive where p looks at
/// its back (the inside of a closed mesh). van Oosterom and Strackee 1983.
inline double solidAngle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p)
{
  const Vec3 u = a - p;
  const Vec3 v = b - p;
  const Vec3 w = c - p;
  const double lu = u.norm();
  const double lv = v.norm();
  const double lw = w.norm();
  const double numerator = u.dot(v.cross(w));
  const double denominator = lu * lv * lw + u.dot(v) * lw + v.dot(w) * lu + w.dot(u) * lv;
  return numerator == 0.0 ? 0.0 : 2.0 * std::atan2(numerator, denominator);
}

} // namespace hybridtree

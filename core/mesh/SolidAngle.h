// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <cmath>

namespace hybridtree
{

inline constexpr double kFullSolidAngle = 12.566370614359172; // 4 pi

/// Sine and cosine of an angle, times any positive number.
struct AnglePair
{
  double sine, cosine;
};

/// Half the signed solid angle of triangle a, b, c seen from p, in (-pi, pi]: positive where p
/// looks at its back (the inside of a closed mesh). van Oosterom and Strackee 1983.
inline AnglePair halfSolidAngle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p)
{
  const Vec3 u = a - p;
  const Vec3 v = b - p;
  const Vec3 w = c - p;
  const double lu = u.norm();
  const double lv = v.norm();
  const double lw = w.norm();
  return { u.dot(v.cross(w)), lu * lv * lw + u.dot(v) * lw + v.dot(w) * lu + w.dot(u) * lv };
}

/// The whole of it, in (-2 pi, 2 pi]; 0 for p in the plane of the triangle.
inline double solidAngle(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p)
{
  const auto [sine, cosine] = halfSolidAngle(a, b, c, p);
  return sine == 0.0 ? 0.0 : 2.0 * std::atan2(sine, cosine);
}

/// Sum of angles from -pi to pi by one arc tangent for all: complex numbers are multiplied, and
/// whole turns counted where a product passes the negative real axis. The arc tangent is most of
/// the work otherwise.
class AngleSum
{
public:
  /// An angle of sine 0 adds nothing, whatever its cosine.
  void add(double sine, double cosine)
  {
    if (sine == 0.0)
    {
      return;
    }
    const double real = real_ * cosine - imaginary_ * sine;
    const double imaginary = real_ * sine + imaginary_ * cosine;
    const double size = std::abs(real) + std::abs(imaginary);
    if (!(size >= kLeast && size <= kMost))
    {
      apart_ += std::atan2(sine, cosine); // the product would overflow or lose digits
      return;
    }
    // Angles of two signs never pass it. What lies on the axis counts as +pi.
    if (imaginary_ >= 0.0 && sine > 0.0 && imaginary < 0.0)
    {
      turns_ += 1.0;
    }
    else if (imaginary_ < 0.0 && sine < 0.0 &&
      (imaginary > 0.0 || (imaginary == 0.0 && real < 0.0)))
    {
      turns_ -= 1.0;
    }
    real_ = real / size;
    imaginary_ = imaginary / size;
  }

  double sum() const
  {
    const double rest = imaginary_ == 0.0 ? std::atan2(0.0, real_) : std::atan2(imaginary_, real_);
    return rest + 0.5 * kFullSolidAngle * turns_ + apart_;
  }

private:
  static constexpr double kLeast = 1e-280;
  static constexpr double kMost = 1e280;

  double real_ = 1.0;
  double imaginary_ = 0.0;
  double turns_ = 0.0;
  double apart_ = 0.0;
};

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hybridtree
{

/// Conservative arithmetic on intervals of reals. Rounding is not directed: callers widen a final
/// result by a few units in the last place.

inline Interval hull(Interval a, Interval b)
{
  return { std::min(a.min, b.min), std::max(a.max, b.max) };
}

inline Interval operator-(Interval a)
{
  return { -a.max, -a.min };
}

inline Interval operator-(Interval a, Interval b)
{
  return { a.min - b.max, a.max - b.min };
}

inline Interval operator*(Interval a, Interval b)
{
  const auto [low, high] =
    std::minmax({ a.min * b.min, a.min * b.max, a.max * b.min, a.max * b.max });
  return { low, high };
}

inline Interval operator*(double a, Interval b)
{
  return a >= 0.0 ? Interval{ a * b.min, a * b.max } : Interval{ a * b.max, a * b.min };
}

inline Interval clamped(Interval a, double low, double high)
{
  return { std::clamp(a.min, low, high), std::clamp(a.max, low, high) };
}

/// Range of the cosine over an interval of radians.
inline Interval cosRange(Interval angle)
{
  constexpr double kPi = 3.14159265358979323846;
  const double first =
    std::ceil(angle.min / kPi); // of the multiples of pi inside, where cos is +-1
  const double last = std::floor(angle.max / kPi);
  if (last > first)
  {
    return { -1.0, 1.0 };
  }
  Interval range = hull(
    { std::cos(angle.min), std::cos(angle.min) }, { std::cos(angle.max), std::cos(angle.max) });
  if (first == last)
  {
    (std::fmod(first, 2.0) == 0.0 ? range.max : range.min) =
      std::fmod(first, 2.0) == 0.0 ? 1.0 : -1.0;
  }
  return range;
}

/// Range of the sine over an interval of radians.
inline Interval sinRange(Interval angle)
{
  constexpr double kHalfPi = 1.57079632679489661923;
  return cosRange({ angle.min - kHalfPi, angle.max - kHalfPi });
}

/// Every matrix M with |M - center| <= radius, entry by entry.
struct MatrixInterval
{
  Mat3 center = Mat3::Zero();
  Mat3 radius = Mat3::Zero();

  MatrixInterval() = default;
  MatrixInterval(const Mat3& middle, const Mat3& deviation) : center(middle), radius(deviation) {}
  /// \param entries row by row.
  explicit MatrixInterval(const std::array<Interval, 9>& entries)
  {
    for (int k = 0; k < 9; ++k)
    {
      center(k / 3, k % 3) = 0.5 * (entries[k].min + entries[k].max);
      radius(k / 3, k % 3) = 0.5 * (entries[k].max - entries[k].min);
    }
  }

  /// A M B for every M held.
  MatrixInterval between(const Mat3& a, const Mat3& b) const
  {
    return { a * center * b, a.cwiseAbs() * radius * b.cwiseAbs() };
  }

  /// Largest |M v| of each row, over every M held and every |v| <= half.
  Vec3 extent(const Vec3& half) const { return (center.cwiseAbs() + radius) * half; }
};

} // namespace hybridtree

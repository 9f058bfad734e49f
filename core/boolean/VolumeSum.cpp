// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/VolumeSum.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace hybridtree
{
namespace
{

// With u = 2^-53: products of two are off by 6u^2, sums by 3u^2, each of itself (Joldes, Muller and
// Popescu 2017, algorithms 11 and 6), differences of two coordinates not at all. So a determinant
// is off by 21u^2 of its terms, whose absolute values sum to at most sqrt(3) times the product of
// the lengths of its rows: 37u^2 of that.
constexpr double kDeterminant = 0x1p-100;
constexpr double kSum = 0x1p-104;

TwoDoubles operator+(const TwoDoubles& a, const TwoDoubles& b)
{
  const TwoDoubles high = twoSum(a.high, b.high);
  const TwoDoubles low = twoSum(a.low, b.low);
  const TwoDoubles sum = fastTwoSum(high.high, high.low + low.high);
  return fastTwoSum(sum.high, low.low + sum.low);
}

TwoDoubles operator-(const TwoDoubles& a, const TwoDoubles& b)
{
  return a + TwoDoubles{ -b.high, -b.low };
}

TwoDoubles operator*(const TwoDoubles& a, const TwoDoubles& b)
{
  const double high = a.high * b.high;
  const double low = std::fma(a.high, b.high, -high);
  return fastTwoSum(high, low + std::fma(a.high, b.low, a.low * b.high));
}

} // namespace

void VolumeSum::add(const Vec3& origin, const Vec3& a, const Vec3& b, const Vec3& c)
{
  const auto from = [&](const Vec3& point)
  {
    std::array<TwoDoubles, 3> way;
    for (int k = 0; k < 3; ++k)
    {
      way[std::size_t(k)] = twoSum(point[k], -origin[k]);
    }
    return way;
  };
  const std::array<TwoDoubles, 3> p = from(a);
  const std::array<TwoDoubles, 3> q = from(b);
  const std::array<TwoDoubles, 3> r = from(c);
  const TwoDoubles determinant = p[0] * (q[1] * r[2] - q[2] * r[1]) +
    p[1] * (q[2] * r[0] - q[0] * r[2]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
  sum_ = sum_ + determinant;
  rounding_ += kDeterminant * (a - origin).norm() * (b - origin).norm() * (c - origin).norm() +
    kSum * std::abs(sum_.high);
}

} // namespace hybridtree

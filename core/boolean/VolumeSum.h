// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"
#include "core/boolean/TwoSum.h"

namespace hybridtree
{

/// The signed volume of a closed surface, triangle by triangle, with a bound of what rounding has
/// done to it: positive where triangles face outward. The numbers are unevaluated sums of two
/// doubles (Dekker 1971), so that the bound is about 2^-100 of the product of three lengths: sheets
/// that lie on each other are told from thin plates however narrow they are, where a sum of doubles
/// knows no more than 2^-50. The bound does not hold where products under- or overflow.
class VolumeSum
{
public:
  /// Adds the tetrahedron of a triangle and `origin`, one point for the whole surface, best on it.
  void add(const Vec3& origin, const Vec3& a, const Vec3& b, const Vec3& c);

  double value() const { return (sum_.high + sum_.low) / 6.0; }
  /// The value is no further off than this and its own last bits.
  double rounding() const { return rounding_ / 6.0; }

private:
  TwoDoubles sum_;
  double rounding_ = 0.0;
};

} // namespace hybridtree

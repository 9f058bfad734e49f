// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <array>
#include <vector>

namespace hybridtree
{

/// A vector-valued polynomial on the unit cube in trivariate Bernstein form:
/// X(s, t, u) = sum_ijk B_i(s) B_j(t) B_k(u) c_ijk, of degree size - 1 along each axis.
///
/// Evaluates beyond [0, 1] as well (the polynomial goes on). Immutable, no allocation per
/// evaluation.
class BernsteinVolume
{
public:
  /// Most coefficients along one axis.
  static constexpr int kLargestSize = 64;

  /// \param sizes coefficients along each axis, 1 to kLargestSize.
  /// \param coefficients sizes[0] * sizes[1] * sizes[2], s fastest.
  /// \throws InvalidParameter when they do not fit.
  BernsteinVolume(const std::array<int, 3>& sizes, std::vector<Vec3> coefficients);

  Vec3 evaluate(const Vec3& at) const;

  /// And the derivatives: column a is the one along axis a.
  Vec3 evaluate(const Vec3& at, Mat3& derivative) const;

  /// The derivative along one axis: degree one less along it (0 stays 0).
  BernsteinVolume derivative(int axis) const;

  /// The same polynomial over a part of the unit cube, which becomes the unit cube (de Casteljau).
  BernsteinVolume restricted(const Box3& part) const;

  /// Bounds of the coefficients, which hold all values over the unit cube (convex hull property).
  Box3 bounds() const;

  const std::array<int, 3>& sizes() const { return sizes_; }
  const std::vector<Vec3>& coefficients() const { return coefficients_; }

private:
  std::array<int, 3> sizes_;
  std::vector<Vec3> coefficients_;
};

} // namespace hybridtree

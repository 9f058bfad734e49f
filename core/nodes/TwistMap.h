// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/IntervalMath.h"

#include <optional>

namespace hybridtree
{

/// Barr's deformations in their own frame ([HT] 4.5.1, after Barr 1984): local coordinates are
/// (n, b, t), t along the axis and n along the bend direction. Each acts fully within
/// begin <= t <= end; before, as at begin, which is the identity; after, as at end (Barr's zones).
/// Values without state beyond these numbers.

/// Turns (n, b) by an angle that grows linearly from 0 at begin to `angle` at end. |J| = 1.
struct TwistMap
{
  double begin;
  double end;
  double angle;

  Vec3 forward(const Vec3& p) const;
  Vec3 inverse(const Vec3& p) const;
  static constexpr double kInverseCost = 0.1;
  Mat3 jacobian(const Vec3& p) const;
  /// Inverse of jacobian(p).
  Mat3 jacobianInverse(const Vec3& p) const;
  /// Holds the Jacobian of forward() at every point of the box.
  MatrixInterval jacobianOver(const Box3& box) const;
  /// Holds the Jacobian of inverse() at every point of the box; empty where inverse() jumps in it.
  std::optional<MatrixInterval> inverseJacobianOver(const Box3& box) const;
  /// Holds inverse() of the box: coarse, but also where inverse() jumps.
  Box3 inverseExtent(const Box3& box) const;
  /// Holds forward() of the box: coarse, but also for the steepest rates.
  Box3 forwardExtent(const Box3& box) const { return this->inverseExtent(box); }
};

} // namespace hybridtree

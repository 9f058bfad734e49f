// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/IntervalMath.h"

#include <optional>

namespace hybridtree
{

/// In the frame and with the zones of TwistMap.
///
/// Bends the axis towards +n (angle > 0) into a circle of radius (end - begin) / |angle|; what lies
/// beyond end goes straight on. The centre line of that circle, n = (end - begin) / angle at
/// t = begin, is where the map is singular; whatever reaches past it would overlap itself.
///
/// Inverse derived afresh, since the printed one has a mistake; 1/k never appears alone, so that
/// k -> 0 goes to the identity without loss of digits.
struct BendMap
{
  double begin;
  double end;
  double angle;

  ///@{ As in TwistMap. inverse() is a right inverse everywhere; it jumps across the half-plane
  /// opposite to the middle of the bend.
  Vec3 forward(const Vec3& p) const;
  Vec3 inverse(const Vec3& p) const;
  static constexpr double kInverseCost = 0.12;
  Mat3 jacobian(const Vec3& p) const;
  Mat3 jacobianInverse(const Vec3& p) const;
  MatrixInterval jacobianOver(const Box3& box) const;
  std::optional<MatrixInterval> inverseJacobianOver(const Box3& box) const;
  Box3 inverseExtent(const Box3& box) const;
  Box3 forwardExtent(const Box3& box) const;
  ///@}

  /// True when inverse(forward(p)) = p all over the box: nothing in it overlaps when bent.
  bool isOneToOneOver(const Box3& box) const;

private:
  double rate() const { return angle / (end - begin); }
  bool isIdentity() const;
  Interval polarAngle(const Box3& box) const;
};

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/IntervalMath.h"

#include <optional>

namespace hybridtree
{

/// In the frame and with the zones of TwistMap.
///
/// Scales (n, b) by a factor that goes linearly from 1 at begin to `factor` at end. |J| = scale^2.
struct TaperMap
{
  double begin;
  double end;
  double factor;

  ///@{ As in TwistMap.
  Vec3 forward(const Vec3& p) const;
  Vec3 inverse(const Vec3& p) const;
  static constexpr double kInverseCost = 0.04;
  Mat3 jacobian(const Vec3& p) const;
  Mat3 jacobianInverse(const Vec3& p) const;
  MatrixInterval jacobianOver(const Box3& box) const;
  std::optional<MatrixInterval> inverseJacobianOver(const Box3& box) const;
  Box3 inverseExtent(const Box3& box) const;
  Box3 forwardExtent(const Box3& box) const;
  ///@}
};

} // namespace hybridtree

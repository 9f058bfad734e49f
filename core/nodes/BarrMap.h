// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/IntervalMath.h"
#include "core/nodes/SpaceWarp.h"

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

/// Scales (n, b) by a factor that goes linearly from 1 at begin to `factor` at end. |J| = scale^2.
struct TaperMap
{
  double begin;
  double end;
  double factor;

  ///@{ As in TwistMap.
  Vec3 forward(const Vec3& p) const;
  Vec3 inverse(const Vec3& p) const;
  Mat3 jacobian(const Vec3& p) const;
  Mat3 jacobianInverse(const Vec3& p) const;
  MatrixInterval jacobianOver(const Box3& box) const;
  std::optional<MatrixInterval> inverseJacobianOver(const Box3& box) const;
  Box3 inverseExtent(const Box3& box) const;
  Box3 forwardExtent(const Box3& box) const;
  ///@}
};

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

/// A Barr map in a frame: w = frame o map o frame^-1. The frame may be scaled, mirrored or sheared,
/// so that the image under any affine map A is the same map in the frame A * frame.
template <typename Map>
class FramedWarp final : public SpaceWarp
{
public:
  /// \pre frame invertible.
  FramedWarp(const Map& map, const Affine3& frame);

  void forward(PointBatch points, VectorBatch image) const override;
  void inverse(PointBatch points, VectorBatch preimage) const override;
  void pullBack(PointBatch preimages, VectorBatch gradient) const override;
  Box3 preimageBounds(const Box3& box) const override;
  Box3 imageBounds(const Box3& box) const override;

  const Map& map() const { return map_; }
  const Affine3& frame() const { return frame_; }
  const Affine3& frameInverse() const { return frameInverse_; }

private:
  Map map_;
  Affine3 frame_;
  Affine3 frameInverse_;
};

extern template class FramedWarp<TwistMap>;
extern template class FramedWarp<TaperMap>;
extern template class FramedWarp<BendMap>;

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/RoundKernels.h"
#include "core/skeletons/KernelSkeleton.h"

namespace hybridtree
{

/// A solid truncated cone with flat ends. One radius of 0 makes a pointed cone, two a segment,
/// which has no inside.
class ConeSkeleton final : public KernelSkeleton<ConeShape>
{
public:
  /// \param radius1 at point1, >= 0. \param radius2 at point2, >= 0. \throws InvalidParameter
  /// otherwise, when the ends of the axis coincide, or when a number is not finite.
  ConeSkeleton(const Vec3& point1, const Vec3& point2, double radius1, double radius2);

  const Vec3& point1() const { return point1_; }
  const Vec3& point2() const { return point2_; }
  double radius1() const { return shape_.bottom; }
  double radius2() const { return shape_.top; }

  double distanceCost() const override { return kClosedForm; }
  Interval distanceRange(const Box3& box) const override;
  Box3 bounds() const override;
  double reach() const override { return kConvex; }
  /// With `offset` 0 the sharp cone, whose vertices on rims have one mean normal, as has the apex.
  std::optional<TriangleMesh> offsetMesh(double offset, double edgeLength) const override;
  SkeletonPtr similarityImage(const Affine3& map, double scale) const override;
  const char* kind() const override { return "cone"; }
  /// "point1", "point2", "radius1", "radius2".
  Parameters parameters() const override;
  static SkeletonPtr fromParameters(const Parameters& parameters);

private:
  // As given: the frame of the shape is rounded.
  const Vec3 point1_;
  const Vec3 point2_;
};

} // namespace hybridtree

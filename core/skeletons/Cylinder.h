// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/RoundKernels.h"
#include "core/skeletons/KernelSkeleton.h"

namespace hybridtree
{

/// A solid cylinder with flat ends; its offset surfaces have round rims. A radius of 0 makes a
/// segment, which has no inside.
class CylinderSkeleton final : public KernelSkeleton<CylinderShape>
{
public:
  /// \param radius >= 0. \throws InvalidParameter otherwise, when the ends of the axis coincide, or
  /// when a number is not finite.
  CylinderSkeleton(const Vec3& point1, const Vec3& point2, double radius);

  const Vec3& point1() const { return point1_; }
  const Vec3& point2() const { return point2_; }
  double radius() const { return shape_.radius; }

  double distanceCost() const override { return kClosedForm; }
  Interval distanceRange(const Box3& box) const override;
  Box3 bounds() const override;
  double reach() const override { return kConvex; }
  /// With `offset` 0 the sharp cylinder, whose vertices on the rims have one mean normal.
  std::optional<TriangleMesh> offsetMesh(double offset, double edgeLength) const override;
  SkeletonPtr similarityImage(const Affine3& map, double scale) const override;
  const char* kind() const override { return "cylinder"; }
  /// "point1", "point2", "radius".
  Parameters parameters() const override;
  static SkeletonPtr fromParameters(const Parameters& parameters);

private:
  // As given: the frame of the shape is rounded.
  const Vec3 point1_;
  const Vec3 point2_;
};

} // namespace hybridtree

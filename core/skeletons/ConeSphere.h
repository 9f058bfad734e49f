// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/RoundKernels.h"
#include "core/skeletons/KernelSkeleton.h"

namespace hybridtree
{

/// The convex hull of two balls. Where one holds the other, it is the skeleton alone; two radii of
/// 0 make a segment, which has no inside.
class ConeSphereSkeleton final : public KernelSkeleton<ConeSphereShape>
{
public:
  /// \param radius1 around point1, >= 0. \param radius2 around point2, >= 0.
  /// \throws InvalidParameter otherwise, or when a number is not finite.
  ConeSphereSkeleton(const Vec3& point1, const Vec3& point2, double radius1, double radius2);

  const Vec3& point1() const { return point1_; }
  const Vec3& point2() const { return point2_; }
  double radius1() const { return radius1_; }
  double radius2() const { return radius2_; }

  double distanceCost() const override { return kClosedForm; }
  Interval distanceRange(const Box3& box) const override;
  Box3 bounds() const override;
  double reach() const override { return kConvex; }
  std::optional<TriangleMesh> offsetMesh(double offset, double edgeLength) const override;
  SkeletonPtr similarityImage(const Affine3& map, double scale) const override;
  const char* kind() const override { return "cone_sphere"; }
  /// "point1", "point2", "radius1", "radius2".
  Parameters parameters() const override;
  static SkeletonPtr fromParameters(const Parameters& parameters);

private:
  // As given: the shape may be one of the balls.
  const Vec3 point1_;
  const Vec3 point2_;
  const double radius1_;
  const double radius2_;
};

} // namespace hybridtree

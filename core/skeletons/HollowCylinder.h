// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/RoundKernels.h"
#include "core/skeletons/KernelSkeleton.h"
#include "core/skeletons/Meridian.h"

namespace hybridtree
{

/// A solid cylinder with a bore all through: a tube with a wall. Equal radii make a surface without
/// inside, an inner radius of 0 the full cylinder.
///
/// All around is nearest to a point of the axis in the bore; the queries then use one fixed side.
class HollowCylinderSkeleton final : public KernelSkeleton<HollowCylinderShape>
{
public:
  /// \param innerRadius 0 to outerRadius. \throws InvalidParameter otherwise, when the ends of the
  /// axis coincide, or when a number is not finite.
  HollowCylinderSkeleton(
    const Vec3& point1, const Vec3& point2, double outerRadius, double innerRadius);

  const Vec3& point1() const { return point1_; }
  const Vec3& point2() const { return point2_; }
  double outerRadius() const { return shape_.outer; }
  double innerRadius() const { return shape_.inner; }

  double distanceCost() const override { return kClosedForm; }
  Interval distanceRange(const Box3& box) const override;
  Box3 bounds() const override;
  double reach() const override { return shape_.inner > 0.0 ? shape_.inner : kConvex; }
  /// An offset below the inner radius leaves the bore open. From there on the bore is filled and a
  /// dimple remains in each end, pointed on the axis. With `offset` 0 the sharp solid. Thin walls
  /// shorten the edges, so that outside and inside keep apart.
  std::optional<TriangleMesh> offsetMesh(double offset, double edgeLength) const override;
  SkeletonPtr similarityImage(const Affine3& map, double scale) const override;
  const char* kind() const override { return "hollow_cylinder"; }
  /// "point1", "point2", "outer_radius", "inner_radius".
  Parameters parameters() const override;
  static SkeletonPtr fromParameters(const Parameters& parameters);

private:
  Meridian meridian(double offset) const;

  // As given: the frame of the shape is rounded.
  const Vec3 point1_;
  const Vec3 point2_;
};

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/skeletons/KernelSkeleton.h"

namespace hybridtree
{

/// A circle (the curve, not the disc); its offset surfaces are tori. A radius of 0 makes a point.
///
/// All of the circle is nearest to a point of its axis; the queries then use one fixed point of it.
class CircleSkeleton final : public KernelSkeleton<CircleShape>
{
public:
  /// \param normal of the plane, of any length but 0. \param radius >= 0.
  /// \throws InvalidParameter otherwise, or when a number is not finite.
  CircleSkeleton(const Vec3& center, const Vec3& normal, double radius);

  const Vec3& center() const { return shape_.center; }
  /// Unit length.
  const Vec3& normal() const { return shape_.normal; }
  double radius() const { return shape_.radius; }

  double distanceCost() const override { return kClosedForm; }
  Interval distanceRange(const Box3& box) const override;
  Box3 bounds() const override;
  double reach() const override { return shape_.radius > 0.0 ? shape_.radius : kConvex; }
  /// Empty from `offset` = radius() on, where the torus meets itself.
  std::optional<TriangleMesh> offsetMesh(double offset, double edgeLength) const override;
  SkeletonPtr similarityImage(const Affine3& map, double scale) const override;
  const char* kind() const override { return "circle"; }
  /// "center", "normal", "radius".
  Parameters parameters() const override;
  static SkeletonPtr fromParameters(const Parameters& parameters);
};

} // namespace hybridtree

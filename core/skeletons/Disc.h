// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/RoundKernels.h"
#include "core/skeletons/KernelSkeleton.h"

namespace hybridtree
{

/// A flat disc, a surface skeleton: its offset surfaces are plates with round rims. A radius of 0
/// makes a point.
class DiscSkeleton final : public KernelSkeleton<DiscShape>
{
public:
  /// \param normal of the plane, of any length but 0. \param radius >= 0.
  /// \throws InvalidParameter otherwise, or when a number is not finite.
  DiscSkeleton(const Vec3& center, const Vec3& normal, double radius);

  const Vec3& center() const { return shape_.frame.origin; }
  /// Unit length.
  const Vec3& normal() const { return shape_.frame.axis; }
  double radius() const { return shape_.radius; }

  double distanceCost() const override { return kClosedForm; }
  Interval distanceRange(const Box3& box) const override;
  Box3 bounds() const override;
  double reach() const override { return kConvex; }
  std::optional<TriangleMesh> offsetMesh(double offset, double edgeLength) const override;
  SkeletonPtr similarityImage(const Affine3& map, double scale) const override;
  const char* kind() const override { return "disc"; }
  /// "center", "normal", "radius".
  Parameters parameters() const override;
  static SkeletonPtr fromParameters(const Parameters& parameters);
};

} // namespace hybridtree

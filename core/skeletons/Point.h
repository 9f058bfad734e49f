// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/skeletons/KernelSkeleton.h"

namespace hybridtree
{

/// One point; its offset surfaces are spheres.
class PointSkeleton final : public KernelSkeleton<PointShape>
{
public:
  /// \throws InvalidParameter when the centre is not finite.
  explicit PointSkeleton(const Vec3& center);

  const Vec3& center() const { return shape_.center; }

  double distanceCost() const override { return kClosedForm; }
  Interval distanceRange(const Box3& box) const override;
  Box3 bounds() const override;
  double reach() const override { return kConvex; }
  std::optional<TriangleMesh> offsetMesh(double radius, double edgeLength) const override;
  SkeletonPtr similarityImage(const Affine3& map, double scale) const override;
  const char* kind() const override { return "point"; }
  /// "center".
  Parameters parameters() const override;
  static SkeletonPtr fromParameters(const Parameters& parameters);
};

} // namespace hybridtree

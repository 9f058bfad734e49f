// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/skeletons/KernelSkeleton.h"

namespace hybridtree
{

/// A straight segment; its offset surfaces are capsules. Two equal ends make a point.
class SegmentSkeleton final : public KernelSkeleton<SegmentShape>
{
public:
  /// \throws InvalidParameter when an end is not finite.
  SegmentSkeleton(const Vec3& a, const Vec3& b);

  const Vec3& a() const { return shape_.start; }
  const Vec3& b() const { return shape_.end; }

  double distanceCost() const override { return kClosedForm; }
  Interval distanceRange(const Box3& box) const override;
  Box3 bounds() const override;
  double reach() const override { return kConvex; }
  std::optional<TriangleMesh> offsetMesh(double radius, double edgeLength) const override;
  SkeletonPtr similarityImage(const Affine3& map, double scale) const override;
  const char* kind() const override { return "segment"; }
  /// "point1", "point2".
  Parameters parameters() const override;
  static SkeletonPtr fromParameters(const Parameters& parameters);
};

} // namespace hybridtree

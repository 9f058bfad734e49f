// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/skeletons/KernelSkeleton.h"

namespace hybridtree
{

/// A solid box, in any rotation; its offset surfaces are rounded boxes. Lengths of 0 make it a
/// rectangle, a segment or a point, which have no inside.
class BoxSkeleton final : public KernelSkeleton<BoxShape>
{
public:
  /// \param lengths full edge lengths along the columns of `rotation`, each >= 0.
  /// \param rotation orthonormal to 1e-9; a reflection is as good.
  /// \throws InvalidParameter otherwise, or when a number is not finite.
  BoxSkeleton(const Vec3& center, const Vec3& lengths, const Mat3& rotation = Mat3::Identity());

  const Vec3& center() const { return shape_.center; }
  Vec3 lengths() const { return 2.0 * shape_.half; }
  const Mat3& rotation() const { return shape_.axes; }

  double distanceCost() const override { return kClosedForm; }
  Interval distanceRange(const Box3& box) const override;
  Box3 bounds() const override;
  double reach() const override { return kConvex; }
  /// With radius 0 the sharp box, whose vertices on edges and corners share one mean normal.
  std::optional<TriangleMesh> offsetMesh(double radius, double edgeLength) const override;
  SkeletonPtr similarityImage(const Affine3& map, double scale) const override;
  const char* kind() const override { return "box"; }
  /// "center", "lengths", "rotation" (9 numbers, row by row).
  Parameters parameters() const override;
  static SkeletonPtr fromParameters(const Parameters& parameters);
};

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/EllipsoidKernels.h"
#include "core/skeletons/KernelSkeleton.h"

namespace hybridtree
{

/// A solid ellipsoid, in any rotation. Distances are Euclidean, so its offset surfaces are not
/// ellipsoids; a sphere under an affine map is the way to an ellipsoid with a field of its own
/// shape.
class EllipsoidSkeleton final : public KernelSkeleton<EllipsoidShape>
{
public:
  /// \param radii along the columns of `rotation`, each > 0, the largest at most 1e8 times the
  /// smallest. \param rotation orthonormal to 1e-9; a reflection is as good.
  /// \throws InvalidParameter otherwise, or when a number is not finite.
  EllipsoidSkeleton(const Vec3& center, const Vec3& radii, const Mat3& rotation = Mat3::Identity());

  const Vec3& center() const { return shape_.center; }
  const Vec3& radii() const { return radii_; }
  const Mat3& rotation() const { return rotation_; }

  double distanceCost() const override { return 0.05; }
  Interval distanceRange(const Box3& box) const override;
  Box3 bounds() const override;
  double reach() const override { return kConvex; }
  /// With radius 0 the ellipsoid itself.
  std::optional<TriangleMesh> offsetMesh(double radius, double edgeLength) const override;
  SkeletonPtr similarityImage(const Affine3& map, double scale) const override;
  const char* kind() const override { return "ellipsoid"; }
  /// "center", "radii", "rotation" (9 numbers, row by row).
  Parameters parameters() const override;
  static SkeletonPtr fromParameters(const Parameters& parameters);

private:
  // In the order given; the shape has the smallest last.
  Vec3 radii_;
  Mat3 rotation_;
};

} // namespace hybridtree

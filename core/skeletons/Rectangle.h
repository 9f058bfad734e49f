// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/skeletons/Plate.h"

namespace hybridtree
{

/// A rectangle, or any parallelogram, given as vtkPlaneSource has it: a corner and the two corners
/// beside it.
class RectangleSkeleton final : public PlateSkeleton
{
public:
  /// \throws InvalidParameter when a number is not finite or the corners are on one line.
  RectangleSkeleton(const Vec3& origin, const Vec3& point1, const Vec3& point2);

  const Vec3& origin() const { return origin_; }
  const Vec3& point1() const { return point1_; }
  const Vec3& point2() const { return point2_; }

  double reach() const override { return kConvex; }
  SkeletonPtr similarityImage(const Affine3& map, double scale) const override;
  const char* kind() const override { return "rectangle"; }
  /// "origin", "point1", "point2".
  Parameters parameters() const override;
  static SkeletonPtr fromParameters(const Parameters& parameters);

private:
  Vec3 origin_, point1_, point2_;
};

} // namespace hybridtree

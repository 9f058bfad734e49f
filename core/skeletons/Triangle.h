// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/skeletons/Plate.h"

namespace hybridtree
{

/// A triangle, the flat piece and not its outline.
class TriangleSkeleton final : public PlateSkeleton
{
public:
  /// \throws InvalidParameter when a number is not finite or the corners are on one line.
  TriangleSkeleton(const Vec3& point1, const Vec3& point2, const Vec3& point3);

  const Vec3& point1() const { return point1_; }
  const Vec3& point2() const { return point2_; }
  const Vec3& point3() const { return point3_; }

  double reach() const override { return kConvex; }
  SkeletonPtr similarityImage(const Affine3& map, double scale) const override;
  const char* kind() const override { return "triangle"; }
  /// "point1", "point2", "point3".
  Parameters parameters() const override;
  static SkeletonPtr fromParameters(const Parameters& parameters);

private:
  Vec3 point1_, point2_, point3_;
};

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/skeletons/Plate.h"

namespace hybridtree
{

/// The inside of a flat outline without holes, convex or not.
class PolygonSkeleton final : public PlateSkeleton
{
public:
  /// Most that a point may lie off the common plane, as a share of the diagonal of the points'
  /// bounds. The skeleton is flat all the same: points are projected onto the plane.
  static constexpr double kFlatness = 1e-4;

  /// \param points of the outline in order, either way around. The first may stand again at the
  /// end, and points may repeat and lie on a line with their neighbours.
  /// \throws InvalidParameter when fewer than 3 differ, a number is not finite, the outline meets
  /// itself or encloses nothing, or the points are not flat to kFlatness.
  explicit PolygonSkeleton(std::vector<Vec3> points);

  /// As given.
  const std::vector<Vec3>& points() const { return points_; }

  SkeletonPtr similarityImage(const Affine3& map, double scale) const override;
  const char* kind() const override { return "polygon"; }
  /// "points": x, y, z of one after the other.
  Parameters parameters() const override;
  static SkeletonPtr fromParameters(const Parameters& parameters);

private:
  std::vector<Vec3> points_;
};

/// The polygon through fewer of its points, as SimplifyCurve.h has it of `levelOfDetail`. An
/// outline that would then meet itself or have no area keeps them all. \throws InvalidParameter as
/// PolygonSkeleton, and for a level that is none.
SkeletonPtr makePolygon(std::vector<Vec3> points, int levelOfDetail);

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/CurveDistance.h"
#include "core/geometry/PlanarRegion.h"
#include "core/geometry/SplineCurve.h"
#include "core/skeletons/Skeleton.h"

namespace hybridtree
{

/// A profile curve in the half plane (distance from the axis, height along it), turned around the
/// axis.
struct RevolutionShape
{
  Vec3 origin = Vec3::Zero(); ///< where the height is 0
  Vec3 axis = Vec3::UnitZ();
  /// Points (radius, height, 0), radius >= 0. Between them a spline may swing over the axis; then
  /// both it and its image on this side are part of the surface.
  SplineCurve profile = {};
  /// The volume between profile and axis, closed at both ends by discs where they are off the axis,
  /// or what a closed profile encloses; otherwise the surface alone.
  bool solid = false;
};

/// Surface or solid of revolution. The distance is that to the profile in the half plane, exact
/// (CurveDistance); points of the axis have their nearest point in one fixed direction.
class RevolutionSkeleton final : public Skeleton
{
public:
  /// \throws InvalidParameter when a number is not finite, a radius negative, the axis 0, or a
  /// solid has fewer than two different profile points.
  explicit RevolutionSkeleton(RevolutionShape shape);

  const RevolutionShape& shape() const { return shape_; }

  void distance(PointBatch points, double* distance) const override;
  void distanceAndGradient(
    PointBatch points, double* distance, VectorBatch gradient) const override;
  void signedDistance(PointBatch points, double* distance) const override;

  double distanceCost() const override { return 0.1; }
  /// By the exact distance at the centre of the box, as for splines.
  Interval distanceRange(const Box3& box) const override;
  Box3 bounds() const override { return bounds_; }

  /// The revolved offset of the profile: arcs around its corners, trimmed where it turns inwards.
  /// No value where that meets itself (found on dense samples and on the rings), where a curved
  /// part turns inwards with a corner, and for sheets between two points of the axis.
  std::optional<TriangleMesh> offsetMesh(double radius, double edgeLength) const override;

  SkeletonPtr similarityImage(const Affine3& map, double scale) const override;
  const char* kind() const override { return "revolution"; }
  /// "origin", "axis", "points" (radius, height, 0 after each other), "spline", "closed" (as
  /// SplineSkeleton), "solid".
  Parameters parameters() const override;
  static SkeletonPtr fromParameters(const Parameters& parameters);

private:
  void offsets(PointBatch points, VectorBatch planar, double* signedDistance) const;

  RevolutionShape shape_;
  CurveDistance distance_; // to all that is drawn in the half plane
  PlanarRegion region_;    // empty for a sheet
  Vec3 side_;
  Box3 bounds_;
};

/// The spans that are drawn in the half plane: the profile, the closing lines of a solid, and
/// mirror images of what is beyond the axis.
std::vector<CubicSpan> drawnProfile(const RevolutionShape& shape);

/// As RevolutionSkeleton::offsetMesh(). \param side unit, across the axis.
std::optional<TriangleMesh> meshRevolution(const RevolutionShape& shape, const Vec3& side,
  double radius, double edgeLength, const CurveDistance& distance);

} // namespace hybridtree

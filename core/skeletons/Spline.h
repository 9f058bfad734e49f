// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/CurveDistance.h"
#include "core/geometry/SplineCurve.h"
#include "core/skeletons/Skeleton.h"

#include <memory>

namespace hybridtree
{

/// A cubic spline (SplineCurve); its offset surfaces are tubes with round ends.
///
/// With radii it is what balls sweep along the curve, so that offset surfaces may taper: the
/// distance is the least |p - c(t)| - s(t). Some s(t) may be below 0, where the curve is thinner
/// than the offset; the largest may not. The distance is the exact minimum over all spans
/// (CurveDistance). Inside of what the balls sweep the signed distance is that to the surface of
/// the deepest ball, which is that of the whole unless it overlaps itself.
///
/// makeSpline() makes them: short ones are their numbers and little else, since hundreds are to fit
/// into one small tree ([HT] 6.3).
class SplineSkeleton : public Skeleton
{
public:
  SplineCurve curve() const;

  void distance(PointBatch points, double* distance) const final;
  void distanceAndGradient(PointBatch points, double* distance, VectorBatch gradient) const final;
  void signedDistance(PointBatch points, double* distance) const final;
  void addFalloff(PointBatch points, const Falloff& falloff, double* sum) const final;

  double distanceCost() const final { return 0.22; }
  /// By the exact distance at the centre of the box. Above it is exact to first order, below it
  /// falls with the diagonal.
  Interval distanceRange(const Box3& box) const final;
  Box3 bounds() const final;

  /// Swept from rings with rotation-minimising frames, with round ends. No value where the surface
  /// meets itself: the curvature radius falls to `radius` (and the radius of the curve), or two
  /// parts of the curve come nearer than twice that; found by bounds, so also in some cases close
  /// to that.
  std::optional<TriangleMesh> offsetMesh(double radius, double edgeLength) const final;

  SkeletonPtr similarityImage(const Affine3& map, double scale) const final;
  const char* kind() const final { return "spline"; }
  /// "points" (x, y, z after each other), "spline" ("catmullRom", "bSpline" or "polyline"),
  /// "closed", and "radii" where there are any.
  Parameters parameters() const final;
  static SkeletonPtr fromParameters(const Parameters& parameters);

private:
  /// The curve, into memory that is used again.
  virtual void read(SplineCurve& curve) const = 0;
  /// What its distance needs. That of a short curve lasts until this thread asks another one.
  virtual const CurveDistance& prepared() const = 0;

  void reachedDistance(PointBatch points, double* distance, double reach) const;
};

using SplinePtr = std::shared_ptr<const SplineSkeleton>;

/// Points that repeat the one before are dropped where the curve goes through them.
/// \throws InvalidParameter when there are no points, a number is not finite, all radii are
/// negative, or the numbers of points and radii differ.
SplinePtr makeSpline(SplineCurve curve);

///@{
/// The curve as parameters, and back. \throws InvalidText, InvalidParameter.
void describeCurve(const SplineCurve& curve, Parameters& parameters);
SplineCurve curveFrom(const Parameters& parameters);
///@}

/// The curve without such repeats. \throws InvalidParameter as makeSpline().
SplineCurve requireCurve(SplineCurve curve);

} // namespace hybridtree

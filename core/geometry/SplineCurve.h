// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/CubicSpan.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

enum class SplineKind : std::uint8_t
{
  /// Through the points, with centripetal parameters (knot distance = square root of the chord):
  /// unlike the uniform one it has neither cusps nor loops within a span, however unevenly the
  /// points lie (Yuksel, Schaefer, Keyser 2011). Once continuously differentiable. Open ends go on
  /// as the parabola through the last three points.
  CatmullRom,
  /// Uniform cubic B-spline near the points: twice continuously differentiable. Open: clamped, so
  /// that it reaches its first and last point; of degree 2 or 1 for three or two points.
  BSpline,
  /// Straight from point to point.
  Polyline
};

/// A curve given by points, each with a radius where `radii` is not empty.
///
/// A single point is a curve without length. Closed curves need three points; with fewer they are
/// open. Radii along a span stay between those of its ends (Catmull-Rom) or control points.
struct SplineCurve
{
  std::vector<Vec3> points = {};
  std::vector<double> radii = {}; ///< empty, or one per point
  SplineKind kind = SplineKind::CatmullRom;
  bool closed = false;

  ThickPoint point(std::size_t k) const { return { points[k], radii.empty() ? 0.0 : radii[k] }; }
  bool isClosed() const { return closed && points.size() > 2; }
};

/// Replaces `spans` by the cubics of the curve, joined bit for bit. \pre one point or more; no two
/// successive points of a Catmull-Rom curve are equal (withoutRepeats()).
void splineSpans(const SplineCurve& curve, std::vector<CubicSpan>& spans);

/// How many cubics that makes.
std::size_t splineSpanCount(const SplineCurve& curve);

/// The curve without points that repeat the one before (or, closed, the first): a repeat adds
/// nothing to a curve through its points. Control points of a B-spline stay, where it does. Of
/// repeats with different radii the largest stays.
SplineCurve withoutRepeats(SplineCurve curve);

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <array>

namespace hybridtree
{

/// Outside of it an element is beyond its reach.
struct ElementBall
{
  Vec3 center;
  double squaredRadius;
};

/// The elements that fields are integrated over, prepared for the kernels, and what they measure.
///
/// R is the reach of the kernel, linear over an element. [SUB] 3.3 takes it constant (the mean of
/// the corners), which jumps between elements; a constant R is the case slope = 0.
///
/// The measure is not the arclength ds, as in [SUB], but sqrt(R_p^2 + slope^2 h^2) / R^2 ds, R_p
/// being R (linear, extrapolated) at the point's projection onto the line of the element and h its
/// distance from that line; on triangles d^2q replaces ds and R^3 replaces R^2. With slope 0 this
/// is ds / R, so fields do not change with the scale of the model. With a slope it is the measure
/// that makes the integral a polynomial: substituting y(s) = (R_p (s - x) - slope h^2) /
/// (R(s) sqrt(R_p^2 + slope^2 h^2)) turns 1 - d^2/R^2 into Q - y^2, Q = 1 - h^2 / (R_p^2 + slope^2
/// h^2). It is additive, so the pieces of an element have together the field of the whole; and a
/// long cone has the field T exactly on the envelope of its balls of radius R / influenceRatio.
///@{
struct SegmentElement
{
  Vec3 start;
  Vec3 direction;      ///< unit
  double length;       ///< > 0
  double startReach;   ///< R at the start
  double slope;        ///< dR/ds
  double inverseStart; ///< 1/R at the start
  double inverseEnd;   ///< 1/R at the end
  ElementBall ball;
};

struct TriangleElement
{
  Vec3 origin;                ///< first corner
  Mat3 axes;                  ///< orthonormal columns: the way R grows, across, normal
  std::array<double, 3> x, y; ///< corners in the plane of the first two axes, counter-clockwise
  /// Of the edges from each corner to the next, in that plane: unit, and 1 / length.
  std::array<double, 3> edgeX, edgeY, inverseLength;
  double originReach;            ///< R at the origin
  double slope;                  ///< >= 0
  std::array<double, 3> inverse; ///< 1/R at the corners
  ElementBall ball;
};
///@}

/// \pre different ends; reaches > 0.
SegmentElement makeSegmentElement(
  const Vec3& start, const Vec3& end, double startReach, double endReach);

/// \pre an area; reaches > 0.
TriangleElement makeTriangleElement(
  const std::array<Vec3, 3>& corners, const std::array<double, 3>& reaches);

} // namespace hybridtree

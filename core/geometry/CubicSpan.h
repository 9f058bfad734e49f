// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <array>

namespace hybridtree
{

/// A point of a thick curve: position and radius. A negative radius stands for a point that is
/// farther than it is: by so much.
struct ThickPoint
{
  Vec3 at = Vec3::Zero();
  double radius = 0.0;
};

inline ThickPoint operator+(const ThickPoint& a, const ThickPoint& b)
{
  return { a.at + b.at, a.radius + b.radius };
}
inline ThickPoint operator-(const ThickPoint& a, const ThickPoint& b)
{
  return { a.at - b.at, a.radius - b.radius };
}
inline ThickPoint operator*(double s, const ThickPoint& a)
{
  return { s * a.at, s * a.radius };
}

/// One cubic c(t), t in [0, 1], in Bezier form, with a radius that is a cubic too: the balls of
/// radius s(t) around c(t). Most curves have s = 0.
struct CubicSpan
{
  std::array<ThickPoint, 4> control;

  ThickPoint at(double t) const;
  /// First and second derivative by t.
  ThickPoint slope(double t) const;
  ThickPoint bend(double t) const;

  /// The part over [from, to] as a span of its own.
  CubicSpan part(double from, double to) const;

  /// Least and greatest coordinate of a ball, axis by axis; of the points themselves. Negative
  /// radii may turn the former around.
  Box3 ballBounds() const;
  Box3 bounds() const;

  bool thick() const;
};

/// A span with what each distance query needs of it, made once per batch or once for all.
///
/// q(t) = (c(t) - p) . c'(t), half the derivative of the squared distance, is a quintic that is
/// linear in p: its coefficients are constants minus those of p . c'(t). With a radius it is
/// (c(t) - p) . c'(t) - (u + s(t)) s'(t), and linear in the distance u, too.
struct PreparedSpan
{
  explicit PreparedSpan(const CubicSpan& span);

  Vec3 origin;                       ///< first control point; all that follows is relative to it
  std::array<Vec3, 4> power;         ///< coefficients of c(t), of 1, t, t^2, t^3
  std::array<Vec3, 3> tangent;       ///< Bernstein coefficients of c'(t)
  std::array<double, 6> self;        ///< Bernstein coefficients of c . c' - s s'
  std::array<double, 6> selfPower;   ///< of 1, t, ... t^5
  std::array<double, 4> radius;      ///< Bernstein coefficients of s(t)
  std::array<double, 4> radiusPower; ///< of 1, t, t^2, t^3
  std::array<double, 3> widening;    ///< Bernstein coefficients of s'(t)
  Box3 box;                          ///< bounds of c(t)
  double largestRadius;
  bool thick;

  /// Quadratic Bernstein coefficients to quintic ones: a quintic's k-th is the sum of row k.
  static constexpr double kElevation[6][3] = { { 1.0, 0.0, 0.0 }, { 0.6, 0.4, 0.0 },
    { 0.3, 0.6, 0.1 }, { 0.1, 0.6, 0.3 }, { 0.0, 0.4, 0.6 }, { 0.0, 0.0, 1.0 } };

  Vec3 at(double t) const { return power[0] + t * (power[1] + t * (power[2] + t * power[3])); }
  double radiusAt(double t) const;
};

/// The t in [0, 1] at which c(t) is nearest to p (thin spans). \param local p - span.origin.
///
/// Real roots of q by Bernstein subdivision: a part whose coefficients change sign once has one
/// root, which Newton's method finds in its bracket; parts with more changes are halved, down to
/// widths (2^-40) where q is 0 to rounding. So no minimum is missed (Sederberg and Nishita 1990).
double nearestParameter(const PreparedSpan& span, const Vec3& local);

/// The least |p - c(t)| - s(t) over the span, and its t. \param local p - span.origin.
///
/// t beats a value u where D(t) - (u + s(t))^2 < 0, a sextic whose minimum is found as above; the
/// sequence of such u falls to the minimum, faster than linearly (Dinkelbach 1967). A negative
/// result means that p is inside.
double leastThickDistance(const PreparedSpan& span, const Vec3& local, double& t);

} // namespace hybridtree

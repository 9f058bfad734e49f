// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/SplineCurve.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

CubicSpan line(const ThickPoint& a, const ThickPoint& b)
{
  const ThickPoint third = (1.0 / 3.0) * (b - a);
  return { { a, a + third, b - third, b } };
}

// The slope of the radius at a point, made such that no span leaves the range of its ends: 0 at an
// extreme, at most three times that of either chord (Fritsch and Carlson 1980).
double monotoneSlope(double slope, double before, double after)
{
  if (before * after <= 0.0)
  {
    return 0.0;
  }
  const double most = 3.0 * std::min(std::abs(before), std::abs(after));
  return std::copysign(std::clamp(std::copysign(1.0, before) * slope, 0.0, most), before);
}

class CatmullRom
{
public:
  explicit CatmullRom(const SplineCurve& curve)
    : curve_(curve), count_(curve.points.size()), closed_(curve.isClosed())
  {
  }

  CubicSpan span(std::size_t k) const
  {
    const ThickPoint a = curve_.point(k);
    const ThickPoint b = curve_.point((k + 1) % count_);
    const double third = this->knots(k) / 3.0;
    return { { a, a + third * this->tangent(k), b - third * this->tangent(k + 1), b } };
  }

private:
  double knots(std::size_t k) const
  {
    return std::sqrt((curve_.points[(k + 1) % count_] - curve_.points[k]).norm());
  }
  ThickPoint chordSlope(std::size_t k) const
  {
    return (1.0 / this->knots(k)) * (curve_.point((k + 1) % count_) - curve_.point(k));
  }
  // Derivative at point k of the parabola through it and its neighbours.
  ThickPoint inner(std::size_t before, std::size_t after) const
  {
    const double a = this->knots(before);
    const double b = this->knots(after);
    const ThickPoint in = this->chordSlope(before);
    const ThickPoint out = this->chordSlope(after);
    ThickPoint slope = (b / (a + b)) * in + (a / (a + b)) * out;
    slope.radius = monotoneSlope(slope.radius, in.radius, out.radius);
    return slope;
  }
  // At an end, from the chord beside it and the slope at the next point.
  ThickPoint outer(std::size_t chord, const ThickPoint& next) const
  {
    const ThickPoint along = this->chordSlope(chord);
    ThickPoint slope = 2.0 * along - next;
    slope.radius = monotoneSlope(slope.radius, along.radius, along.radius);
    return slope;
  }
  ThickPoint tangent(std::size_t k) const
  {
    if (closed_)
    {
      return this->inner((k + count_ - 1) % count_, k % count_);
    }
    if (count_ == 2)
    {
      return this->chordSlope(0);
    }
    if (k == 0)
    {
      return this->outer(0, this->inner(0, 1));
    }
    if (k == count_ - 1)
    {
      return this->outer(k - 1, this->inner(k - 2, k - 1));
    }
    return this->inner(k - 1, k);
  }

  const SplineCurve& curve_;
  std::size_t count_;
  bool closed_;
};

CubicSpan periodicBSpline(const SplineCurve& curve, std::size_t k)
{
  const std::size_t n = curve.points.size();
  const ThickPoint a = curve.point(k);
  const ThickPoint b = curve.point((k + 1) % n);
  const ThickPoint c = curve.point((k + 2) % n);
  const ThickPoint d = curve.point((k + 3) % n);
  return { { (1.0 / 6.0) * (a + 4.0 * b + c), (1.0 / 3.0) * (2.0 * b + c),
    (1.0 / 3.0) * (b + 2.0 * c), (1.0 / 6.0) * (b + 4.0 * c + d) } };
}

// Span k of the clamped B-spline: its Bezier points are values of the polar form (de Boor).
CubicSpan clampedBSpline(const SplineCurve& curve, std::size_t k)
{
  const auto last = static_cast<double>(curve.points.size() - 3); // largest knot
  const auto knot = [&](std::size_t index)
  { return std::clamp(static_cast<double>(index) - 3.0, 0.0, last); };
  const auto polar = [&](double u, double v, double w)
  {
    std::array<ThickPoint, 4> p;
    for (std::size_t i = 0; i < 4; ++i)
    {
      p[i] = curve.point(k + i);
    }
    const std::array<double, 3> at = { u, v, w };
    for (std::size_t round = 1; round < 4; ++round)
    {
      for (std::size_t i = 0; i + round < 4; ++i)
      {
        const double from = knot(k + i + round);
        const double to = knot(k + i + 4);
        const double share = (at[round - 1] - from) / (to - from);
        p[i] = (1.0 - share) * p[i] + share * p[i + 1];
      }
    }
    return p[0];
  };
  const auto a = static_cast<double>(k);
  const double b = a + 1.0;
  return { { polar(a, a, a), polar(a, a, b), polar(a, b, b), polar(b, b, b) } };
}

// With three points or fewer.
CubicSpan shortBSpline(const SplineCurve& curve)
{
  const ThickPoint a = curve.point(0);
  const ThickPoint b = curve.point(1);
  if (curve.points.size() == 2)
  {
    return line(a, b);
  }
  const ThickPoint c = curve.point(2);
  return { { a, (1.0 / 3.0) * (a + 2.0 * b), (1.0 / 3.0) * (2.0 * b + c), c } };
}

CubicSpan spanOf(const SplineCurve& curve, std::size_t k)
{
  const std::size_t n = curve.points.size();
  switch (curve.kind)
  {
    case SplineKind::CatmullRom:
      return CatmullRom(curve).span(k);
    case SplineKind::Polyline:
      return line(curve.point(k), curve.point((k + 1) % n));
    default:
      return curve.isClosed() ? periodicBSpline(curve, k)
                              : (n < 4 ? shortBSpline(curve) : clampedBSpline(curve, k));
  }
}

} // namespace

std::size_t splineSpanCount(const SplineCurve& curve)
{
  const std::size_t n = curve.points.size();
  if (curve.isClosed())
  {
    return n;
  }
  const std::size_t fewer = curve.kind == SplineKind::BSpline ? 3 : 1;
  return n > fewer ? n - fewer : 1;
}

void splineSpans(const SplineCurve& curve, std::vector<CubicSpan>& spans)
{
  spans.clear();
  if (curve.points.size() == 1)
  {
    const ThickPoint point = curve.point(0);
    spans.push_back({ { point, point, point, point } });
    return;
  }
  const std::size_t count = splineSpanCount(curve);
  for (std::size_t k = 0; k < count; ++k)
  {
    spans.push_back(spanOf(curve, k));
    if (k > 0)
    {
      spans[k].control[0] = spans[k - 1].control[3];
    }
  }
  if (curve.isClosed())
  {
    spans.back().control[3] = spans.front().control[0];
  }
}

SplineCurve withoutRepeats(SplineCurve curve)
{
  if (curve.kind == SplineKind::BSpline)
  {
    return curve;
  }
  SplineCurve result;
  result.kind = curve.kind;
  result.closed = curve.closed;
  const auto merge = [&](std::size_t into, std::size_t from)
  {
    if (!curve.radii.empty())
    {
      result.radii[into] = std::max(result.radii[into], curve.radii[from]);
    }
  };
  for (std::size_t k = 0; k < curve.points.size(); ++k)
  {
    if (!result.points.empty() && result.points.back() == curve.points[k])
    {
      merge(result.points.size() - 1, k);
      continue;
    }
    result.points.push_back(curve.points[k]);
    if (!curve.radii.empty())
    {
      result.radii.push_back(curve.radii[k]);
    }
  }
  if (curve.closed && result.points.size() > 1 && result.points.back() == result.points.front())
  {
    merge(0, curve.points.size() - 1);
    result.points.pop_back();
    if (!curve.radii.empty())
    {
      result.radii.pop_back();
    }
  }
  return result;
}

} // namespace hybridtree

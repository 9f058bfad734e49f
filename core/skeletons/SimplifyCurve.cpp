// SPDX-License-Identifier: BSD-3-Clause
#include "core/skeletons/SimplifyCurve.h"

#include "core/base/Error.h"
#include "core/geometry/CurveDistance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

double deviation(const SplineCurve& curve, std::size_t k, std::size_t from, std::size_t to)
{
  const ThickPoint a = curve.point(from);
  const ThickPoint edge = curve.point(to) - a;
  const ThickPoint p = curve.point(k) - a;
  const double squared = edge.at.squaredNorm() + edge.radius * edge.radius;
  const double t = squared > 0.0
    ? std::clamp((p.at.dot(edge.at) + p.radius * edge.radius) / squared, 0.0, 1.0)
    : 0.0;
  const ThickPoint off = p - t * edge;
  return off.at.norm() + std::abs(off.radius);
}

// Marks the points between two kept ones that deviate from their chord by more than `allowed`.
void keepWhereNeeded(const SplineCurve& curve, std::size_t from, std::size_t to, double allowed,
  std::vector<bool>& kept)
{
  std::vector<std::pair<std::size_t, std::size_t>> parts{ { from, to } };
  while (!parts.empty())
  {
    const auto [first, last] = parts.back();
    parts.pop_back();
    double most = allowed;
    std::size_t farthest = first;
    for (std::size_t k = first + 1; k < last; ++k)
    {
      const double here = deviation(curve, k, first, last);
      if (here > most)
      {
        most = here;
        farthest = k;
      }
    }
    if (farthest != first)
    {
      kept[farthest] = true;
      parts.emplace_back(first, farthest);
      parts.emplace_back(farthest, last);
    }
  }
}

SplineCurve withPoints(const SplineCurve& curve, const std::vector<bool>& kept)
{
  SplineCurve result;
  result.kind = curve.kind;
  result.closed = curve.closed;
  for (std::size_t k = 0; k < kept.size(); ++k)
  {
    if (kept[k])
    {
      result.points.push_back(curve.points[k]);
      if (!curve.radii.empty())
      {
        result.radii.push_back(curve.radii[k]);
      }
    }
  }
  return result;
}

// Whether no point of one curve is farther than `tolerance` from the other.
bool liesWithin(const std::vector<CubicSpan>& spans, const CurveDistance& other, double tolerance)
{
  constexpr int kSamples = 16;
  std::vector<double> x, y, z;
  std::vector<double> own;
  double gap = 0.0;
  for (const CubicSpan& span : spans)
  {
    ThickPoint before = span.at(0.0);
    for (int k = 0; k <= kSamples; ++k)
    {
      const ThickPoint here = span.at(double(k) / kSamples);
      x.push_back(here.at.x());
      y.push_back(here.at.y());
      z.push_back(here.at.z());
      own.push_back(here.radius);
      gap = std::max(gap, (here.at - before.at).norm() + std::abs(here.radius - before.radius));
      before = here;
    }
  }
  std::vector<double> u(x.size()), v(x.size()), w(x.size()), radius(x.size());
  other.offsets({ x.data(), y.data(), z.data(), x.size() }, { u.data(), v.data(), w.data() },
    radius.data(), std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < x.size(); ++k)
  {
    const double off = Vec3(u[k], v[k], w[k]).norm() + std::abs(own[k] - radius[k]);
    // Between samples the deviation changes by a fraction of their gap.
    if (!(off + std::min(0.1 * gap, 0.1 * tolerance) <= tolerance))
    {
      return false;
    }
  }
  return true;
}

} // namespace

SplineCurve simplified(const SplineCurve& curve, double tolerance)
{
  const std::size_t count = curve.points.size();
  if (!(tolerance > 0.0) || count < 3)
  {
    return curve;
  }
  std::vector<CubicSpan> spans;
  splineSpans(curve, spans);
  const CurveDistance full(spans);
  for (double allowed = 8.0 * tolerance; allowed > 0.02 * tolerance; allowed *= 0.6)
  {
    std::vector<bool> kept(count, false);
    kept.front() = true;
    kept.back() = true;
    if (curve.isClosed())
    {
      kept[count / 3] = true;
      kept[2 * count / 3] = true;
    }
    std::size_t from = 0;
    for (std::size_t k = 1; k < count; ++k)
    {
      if (kept[k])
      {
        keepWhereNeeded(curve, from, k, allowed, kept);
        from = k;
      }
    }
    const SplineCurve fewer = withPoints(curve, kept);
    if (fewer.points.size() == count)
    {
      break;
    }
    std::vector<CubicSpan> fewerSpans;
    splineSpans(fewer, fewerSpans);
    if (liesWithin(spans, CurveDistance(fewerSpans), tolerance) &&
      liesWithin(fewerSpans, full, tolerance))
    {
      return fewer;
    }
  }
  return curve;
}

double detailTolerance(const Box3& bounds, int level)
{
  if (level < 0 || level > kExactDetail)
  {
    throw InvalidParameter("LevelOfDetail", level, "from 0 to 4");
  }
  return level == kExactDetail ? 0.0 : 0.02 * std::pow(0.5, level) * bounds.diagonal().norm();
}

double detailTolerance(const SplineCurve& curve, int level)
{
  Box3 bounds;
  for (const Vec3& point : curve.points)
  {
    bounds.extend(point);
  }
  return detailTolerance(bounds, level);
}

} // namespace hybridtree

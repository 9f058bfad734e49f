// SPDX-License-Identifier: BSD-3-Clause
#include "core/geometry/CurveDistance.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

// Few enough that the box of points that come in order is small.
constexpr std::size_t kSlice = 64;

// Bounds are computed with rounding of this order: what they leave out is farther by more.
constexpr double kSlack = 1e-13;

double squaredFarthest(const Box3& box, const Vec3& p)
{
  return (box.max() - p).cwiseAbs().cwiseMax((box.min() - p).cwiseAbs()).squaredNorm();
}

} // namespace

void CurveDistance::assign(const std::vector<CubicSpan>& spans)
{
  spans_.clear();
  spans_.reserve(spans.size());
  bounds_.setEmpty();
  thick_ = false;
  Box3 centers;
  for (const CubicSpan& span : spans)
  {
    spans_.emplace_back(span);
    const Box3 balls = span.ballBounds();
    bounds_.min() = bounds_.min().cwiseMin(balls.min());
    bounds_.max() = bounds_.max().cwiseMax(balls.max());
    centers.extend(spans_.back().box);
    thick_ = thick_ || spans_.back().thick;
  }
  // Where radii are negative throughout, the two have changed sides.
  const Vec3 low = bounds_.min().cwiseMin(bounds_.max());
  bounds_.max() = bounds_.min().cwiseMax(bounds_.max());
  bounds_.min() = low;
  size_ = centers.min().cwiseAbs().cwiseMax(centers.max().cwiseAbs()).norm();
}

void CurveDistance::offsets(
  PointBatch points, VectorBatch offset, double* radius, double reach) const
{
  for (std::size_t begin = 0; begin < points.size; begin += kSlice)
  {
    this->slice(points.slice(begin, std::min(kSlice, points.size - begin)), offset.slice(begin),
      radius ? radius + begin : nullptr, reach);
  }
}

void CurveDistance::slice(PointBatch points, VectorBatch offset, double* radius, double reach) const
{
  Box3 box;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    box.extend(points[k]);
  }
  const double size = size_ + box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).norm();
  const double slack = kSlack * size;
  // Each span's first ball is one of the curve, whose farthest distance bounds the nearest.
  double most = reach;
  for (const PreparedSpan& span : spans_)
  {
    most = std::min(most, std::sqrt(squaredFarthest(box, span.origin)) - span.radius[0]);
  }
  const double limit = most + slack;
  thread_local std::vector<const PreparedSpan*> near;
  thread_local std::vector<std::pair<double, const PreparedSpan*>> ordered;
  ordered.clear();
  near.clear();
  for (const PreparedSpan& span : spans_)
  {
    const double least = std::sqrt(box.squaredExteriorDistance(span.box)) - span.largestRadius;
    if (least <= limit)
    {
      ordered.emplace_back(least, &span);
    }
  }
  if (ordered.empty())
  {
    std::fill_n(offset.x, points.size, 2.0 * (reach + size));
    std::fill_n(offset.y, points.size, 0.0);
    std::fill_n(offset.z, points.size, 0.0);
    if (radius)
    {
      std::fill_n(radius, points.size, 0.0);
    }
    return;
  }
  std::stable_sort(
    ordered.begin(), ordered.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& item : ordered)
  {
    near.push_back(item.second);
  }
  if (thick_)
  {
    nearestOnThickSpans(near.data(), near.size(), points, offset, radius);
    return;
  }
  nearestOnSpans(near.data(), near.size(), points, offset);
  if (radius)
  {
    std::fill_n(radius, points.size, 0.0);
  }
}

} // namespace hybridtree

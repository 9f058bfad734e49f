// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/CurvePath.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{

CurvePath::CurvePath(const CurvePiece& piece, const RefinedSkeleton& refined, int level)
  : closed_(piece.closed)
{
  const auto add = [&](std::int32_t point)
  {
    const Vec3& at = refined.points[point];
    length_.push_back(points_.empty() ? 0.0 : length_.back() + (at - points_.back()).norm());
    points_.push_back(at);
    radii_.push_back(refined.radii[point]);
  };
  add(piece.points.front());
  const std::int32_t parts = 1 << level;
  for (std::size_t k = 0; k < piece.segments.size(); ++k)
  {
    // The parts of a segment follow each other, from its first point to its second.
    const std::int32_t first = piece.segments[k] * parts;
    const bool forward = refined.segments[first][0] == piece.points[k];
    for (std::int32_t n = 0; n < parts; ++n)
    {
      elements_.push_back(piece.segments[k]);
      add(forward ? refined.segments[first + n][1] : refined.segments[first + parts - 1 - n][0]);
    }
  }
}

CurvePath::Place CurvePath::place(double s) const
{
  if (closed_)
  {
    s -= length() * std::floor(s / length());
  }
  const auto above = std::upper_bound(length_.begin() + 1, length_.end() - 1, s);
  const auto segment = std::size_t(above - length_.begin()) - 1;
  const double whole = length_[segment + 1] - length_[segment];
  return { segment, whole > 0.0 ? (s - length_[segment]) / whole : 0.0 };
}

Vec3 CurvePath::point(double s) const
{
  const Place at = place(s);
  return points_[at.segment] + at.share * (points_[at.segment + 1] - points_[at.segment]);
}

double CurvePath::radius(double s) const
{
  const Place at = place(s);
  return radii_[at.segment] +
    std::clamp(at.share, 0.0, 1.0) * (radii_[at.segment + 1] - radii_[at.segment]);
}

Vec3 CurvePath::tangent(double s, double reach) const
{
  const Vec3 chord = point(s + reach) - point(s - reach);
  if (chord.norm() > 1e-3 * reach)
  {
    return chord.normalized();
  }
  const Place at = place(s); // folded back upon itself
  return (points_[at.segment + 1] - points_[at.segment]).normalized();
}

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
// Levels of detail: fewer points, and surfaces no farther apart than the level says.
#include "core/skeletons/SimplifyCurve.h"

#include "core/skeletons/Spline.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree
{
namespace
{

using test::PointList;

SplineCurve wave(SplineKind kind, bool closed, bool thick)
{
  SplineCurve curve;
  curve.kind = kind;
  curve.closed = closed;
  const int count = 120;
  for (int k = 0; k < count; ++k)
  {
    const double turn = 2.0 * EIGEN_PI * k / count;
    curve.points.emplace_back(std::cos(turn) + 0.004 * std::cos(31.0 * turn),
      std::sin(turn) + 0.1 * std::sin(5.0 * turn), 0.2 * std::cos(3.0 * turn));
    if (thick)
    {
      curve.radii.push_back(0.05 + 0.03 * std::cos(4.0 * turn));
    }
  }
  return curve;
}

// Points of the surface at 0.1 from one curve: how far from that of the other?
double surfaceDistance(const SplineCurve& from, const SplineCurve& to)
{
  test::Random random(3);
  const SplinePtr source = makeSpline(from);
  const SplinePtr target = makeSpline(to);
  std::vector<CubicSpan> spans;
  splineSpans(from, spans);
  PointList points;
  for (const CubicSpan& span : spans)
  {
    for (int k = 0; k < 20; ++k)
    {
      const double t = random.unit();
      const Vec3 across = random.direction().cross(span.slope(t).at).normalized();
      points.add(span.at(t).at + (0.1 + span.at(t).radius) * across);
    }
  }
  std::vector<double> own(points.size()), other(points.size());
  source->signedDistance(points, own.data());
  target->signedDistance(points, other.data());
  double most = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    most = std::max(most, std::abs(own[k] - other[k]));
  }
  return most;
}

TEST(SimplifyCurve, SurfacesStayWithinTheToleranceOfTheLevel)
{
  for (const SplineKind kind :
    { SplineKind::CatmullRom, SplineKind::BSpline, SplineKind::Polyline })
  {
    for (const bool closed : { false, true })
    {
      for (const bool thick : { false, true })
      {
        const SplineCurve full = wave(kind, closed, thick);
        std::size_t before = 0;
        for (int level = 0; level <= kExactDetail; ++level)
        {
          const double tolerance = detailTolerance(full, level);
          const SplineCurve fewer = simplified(full, tolerance);
          EXPECT_GE(fewer.points.size(), before);
          before = fewer.points.size();
          EXPECT_LE(surfaceDistance(full, fewer), tolerance + 1e-12) << level;
          EXPECT_LE(surfaceDistance(fewer, full), tolerance + 1e-12) << level;
          EXPECT_EQ(fewer.radii.size(), thick ? fewer.points.size() : 0u);
          if (level == 0)
          {
            EXPECT_LE(fewer.points.size(), full.points.size() / 2);
          }
        }
        EXPECT_EQ(before, full.points.size()); // the last level is exact
      }
    }
  }
}

} // namespace
} // namespace hybridtree

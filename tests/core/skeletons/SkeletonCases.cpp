// SPDX-License-Identifier: BSD-3-Clause
#include "tests/core/skeletons/SkeletonCases.h"

#include "core/skeletons/Meridian.h"
#include "tests/core/skeletons/PlateCases.h"
#include "tests/core/skeletons/RoundCases.h"

#include <limits>

namespace hybridtree::test
{
namespace
{

SkeletonCase pointCase(Random& random)
{
  const Vec3 center = 2.0 * random.direction();
  return { "point", std::make_shared<PointSkeleton>(center), { center }, 0.0, nullptr };
}

SkeletonCase segmentCase(const Vec3& a, const Vec3& b)
{
  constexpr int kSamples = 4000;
  SkeletonCase result{ "segment", std::make_shared<SegmentSkeleton>(a, b), {}, 0.0, nullptr };
  for (int k = 0; k <= kSamples; ++k)
  {
    result.samples.push_back(a + (b - a) * (double(k) / kSamples));
  }
  result.cover = 0.5 * (b - a).norm() / kSamples;
  return result;
}

SkeletonCase circleCase(const Vec3& center, const Vec3& normal, double radius)
{
  constexpr int kSamples = 4000;
  SkeletonCase result{ "circle", std::make_shared<CircleSkeleton>(center, normal, radius), {}, 0.0,
    nullptr };
  const Vec3 unit = normal.normalized();
  const Mat3 frame = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), unit).toRotationMatrix();
  for (int k = 0; k < kSamples; ++k)
  {
    const double turn = 2.0 * EIGEN_PI * k / kSamples;
    result.samples.push_back(center + radius * (frame * Vec3(std::cos(turn), std::sin(turn), 0.0)));
  }
  result.cover = radius * EIGEN_PI / kSamples;
  return result;
}

SkeletonCase boxCase(const Vec3& center, const Vec3& lengths, const Mat3& rotation)
{
  constexpr int kSide = 50;
  SkeletonCase result{ "box", std::make_shared<BoxSkeleton>(center, lengths, rotation), {}, 0.0,
    nullptr };
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int i = 0; i <= kSide; ++i)
    {
      for (int j = 0; j <= kSide; ++j)
      {
        for (const double side : { -0.5, 0.5 })
        {
          Vec3 local;
          local[axis] = side;
          local[(axis + 1) % 3] = double(i) / kSide - 0.5;
          local[(axis + 2) % 3] = double(j) / kSide - 0.5;
          result.samples.push_back(center + rotation * local.cwiseProduct(lengths));
        }
      }
    }
  }
  result.cover = 0.5 * std::sqrt(2.0) * lengths.maxCoeff() / kSide;
  result.inside = [center, lengths, rotation](const Vec3& p)
  {
    const Vec3 local = rotation.transpose() * (p - center);
    return (local.cwiseAbs().array() < 0.5 * lengths.array()).all();
  };
  return result;
}

SkeletonCase splineCase(SplineCurve curve)
{
  constexpr int kSamples = 400; // per span
  std::vector<CubicSpan> spans;
  splineSpans(curve, spans);
  SkeletonCase result{ "spline", makeSpline(curve), {}, 0.0, nullptr };
  result.sharpRange = false;
  for (const CubicSpan& span : spans)
  {
    Vec3 before = span.control[0].at;
    for (int k = 0; k <= kSamples; ++k)
    {
      result.samples.push_back(span.at(double(k) / kSamples).at);
      // A little more than half the chord, for the curve between.
      result.cover = std::max(result.cover, 0.55 * (result.samples.back() - before).norm());
      before = result.samples.back();
    }
  }
  return result;
}

// A profile away from the axis, from bottom to top: polygons of it are simple.
SplineCurve profileCurve(Random& random, SplineKind kind, bool toAxis)
{
  SplineCurve curve;
  curve.kind = kind;
  for (int k = 0; k < 5; ++k)
  {
    curve.points.emplace_back(random.uniform(0.3, 1.0), 0.4 * k - 0.8, 0.0);
  }
  if (toAxis)
  {
    curve.points.front().x() = 0.0;
    curve.points.back().x() = 0.0;
  }
  return curve;
}

SkeletonCase revolutionCase(Random& random, const SplineCurve& profile, bool solid)
{
  constexpr int kAlong = 60; // per span
  constexpr int kAround = 240;
  const RevolutionShape shape{ random.direction(), random.direction(), profile, solid };
  const bool corners = profile.kind == SplineKind::Polyline;
  SkeletonCase result{ corners ? "revolution with corners" : "revolution",
    std::make_shared<RevolutionSkeleton>(shape), {}, 0.0, nullptr };
  result.sharpRange = false;
  const Mat3 frame =
    Eigen::Quaterniond::FromTwoVectors(Vec3::UnitZ(), shape.axis).toRotationMatrix();
  std::vector<Vec2> polygon;
  double gap = 0.0;
  double widest = 0.0;
  for (const CubicSpan& span : drawnProfile(shape))
  {
    for (int k = 0; k <= kAlong; ++k)
    {
      const Vec3 p = span.at(double(k) / kAlong).at;
      if (k > 0)
      {
        gap = std::max(gap, (Vec2(p.x(), p.y()) - polygon.back()).norm());
      }
      polygon.emplace_back(p.x(), p.y());
      widest = std::max(widest, p.x());
      for (int turn = 0; turn < kAround; ++turn)
      {
        const double angle = 2.0 * EIGEN_PI * turn / kAround;
        result.samples.push_back(
          shape.origin + frame * Vec3(p.x() * std::cos(angle), p.x() * std::sin(angle), p.y()));
      }
    }
  }
  result.cover = std::hypot(0.55 * gap, EIGEN_PI * widest / kAround);
  if (solid)
  {
    // Even-odd rule over the sampled outline.
    result.inside = [polygon, shape](const Vec3& p)
    {
      const Vec3 local = p - shape.origin;
      const double y = shape.axis.dot(local);
      const double x = (local - y * shape.axis).norm();
      bool inside = false;
      for (std::size_t k = 0; k < polygon.size(); ++k)
      {
        const Vec2& a = polygon[k];
        const Vec2& b = polygon[(k + 1) % polygon.size()];
        if ((a.y() <= y) != (b.y() <= y) &&
          x < a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()))
        {
          inside = !inside;
        }
      }
      return inside;
    };
  }
  return result;
}

} // namespace

double distanceToSpans(const std::vector<CubicSpan>& spans, const Vec3& p)
{
  constexpr int kSamples = 500;
  double least = std::numeric_limits<double>::infinity();
  for (const CubicSpan& span : spans)
  {
    const auto at = [&](double t)
    {
      const ThickPoint c = span.at(t);
      return (p - c.at).norm() - c.radius;
    };
    for (int k = 0; k <= kSamples; ++k)
    {
      const double t = double(k) / kSamples;
      double low = std::max(0.0, t - 1.0 / kSamples);
      double high = std::min(1.0, t + 1.0 / kSamples);
      if (at(t) > at(low) || at(t) > at(high))
      {
        continue;
      }
      while (high - low > 1e-12)
      {
        const double third = (high - low) / 3.0;
        (at(low + third) < at(high - third) ? high : low) +=
          at(low + third) < at(high - third) ? -third : third;
      }
      least = std::min(least, at(0.5 * (low + high)));
    }
  }
  return least;
}

std::vector<Vec3> randomWalk(Random& random, int count)
{
  std::vector<Vec3> points{ random.direction() };
  while (points.size() < static_cast<std::size_t>(count))
  {
    points.push_back(points.back() + random.uniform(0.2, 0.8) * random.direction());
  }
  return points;
}

std::vector<SkeletonCase> skeletonCases()
{
  Random random(11);
  std::vector<SkeletonCase> cases;
  for (int round = 0; round < 3; ++round)
  {
    cases.push_back(pointCase(random));
    cases.push_back(segmentCase(random.direction(), 2.0 * random.direction()));
    cases.push_back(
      circleCase(random.direction(), 3.0 * random.direction(), random.uniform(0.3, 2.0)));
    const Vec3 lengths(
      random.uniform(0.2, 2.0), random.uniform(0.2, 2.0), random.uniform(0.2, 2.0));
    cases.push_back(boxCase(random.direction(), lengths, random.rotation()));
  }
  for (const SplineKind kind :
    { SplineKind::CatmullRom, SplineKind::BSpline, SplineKind::Polyline })
  {
    for (const bool closed : { false, true })
    {
      cases.push_back(splineCase({ randomWalk(random, 4), {}, kind, closed }));
      cases.push_back(splineCase({ randomWalk(random, 12), {}, kind, closed }));
    }
  }
  for (const SplineKind kind : { SplineKind::CatmullRom, SplineKind::Polyline })
  {
    for (const bool solid : { false, true })
    {
      cases.push_back(revolutionCase(random, profileCurve(random, kind, false), solid));
      cases.push_back(revolutionCase(random, profileCurve(random, kind, true), solid));
    }
  }
  const auto named = [&](SkeletonCase item, const char* name)
  {
    item.name = name;
    cases.push_back(std::move(item));
  };
  named(segmentCase(Vec3(1, 2, 3), Vec3(1, 2, 3)), "segment without length");
  named(circleCase(Vec3(1, 0, 0), Vec3(0, 1, 0), 0.0), "circle without radius");
  named(splineCase({ { Vec3(1, 2, 3) }, {}, SplineKind::CatmullRom, true }), "spline of a point");
  named(splineCase({ { Vec3(1, 2, 3), Vec3(1, 1, 3) }, {}, SplineKind::BSpline, true }),
    "spline of two points");
  named(splineCase({ randomWalk(random, 3), {}, SplineKind::BSpline, false }), "parabola");
  named(boxCase(Vec3(0, 1, 0), Vec3(1, 2, 0), random.rotation()), "rectangle");
  named(boxCase(Vec3(0, 1, 0), Vec3(1, 0, 0), random.rotation()), "box as segment");
  named(boxCase(Vec3(0, 1, 0), Vec3(0, 0, 0), random.rotation()), "box as point");
  Mat3 mirror = random.rotation();
  mirror.col(1) *= -1.0;
  named(boxCase(Vec3(0, 1, 0), Vec3(1, 2, 0.5), mirror), "mirrored box");
  for (const RoundCase& round : roundCases())
  {
    cases.push_back(withSamples(round));
  }
  for (const PlateCase& plate : plateCases())
  {
    cases.push_back(withSamples(plate));
  }
  for (SkeletonCase& ellipsoid : ellipsoidCases())
  {
    cases.push_back(std::move(ellipsoid));
  }
  return cases;
}

Affine3 randomSimilarity(Random& random, double scale)
{
  Affine3 map = Affine3::Identity();
  map.linear() = scale * random.rotation();
  if (random.chance(0.5))
  {
    map.linear().col(random.integer(0, 2)) *= -1.0;
  }
  map.translation() = 3.0 * random.direction();
  return map;
}

Affine3 randomAffine(Random& random)
{
  Affine3 map = Affine3::Identity();
  Vec3 stretch;
  for (double& value : stretch)
  {
    value = std::exp(random.uniform(std::log(0.3), std::log(3.0))) * (random.chance(0.3) ? -1 : 1);
  }
  map.linear() = random.rotation() * stretch.asDiagonal() * random.rotation();
  map.translation() = 2.0 * random.direction();
  return map;
}

} // namespace hybridtree::test

// SPDX-License-Identifier: BSD-3-Clause
// Splines: distance against brute force where it is hardest, curves against their definition, and
// the swept mesh.
#include "core/skeletons/Spline.h"

#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "core/skeletons/TubeClearance.h"
#include "tests/core/skeletons/SkeletonCases.h"
#include "tests/support/MeshShape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

using test::PointList;
using test::Random;
using test::randomWalk;
using test::VectorList;

std::vector<CubicSpan> spansOf(const SplineCurve& curve)
{
  std::vector<CubicSpan> spans;
  splineSpans(curve, spans);
  return spans;
}

std::vector<SplineCurve> hardCurves()
{
  Random random(41);
  std::vector<SplineCurve> curves;
  for (const SplineKind kind : { SplineKind::CatmullRom, SplineKind::BSpline })
  {
    for (int round = 0; round < 3; ++round)
    {
      curves.push_back({ randomWalk(random, 4 + 3 * round), {}, kind, round == 1 });
    }
    // Turning back on itself, long beside short, straight.
    curves.push_back(
      { { Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1e-3, 0), Vec3(1, 1e-3, 0) }, {}, kind, false });
    curves.push_back(
      { { Vec3(0, 0, 0), Vec3(1e-4, 0, 0), Vec3(3, 1, 0), Vec3(3, 1.001, 0) }, {}, kind, false });
    curves.push_back(
      { { Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(2, 2, 2), Vec3(5, 5, 5) }, {}, kind, false });
  }
  return curves;
}

TEST(Spline, DistanceIsThatOfBruteForce)
{
  Random random(42);
  for (const SplineCurve& curve : hardCurves())
  {
    const SplinePtr spline = makeSpline(curve);
    const std::vector<CubicSpan> spans = spansOf(curve);
    Box3 room = spline->bounds();
    room = Box3(Vec3(room.min().array() - 1.0), Vec3(room.max().array() + 1.0));
    PointList points = randomPoints(random, room, 60);
    // On centres of curvature q has a multiple root.
    for (const CubicSpan& span : spans)
    {
      const double t = random.unit();
      const Vec3 slope = span.slope(t).at;
      const Vec3 bend = span.bend(t).at;
      const Vec3 across = bend - slope.dot(bend) / slope.squaredNorm() * slope;
      if (across.norm() > 1e-6)
      {
        const Vec3 center = span.at(t).at + slope.squaredNorm() / across.squaredNorm() * across;
        points.add(center);
        points.add(span.at(t).at + 1e-7 * across);
      }
    }
    std::vector<double> distance(points.size());
    spline->distance(points, distance.data());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const double expected = test::distanceToSpans(spans, points[k]);
      EXPECT_NEAR(distance[k], expected, 1e-9 * expected + 1e-13)
        << points[k].transpose() << " kind " << int(curve.kind);
    }
  }
}

TEST(Spline, ThickDistanceIsThatToTheNearestBall)
{
  Random random(43);
  for (int round = 0; round < 8; ++round)
  {
    SplineCurve curve{ randomWalk(random, 3 + round), {},
      round % 2 ? SplineKind::BSpline : SplineKind::CatmullRom, round > 5 };
    for (std::size_t k = 0; k < curve.points.size(); ++k)
    {
      curve.radii.push_back(random.chance(0.2) ? 0.0 : random.uniform(-0.2, 0.4));
    }
    curve.radii[1] = 0.3;
    const SplinePtr spline = makeSpline(curve);
    const std::vector<CubicSpan> spans = spansOf(curve);
    const PointList points = randomPoints(random,
      Box3(Vec3(spline->bounds().min().array() - 0.5), Vec3(spline->bounds().max().array() + 0.5)),
      120);
    std::vector<double> distance(points.size()), signedDistance(points.size());
    VectorList gradient(points.size());
    spline->signedDistance(points, signedDistance.data());
    spline->distanceAndGradient(points, distance.data(), gradient);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const double expected = test::distanceToSpans(spans, points[k]);
      EXPECT_EQ(distance[k], std::max(0.0, signedDistance[k]));
      EXPECT_NEAR(distance[k], std::max(0.0, expected), 1e-9);
      EXPECT_EQ(signedDistance[k] < 0.0, expected < 0.0);
      EXPECT_NEAR(signedDistance[k], expected, 1e-9);
      if (distance[k] > 1e-3)
      {
        EXPECT_NEAR(gradient[k].norm(), 1.0, 1e-12);
        const Vec3 nearer = points[k] - 1e-3 * gradient[k];
        EXPECT_NEAR(test::distanceToSpans(spans, nearer), distance[k] - 1e-3, 1e-9);
      }
    }
  }
}

TEST(Spline, GoesThroughItsPointsOrReachesItsEnds)
{
  Random random(44);
  for (const bool closed : { false, true })
  {
    SplineCurve curve{ randomWalk(random, 9), {}, SplineKind::CatmullRom, closed };
    const SplinePtr through = makeSpline(curve);
    std::vector<double> distance(curve.points.size());
    through->distance(PointList(curve.points), distance.data());
    for (const double d : distance)
    {
      EXPECT_LE(d, 1e-13);
    }
    for (const SplineKind kind : { SplineKind::CatmullRom, SplineKind::BSpline })
    {
      curve.kind = kind;
      const std::vector<CubicSpan> spans = spansOf(curve);
      EXPECT_EQ(spans.size(), splineSpanCount(curve));
      for (std::size_t k = closed ? 0 : 1; k < spans.size(); ++k)
      {
        const CubicSpan& before = spans[(k + spans.size() - 1) % spans.size()];
        EXPECT_EQ(before.control[3].at, spans[k].control[0].at);
        // No corner.
        EXPECT_LE(
          (before.slope(1.0).at.normalized() - spans[k].slope(0.0).at.normalized()).norm(), 1e-12);
      }
    }
    if (!closed)
    {
      const std::vector<CubicSpan> spans = spansOf(curve);
      EXPECT_LE((spans.front().control[0].at - curve.points.front()).norm(), 1e-14);
      EXPECT_LE((spans.back().control[3].at - curve.points.back()).norm(), 1e-14);
    }
  }
}

TEST(Spline, RepeatedPointsAreOnePoint)
{
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(1, 1, 0);
  const SplinePtr clean = makeSpline({ { a, b, c }, {}, SplineKind::CatmullRom, true });
  const SplinePtr repeated =
    makeSpline({ { a, a, b, c, c, c, a }, {}, SplineKind::CatmullRom, true });
  EXPECT_EQ(repeated->parameters().entries(), clean->parameters().entries());
  const SplinePtr point = makeSpline({ { a, a, a }, {}, SplineKind::CatmullRom, true });
  EXPECT_EQ(point->curve().points.size(), 1u);
}

TEST(Spline, RadiiStayBetweenThoseOfTheirPoints)
{
  Random random(45);
  for (int round = 0; round < 20; ++round)
  {
    SplineCurve curve{ randomWalk(random, 6), {}, SplineKind::CatmullRom, round % 2 == 0 };
    for (int k = 0; k < 6; ++k)
    {
      curve.radii.push_back(random.chance(0.3) ? 0.0 : random.unit());
    }
    const std::vector<CubicSpan> spans = spansOf(curve);
    for (std::size_t k = 0; k < spans.size(); ++k)
    {
      const double a = curve.radii[k];
      const double b = curve.radii[(k + 1) % 6];
      for (double t = 0.0; t <= 1.0; t += 0.05)
      {
        EXPECT_GE(spans[k].at(t).radius, std::min(a, b) - 1e-14);
        EXPECT_LE(spans[k].at(t).radius, std::max(a, b) + 1e-14);
      }
    }
  }
}

SplineCurve helix(bool closed)
{
  SplineCurve curve;
  curve.closed = closed;
  for (int k = 0; k < 12; ++k)
  {
    const double turn = 2.0 * EIGEN_PI * k / 12.0;
    curve.points.emplace_back(
      std::cos(turn), std::sin(turn), closed ? 0.2 * std::sin(2.0 * turn) : 0.1 * k);
  }
  return curve;
}

TEST(Spline, SweptMeshIsClosedExactAndFine)
{
  for (const bool closed : { false, true })
  {
    for (const bool thick : { false, true })
    {
      SplineCurve curve = helix(closed);
      for (int k = 0; thick && k < 12; ++k)
      {
        curve.radii.push_back(0.03 + 0.03 * std::cos(0.5 * k * 2.0 * EIGEN_PI / 6.0));
      }
      const SplinePtr spline = makeSpline(curve);
      const double radius = 0.15;
      for (const double length : { 0.02, 0.07, 0.3, 100.0 })
      {
        const auto mesh = spline->offsetMesh(radius, length);
        ASSERT_TRUE(mesh) << "closed " << closed << " thick " << thick << " " << length;
        const MeshReport report = checkMesh(*mesh);
        EXPECT_TRUE(report.closedManifold()) << report.describe();
        EXPECT_EQ(report.genus(), closed ? 1 : 0);
        EXPECT_EQ(report.components, 1u);
        EXPECT_GT(signedVolume(*mesh), 0.0);
        const PointList points(mesh->points);
        std::vector<double> distance(points.size());
        VectorList gradient(points.size());
        spline->distanceAndGradient(points, distance.data(), gradient);
        for (std::size_t k = 0; k < points.size(); ++k)
        {
          EXPECT_NEAR(distance[k], radius, 1e-10);
          EXPECT_LE((mesh->normals[k] - gradient[k]).norm(), 1e-6);
        }
        const test::MeshShape shape = test::shapeOf(*mesh);
        EXPECT_LE(shape.longest, length * (1.0 + 1e-12));
        if (length < 0.1)
        {
          EXPECT_GE(shape.mean, 0.6 * length);
        }
      }
    }
  }
}

TEST(Spline, ATubesVolumeIsThatOfPappus)
{
  for (const bool closed : { false, true })
  {
    const SplineCurve curve = helix(closed);
    double length = 0.0;
    for (const CubicSpan& span : spansOf(curve))
    {
      for (int k = 0; k < 1000; ++k)
      {
        length += span.slope((k + 0.5) / 1000.0).at.norm() / 1000.0;
      }
    }
    const double r = 0.15;
    const double exact =
      EIGEN_PI * r * r * length + (closed ? 0.0 : 4.0 / 3.0 * EIGEN_PI * r * r * r);
    const SplinePtr spline = makeSpline(curve);
    const double coarse = signedVolume(*spline->offsetMesh(r, 0.04)) - exact;
    const double fine = signedVolume(*spline->offsetMesh(r, 0.01)) - exact;
    EXPECT_LE(std::abs(coarse), 0.03 * exact);
    EXPECT_LE(std::abs(fine), std::abs(coarse) / 8.0);
  }
}

TEST(Spline, TubesThatMeetThemselvesAreLeftToTheLattice)
{
  // A hairpin whose legs are 0.4 apart, and two loops of a helix 0.3 apart.
  const SplinePtr hairpin =
    makeSpline({ { Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 0.4, 0), Vec3(0, 0.4, 0) }, {},
      SplineKind::CatmullRom, false });
  EXPECT_FALSE(hairpin->offsetMesh(0.25, 0.1));
  EXPECT_TRUE(hairpin->offsetMesh(0.1, 0.1));
  SplineCurve coil;
  for (int k = 0; k < 24; ++k)
  {
    coil.points.emplace_back(
      std::cos(EIGEN_PI * k / 6.0), std::sin(EIGEN_PI * k / 6.0), 0.3 * k / 12.0);
  }
  EXPECT_FALSE(makeSpline(coil)->offsetMesh(0.155, 0.1));
  EXPECT_TRUE(makeSpline(coil)->offsetMesh(0.145, 0.1));
  // A corner.
  coil.kind = SplineKind::Polyline;
  EXPECT_FALSE(makeSpline(coil)->offsetMesh(0.05, 0.1));
}

TEST(Spline, ClearTubesDoNotMeetThemselves)
{
  // Where bounds say that a tube is clear, every point of its surface is as far from the curve as
  // from the point it belongs to.
  Random random(46);
  int clear[2] = { 0, 0 };
  for (int round = 0; round < 1000; ++round)
  {
    const bool thick = round % 3 != 0;
    SplineCurve curve{ randomWalk(random, 5), {},
      round % 5 ? SplineKind::CatmullRom : SplineKind::BSpline, round % 2 == 0 };
    for (std::size_t k = 0; thick && k < curve.points.size(); ++k)
    {
      curve.radii.push_back(random.chance(0.3) ? 0.0 : random.uniform(0.0, 0.25));
    }
    const std::vector<CubicSpan> spans = spansOf(curve);
    const double radius = random.uniform(0.01, 0.15);
    if (!tubeIsClear(spans, curve.closed, radius))
    {
      continue;
    }
    ++clear[thick];
    const SplinePtr spline = makeSpline(curve);
    PointList points;
    for (int k = 0; k < 200; ++k)
    {
      const CubicSpan& span = spans[std::size_t(random.integer(0, int(spans.size()) - 1))];
      const double t = random.unit();
      const ThickPoint slope = span.slope(t);
      const Vec3 along = slope.at.normalized();
      const Vec3 across = random.direction().cross(along).normalized();
      const double lean = -slope.radius / slope.at.norm();
      points.add(span.at(t).at +
        (radius + span.at(t).radius) * (std::sqrt(1.0 - lean * lean) * across + lean * along));
    }
    std::vector<double> distance(points.size());
    spline->distance(points, distance.data());
    for (const double d : distance)
    {
      EXPECT_NEAR(d, radius, 1e-12) << "round " << round;
    }
  }
  EXPECT_GT(clear[0], 5);
  EXPECT_GT(clear[1], 5);
}

TEST(Spline, BadValuesAreNamed)
{
  const auto message = [](SplineCurve curve) -> std::string
  {
    try
    {
      const SplinePtr spline = makeSpline(std::move(curve));
    }
    catch (const InvalidParameter& error)
    {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(message({}), "Points is empty; it must be one point or more.");
  EXPECT_EQ(message({ { Vec3(0, 0, 0), Vec3(0, std::nan(""), 0) } }),
    "Point 1 is (0 nan 0); it must be three finite numbers.");
  EXPECT_EQ(message({ { Vec3(0, 0, 0), Vec3(0, 1, 0) }, { -2.0, -1.0 } }),
    "The largest radius is -1; it must be 0 or more.");
  EXPECT_NE(message({ { Vec3(0, 0, 0), Vec3(0, 1, 0) }, { 1.0 } }).find("number of radii"),
    std::string::npos);
}

} // namespace
} // namespace hybridtree

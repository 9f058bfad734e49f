// SPDX-License-Identifier: BSD-3-Clause
// Skeletons of revolution against a search along their section, to the last digits.
#include "core/base/Error.h"
#include "tests/core/skeletons/RoundCases.h"

#include <gtest/gtest.h>

#include <limits>

namespace hybridtree
{
namespace
{

using test::PointList;
using test::Random;
using test::RoundCase;

// The least distance of a point of the half plane to one piece: the best of many steps, closed in
// on.
double distanceToPiece(
  const std::function<Eigen::Vector2d(double)>& piece, const Eigen::Vector2d& p)
{
  constexpr int kSteps = 400;
  int best = 0;
  const auto at = [&](double t) { return (piece(t) - p).norm(); };
  for (int k = 1; k <= kSteps; ++k)
  {
    best = at(double(k) / kSteps) < at(double(best) / kSteps) ? k : best;
  }
  double low = std::max(0.0, double(best - 1) / kSteps);
  double high = std::min(1.0, double(best + 1) / kSteps);
  double least = at(double(best) / kSteps);
  for (int round = 0; round < 60; ++round)
  {
    const double a = low + (high - low) / 3.0;
    const double b = high - (high - low) / 3.0;
    least = std::min({ least, at(a), at(b) });
    (at(a) < at(b) ? high : low) = at(a) < at(b) ? b : a;
  }
  return least;
}

double searched(const RoundCase& item, double radial, double height)
{
  double least = std::numeric_limits<double>::infinity();
  for (const auto& piece : item.pieces)
  {
    least = std::min(least, distanceToPiece(piece, Eigen::Vector2d(radial, height)));
  }
  return item.inside && item.inside(radial, height) ? -least : least;
}

// Points all around, and some at corners, on the axis and far away.
std::vector<Eigen::Vector2d> halfPlanePoints(const RoundCase& item, Random& random)
{
  std::vector<Eigen::Vector2d> points;
  for (int k = 0; k < 150; ++k)
  {
    points.emplace_back(random.uniform(0.0, 2.5), random.uniform(-2.0, 4.0));
    points.emplace_back(0.0, random.uniform(-2.0, 4.0));
    points.emplace_back(random.uniform(0.0, 1e4), random.uniform(-1e4, 1e4));
  }
  for (const auto& piece : item.pieces)
  {
    for (const double t : { 0.0, 0.5, 1.0 })
    {
      const double near = random.uniform(0.0, 1e-3);
      points.emplace_back(piece(t) + near * Eigen::Vector2d(1.0, random.uniform(-1.0, 1.0)));
    }
  }
  return points;
}

TEST(RoundSkeleton, DistanceIsExact)
{
  Random random(32);
  for (const RoundCase& item : test::roundCases())
  {
    const Vec3 u = item.axis.unitOrthogonal();
    const Vec3 v = item.axis.cross(u);
    for (const Eigen::Vector2d& place : halfPlanePoints(item, random))
    {
      const double turn = random.uniform(0.0, 6.3);
      const Vec3 p =
        item.origin + place.y() * item.axis + place.x() * (std::cos(turn) * u + std::sin(turn) * v);
      double distance, signedDistance;
      item.skeleton->distance(PointList({ p }), &distance);
      item.skeleton->signedDistance(PointList({ p }), &signedDistance);
      const double expected = searched(item, place.x(), place.y());
      // Coordinates are rounded themselves.
      const double allowed = 1e-9 * std::abs(expected) + 4e-15 * (1.0 + p.norm());
      EXPECT_NEAR(signedDistance, expected, allowed) << item.name << " at " << place.transpose();
      EXPECT_EQ(distance, std::max(0.0, signedDistance)) << item.name;
    }
  }
}

TEST(RoundSkeleton, OnTheAxisOfABoreOneNearestPointIsKept)
{
  Random random(33);
  for (int round = 0; round < 20; ++round)
  {
    const Vec3 start = random.direction();
    const Vec3 end = start + random.uniform(0.5, 2.0) * random.direction();
    const HollowCylinderSkeleton tube(start, end, 1.0, random.uniform(0.1, 0.9));
    const PointList points({ start + random.uniform(0.0, 1.0) * (end - start) });
    double distance;
    test::VectorList gradient(1), again(1);
    tube.distanceAndGradient(points, &distance, gradient);
    tube.distanceAndGradient(points, &distance, again);
    EXPECT_NEAR(distance, tube.innerRadius(), 1e-12);
    EXPECT_NEAR(gradient[0].norm(), 1.0, 1e-12);
    EXPECT_NEAR(gradient[0].dot(end - start), 0.0, 1e-12);
    EXPECT_EQ(gradient[0], again[0]);
  }
}

TEST(RoundSkeleton, BadValuesAreNamed)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vec3 zero = Vec3::Zero();
  const Vec3 one = Vec3::UnitX();
  const auto message = [](const auto& make) -> std::string
  {
    try
    {
      make();
    }
    catch (const InvalidParameter& error)
    {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(message([&] { DiscSkeleton(zero, zero, 1.0); }),
    "Normal is (0 0 0); it must be of a length other than 0, to give a direction.");
  EXPECT_EQ(message([&] { CylinderSkeleton(one, one, 1.0); }),
    "Point2 - Point1 is (0 0 0); it must be of a length other than 0, to give a direction.");
  EXPECT_EQ(message([&] { CylinderSkeleton(zero, one, -1.0); }),
    "Radius is -1; it must be a finite number >= 0.");
  EXPECT_EQ(message([&] { HollowCylinderSkeleton(zero, one, 1.0, 2.0); }),
    "InnerRadius is 2; it must be at most OuterRadius, which is 1.");
  EXPECT_EQ(message([&] { HollowCylinderSkeleton(zero, one, 1.0, nan); }),
    "InnerRadius is nan; it must be a finite number >= 0.");
  EXPECT_EQ(message([&] { ConeSkeleton(zero, one, 1.0, -2.0); }),
    "Radius2 is -2; it must be a finite number >= 0.");
  EXPECT_EQ(message([&] { ConeSphereSkeleton(Vec3(nan, 0, 0), one, 1.0, 2.0); }),
    "Point1 is (nan 0 0); it must be three finite numbers.");
}

} // namespace
} // namespace hybridtree

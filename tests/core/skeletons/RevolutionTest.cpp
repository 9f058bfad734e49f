// SPDX-License-Identifier: BSD-3-Clause
// Surfaces of revolution: the direct mesh against the distance and exact volumes, errors.
#include "core/skeletons/Revolution.h"

#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "tests/core/skeletons/SkeletonCases.h"
#include "tests/support/MeshShape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

using test::PointList;
using test::VectorList;

RevolutionSkeleton make(std::vector<Vec3> points, SplineKind kind, bool closed, bool solid)
{
  return RevolutionSkeleton(
    { Vec3(1, 2, 3), Vec3(1, -1, 2), { std::move(points), {}, kind, closed }, solid });
}

struct Case
{
  const char* name;
  RevolutionSkeleton skeleton;
  double radius;
  double volume; // 0: not known
  int genus;
};

// pi r^2 h and what a ball sweeps around it.
double roundedCylinder(double r, double h, double t)
{
  return EIGEN_PI *
    (r * r * h + 2.0 * r * r * t + 2.0 * r * h * t + EIGEN_PI * r * t * t + h * t * t +
      4.0 / 3.0 * t * t * t);
}

std::vector<Case> cases()
{
  const std::vector<Vec3> wall{ Vec3(0.5, 0, 0), Vec3(0.5, 1, 0) };
  const std::vector<Vec3> bowl{ Vec3(0, 0, 0), Vec3(0.6, 0.05, 0), Vec3(0.9, 0.6, 0) };
  const std::vector<Vec3> vase{ Vec3(0.3, 0, 0), Vec3(0.5, 0.4, 0), Vec3(0.2, 0.9, 0),
    Vec3(0.4, 1.3, 0) };
  const std::vector<Vec3> step{ Vec3(0.9, 0, 0), Vec3(0.9, 0.4, 0), Vec3(0.4, 0.4, 0),
    Vec3(0.4, 1, 0) };
  const std::vector<Vec3> square{ Vec3(0.5, 0, 0), Vec3(1, 0, 0), Vec3(1, 0.5, 0),
    Vec3(0.5, 0.5, 0) };
  const auto line = SplineKind::Polyline;
  const auto curve = SplineKind::CatmullRom;
  std::vector<Case> result;
  result.push_back(
    { "cylinder", make(wall, line, false, true), 0.2, roundedCylinder(0.5, 1, 0.2), 0 });
  result.push_back({ "sharp cylinder", make(wall, line, false, true), 0.0, EIGEN_PI * 0.25, 0 });
  // Pappus: the area of a stadium times the way of its middle.
  result.push_back({ "tube", make(wall, line, false, false), 0.1,
    2.0 * EIGEN_PI * 0.5 * (0.2 + EIGEN_PI * 0.01), 1 });
  result.push_back({ "bowl", make(bowl, line, false, false), 0.05, 0.0, 0 });
  result.push_back({ "curved bowl", make(bowl, curve, false, false), 0.05, 0.0, 0 });
  result.push_back({ "vase", make(vase, curve, false, true), 0.05, 0.0, 0 });
  result.push_back({ "vase wall", make(vase, curve, false, false), 0.05, 0.0, 1 });
  result.push_back({ "step", make(step, line, false, true), 0.1, 0.0, 0 });
  result.push_back({ "square ring", make(square, line, true, true), 0.1,
    2.0 * EIGEN_PI * 0.75 * (0.25 + 0.2 + EIGEN_PI * 0.01), 1 });
  result.push_back({ "round ring", make(square, curve, true, true), 0.1, 0.0, 1 });
  return result;
}

TEST(Revolution, MeshIsClosedExactAndFine)
{
  for (const Case& item : cases())
  {
    for (const double length : { 0.03, 0.1, 0.5 })
    {
      const auto mesh = item.skeleton.offsetMesh(item.radius, length);
      ASSERT_TRUE(mesh) << item.name << " " << length;
      const MeshReport report = checkMesh(*mesh);
      EXPECT_TRUE(report.closedManifold()) << item.name << " " << report.describe();
      EXPECT_EQ(report.genus(), item.genus) << item.name;
      EXPECT_GT(signedVolume(*mesh), 0.0) << item.name;
      const PointList points(mesh->points);
      std::vector<double> distance(points.size());
      VectorList gradient(points.size());
      item.skeleton.distanceAndGradient(points, distance.data(), gradient);
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        EXPECT_NEAR(distance[k], item.radius, 1e-12) << item.name;
      }
      EXPECT_LE(test::shapeOf(*mesh).longest, length * (1.0 + 1e-12)) << item.name;
    }
  }
}

// The nearest point is in the half-plane through p, where the profile is a curve.
TEST(Revolution, DistanceIsThatToTheProfile)
{
  test::Random random(48);
  for (int round = 0; round < 40; ++round)
  {
    std::vector<Vec3> profile;
    const int count = random.integer(2, 6);
    for (int k = 0; k < count; ++k)
    {
      profile.emplace_back(random.uniform(0.0, 1.0), 0.4 * k, 0.0);
    }
    const RevolutionSkeleton skeleton =
      make(profile, static_cast<SplineKind>(round % 3), false, random.chance(0.5));
    const RevolutionShape& shape = skeleton.shape();
    const std::vector<CubicSpan> spans = drawnProfile(shape);
    const Box3 bounds = skeleton.bounds();
    const PointList points = randomPoints(
      random, Box3(Vec3(bounds.min().array() - 1.0), Vec3(bounds.max().array() + 1.0)), 50);
    std::vector<double> distance(points.size());
    skeleton.signedDistance(points, distance.data());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const Vec3 p = points[k] - shape.origin;
      const double height = shape.axis.dot(p);
      const double expected =
        test::distanceToSpans(spans, Vec3((p - height * shape.axis).norm(), height, 0.0));
      EXPECT_NEAR(std::abs(distance[k]), expected, 1e-9 * expected + 1e-13) << round;
    }
  }
}

TEST(Revolution, VolumeConvergesToTheSolid)
{
  for (const Case& item : cases())
  {
    if (item.volume > 0.0)
    {
      const double coarse =
        signedVolume(*item.skeleton.offsetMesh(item.radius, 0.08)) - item.volume;
      const double fine = signedVolume(*item.skeleton.offsetMesh(item.radius, 0.02)) - item.volume;
      EXPECT_LE(std::abs(coarse), 0.1 * item.volume) << item.name;
      EXPECT_LE(std::abs(fine), std::abs(coarse) / 8.0 + 1e-12) << item.name;
    }
  }
}

// Share of the box in which the distance is below the radius, times its volume, and twice the
// standard deviation of that.
std::pair<double, double> sampledVolume(
  test::Random& random, const Skeleton& skeleton, double radius)
{
  constexpr int kCount = 20000;
  Box3 box = skeleton.bounds();
  box = Box3(Vec3(box.min().array() - radius), Vec3(box.max().array() + radius));
  PointList points;
  for (int k = 0; k < kCount; ++k)
  {
    points.add(box.min() +
      Vec3(random.unit(), random.unit(), random.unit()).cwiseProduct(Vec3(box.sizes())));
  }
  std::vector<double> distance(points.size());
  skeleton.signedDistance(points, distance.data());
  const double share =
    double(std::count_if(distance.begin(), distance.end(), [&](double d) { return d < radius; })) /
    kCount;
  return { share * box.volume(), 2.0 * box.volume() * std::sqrt(share * (1.0 - share) / kCount) };
}

TEST(Revolution, RandomProfilesMakeClosedMeshesOfTheRightVolume)
{
  test::Random random(47);
  int meshed = 0;
  for (int round = 0; round < 80; ++round)
  {
    const bool closed = round % 4 == 3;
    std::vector<Vec3> points;
    const int count = random.integer(closed ? 3 : 2, 7);
    for (int k = 0; k < count; ++k)
    {
      const double turn = 2.0 * EIGEN_PI * k / count;
      points.push_back(closed ? Vec3(1.2 + random.uniform(0.4, 0.8) * std::cos(turn),
                                  random.uniform(0.4, 0.8) * std::sin(turn), 0.0)
                              : Vec3(random.chance(0.2) ? 0.0 : random.uniform(0.05, 1.0),
                                  0.5 * k + random.uniform(-0.2, 0.2), 0.0));
    }
    const bool solid = random.chance(0.6);
    const RevolutionSkeleton skeleton =
      make(points, static_cast<SplineKind>(random.integer(0, 2)), closed, solid);
    const double radius = solid && random.chance(0.3) ? 0.0 : random.uniform(0.02, 0.15);
    const auto mesh = skeleton.offsetMesh(radius, 0.05);
    if (!mesh)
    {
      continue;
    }
    ++meshed;
    const MeshReport report = checkMesh(*mesh);
    EXPECT_TRUE(report.closedManifold()) << round << " " << report.describe();
    const PointList vertices(mesh->points);
    std::vector<double> distance(vertices.size());
    skeleton.signedDistance(vertices, distance.data());
    for (const double d : distance)
    {
      EXPECT_NEAR(d, radius, 1e-9) << round;
    }
    const auto [volume, deviation] = sampledVolume(random, skeleton, radius);
    // Flat triangles cut a little off: their sag, over the surface.
    double area = 0.0;
    for (std::size_t t = 0; t < mesh->triangles.size(); ++t)
    {
      area += 0.5 * areaNormal(*mesh, t).norm();
    }
    EXPECT_NEAR(signedVolume(*mesh), volume, 2.5 * deviation + 0.004 * area) << round;
  }
  EXPECT_GT(meshed, 30);
}

TEST(Revolution, OffsetsThatMeetThemselvesAreLeftToTheLattice)
{
  const auto line = SplineKind::Polyline;
  // The hole of the ring is filled, the groove between two walls closes, the profile crosses
  // itself.
  EXPECT_FALSE(make({ Vec3(0.1, 0, 0), Vec3(0.1, 1, 0) }, line, false, false).offsetMesh(0.2, 0.1));
  EXPECT_FALSE(
    make({ Vec3(0.5, 0, 0), Vec3(0.5, 1, 0), Vec3(0.8, 1, 0), Vec3(0.8, 0, 0) }, line, false, false)
      .offsetMesh(0.2, 0.1));
  EXPECT_FALSE(
    make({ Vec3(0.5, 0, 0), Vec3(1, 1, 0), Vec3(0.5, 1, 0), Vec3(1, 0, 0) }, line, false, true)
      .offsetMesh(0.01, 0.1));
}

TEST(Revolution, BadValuesAreNamed)
{
  const auto message = [](const RevolutionShape& shape) -> std::string
  {
    try
    {
      const RevolutionSkeleton skeleton(shape);
    }
    catch (const InvalidParameter& error)
    {
      return error.what();
    }
    return "no error";
  };
  const Vec3 up = Vec3::UnitZ();
  EXPECT_NE(message({ Vec3::Zero(), up, { { Vec3(-1, 0, 0), Vec3(1, 0, 0) } }, true })
              .find("The radius of profile point 0 is -1"),
    std::string::npos);
  EXPECT_NE(message({ Vec3::Zero(), up, { { Vec3(1, 0, 0), Vec3(1, 0, 0) } }, true })
              .find("2 or more for a solid"),
    std::string::npos);
  EXPECT_NE(message({ Vec3::Zero(), Vec3::Zero(), { { Vec3(1, 0, 0), Vec3(1, 1, 0) } }, true })
              .find("Axis"),
    std::string::npos);
  EXPECT_NE(message({ Vec3::Zero(), up, {}, true }).find("Points"), std::string::npos);
}

} // namespace
} // namespace hybridtree

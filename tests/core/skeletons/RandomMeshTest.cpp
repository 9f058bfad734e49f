// SPDX-License-Identifier: BSD-3-Clause
// What [HT] 5.1 asks of direct meshes, over random shapes of every kind: closed, on the surface, no
// edge too long, few too short, few thin triangles.
#include "core/mesh/MeshChecks.h"
#include "tests/core/skeletons/PlateCases.h"
#include "tests/support/MeshShape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

namespace hybridtree
{
namespace
{

using test::PointList;
using test::Random;

struct RandomKind
{
  std::string name;
  std::function<SkeletonPtr(Random&)> make;
  bool solid = false;    // has a surface at radius 0
  double needles = 0.01; // most triangles with an angle under 25 degrees, as a share
};

Vec3 place(Random& random, double size)
{
  return size * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
}

// From 0.2 to 2, as often below 0.63 as above.
double size(Random& random)
{
  return 0.2 * std::pow(10.0, random.unit());
}

std::vector<Vec3> outline(Random& random)
{
  const int count = random.integer(3, 9);
  const Mat3 turned = random.rotation();
  const double wide = size(random);
  std::vector<Vec3> corners;
  for (int k = 0; k < count; ++k)
  {
    const double turn = 2.0 * EIGEN_PI * (k + random.uniform(0.0, 0.5)) / count;
    corners.push_back(
      turned * (wide * random.uniform(0.6, 1.4) * Vec3(std::cos(turn), std::sin(turn), 0.0)));
  }
  return corners;
}

SkeletonPtr spline(Random& random, bool thick)
{
  SplineCurve curve;
  curve.kind = random.chance(0.5) ? SplineKind::CatmullRom : SplineKind::BSpline;
  const int count = random.integer(3, 8);
  Vec3 at = Vec3::Zero();
  Vec3 way = random.direction();
  for (int k = 0; k < count; ++k)
  {
    curve.points.push_back(at);
    way = (way + 0.5 * random.direction()).normalized();
    at += random.uniform(1.0, 2.0) * way;
    if (thick)
    {
      curve.radii.push_back(random.uniform(0.0, 0.3));
    }
  }
  return makeSpline(curve);
}

SkeletonPtr revolution(Random& random, bool solid)
{
  RevolutionShape shape{ place(random, 1.0), random.direction(), {}, solid };
  shape.profile.kind = static_cast<SplineKind>(random.integer(0, 2));
  const int count = random.integer(2, 5);
  for (int k = 0; k < count; ++k)
  {
    shape.profile.points.emplace_back(random.uniform(0.6, 1.5), 0.7 * k, 0.0);
  }
  return std::make_shared<RevolutionSkeleton>(shape);
}

std::vector<RandomKind> kinds()
{
  const auto ends = [](Random& random)
  {
    const Vec3 a = place(random, 1.0);
    return std::pair<Vec3, Vec3>(a, a + size(random) * random.direction());
  };
  return {
    { "point", [](Random& random) { return std::make_shared<PointSkeleton>(place(random, 3.0)); } },
    { "segment",
      [=](Random& random)
      {
        const auto [a, b] = ends(random);
        return std::make_shared<SegmentSkeleton>(a, b);
      } },
    { "circle",
      [](Random& random)
      {
        return std::make_shared<CircleSkeleton>(
          place(random, 1.0), random.direction(), random.uniform(0.5, 2.0));
      } },
    { "disc",
      [](Random& random) {
        return std::make_shared<DiscSkeleton>(place(random, 1.0), random.direction(), size(random));
      } },
    { "rectangle",
      [](Random& random)
      {
        const Vec3 a = random.direction();
        const Vec3 b = a.cross(random.direction()).normalized() + random.uniform(-0.9, 0.9) * a;
        return std::make_shared<RectangleSkeleton>(
          Vec3::Zero(), Vec3(size(random) * a), Vec3(size(random) * b));
      } },
    { "triangle",
      [](Random& random)
      {
        const double wide = size(random);
        return std::make_shared<TriangleSkeleton>(Vec3(wide * random.direction()),
          Vec3(wide * random.direction()), Vec3(wide * random.direction()));
      } },
    { "polygon",
      [](Random& random) { return std::make_shared<PolygonSkeleton>(outline(random)); } },
    { "box",
      [](Random& random)
      {
        return std::make_shared<BoxSkeleton>(
          place(random, 1.0), Vec3(size(random), size(random), size(random)), random.rotation());
      },
      true },
    { "cylinder",
      [=](Random& random)
      {
        const auto [a, b] = ends(random);
        return std::make_shared<CylinderSkeleton>(a, b, size(random));
      },
      true },
    { "hollow cylinder",
      [=](Random& random)
      {
        const auto [a, b] = ends(random);
        const double outer = random.uniform(0.6, 2.0);
        return std::make_shared<HollowCylinderSkeleton>(
          a, b, outer, outer * random.uniform(0.4, 0.9));
      },
      true },
    { "cone",
      [=](Random& random)
      {
        const auto [a, b] = ends(random);
        return std::make_shared<ConeSkeleton>(
          a, b, size(random), random.chance(0.2) ? 0.0 : size(random));
      },
      true },
    { "cone sphere",
      [=](Random& random)
      {
        const auto [a, b] = ends(random);
        return std::make_shared<ConeSphereSkeleton>(a, b, size(random), size(random));
      },
      true },
    { "ellipsoid",
      [](Random& random)
      {
        return std::make_shared<EllipsoidSkeleton>(
          place(random, 1.0), Vec3(size(random), size(random), size(random)), random.rotation());
      },
      true },
    { "spline", [](Random& random) { return spline(random, false); } },
    { "spline with radii", [](Random& random) { return spline(random, true); }, false, 0.03 },
    { "surface of revolution", [](Random& random) { return revolution(random, false); } },
    { "solid of revolution", [](Random& random) { return revolution(random, true); }, true },
  };
}

void expectGood(const TriangleMesh& mesh, const RandomKind& kind, const Skeleton& skeleton,
  double radius, double length)
{
  const MeshReport report = checkMesh(mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.degenerateTriangles, 0u);
  EXPECT_GT(signedVolume(mesh), 0.0);
  const PointList points(mesh.points);
  std::vector<double> distance(points.size());
  skeleton.signedDistance(points, distance.data());
  double off = 0.0;
  for (const double d : distance)
  {
    off = std::max(off, std::abs(d - radius));
  }
  EXPECT_LE(off, 1e-10);
  const test::MeshShape shape = test::shapeOf(mesh);
  EXPECT_LE(shape.longest, length * (1.0 + 1e-12));
  EXPECT_GE(shape.mean, 0.6 * length);
  // A sharp tip has a few by itself.
  const double tip = radius == 0.0 ? 6.0 / double(mesh.triangles.size()) : 0.0;
  EXPECT_LE(shape.needles, kind.needles + tip);
}

TEST(RandomMesh, IsClosedExactFineAndWellShaped)
{
  Random random(83);
  for (const RandomKind& kind : kinds())
  {
    int meshed = 0;
    for (int round = 0; round < 30; ++round)
    {
      const SkeletonPtr skeleton = kind.make(random);
      const double radius = kind.solid && random.chance(0.3) ? 0.0 : random.uniform(0.1, 0.5);
      const double length = random.uniform(0.025, 0.06);
      const auto mesh = skeleton->offsetMesh(radius, length);
      if (!mesh)
      {
        continue; // it meets itself
      }
      ++meshed;
      SCOPED_TRACE(kind.name + ", round " + std::to_string(round) + ", radius " +
        std::to_string(radius) + ", length " + std::to_string(length));
      expectGood(*mesh, kind, *skeleton, radius, length);
    }
    EXPECT_GE(meshed, 10) << kind.name;
  }
}

} // namespace
} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
// Direct meshes: topology, shape of triangles, exactness of points and normals, enclosed volume.
#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "tests/core/skeletons/PlateCases.h"
#include "tests/support/MeshShape.h"

#include <gtest/gtest.h>

#include <set>

namespace hybridtree
{
namespace
{

using test::PointList;
using test::Random;
using test::VectorList;

struct OffsetCase
{
  std::string name;
  SkeletonPtr skeleton;
  double radius;
  double volume;
  int genus = 0;
  int tips = 0; // points where the surface has no tangent plane though the radius is not 0
};

double sphere(double r)
{
  return 4.0 / 3.0 * EIGEN_PI * r * r * r;
}

// Steiner: volume, surface, mean width and points of the box, each swept by its part of the ball.
double roundedBox(const Vec3& l, double r)
{
  return l.prod() + 2.0 * r * (l[0] * l[1] + l[1] * l[2] + l[2] * l[0]) +
    EIGEN_PI * r * r * l.sum() + sphere(r);
}

// Cylinder and cone frusta, swept by the ball: their volume, and what Steiner adds to it.
double roundedCone(double h, double a, double b, double r)
{
  const double slant = std::hypot(h, a - b);
  const double tilt = std::atan2(a - b, h);
  const double area = EIGEN_PI * ((a + b) * slant + a * a + b * b);
  // Half the sum over the edges of length times angle between the normals beside, and pi h more
  // for the turn of the side itself.
  const double right = 0.5 * EIGEN_PI;
  const double mean = EIGEN_PI * (a * (right + tilt) + b * (right - tilt) + h);
  return EIGEN_PI * h * (a * a + a * b + b * b) / 3.0 + area * r + mean * r * r + sphere(r);
}

// Two balls without their caps and the frustum between.
double hullOfBalls(double length, double a, double b)
{
  const double s = (a - b) / length;
  const double c = std::sqrt(1.0 - s * s);
  const auto cap = [](double r, double h) { return EIGEN_PI * h * h * (3.0 * r - h) / 3.0; };
  const double height = length - (a - b) * s;
  return cap(a, a + a * s) + cap(b, b - b * s) +
    EIGEN_PI * height * c * c * (a * a + a * b + b * b) / 3.0;
}

// A tube with wall, swept: by Pappus, the area of its section times the way of the centre.
double roundedTube(double h, double outer, double inner, double r)
{
  const double w = outer - inner;
  const double area = w * h + 2.0 * r * (w + h) + EIGEN_PI * r * r;
  return area * EIGEN_PI * (outer + inner);
}

void addRound(std::vector<OffsetCase>& cases, Random& random)
{
  const Vec3 a = random.direction();
  const Vec3 across = random.direction();
  const auto add = [&](const char* name, const SkeletonPtr& skeleton, double r, double volume,
                     int genus = 0) {
    cases.push_back({ name, skeleton, r, volume, genus });
  };
  for (const double r : { 0.15, 0.4 })
  {
    const double plate = 2.0 * r * EIGEN_PI + EIGEN_PI * EIGEN_PI * r * r + sphere(r);
    add("disc", std::make_shared<DiscSkeleton>(a, across, 1.0), r, plate);
  }
  for (const double r : { 0.0, 0.1, 0.4 })
  {
    add("cylinder", std::make_shared<CylinderSkeleton>(a, a + 1.3 * across, 0.5), r,
      roundedCone(1.3, 0.5, 0.5, r));
    add("cone", std::make_shared<ConeSkeleton>(a, a + 1.2 * across, 0.4, 0.7), r,
      roundedCone(1.2, 0.4, 0.7, r));
    add("pointed cone", std::make_shared<ConeSkeleton>(a, a + 0.8 * across, 0.6, 0.0), r,
      roundedCone(0.8, 0.6, 0.0, r));
    add("tube", std::make_shared<HollowCylinderSkeleton>(a, a + 1.1 * across, 1.0, 0.6), r,
      roundedTube(1.1, 1.0, 0.6, r), 1);
    add("cone sphere", std::make_shared<ConeSphereSkeleton>(a, a + 1.1 * across, 0.6, 0.2), r,
      hullOfBalls(1.1, 0.6 + r, 0.2 + r));
  }
  // The bore closed: the rounded cylinder less what the dimples leave out, a solid of revolution
  // between the half circle over the inner rim and its top.
  const double bore = 0.2;
  const double r = 0.3;
  const double top = std::sqrt(r * r - bore * bore);
  const double angle = std::asin(bore / r);
  // Volume under the arc over radial < bore, by shells.
  const double under = 2.0 * EIGEN_PI *
    (0.5 * bore * (bore * top + r * r * angle) - (r * r * r - top * top * top) / 3.0);
  add("tube with closed bore",
    std::make_shared<HollowCylinderSkeleton>(a, a + 1.1 * across, 0.8, bore), r,
    roundedCone(1.1, 0.8, 0.8, r) - 2.0 * (EIGEN_PI * bore * bore * r - under));
  cases.back().tips = 2;
  add("ball of cone sphere", std::make_shared<ConeSphereSkeleton>(a, a + 0.1 * across, 0.2, 0.5),
    0.3, sphere(0.8));
}

// A convex plate, swept.
double roundedPlate(double area, double outline, double r)
{
  return 2.0 * r * area + 0.5 * EIGEN_PI * r * r * outline + sphere(r);
}

// Steiner: integrals over the unit sphere of abc |u / e|, the area, and of |u e|, the height of the
// tangent plane across u, which is the integral of the mean curvature.
double sweptEllipsoid(const Vec3& e, double r)
{
  constexpr int kSteps = 400;
  double area = 0.0;
  double mean = 0.0;
  for (int i = 0; i < kSteps; ++i)
  {
    for (int j = 0; j < kSteps; ++j)
    {
      const double z = 2.0 * (i + 0.5) / kSteps - 1.0;
      const double turn = 2.0 * EIGEN_PI * (j + 0.5) / kSteps;
      const double across = std::sqrt(1.0 - z * z);
      const Vec3 u(across * std::cos(turn), across * std::sin(turn), z);
      const double part = 4.0 * EIGEN_PI / (kSteps * kSteps);
      area += part * e.prod() * u.cwiseQuotient(e).norm();
      mean += part * u.cwiseProduct(e).norm();
    }
  }
  return 4.0 / 3.0 * EIGEN_PI * e.prod() + area * r + mean * r * r + sphere(r);
}

void addFlatAndEllipsoids(std::vector<OffsetCase>& cases, Random& random)
{
  const auto add = [&](const char* name, const SkeletonPtr& skeleton, double r, double volume) {
    cases.push_back({ name, skeleton, r, volume });
  };
  const Mat3 turned = random.rotation();
  const Vec3 at = random.direction();
  const auto place = [&](double x, double y) { return Vec3(at + turned * Vec3(x, y, 0.0)); };
  for (const double r : { 0.15, 0.4 })
  {
    add("rectangle", std::make_shared<RectangleSkeleton>(place(0, 0), place(1.2, 0), place(0, 0.7)),
      r, roundedPlate(0.84, 3.8, r));
    add("leaning rectangle",
      std::make_shared<RectangleSkeleton>(place(0, 0), place(1.5, 0), place(0.9, 1.2)), r,
      roundedPlate(1.8, 6.0, r));
    add("flat rectangle",
      std::make_shared<RectangleSkeleton>(place(0, 0), place(1.5, 0), place(1.6, 1.2)), r,
      roundedPlate(1.8, 7.0, r));
    add("triangle", std::make_shared<TriangleSkeleton>(place(0, 0), place(1.5, 0), place(0, 2)), r,
      roundedPlate(1.5, 6.0, r));
    add("even triangle",
      std::make_shared<TriangleSkeleton>(place(0, 0), place(1.2, 0), place(0.6, 0.8)), r,
      roundedPlate(0.48, 3.2, r));
    std::vector<Vec3> hexagon;
    for (const Vec3& corner : test::star(6, 1.0, 1.0))
    {
      hexagon.push_back(at + turned * corner);
    }
    const double side = 2.0 * std::sin(EIGEN_PI / 12.0);
    add("polygon", std::make_shared<PolygonSkeleton>(hexagon), r,
      roundedPlate(6.0 * std::sin(EIGEN_PI / 6.0), 12.0 * side, r));
  }
  for (const Vec3& radii :
    { Vec3(1, 1, 1), Vec3(0.6, 1, 0.8), Vec3(0.4, 0.4, 1.5), Vec3(1, 0.3, 1), Vec3(2, 0.8, 0.2) })
  {
    for (const double r : { 0.0, 0.3 })
    {
      add("ellipsoid", std::make_shared<EllipsoidSkeleton>(at, radii, turned), r,
        sweptEllipsoid(radii, r));
    }
  }
}

std::vector<OffsetCase> offsetCases()
{
  Random random(21);
  std::vector<OffsetCase> cases;
  const auto add = [&](const char* name, SkeletonPtr skeleton, double r, double volume,
                     int genus = 0) {
    cases.push_back({ name, std::move(skeleton), r, volume, genus });
  };
  add("sphere", std::make_shared<PointSkeleton>(random.direction()), 0.8, sphere(0.8));
  for (const double length : { 0.0, 0.01, 0.1, 0.3, 3.0 })
  {
    const Vec3 a = random.direction();
    const Vec3 b = a + length * random.direction();
    add(
      "capsule", std::make_shared<SegmentSkeleton>(a, b), 0.5, roundedBox(Vec3(length, 0, 0), 0.5));
  }
  for (const double tube : { 0.1, 0.3, 0.6, 0.9, 0.99 })
  {
    add("torus", std::make_shared<CircleSkeleton>(random.direction(), random.direction(), 1.0),
      tube, 2.0 * EIGEN_PI * EIGEN_PI * tube * tube, 1);
  }
  for (const Vec3& l : { Vec3(1, 2, 0.7), Vec3(1, 1, 1), Vec3(1, 2, 0), Vec3(2, 0.02, 1) })
  {
    add("rounded box", std::make_shared<BoxSkeleton>(random.direction(), l, random.rotation()), 0.3,
      roundedBox(l, 0.3));
  }
  addRound(cases, random);
  addFlatAndEllipsoids(cases, random);
  Mat3 mirror = random.rotation();
  mirror.col(2) *= -1.0;
  add("mirrored box", std::make_shared<BoxSkeleton>(random.direction(), Vec3(1, 2, 0.7), mirror),
    0.3, roundedBox(Vec3(1, 2, 0.7), 0.3));
  add("box", std::make_shared<BoxSkeleton>(random.direction(), Vec3(1, 2, 0.7), random.rotation()),
    0.0, 1.4);
  add("mirrored sharp box",
    std::make_shared<BoxSkeleton>(random.direction(), Vec3(1, 2, 0.7), mirror), 0.0, 1.4);
  return cases;
}

TEST(OffsetMesh, IsAClosedManifoldAtEveryEdgeLength)
{
  for (const OffsetCase& item : offsetCases())
  {
    for (const double length : { 0.03, 0.1, 0.3, 0.5, 1.0, 3.0, 100.0 })
    {
      const auto mesh = item.skeleton->offsetMesh(item.radius, length);
      ASSERT_TRUE(mesh) << item.name;
      const MeshReport report = checkMesh(*mesh);
      EXPECT_TRUE(report.closedManifold())
        << item.name << " at " << length << ": " << report.describe();
      EXPECT_EQ(report.unusedPoints, 0u) << item.name << " at " << length;
      EXPECT_EQ(report.degenerateTriangles, 0u) << item.name << " at " << length;
      EXPECT_EQ(report.components, 1u) << item.name << " at " << length;
      EXPECT_EQ(report.genus(), item.genus) << item.name << " at " << length;
      EXPECT_GT(signedVolume(*mesh), 0.0) << item.name << " at " << length;
    }
  }
}

TEST(OffsetMesh, PointsAndNormalsAreExact)
{
  for (const OffsetCase& item : offsetCases())
  {
    const TriangleMesh mesh = *item.skeleton->offsetMesh(item.radius, 0.1);
    const PointList points(mesh.points);
    std::vector<double> distance(points.size());
    VectorList gradient(points.size());
    item.skeleton->distanceAndGradient(points, distance.data(), gradient);
    int differing = 0;
    ASSERT_EQ(mesh.normals.size(), mesh.points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      EXPECT_NEAR(distance[k], item.radius, 1e-13) << item.name;
      EXPECT_NEAR(mesh.normals[k].norm(), 1.0, 1e-13) << item.name;
      if (item.radius > 0.0)
      {
        differing += (mesh.normals[k] - gradient[k]).norm() > 1e-11;
      }
    }
    EXPECT_EQ(differing, item.tips) << item.name;
    // Sharp shapes, too: the normals of the points look to the side of the triangles around them.
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    {
      for (const std::int32_t corner : mesh.triangles[t])
      {
        EXPECT_GT(areaNormal(mesh, t).normalized().dot(mesh.normals[corner]), 0.4) << item.name;
      }
    }
  }
}

TEST(OffsetMesh, EdgesFillTheTargetLengthAndTrianglesAreWellShaped)
{
  for (const OffsetCase& item : offsetCases())
  {
    for (const double length : { 0.02, 0.033, 0.05, 0.09 })
    {
      const test::MeshShape shape = test::shapeOf(*item.skeleton->offsetMesh(item.radius, length));
      EXPECT_LE(shape.longest, length * (1.0 + 1e-12)) << item.name << " r " << item.radius;
      EXPECT_GE(shape.mean, 0.6 * length) << item.name << " r " << item.radius << " at " << length;
      EXPECT_LE(shape.needles, 0.01) << item.name << " r " << item.radius << " at " << length;
    }
  }
}

TEST(OffsetMesh, VolumeConvergesToTheSolid)
{
  for (const OffsetCase& item : offsetCases())
  {
    const double coarse = signedVolume(*item.skeleton->offsetMesh(item.radius, 0.08)) - item.volume;
    const double fine = signedVolume(*item.skeleton->offsetMesh(item.radius, 0.02)) - item.volume;
    EXPECT_LE(std::abs(coarse), 0.1 * item.volume) << item.name;
    // Second order: a quarter of the length leaves about a sixteenth of the error.
    EXPECT_LE(std::abs(fine), std::abs(coarse) / 8.0 + 1e-12) << item.name;
  }
}

using PointSet = std::set<std::array<long long, 3>>;

PointSet rounded(const std::vector<Vec3>& points, const Affine3& map)
{
  PointSet result;
  for (const Vec3& point : points)
  {
    const Vec3 p = (map * point) * 1e6;
    result.insert({ std::llround(p[0]), std::llround(p[1]), std::llround(p[2]) });
  }
  return result;
}

TEST(OffsetMesh, IsSymmetricInThePlanesOfTheShape)
{
  const std::vector<std::pair<SkeletonPtr, double>> shapes = {
    { std::make_shared<PointSkeleton>(Vec3::Zero()), 0.7071 },
    { std::make_shared<SegmentSkeleton>(Vec3(0, 0, -0.5), Vec3(0, 0, 0.5)), 0.3 },
    { std::make_shared<CircleSkeleton>(Vec3::Zero(), Vec3::UnitZ(), 1.0), 0.2 },
    { std::make_shared<CircleSkeleton>(Vec3::Zero(), Vec3::UnitZ(), 1.0), 0.7 },
    { std::make_shared<BoxSkeleton>(Vec3::Zero(), Vec3(1, 2, 0.5)), 0.2 },
    { std::make_shared<BoxSkeleton>(Vec3::Zero(), Vec3(1, 2, 0.5)), 0.0 },
    { std::make_shared<DiscSkeleton>(Vec3::Zero(), Vec3::UnitZ(), 1.0), 0.2 },
    { std::make_shared<CylinderSkeleton>(-Vec3::UnitY(), Vec3::UnitY(), 0.6), 0.0 },
    { std::make_shared<CylinderSkeleton>(-Vec3::UnitY(), Vec3::UnitY(), 0.6), 0.2 },
    { std::make_shared<HollowCylinderSkeleton>(-Vec3::UnitX(), Vec3::UnitX(), 0.8, 0.4), 0.2 },
    { std::make_shared<HollowCylinderSkeleton>(-Vec3::UnitX(), Vec3::UnitX(), 0.8, 0.1), 0.2 },
    { std::make_shared<RectangleSkeleton>(Vec3(-1, -0.6, 0), Vec3(1, -0.6, 0), Vec3(-1, 0.6, 0)),
      0.2 },
    { std::make_shared<EllipsoidSkeleton>(Vec3::Zero(), Vec3(0.5, 1, 0.7)), 0.0 },
    { std::make_shared<EllipsoidSkeleton>(Vec3::Zero(), Vec3(0.5, 1, 0.7)), 0.3 },
  };
  for (const auto& [skeleton, radius] : shapes)
  {
    const TriangleMesh mesh = *skeleton->offsetMesh(radius, 0.13);
    const PointSet points = rounded(mesh.points, Affine3::Identity());
    EXPECT_EQ(points.size(), mesh.points.size());
    for (int axis = 0; axis < 3; ++axis)
    {
      Affine3 mirror = Affine3::Identity();
      mirror.linear()(axis, axis) = -1.0;
      EXPECT_EQ(rounded(mesh.points, mirror), points) << skeleton->kind() << " axis " << axis;
    }
  }
}

TEST(OffsetMesh, SimilarShapesHaveSimilarMeshes)
{
  Random random(22);
  for (const OffsetCase& item : offsetCases())
  {
    const double scale = random.uniform(0.5, 2.0);
    const Affine3 map = test::randomSimilarity(random, scale);
    const SkeletonPtr image = item.skeleton->similarityImage(map, scale);
    const TriangleMesh before = *item.skeleton->offsetMesh(item.radius, 0.1);
    const TriangleMesh after = *image->offsetMesh(scale * item.radius, scale * 0.1);
    EXPECT_NEAR(double(after.triangles.size()), double(before.triangles.size()),
      0.05 * double(before.triangles.size()))
      << item.name;
    EXPECT_NEAR(
      signedVolume(after), std::pow(scale, 3) * signedVolume(before), 1e-2 * signedVolume(after))
      << item.name;
  }
}

TEST(OffsetMesh, ATorusThatMeetsItselfIsLeftToTheLattice)
{
  const CircleSkeleton circle(Vec3::Zero(), Vec3::UnitX(), 1.0);
  EXPECT_FALSE(circle.offsetMesh(1.0, 0.1));
  EXPECT_FALSE(circle.offsetMesh(1.5, 0.1));
  EXPECT_TRUE(circle.offsetMesh(0.999, 0.1));
}

TEST(OffsetMesh, AFlatBoxWithoutRadiusHasNoSurface)
{
  EXPECT_TRUE(BoxSkeleton(Vec3::Zero(), Vec3(1, 1, 0)).offsetMesh(0.0, 0.1)->empty());
}

TEST(OffsetMesh, TooManyTrianglesAreRefusedWithTheirNumber)
{
  const std::vector<std::pair<SkeletonPtr, double>> shapes = {
    { std::make_shared<PointSkeleton>(Vec3::Zero()), 1.0 },
    { std::make_shared<SegmentSkeleton>(Vec3::Zero(), Vec3(1, 0, 0)), 0.3 },
    { std::make_shared<CircleSkeleton>(Vec3::Zero(), Vec3::UnitZ(), 1.0), 0.2 },
    { std::make_shared<BoxSkeleton>(Vec3::Zero(), Vec3(1, 2, 0.5)), 0.2 },
    { std::make_shared<BoxSkeleton>(Vec3::Zero(), Vec3(1, 2, 0.5)), 0.0 },
    { std::make_shared<DiscSkeleton>(Vec3::Zero(), Vec3::UnitZ(), 1.0), 0.2 },
    { std::make_shared<ConeSkeleton>(Vec3::Zero(), Vec3(1, 0, 0), 0.3, 0.0), 0.0 },
    { std::make_shared<TriangleSkeleton>(Vec3::Zero(), Vec3(2, 0, 0), Vec3(0, 1, 0)), 0.2 },
    { std::make_shared<EllipsoidSkeleton>(Vec3::Zero(), Vec3(1, 2, 3)), 0.0 },
  };
  for (const auto& [skeleton, radius] : shapes)
  {
    for (const double length : { 1e-4, 1e-9, 1e-200, 1e-308 })
    {
      try
      {
        skeleton->offsetMesh(radius, length);
        FAIL() << skeleton->kind() << " at " << length;
      }
      catch (const TooLarge& error)
      {
        EXPECT_NE(std::string(error.what()).find("5e+07"), std::string::npos) << error.what();
      }
    }
  }
}

} // namespace
} // namespace hybridtree

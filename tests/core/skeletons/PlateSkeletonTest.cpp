// SPDX-License-Identifier: BSD-3-Clause
// Flat skeletons and ellipsoids against what is written down without their code.
#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "tests/core/skeletons/PlateCases.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace hybridtree
{
namespace
{

using test::PlateCase;
using test::PointList;
using test::Random;
using test::VectorList;

double distanceToSegment(const Vec3& p, const Vec3& a, const Vec3& b)
{
  const double foot = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - foot * (b - a)).norm();
}

double expectedDistance(const PlateCase& plate, const Vec3& p)
{
  const auto& corners = plate.corners;
  Vec3 normal = Vec3::Zero();
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    normal += (corners[k] - corners[0]).cross(corners[(k + 1) % corners.size()] - corners[0]);
  }
  normal.normalize();
  const double height = (p - corners[0]).dot(normal);
  if (test::isInside(corners, p - height * normal))
  {
    return std::abs(height);
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    least = std::min(least, distanceToSegment(p, corners[k], corners[(k + 1) % corners.size()]));
  }
  return least;
}

double distanceAt(const Skeleton& skeleton, const Vec3& p)
{
  double distance;
  skeleton.distance(PointList({ p }), &distance);
  return distance;
}

double signedDistanceAt(const Skeleton& skeleton, const Vec3& p)
{
  double distance;
  skeleton.signedDistance(PointList({ p }), &distance);
  return distance;
}

TEST(PlateSkeleton, DistanceIsExact)
{
  Random random(43);
  for (const PlateCase& item : test::plateCases())
  {
    const Box3 box = item.skeleton->bounds();
    std::vector<Vec3> points;
    for (int k = 0; k < 400; ++k)
    {
      const Vec3 near = random.inBox(box) + random.uniform(0.0, 1.0) * random.direction();
      points.push_back(near);
      points.push_back(100.0 * near);
      // Close to the outline, where inside turns to outside.
      const std::size_t side = std::size_t(random.integer(0, int(item.corners.size()) - 1));
      const Vec3& a = item.corners[side];
      const Vec3& b = item.corners[(side + 1) % item.corners.size()];
      points.push_back(a + random.unit() * (b - a) + 1e-3 * random.direction());
      points.push_back(a);
    }
    for (const Vec3& p : points)
    {
      const double expected = expectedDistance(item, p);
      EXPECT_NEAR(
        distanceAt(*item.skeleton, p), expected, 1e-9 * expected + 1e-14 * (1.0 + p.norm()))
        << item.name << " at " << p.transpose();
    }
  }
}

// Eberly's secular equation in its own variable, bisected in long double.
double bisectedDistance(const Vec3& radii, const Vec3& p)
{
  const auto excess = [&](long double t)
  {
    long double sum = -1.0L;
    for (int k = 0; k < 3; ++k)
    {
      const long double e = radii[k];
      const long double term = e * p[k] / (t + e * e);
      sum += term * term;
    }
    return sum;
  };
  const long double least = radii.minCoeff();
  long double low = -least * least;
  long double high = 3.0L * radii.maxCoeff() * p.norm() + 1.0L;
  for (int k = 0; k < 400; ++k)
  {
    const long double middle = 0.5L * (low + high);
    (excess(middle) > 0.0L ? low : high) = middle;
  }
  const long double t = 0.5L * (low + high);
  long double squared = 0.0L;
  for (int k = 0; k < 3; ++k)
  {
    const long double off = t * p[k] / (t + (long double)(radii[k]) * radii[k]);
    squared += off * off;
  }
  return static_cast<double>(t < 0.0L ? -std::sqrt(squared) : std::sqrt(squared));
}

TEST(EllipsoidSkeleton, DistanceIsExact)
{
  Random random(44);
  for (int round = 0; round < 3000; ++round)
  {
    Vec3 radii;
    for (double& radius : radii)
    {
      radius = std::pow(10.0, random.uniform(-1.5, 1.0));
    }
    radii[1] = random.chance(0.2) ? radii[0] : radii[1];
    const EllipsoidSkeleton skeleton(Vec3::Zero(), radii);
    const double size = std::pow(10.0, random.uniform(-2.0, 1.5));
    const Vec3 p = size * Vec3(radii.cwiseProduct(random.direction()));
    const double expected = bisectedDistance(radii, p);
    EXPECT_NEAR(signedDistanceAt(skeleton, p), expected,
      1e-9 * std::abs(expected) + 1e-14 * (radii.maxCoeff() + p.norm()))
      << "radii " << radii.transpose() << " at " << p.transpose();
  }
}

TEST(EllipsoidSkeleton, DistanceIsExactWhereManyPointsAreNearest)
{
  const Vec3 radii(2.0, 1.2, 0.5);
  const EllipsoidSkeleton skeleton(Vec3::Zero(), radii);
  const auto at = [&](const Vec3& p) { return signedDistanceAt(skeleton, p); };
  EXPECT_NEAR(at(Vec3::Zero()), -0.5, 1e-15);
  // Within the focal ellipse of the plane of the longer axes the foot leaves that plane:
  // x_i = e_i^2 p_i / (e_i^2 - c^2), and the last coordinate is what the surface asks for.
  Random random(45);
  for (int round = 0; round < 500; ++round)
  {
    const double share = round == 0 ? 1.0 : 1.0 - std::pow(10.0, random.uniform(-16.0, 0.0));
    const double turn = random.uniform(0.0, 6.3);
    const double c = radii[2] * radii[2];
    const Vec3 p(share * (4.0 - c) / 2.0 * std::cos(turn),
      share * (1.44 - c) / 1.2 * std::sin(turn), random.chance(0.5) ? 0.0 : 1e-30);
    const Vec3 foot(4.0 * p[0] / (4.0 - c), 1.44 * p[1] / (1.44 - c), 0.0);
    const double rest = 1.0 - foot.cwiseQuotient(radii).squaredNorm();
    const double expected =
      Vec3(foot - p + radii[2] * std::sqrt(std::max(0.0, rest)) * Vec3::UnitZ()).norm();
    EXPECT_NEAR(at(p), -expected, 1e-9 * expected) << p.transpose();
  }
  // On the axes, inside and out.
  for (const double x : { 1.95, 2.0, 3.0, 1e6 })
  {
    EXPECT_NEAR(at(Vec3(x, 0, 0)), x - 2.0, 1e-15 * x) << x;
    EXPECT_NEAR(at(Vec3(0, 0, -x)), x - 0.5, 1e-15 * x) << x;
  }
}

// Area and more of a plate swept by a ball; reflex corners lose what two rims share there.
double sweptPlate(const std::vector<Vec3>& corners, double r)
{
  double area = 0.0;
  double length = 0.0;
  double wedges = 0.0;
  for (std::size_t k = 0; k < corners.size(); ++k)
  {
    const Vec3& a = corners[k];
    const Vec3& b = corners[(k + 1) % corners.size()];
    const Vec3& c = corners[(k + 2) % corners.size()];
    area += 0.5 * (a[0] * b[1] - a[1] * b[0]);
    length += (b - a).norm();
    const double turn = std::atan2((b - a).cross(c - b)[2], (b - a).dot(c - b));
    wedges += turn > 0.0 ? 2.0 / 3.0 * turn : -4.0 / 3.0 * std::tan(-0.5 * turn);
  }
  return 2.0 * r * area + 0.5 * EIGEN_PI * r * r * length + r * r * r * wedges;
}

TEST(PlateMesh, ReflexCornersAreCreasesOfAClosedSurface)
{
  for (const auto& corners : { test::letterL(), test::star(5, 0.8, 1.6), test::star(32, 1.0, 1.1) })
  {
    const PolygonSkeleton skeleton(corners);
    for (const double r : { 0.1, 0.3 })
    {
      const double volume = sweptPlate(corners, r);
      double before = 0.0;
      for (const double length : { 0.1, 0.025 })
      {
        const auto mesh = skeleton.offsetMesh(r, length);
        if (corners.size() == 64 && r == 0.3)
        {
          EXPECT_FALSE(mesh); // the mitres are longer than its sides
          continue;
        }
        ASSERT_TRUE(mesh) << corners.size() << " corners, r " << r;
        EXPECT_TRUE(isClosedManifold(*mesh));
        const double error = std::abs(signedVolume(*mesh) - volume);
        EXPECT_LE(error, length == 0.1 ? 0.05 * volume : 0.25 * before) << corners.size();
        before = error;
        for (const Vec3& p : mesh->points)
        {
          EXPECT_NEAR(distanceAt(skeleton, p), r, 1e-13);
        }
        for (std::size_t t = 0; t < mesh->triangles.size(); ++t)
        {
          for (const std::int32_t corner : mesh->triangles[t])
          {
            EXPECT_GT(areaNormal(*mesh, t).normalized().dot(mesh->normals[corner]), 0.4);
          }
        }
      }
    }
  }
}

TEST(PlateMesh, RimsThatMeetThemselvesAreLeftToTheLattice)
{
  // A slot of width 0.2 between two arms, and a notch whose sides are shorter than the mitres.
  const PolygonSkeleton slot({ Vec3(0, 0, 0), Vec3(2.2, 0, 0), Vec3(2.2, 2, 0), Vec3(1.2, 2, 0),
    Vec3(1.2, 1, 0), Vec3(1, 1, 0), Vec3(1, 2, 0), Vec3(0, 2, 0) });
  EXPECT_TRUE(slot.offsetMesh(0.08, 0.1));
  EXPECT_FALSE(slot.offsetMesh(0.12, 0.1));
  // Arms whose ends come close around a corner, without a side between them.
  const PolygonSkeleton horns({ Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(4, 3, 0), Vec3(2.1, 3, 0),
    Vec3(3, 1, 0), Vec3(1, 1, 0), Vec3(1.9, 3, 0), Vec3(0, 3, 0) });
  EXPECT_TRUE(horns.offsetMesh(0.09, 0.1));
  EXPECT_FALSE(horns.offsetMesh(0.11, 0.1));
}

TEST(PolygonSkeleton, RepeatedPointsAndSlightlyUnevenOnesAreForgiven)
{
  std::vector<Vec3> points = test::letterL();
  const PolygonSkeleton clean(points);
  points.insert(points.begin() + 2, points[1]);
  points.push_back(points.front());
  points[4].z() += 1e-5;
  const PolygonSkeleton rough(points);
  Random random(46);
  for (int k = 0; k < 100; ++k)
  {
    const Vec3 p = 3.0 * random.direction();
    EXPECT_NEAR(distanceAt(rough, p), distanceAt(clean, p), 2e-5);
  }
}

TEST(PlateSkeleton, BadOutlinesAreNamed)
{
  const auto message = [](std::vector<Vec3> points) -> std::string
  {
    try
    {
      PolygonSkeleton{ std::move(points) };
    }
    catch (const InvalidParameter& error)
    {
      return error.what();
    }
    return "no error";
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto has = [&](const std::string& text, const char* part)
  { EXPECT_NE(text.find(part), std::string::npos) << text; };
  has(message({}), "at least 3");
  has(message({ Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0), Vec3(0, 0, 0) }), "at least 3");
  has(message({ Vec3(0, 0, 0), Vec3(1, nan, 0), Vec3(1, 1, 0) }), "finite");
  has(message({ Vec3(0, 0, 0), Vec3(1, 1, 0), Vec3(2, 2, 0) }), "without area");
  has(message({ Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0.1), Vec3(0, 1, 0) }), "in one plane");
  // An eight with unequal halves, a touch at a corner, and a spike.
  has(message({ Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0.5, 2, 0), Vec3(1.5, 2, 0) }), "meet");
  has(
    message({ Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 2, 0), Vec3(1, 0, 0), Vec3(0, 2, 0) }), "meet");
  has(
    message({ Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(2, 1, 0), Vec3(3, 1, 0), Vec3(0, 1, 0) }), "meet");
  EXPECT_THROW(TriangleSkeleton(Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(2, 2, 2)), InvalidParameter);
  EXPECT_THROW(RectangleSkeleton(Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(-3, 0, 0)), InvalidParameter);
  EXPECT_THROW(EllipsoidSkeleton(Vec3::Zero(), Vec3(1, 0, 1)), InvalidParameter);
  EXPECT_THROW(EllipsoidSkeleton(Vec3::Zero(), Vec3(1, 1e-9, 1)), InvalidParameter);
}

} // namespace
} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
// Direct meshes of plates of any outline: what is filled by the lattice, and what is too narrow.
#include "core/mesh/MeshChecks.h"
#include "core/skeletons/LongestEdge.h"
#include "tests/core/skeletons/PlateCases.h"
#include "tests/support/MeshShape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace hybridtree
{
namespace
{

using test::Random;

constexpr double kRadius = 0.05;

double areaOf(const TriangleMesh& mesh)
{
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    area += 0.5 * areaNormal(mesh, t).norm();
  }
  return area;
}

void expectGood(const PolygonSkeleton& skeleton, double length, const std::string& name)
{
  const auto mesh = skeleton.offsetMesh(kRadius, length);
  ASSERT_TRUE(mesh) << name;
  EXPECT_TRUE(isClosedManifold(*mesh)) << name;
  EXPECT_LE(longestEdge(*mesh), length) << name;
  std::vector<double> x, y, z, distance(mesh->points.size());
  for (const Vec3& p : mesh->points)
  {
    x.push_back(p.x()), y.push_back(p.y()), z.push_back(p.z());
  }
  skeleton.distance({ x.data(), y.data(), z.data(), x.size() }, distance.data());
  for (const double d : distance)
  {
    ASSERT_NEAR(d, kRadius, 1e-12) << name;
  }
  for (const Vec3& normal : mesh->normals)
  {
    ASSERT_NEAR(normal.norm(), 1.0, 1e-12) << name;
  }
}

// Corners at random distances around the origin: simple, and mostly not convex.
std::vector<Vec3> roughStar(Random& random)
{
  const int count = random.integer(3, 12);
  std::vector<Vec3> corners;
  for (int k = 0; k < count; ++k)
  {
    const double turn = 2.0 * EIGEN_PI * (k + random.uniform(-0.2, 0.2)) / count;
    corners.push_back(random.uniform(0.6, 1.4) * Vec3(std::cos(turn), std::sin(turn), 0.0));
  }
  return corners;
}

TEST(PlateMesh, FacesOfAnyOutlineAreFilled)
{
  Random random(81);
  for (int round = 0; round < 60; ++round)
  {
    const PolygonSkeleton skeleton(roughStar(random));
    if (!skeleton.offsetMesh(kRadius, 0.5))
    {
      continue; // a corner too tight for its rim
    }
    const double length = random.chance(0.5) ? 0.03 : random.uniform(0.05, 0.6);
    expectGood(skeleton, length, "round " + std::to_string(round));
    if (length == 0.03)
    {
      const auto mesh = skeleton.offsetMesh(kRadius, length);
      EXPECT_LE(test::shapeOf(*mesh).needles, 0.01) << "round " << round;
    }
  }
}

TEST(PlateMesh, NarrowOutlinesAndNecksAreFilled)
{
  // No lattice fits into the first, and two pieces of it into the second and third.
  const std::vector<std::vector<Vec3>> outlines = {
    { Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0.3, 0.1, 0) },
    { Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0.45, 0), Vec3(2, 0.45, 0), Vec3(2, 0, 0),
      Vec3(3, 0, 0), Vec3(3, 1, 0), Vec3(2, 1, 0), Vec3(2, 0.55, 0), Vec3(1, 0.55, 0),
      Vec3(1, 1, 0), Vec3(0, 1, 0) },
    { Vec3(0, 0, 0), Vec3(1, 0.45, 0), Vec3(2.2, 0.1, 0), Vec3(1.9, 1.2, 0), Vec3(1, 0.56, 0),
      Vec3(0, 1, 0) },
  };
  for (const auto& outline : outlines)
  {
    for (const double length : { 0.02, 0.1, 0.3, 2.0 })
    {
      expectGood(PolygonSkeleton(outline), length, "edge length " + std::to_string(length));
    }
  }
}

// Two windings of a spiral: its lattice is one piece, and long.
TEST(PlateMesh, LongOutlinesAreFilled)
{
  std::vector<Vec3> outline;
  for (int side = 0; side < 2; ++side)
  {
    for (int k = 0; k <= 60; ++k)
    {
      const double turn = 4.0 * EIGEN_PI * (side ? 60 - k : k) / 60.0;
      const double out = 0.5 + 0.12 * turn + (side ? 0.0 : 0.4);
      outline.push_back(out * Vec3(std::cos(turn), std::sin(turn), 0.0));
    }
  }
  expectGood(PolygonSkeleton(outline), 0.05, "spiral");
}

// Whether the mirror image of the mesh is the mesh: points, and triangles by their middles.
void expectMirrored(const TriangleMesh& mesh, const Vec3& across)
{
  std::vector<Vec3> here = mesh.points;
  for (const auto& [a, b, c] : mesh.triangles)
  {
    here.push_back((mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0);
  }
  const Vec3 order(0.61, 0.57, 0.55);
  const auto before = [&](const Vec3& p, const Vec3& q) { return order.dot(p) < order.dot(q); };
  std::sort(here.begin(), here.end(), before);
  int missing = 0;
  for (const Vec3& p : here)
  {
    const Vec3 image = p - 2.0 * across.dot(p) * across;
    const Vec3 off = 1e-9 * order;
    const auto begin = std::lower_bound(here.begin(), here.end(), Vec3(image - off), before);
    const auto end = std::upper_bound(begin, here.end(), Vec3(image + off), before);
    missing += std::none_of(begin, end, [&](const Vec3& q) { return (q - image).norm() <= 1e-9; });
  }
  EXPECT_EQ(missing, 0) << "of " << here.size();
}

TEST(PlateMesh, IsSymmetricWhereTheOutlineIs)
{
  const std::vector<std::vector<Vec3>> outlines = {
    { Vec3(-0.4, 0, 0), Vec3(0.4, 0, 0), Vec3(0, 1.7, 0) },                // tall
    { Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0, 0.6, 0) },                    // flat
    { Vec3(0, 0, 0), Vec3(1, 0.9, 0), Vec3(0, 2.3, 0), Vec3(-1, 0.9, 0) }, // kite
    { Vec3(-1, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 1, 0), Vec3(-0.5, 1, 0) },  // trapezium
    { Vec3(-1, 0, 0), Vec3(0, 0.5, 0), Vec3(1, 0, 0), Vec3(0, 1.6, 0) },   // arrow
  };
  for (const auto& outline : outlines)
  {
    for (std::size_t first = 0; first < outline.size(); ++first)
    {
      std::vector<Vec3> turned = outline;
      std::rotate(turned.begin(), turned.begin() + std::ptrdiff_t(first), turned.end());
      for (const double length : { 0.04, 0.13 })
      {
        const auto mesh = PolygonSkeleton(turned).offsetMesh(kRadius, length);
        ASSERT_TRUE(mesh);
        EXPECT_TRUE(isClosedManifold(*mesh));
        SCOPED_TRACE(std::to_string(outline.size()) + " corners from " + std::to_string(first) +
          ", edge length " + std::to_string(length));
        expectMirrored(*mesh, Vec3::UnitX());
        expectMirrored(*mesh, Vec3::UnitZ());
      }
    }
  }
}

TEST(PlateMesh, FacesHaveTheAreaOfTheOutline)
{
  const double area = 3.0; // of the letter L; the rims' is known, too
  const double length = 8.0;
  const auto mesh = PolygonSkeleton(test::letterL()).offsetMesh(kRadius, 0.02);
  ASSERT_TRUE(mesh);
  const double rims = EIGEN_PI * kRadius * length;
  EXPECT_NEAR(areaOf(*mesh), 2.0 * area + rims, 0.05 * rims);
}

} // namespace
} // namespace hybridtree

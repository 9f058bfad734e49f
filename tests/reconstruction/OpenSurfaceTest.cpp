// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Convection.h"
#include "reconstruction/Holes.h"
#include "reconstruction/LevelOfDetail.h"

#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "tests/reconstruction/DemoPoints.h"
#include "tests/reconstruction/OpenSamples.h"
#include "tests/reconstruction/Samples.h"
#include "tests/support/CancelAt.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <tuple>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

double areaOf(const TriangleMesh& mesh)
{
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    area += 0.5 * areaNormal(mesh, t).norm();
  }
  return area;
}

class SphereWithoutCap : public testing::TestWithParam<double>
{
};

TEST_P(SphereWithoutCap, IsADiscLeftOpenAndABallClosed)
{
  const double top = GetParam();
  const double pi = std::acos(-1.0);
  for (const std::uint64_t seed : { 1u, 2u })
  {
    const std::vector<Vec3> points =
      onlyWhere(randomSphere(4000, seed), [&](const Vec3& p) { return p.z() < top; });
    const ReconstructedSurface sheet = reconstruct(points, open());
    expectManifold(sheet, points);
    const MeshReport report = checkMesh(sheet.mesh);
    EXPECT_EQ(report.components, 1u);
    EXPECT_EQ(borderLoops(sheet.mesh), 1u) << report.describe();
    EXPECT_EQ(report.eulerCharacteristic, 1) << report.describe();
    EXPECT_NEAR(areaOf(sheet.mesh), 2.0 * pi * (1.0 + top), 0.35) << "seed " << seed;
    EXPECT_GT(sheet.mesh.points.size(), points.size() * 97 / 100);
    // Outward, though nobody said where that is.
    EXPECT_GT(sheet.mesh.normals[0].dot(sheet.mesh.points[0]), 0.0);

    const ReconstructedSurface solid = reconstruct(points);
    expectManifold(solid, points);
    EXPECT_TRUE(checkMesh(solid.mesh).closedManifold());
    EXPECT_EQ(checkMesh(solid.mesh).genus(), 0);
    const double volume = pi * (2.0 / 3.0 + top - top * top * top / 3.0);
    EXPECT_NEAR(signedVolume(solid.mesh), volume, 0.03 * volume);
  }
}

INSTANTIATE_TEST_SUITE_P(Heights, SphereWithoutCap, testing::Values(0.9, 0.7, 0.3, 0.0));

TEST(OpenSurface, LeavesNothingOpenWhereNothingIsMissing)
{
  for (const std::uint64_t seed : { 3u, 4u })
  {
    const std::vector<Vec3> points = randomTorus(1.0, 0.4, 6000, seed);
    const ReconstructedSurface surface = reconstruct(points, open());
    expectManifold(surface, points);
    EXPECT_TRUE(checkMesh(surface.mesh).closedManifold()) << checkMesh(surface.mesh).describe();
    EXPECT_EQ(checkMesh(surface.mesh).genus(), 1);
  }
}

TEST(OpenSurface, FindsEachHoleOfATorus)
{
  const std::vector<Vec3> points = onlyWhere(randomTorus(1.0, 0.4, 5000, 5),
    [](const Vec3& p)
    { return (p - Vec3(1.4, 0, 0)).norm() > 0.25 && (p - Vec3(-1, 0, 0.4)).norm() > 0.2; });
  const ReconstructedSurface surface = reconstruct(points, open());
  expectManifold(surface, points);
  EXPECT_EQ(borderLoops(surface.mesh), 2u) << checkMesh(surface.mesh).describe();
  EXPECT_EQ(checkMesh(surface.mesh).eulerCharacteristic, -2);
  const MeshReport solid = checkMesh(reconstruct(points).mesh);
  EXPECT_TRUE(solid.closedManifold()) << solid.describe();
  EXPECT_EQ(solid.genus(), 1);
}
TEST(OpenSurface, TellsOfWhatItCloses)
{
  const std::vector<Vec3> all = randomSphere(6000, 33);
  EXPECT_TRUE(reconstruct(all).warnings.empty());
  const std::vector<Vec3> half = onlyWhere(all, [](const Vec3& p) { return p.z() < 0.0; });
  EXPECT_EQ(reconstruct(half).warnings.size(), 1u);
  EXPECT_TRUE(reconstruct(half, open()).warnings.empty());
}

TEST(OpenSurface, LooksWhereTheNormalsDo)
{
  const std::vector<Vec3> points = landscape(4000, 7);
  for (const double up : { 1.0, -1.0 })
  {
    ConvectionOptions options = open();
    options.normals.assign(points.size(), Vec3(0.0, 0.0, up));
    const ReconstructedSurface surface = reconstruct(points, options);
    expectManifold(surface, points);
    EXPECT_GT(surface.mesh.points.size(), points.size() * 95 / 100);
    EXPECT_GT(up * surface.mesh.normals[0].z(), 0.0);
  }
}

TEST(Normals, TellOfCavities)
{
  // A shell, and a ball in its cavity.
  std::vector<Vec3> points;
  ConvectionOptions options;
  for (const auto& [radius, sign, count] :
    { std::tuple(1.0, 1.0, 6000), std::tuple(0.7, -1.0, 3000), std::tuple(0.4, 1.0, 1000) })
  {
    for (const Vec3& p : randomSphere(std::size_t(count), 8))
    {
      points.push_back(radius * p);
      options.normals.push_back(sign * p);
    }
  }
  const ReconstructedSurface surface = reconstruct(points, options);
  expectManifold(surface, points);
  const MeshReport report = checkMesh(surface.mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.components, 3u);
  const double volume = 4.0 / 3.0 * std::acos(-1.0) * (1.0 - std::pow(0.7, 3) + std::pow(0.4, 3));
  EXPECT_NEAR(signedVolume(surface.mesh), volume, 0.03 * volume);
  options.normals.clear();
  EXPECT_EQ(checkMesh(reconstruct(points, options).mesh).components, 1u);
}

TEST(Normals, MayBeMissingOrWrongHereAndThere)
{
  const std::vector<Vec3> points = randomTorus(1.0, 0.4, 5000, 9);
  Random random(10);
  ConvectionOptions options;
  for (const Vec3& p : points)
  {
    const Vec3 ring = Vec3(p.x(), p.y(), 0.0).normalized();
    const Vec3 normal = p - ring;
    options.normals.push_back(
      random.chance(0.05) ? -normal : (random.chance(0.3) ? Vec3(Vec3::Zero()) : normal));
  }
  const ReconstructedSurface surface = reconstruct(points, options);
  expectManifold(surface, points);
  EXPECT_TRUE(checkMesh(surface.mesh).closedManifold());
  EXPECT_EQ(checkMesh(surface.mesh).genus(), 1);
  EXPECT_EQ(checkMesh(surface.mesh).components, 1u);
}

TEST(Normals, AreChecked)
{
  const std::vector<Vec3> points = randomSphere(100, 11);
  ConvectionOptions options;
  options.normals.assign(99, Vec3(1, 0, 0));
  EXPECT_THROW(reconstruct(points, options), InvalidParameter);
  options.normals.assign(100, Vec3(1, 0, 0));
  options.normals[42].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(reconstruct(points, options), InvalidGeometry);
  EXPECT_THROW(reconstruct(points, LevelOfDetail{ 0.0, 50 }, options), InvalidGeometry);
}

TEST(OpenSurface, AtALevelOfDetailToo)
{
  const std::vector<Vec3> points =
    onlyWhere(randomSphere(8000, 12), [](const Vec3& p) { return p.z() < 0.6; });
  const ReconstructedSurface surface = reconstruct(points, LevelOfDetail{ 0.0, 1500 }, open());
  expectManifold(surface, points);
  EXPECT_EQ(borderLoops(surface.mesh), 1u);
  EXPECT_EQ(checkMesh(surface.mesh).eulerCharacteristic, 1);
}

// A level of detail follows solids only: it must not be silent about the rest.
TEST(OpenSurface, SaysWhereALevelOfDetailMissesIt)
{
  const std::vector<Vec3> points = landscape(4000, 16);
  const ReconstructedSurface surface = reconstruct(points, LevelOfDetail{ 0.0, 1500 }, open());
  expectManifold(surface, points);
  EXPECT_FALSE(surface.warnings.empty() && surface.mesh.points.size() < 1300)
    << surface.mesh.points.size();
}

TEST(OpenSurface, TellsOfPointsTooFarOffToSeeHoles)
{
  std::vector<Vec3> points = randomSphere(1000, 17);
  points.push_back({ 1e9, 0.0, 0.0 });
  EXPECT_THROW(reconstruct(points, open()), InvalidGeometry);
  EXPECT_NO_THROW(reconstruct(points));
}

TEST(OpenSurface, RefusesAFactorThatMeansNothing)
{
  ConvectionOptions options = open();
  options.holeFactor = 0.99;
  EXPECT_THROW(reconstruct(randomSphere(100, 13), options), InvalidParameter);
}

TEST(OpenSurface, CanBeCancelled)
{
  ReconstructedSurface surface = reconstruct(randomSphere(500, 14));
  EXPECT_THROW(openHoles(surface, randomSphere(500, 14), 5.0, CancelAt(0)), Cancelled);
}

// The triangles of a mesh above a plane, and the points too.
struct CutMesh
{
  TriangleMesh mesh;
  std::vector<Vec3> points;
};

CutMesh cutMesh(const TriangleMesh& source, double share, std::size_t count)
{
  const std::vector<Vec3> all = randomSurfacePoints(source, count, 15);
  Box3 box;
  for (const Vec3& p : all)
  {
    box.extend(p);
  }
  const double cut = box.min().y() + share * box.sizes().y();
  CutMesh result;
  result.points = onlyWhere(all, [&](const Vec3& p) { return p.y() > cut; });
  result.mesh.points = source.points;
  for (const Triangle& t : source.triangles)
  {
    if (std::all_of(t.begin(), t.end(), [&](auto v) { return source.points[v].y() > cut; }))
    {
      result.mesh.triangles.push_back(t);
    }
  }
  return result;
}

struct MeshWithHole
{
  const char* name;
  double share; // of the extent along y that is cut off
};

void PrintTo(const MeshWithHole& mesh, std::ostream* out)
{
  *out << mesh.name;
}

class OpenScan : public testing::TestWithParam<MeshWithHole>
{
};

// Real meshes, sampled at random but for a part that is cut off: the same borders, and the same
// handles, as the mesh has when it is cut.
TEST_P(OpenScan, HasTheBordersOfTheMesh)
{
  const auto [name, share] = GetParam();
  const std::optional<TriangleMesh> source = demoMesh(name);
  if (!source)
  {
    GTEST_SKIP() << name << " needs Debian's libcgal-demo: apt install libcgal-demo";
  }
  const auto [wanted, points] = cutMesh(*source, share, 20000);
  const ReconstructedSurface sheet = reconstruct(points, open());
  expectManifold(sheet, points);
  const MeshReport report = checkMesh(sheet.mesh);
  EXPECT_GT(sheet.mesh.points.size(), points.size() * 95 / 100);
  EXPECT_EQ(report.components, checkMesh(wanted).components);
  EXPECT_EQ(borderLoops(sheet.mesh), borderLoops(wanted)) << report.describe();
  EXPECT_EQ(report.eulerCharacteristic, checkMesh(wanted).eulerCharacteristic);
  const ReconstructedSurface solid = reconstruct(points);
  EXPECT_TRUE(checkMesh(solid.mesh).closedManifold());
  EXPECT_EQ(checkMesh(solid.mesh).components, 1u);
  EXPECT_GT(solid.mesh.points.size(), points.size() * 95 / 100);
}

INSTANTIATE_TEST_SUITE_P(DemoMeshes, OpenScan,
  testing::Values(MeshWithHole{ "bear.off", 0.2 }, MeshWithHole{ "hand.off", 0.3 }));

} // namespace

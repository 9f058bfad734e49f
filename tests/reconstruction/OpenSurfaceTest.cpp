// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Convection.h"
#include "reconstruction/Holes.h"
#include "reconstruction/LevelOfDetail.h"

#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "tests/reconstruction/DemoPoints.h"
#include "tests/reconstruction/Samples.h"
#include "tests/support/CancelAt.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

ConvectionOptions open()
{
  ConvectionOptions options;
  options.closeHoles = false;
  return options;
}

std::vector<Vec3> onlyWhere(std::vector<Vec3> points, const std::function<bool(const Vec3&)>& keep)
{
  points.erase(
    std::remove_if(points.begin(), points.end(), [&](const Vec3& p) { return !keep(p); }),
    points.end());
  return points;
}

// Loops of open edges. \pre the mesh is a manifold with boundary.
std::size_t borderLoops(const TriangleMesh& mesh)
{
  std::map<std::int32_t, std::int32_t> next;
  for (const Triangle& t : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      next[t[k]] = -1;
    }
  }
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  for (const Triangle& t : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      ++edges[{ t[k], t[(k + 1) % 3] }];
    }
  }
  for (const auto& [edge, count] : edges)
  {
    if (edges.count({ edge.second, edge.first }) == 0)
    {
      next[edge.first] = edge.second;
    }
  }
  std::size_t loops = 0;
  for (auto& [from, to] : next)
  {
    if (to >= 0)
    {
      ++loops;
      for (std::int32_t at = from; at >= 0;)
      {
        at = std::exchange(next[at], -1);
      }
    }
  }
  return loops;
}

// An oriented manifold with boundary, of points of the input.
void expectManifold(const ReconstructedSurface& surface, const std::vector<Vec3>& points)
{
  const MeshReport report = checkMesh(surface.mesh);
  EXPECT_TRUE(report.oriented() && report.edgeManifold() && report.vertexManifold())
    << report.describe();
  EXPECT_EQ(report.unusedPoints, 0u);
  ASSERT_EQ(surface.pointIds.size(), surface.mesh.points.size());
  ASSERT_EQ(surface.mesh.normals.size(), surface.mesh.points.size());
  for (std::size_t k = 0; k < surface.pointIds.size(); ++k)
  {
    ASSERT_EQ(surface.mesh.points[k], points.at(surface.pointIds[k]));
  }
}

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

// A landscape: neither closed nor nearly so.
std::vector<Vec3> landscape(std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  std::vector<Vec3> points(count);
  for (Vec3& p : points)
  {
    const double x = random.uniform(0.0, 4.0);
    const double y = random.uniform(0.0, 3.0);
    p = { x, y, 0.3 * std::sin(3.0 * x) * std::cos(2.0 * y) };
  }
  return points;
}

double heightOf(int shape, double x, double y)
{
  return shape == 0
    ? 0.3 * std::sin(3.0 * x) * std::cos(2.0 * y)
    : 0.6 * std::exp(-2.0 * ((x - 2.0) * (x - 2.0) + (y - 1.5) * (y - 1.5))) + // a hill, and waves
      0.02 * std::sin(15.0 * x) * std::sin(13.0 * y);
}

class Landscape : public testing::TestWithParam<int>
{
};

// One sheet that looks to one side, though nobody says which: not half a shell on both. Among
// random points a handle may be left.
TEST_P(Landscape, IsOneSheet)
{
  for (const std::uint64_t seed : { 20u, 21u })
  {
    std::vector<Vec3> points = landscape(10000, seed);
    for (Vec3& p : points)
    {
      p.z() = heightOf(GetParam(), p.x(), p.y());
    }
    const ReconstructedSurface surface = reconstruct(points, open());
    expectManifold(surface, points);
    const MeshReport report = checkMesh(surface.mesh);
    EXPECT_EQ(report.components, 1u);
    EXPECT_GE(report.eulerCharacteristic, -3) << report.describe();
    EXPECT_GT(surface.mesh.points.size(), points.size() * 97 / 100);
    double up = 0.0;
    for (std::size_t t = 0; t < surface.mesh.triangles.size(); ++t)
    {
      up += 0.5 * areaNormal(surface.mesh, t).z();
    }
    EXPECT_GT(std::abs(up), 0.95 * 4.0 * 3.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Landscape, testing::Range(0, 2));

// A height field over an outline in [0, 4] x [0, 3], steeper than a watershed of sizes can tell.
struct Terrain
{
  const char* name;
  double (*height)(double x, double y);
  bool (*covers)(double x, double y);
  double steepest; // greatest area over a unit of the plane
  std::size_t borders = 1;
};

void PrintTo(const Terrain& terrain, std::ostream* out)
{
  *out << terrain.name;
}

bool everywhere(double, double)
{
  return true;
}

double waves(double x, double y)
{
  return heightOf(0, x, y);
}

double cutHills(double x, double y)
{
  const auto hill = [&](double u, double v)
  { return std::exp(-2.0 * ((x - u) * (x - u) + (y - v) * (y - v))); };
  return 0.8 * hill(0.2, 0.1) + 0.5 * hill(4.0, 2.0) + 0.02 * std::sin(7.0 * x) * std::sin(6.0 * y);
}

double canyon(double x, double y)
{
  const double fromMiddle = std::abs(x - 2.0 - 0.3 * std::sin(2.0 * y));
  return 0.6 / (1.0 + std::exp(-50.0 * (fromMiddle - 0.3))) + 0.03 * std::sin(5.0 * x + y);
}

const Terrain kTerrains[] = {
  { "HillsCutByTheRim", cutHills, everywhere, 2.0 },
  { "SharpValley", [](double x, double) { return 2.0 * std::abs(x - 2.0); }, everywhere, 2.3 },
  { "Ridges", [](double x, double) { return 1.2 * std::abs(x - std::floor(x) - 0.5); }, everywhere,
    1.6 },
  { "Canyon", canyon, everywhere, 8.0 },
  { "LShape", waves, [](double x, double y) { return x < 1.3 || y < 1.0; }, 1.4 },
  { "Lake", waves, [](double x, double y) { return std::hypot(x - 2.0, y - 1.5) > 0.6; }, 1.4, 2 },
  { "Saddle",
    [](double x, double y) { return 0.3 * ((x - 2.0) * (x - 2.0) - (y - 1.5) * (y - 1.5)); },
    everywhere, 1.8 },
};

struct TerrainPoints
{
  std::vector<Vec3> points;
  std::vector<Vec3> normals;
};

// Every piece of the surface's area alike.
TerrainPoints sampleOf(const Terrain& terrain, std::size_t count, std::uint64_t seed)
{
  constexpr double kStep = 1e-5;
  Random random(seed);
  TerrainPoints sample;
  while (sample.points.size() < count)
  {
    const double x = random.uniform(0.0, 4.0);
    const double y = random.uniform(0.0, 3.0);
    const auto slope = [&](double dx, double dy)
    { return (terrain.height(x + dx, y + dy) - terrain.height(x - dx, y - dy)) / (2.0 * kStep); };
    const Vec3 normal = Vec3(-slope(kStep, 0.0), -slope(0.0, kStep), 1.0);
    if (terrain.covers(x, y) && random.chance(normal.norm() / terrain.steepest))
    {
      sample.points.push_back({ x, y, terrain.height(x, y) });
      sample.normals.push_back(normal.normalized());
    }
  }
  return sample;
}

// One sheet through all points, its rim the only border.
void expectOneSheet(const TerrainPoints& sample, const ReconstructedSurface& surface,
  std::size_t borders, const std::string& what)
{
  SCOPED_TRACE(what);
  expectManifold(surface, sample.points);
  const MeshReport report = checkMesh(surface.mesh);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(borderLoops(surface.mesh), borders);
  EXPECT_EQ(report.eulerCharacteristic, 2 - static_cast<std::int64_t>(borders))
    << report.describe();
  EXPECT_GT(surface.mesh.points.size(), sample.points.size() * 97 / 100);
  std::size_t alike = 0;
  for (std::size_t k = 0; k < surface.pointIds.size(); ++k)
  {
    alike += surface.mesh.normals[k].dot(sample.normals[surface.pointIds[k]]) > 0.0;
  }
  // To one side: a deep valley may be taken for a bowl.
  EXPECT_GT(std::max(alike, surface.pointIds.size() - alike), surface.pointIds.size() * 97 / 100);
}

class OpenTerrain : public testing::TestWithParam<Terrain>
{
};

TEST_P(OpenTerrain, IsOneSheetThroughAllPoints)
{
  for (const std::uint64_t seed : { 1u, 2u })
  {
    const TerrainPoints sample = sampleOf(GetParam(), 6000, seed);
    ConvectionOptions options = open();
    expectOneSheet(sample, reconstruct(sample.points, options), GetParam().borders,
      "seed " + std::to_string(seed) + " without normals");
    options.normals = sample.normals;
    expectOneSheet(sample, reconstruct(sample.points, options), GetParam().borders,
      "seed " + std::to_string(seed) + " with normals");
  }
}

class ClosedTerrain : public testing::TestWithParam<Terrain>
{
};

// Closed towards the hull. Where the hull touches the surface on both sides, handles may be left.
TEST_P(ClosedTerrain, IsTheSkinOfOneSolid)
{
  const TerrainPoints sample = sampleOf(GetParam(), 6000, 3);
  ConvectionOptions options;
  for (const bool known : { false, true })
  {
    options.normals = known ? sample.normals : std::vector<Vec3>();
    const ReconstructedSurface surface = reconstruct(sample.points, options);
    expectManifold(surface, sample.points);
    const MeshReport report = checkMesh(surface.mesh);
    EXPECT_TRUE(report.closedManifold()) << report.describe();
    EXPECT_EQ(report.components, 1u);
    EXPECT_GT(surface.mesh.points.size(), sample.points.size() * 97 / 100);
  }
}

TEST(OpenSurface, TellsOfWhatItCloses)
{
  const std::vector<Vec3> all = randomSphere(6000, 33);
  EXPECT_TRUE(reconstruct(all).warnings.empty());
  const std::vector<Vec3> half = onlyWhere(all, [](const Vec3& p) { return p.z() < 0.0; });
  EXPECT_EQ(reconstruct(half).warnings.size(), 1u);
  EXPECT_TRUE(reconstruct(half, open()).warnings.empty());
}

INSTANTIATE_TEST_SUITE_P(Shapes, ClosedTerrain,
  testing::Values(kTerrains[1], kTerrains[2], kTerrains[4], kTerrains[5], kTerrains[6]),
  [](const auto& info) { return info.param.name; });

INSTANTIATE_TEST_SUITE_P(Shapes, OpenTerrain, testing::ValuesIn(kTerrains),
  [](const auto& info) { return info.param.name; });

TEST(OpenSurface, OfARegularGridIsOneSheet)
{
  for (const double jitter : { 0.0, 0.8 })
  {
    Random random(30);
    TerrainPoints sample;
    for (int i = 0; i <= 100; ++i)
    {
      for (int j = 0; j <= 75; ++j)
      {
        const double x = 0.04 * (i + jitter * random.uniform(-0.5, 0.5));
        const double y = 0.04 * (j + jitter * random.uniform(-0.5, 0.5));
        sample.points.push_back({ x, y, heightOf(1, x, y) });
        sample.normals.push_back(Vec3::UnitZ());
      }
    }
    expectOneSheet(
      sample, reconstruct(sample.points, open()), 1, "jitter " + std::to_string(jitter));
  }
}

// A turn of the points turns the sheet: nothing is said of up, so it may look the other way.
TEST(OpenSurface, DoesNotDependOnAxes)
{
  Random random(31);
  for (const Terrain& terrain : { kTerrains[0], kTerrains[1] })
  {
    const TerrainPoints sample = sampleOf(terrain, 4000, 32);
    const Mat3 turn = random.rotation();
    std::vector<Vec3> turned;
    for (const Vec3& p : sample.points)
    {
      turned.push_back(turn * p + Vec3(10.0, -20.0, 30.0));
    }
    const ReconstructedSurface surface = reconstruct(turned, open());
    expectManifold(surface, turned);
    EXPECT_EQ(checkMesh(surface.mesh).components, 1u);
    EXPECT_EQ(borderLoops(surface.mesh), 1u) << terrain.name;
    EXPECT_EQ(checkMesh(surface.mesh).eulerCharacteristic, 1) << terrain.name;
    EXPECT_GT(surface.mesh.points.size(), turned.size() * 97 / 100);
  }
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

// SPDX-License-Identifier: BSD-3-Clause
// Height fields, neither closed nor nearly so: one sheet through all points, or the skin of one
// solid.
#include "reconstruction/Convection.h"

#include "core/mesh/MeshChecks.h"
#include "tests/reconstruction/OpenSamples.h"
#include "tests/reconstruction/Samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>
#include <vector>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

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

} // namespace

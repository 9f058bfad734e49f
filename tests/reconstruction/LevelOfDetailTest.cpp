// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/LevelOfDetail.h"
#include "reconstruction/DynamicReconstruction.h"
#include "reconstruction/PointOctree.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/mesh/MeshChecks.h"
#include "tests/reconstruction/MeshDistances.h"
#include "tests/reconstruction/Samples.h"
#include "tests/support/CancelAt.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

void expectSound(const ReconstructedSurface& surface, const std::vector<Vec3>& points, int genus)
{
  const MeshReport report = checkMesh(surface.mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.genus(), genus);
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.unusedPoints, 0u);
  EXPECT_GT(signedVolume(surface.mesh), 0.0);
  ASSERT_EQ(surface.pointIds.size(), surface.mesh.points.size());
  for (std::size_t k = 0; k < surface.pointIds.size(); ++k)
  {
    ASSERT_EQ(surface.mesh.points[k], points.at(surface.pointIds[k])) << "vertex " << k;
  }
}

TEST(LevelOfDetail, HonoursTheTolerance)
{
  const std::vector<Vec3> points = randomTorus(1.0, 0.4, 20000, 1);
  std::size_t before = 0;
  for (const double tolerance : { 0.03, 0.01, 0.003, 0.001 })
  {
    const ReconstructedSurface surface = reconstruct(points, LevelOfDetail{ tolerance, 0 });
    expectSound(surface, points, 1);
    EXPECT_TRUE(surface.warnings.empty()) << surface.warnings[0];
    EXPECT_LE(farthest(points, surface.mesh), tolerance * (1.0 + 1e-12));
    EXPECT_GT(surface.mesh.points.size(), before);
    before = surface.mesh.points.size();
  }
  EXPECT_LT(before, points.size() / 2);
}

TEST(LevelOfDetail, MeetsTheNumberOfVertices)
{
  const std::vector<Vec3> points = randomTorus(1.0, 0.4, 20000, 2);
  for (const std::size_t wanted : { 800u, 3000u, 9000u })
  {
    const ReconstructedSurface surface = reconstruct(points, LevelOfDetail{ 0.0, wanted });
    expectSound(surface, points, 1);
    EXPECT_NEAR(double(surface.mesh.points.size()), double(wanted), 0.05 * double(wanted));
  }
  // All there are.
  const ReconstructedSurface all = reconstruct(points, LevelOfDetail{ 0.0, 50000 });
  EXPECT_GT(all.mesh.points.size(), 19000u);
}

TEST(LevelOfDetail, MakesFlatPartsOfLargeTriangles)
{
  // A box with rounded edges.
  Random random(3);
  std::vector<Vec3> points;
  while (points.size() < 30000)
  {
    const Vec3 p = random.inBox(Box3(Vec3(-1, -1, -1), Vec3(1, 1, 1)));
    const Vec3 core = p.cwiseMax(-0.7).cwiseMin(0.7);
    if ((p - core).norm() > 0.05)
    {
      points.push_back(core + 0.3 * (p - core).normalized());
    }
  }
  const ReconstructedSurface surface = reconstruct(points, LevelOfDetail{ 0.005, 0 });
  expectSound(surface, points, 0);
  EXPECT_LE(farthest(points, surface.mesh), 0.005 * (1.0 + 1e-12));
  const auto isFlat = [](const Vec3& p) { return (p.cwiseAbs().array() < 0.69).count() == 2; };
  std::size_t flat = 0;
  for (const Vec3& p : surface.mesh.points)
  {
    flat += isFlat(p);
  }
  const auto flatPoints = std::count_if(points.begin(), points.end(), isFlat);
  const double shareOfInput = double(flatPoints) / double(points.size());
  EXPECT_LT(double(flat) / double(surface.mesh.points.size()), 0.6 * shareOfInput);
}

struct MeshCase
{
  const char* name;
  int genus;
};

void PrintTo(const MeshCase& mesh, std::ostream* out)
{
  *out << mesh.name;
}

class LevelOfDetailOfMesh : public testing::TestWithParam<MeshCase>
{
};

// Dense samples of closed meshes, thinned: the genus stays.
TEST_P(LevelOfDetailOfMesh, KeepsTheGenus)
{
  const auto [name, genus] = GetParam();
  const std::optional<TriangleMesh> source = demoMesh(name);
  if (!source)
  {
    GTEST_SKIP() << name << " needs Debian's libcgal-demo: apt install libcgal-demo";
  }
  const std::vector<Vec3> points = randomSurfacePoints(*source, 40000, 1);
  const double diagonal = source->bounds().diagonal().norm();
  const ReconstructedSurface surface = reconstruct(points, LevelOfDetail{ 0.001 * diagonal, 0 });
  expectSound(surface, points, genus);
  EXPECT_LT(surface.mesh.points.size(), points.size() / 2);
  // What the surface cannot come to is told of.
  if (surface.warnings.empty())
  {
    EXPECT_LE(farthest(points, surface.mesh), 0.001 * diagonal * (1.0 + 1e-12));
  }
}

INSTANTIATE_TEST_SUITE_P(DemoMeshes, LevelOfDetailOfMesh,
  testing::Values(MeshCase{ "elephant.off", 3 }, MeshCase{ "bear.off", 0 },
    MeshCase{ "eight.off", 2 }, MeshCase{ "anchor.off", 4 }, MeshCase{ "hand.off", 0 },
    MeshCase{ "small_cube.off", 0 }));

TEST(LevelOfDetail, IsTheSameEveryTime)
{
  const std::vector<Vec3> points = randomTorus(1.0, 0.4, 5000, 4);
  const ReconstructedSurface one = reconstruct(points, LevelOfDetail{ 0.01, 0 });
  const ReconstructedSurface two = reconstruct(points, LevelOfDetail{ 0.01, 0 });
  EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
  EXPECT_EQ(one.pointIds, two.pointIds);
}

TEST(LevelOfDetail, SurvivesAnything)
{
  Random random(5);
  const Box3 unit(Vec3::Zero(), Vec3::Ones());
  std::vector<std::vector<Vec3>> inputs;
  for (const std::size_t count : { 5u, 20u, 100u, 2000u })
  {
    std::vector<Vec3> cloud(count);
    std::generate(cloud.begin(), cloud.end(), [&] { return random.inBox(unit); });
    inputs.push_back(cloud);
  }
  std::vector<Vec3> grid;
  for (int k = 0; k < 512; ++k)
  {
    grid.push_back({ double(k % 8), double(k / 8 % 8), double(k / 64) });
  }
  inputs.push_back(grid);
  inputs.push_back(grid);
  inputs.back().insert(inputs.back().end(), grid.begin(), grid.end());
  inputs.push_back(randomSphere(1000, 6));
  inputs.back().push_back({ 1e6, 0.0, 0.0 });
  for (std::size_t k = 0; k < inputs.size(); ++k)
  {
    for (const LevelOfDetail& detail :
      { LevelOfDetail{ 0.01, 0 }, LevelOfDetail{ 1.0, 0 }, LevelOfDetail{ 0.0, 60 } })
    {
      SCOPED_TRACE("input " + std::to_string(k));
      const MeshReport report = checkMesh(reconstruct(inputs[k], detail).mesh);
      EXPECT_TRUE(report.closedManifold()) << report.describe();
      EXPECT_GT(report.components, 0u);
    }
  }
}

TEST(LevelOfDetail, SaysWhatIsWrong)
{
  const std::vector<Vec3> points = randomSphere(100, 7);
  EXPECT_THROW(reconstruct(points, LevelOfDetail{ -1.0, 0 }), InvalidParameter);
  EXPECT_THROW(reconstruct(points, LevelOfDetail{ 0.0, 0 }), InvalidParameter);
  EXPECT_THROW(reconstruct(points, LevelOfDetail{ 1.0, 10 }), InvalidParameter);
  EXPECT_THROW(reconstruct(points, LevelOfDetail{ 0.0, 3 }), InvalidParameter);
  EXPECT_THROW(reconstruct({}, LevelOfDetail{ 0.1, 0 }), InvalidGeometry);
  std::vector<Vec3> plane(50);
  Random random(8);
  std::generate(
    plane.begin(), plane.end(), [&] { return Vec3(random.unit(), random.unit(), 0.0); });
  EXPECT_THROW(reconstruct(plane, LevelOfDetail{ 0.1, 0 }), InvalidGeometry);
  std::vector<Vec3> broken = points;
  broken[7].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(reconstruct(broken, LevelOfDetail{ 0.1, 0 }), InvalidGeometry);
}

TEST(LevelOfDetail, CanBeCancelledEverywhere)
{
  const std::vector<Vec3> points = randomTorus(1.0, 0.4, 5000, 9);
  int checks = 1;
  for (bool finished = false; !finished; checks *= 2)
  {
    try
    {
      reconstruct(points, LevelOfDetail{ 0.003, 0 }, {}, CancelAt(checks));
      finished = true;
    }
    catch (const Cancelled&)
    {
    }
  }
  EXPECT_GT(checks, 5);
}

double meanDistance(const std::vector<Vec3>& points, const TriangleMesh& mesh)
{
  const std::vector<double> all = distances(points, mesh);
  return std::accumulate(all.begin(), all.end(), 0.0) / double(all.size());
}

std::set<std::int32_t> idsOf(const ReconstructedSurface& surface)
{
  return { surface.pointIds.begin(), surface.pointIds.end() };
}

TEST(DynamicReconstruction, GoesToAnyLevelAsWellAsAFreshRun)
{
  const std::vector<Vec3> points = randomTorus(1.0, 0.4, 20000, 11);
  DynamicReconstruction dynamic(points);
  for (const std::size_t wanted : { 3000u, 4500u, 3000u, 6500u, 2800u, 900u })
  {
    SCOPED_TRACE("vertices " + std::to_string(wanted));
    const ReconstructedSurface surface = dynamic.update(LevelOfDetail{ 0.0, wanted });
    expectSound(surface, points, 1);
    EXPECT_EQ(surface.mesh.points.size(), wanted);
    const ReconstructedSurface fresh = reconstruct(points, LevelOfDetail{ 0.0, wanted });
    EXPECT_LE(meanDistance(points, surface.mesh), 1.15 * meanDistance(points, fresh.mesh));
    EXPECT_LE(farthest(points, surface.mesh), 2.0 * farthest(points, fresh.mesh));
  }
  for (const double tolerance : { 0.01, 0.006, 0.01, 0.003, 0.02 })
  {
    SCOPED_TRACE("tolerance " + std::to_string(tolerance));
    const ReconstructedSurface surface = dynamic.update(LevelOfDetail{ tolerance, 0 });
    expectSound(surface, points, 1);
    EXPECT_LE(farthest(points, surface.mesh), tolerance * (1.0 + 1e-12));
    const ReconstructedSurface fresh = reconstruct(points, LevelOfDetail{ tolerance, 0 });
    EXPECT_LE(double(surface.mesh.points.size()), 1.3 * double(fresh.mesh.points.size()));
  }
}

TEST(DynamicReconstruction, ComesBackToWhereItWas)
{
  const std::vector<Vec3> points = randomTorus(1.0, 0.4, 20000, 12);
  DynamicReconstruction dynamic(points);
  const auto before = idsOf(dynamic.update(LevelOfDetail{ 0.0, 3000 }));
  const auto more = idsOf(dynamic.update(LevelOfDetail{ 0.0, 5000 }));
  EXPECT_GT(more.size(), before.size());
  EXPECT_EQ(idsOf(dynamic.update(LevelOfDetail{ 0.0, 3000 })), before);
}

// So many points in a step that several threads place them, to and fro, and from the hull again.
TEST(DynamicReconstruction, IsTheSameForAnyNumberOfThreads)
{
  const std::vector<Vec3> points = randomTorus(1.0, 0.4, 20000, 16);
  std::vector<std::int32_t> gone(300);
  std::iota(gone.begin(), gone.end(), 0);
  DynamicReconstruction parallel(points);
  DynamicReconstruction serial(points);
  for (const LevelOfDetail& detail :
    { LevelOfDetail{ 0.0, 4000 }, LevelOfDetail{ 0.0, 9500 }, LevelOfDetail{ 0.0, 4500 },
      LevelOfDetail{ 0.0, 9800 }, LevelOfDetail{ 0.002, 0 }, LevelOfDetail{ 0.0005, 0 } })
  {
    SCOPED_TRACE("vertices " + std::to_string(detail.vertices));
    setThreadCount(2);
    const ReconstructedSurface one = parallel.update(detail);
    setThreadCount(1);
    const ReconstructedSurface two = serial.update(detail);
    setThreadCount(0);
    expectSound(one, points, 1);
    EXPECT_EQ(one.mesh.triangles, two.mesh.triangles);
    EXPECT_EQ(one.pointIds, two.pointIds);
    if (detail.vertices == 9500)
    {
      parallel.remove(gone);
      serial.remove(gone);
    }
  }
}

TEST(DynamicReconstruction, RefinesInARegionOnly)
{
  const std::vector<Vec3> points = randomTorus(1.0, 0.4, 20000, 13);
  DynamicReconstruction dynamic(points);
  const LevelOfDetail coarse{ 0.02, 0 };
  const ReconstructedSurface without = dynamic.update(coarse);
  for (const double side : { 1.0, -1.0 })
  {
    LevelOfDetail detail = coarse;
    detail.region = Box3(Vec3(side - 0.6, -0.6, -0.6), Vec3(side + 0.6, 0.6, 0.6));
    detail.regionTolerance = 0.002;
    const ReconstructedSurface surface = dynamic.update(detail);
    expectSound(surface, points, 1);
    std::vector<Vec3> within;
    std::copy_if(points.begin(), points.end(), std::back_inserter(within),
      [&](const Vec3& p) { return detail.region.contains(p); });
    const std::vector<double> all = distances(within, surface.mesh);
    const auto far = std::count_if(
      all.begin(), all.end(), [](double distance) { return distance > 0.002 * (1.0 + 1e-12); });
    EXPECT_LE(far, static_cast<std::ptrdiff_t>(within.size() / 500));
    EXPECT_EQ(far > 0, !surface.warnings.empty());
    EXPECT_LE(farthest(points, surface.mesh), 0.02 * (1.0 + 1e-12));
    const auto ids = idsOf(surface);
    for (const std::int32_t id : idsOf(without))
    {
      if (!detail.region.contains(points[id]))
      {
        EXPECT_EQ(ids.count(id), 1u); // kept
      }
    }
    for (const std::int32_t id : ids)
    {
      if (!detail.region.contains(points[id]))
      {
        EXPECT_EQ(idsOf(without).count(id), 1u); // nothing new
      }
    }
  }
  EXPECT_EQ(idsOf(dynamic.update(coarse)), idsOf(without));
}

TEST(DynamicReconstruction, TakesPointsInAndOut)
{
  const std::vector<Vec3> all = randomTorus(1.0, 0.4, 16000, 14);
  DynamicReconstruction dynamic({ all.begin(), all.begin() + 10000 });
  const LevelOfDetail detail{ 0.004, 0 };
  dynamic.update(detail);
  dynamic.add({ all.begin() + 10000, all.end() });
  ReconstructedSurface surface = dynamic.update(detail);
  expectSound(surface, all, 1);
  EXPECT_LE(farthest(all, surface.mesh), 0.004 * (1.0 + 1e-12));
  // Some vertices and some others; at last also those that the surface was first made of.
  Random random(15);
  std::vector<std::int32_t> left(all.size());
  std::iota(left.begin(), left.end(), 0);
  for (const double share : { 0.001, 0.1 })
  {
    std::vector<std::int32_t> gone;
    std::vector<std::int32_t> stay;
    for (const std::int32_t point : left)
    {
      (random.chance(share) ? gone : stay).push_back(point);
    }
    left = stay;
    dynamic.remove(gone);
    surface = dynamic.update(detail);
    expectSound(surface, all, 1);
    for (const std::int32_t point : gone)
    {
      EXPECT_EQ(std::count(surface.pointIds.begin(), surface.pointIds.end(), point), 0);
    }
    std::vector<Vec3> points;
    for (const std::int32_t point : left)
    {
      points.push_back(all[point]);
    }
    EXPECT_LE(farthest(points, surface.mesh), 0.004 * (1.0 + 1e-12));
  }
  EXPECT_THROW(dynamic.remove({ 16000 }), std::out_of_range);
}

TEST(PointOctree, PicksADistinctPointPerLeaf)
{
  const std::vector<Vec3> points = randomTorus(1.0, 0.4, 20000, 10);
  PointOctree octree(points, Progress::none());
  std::size_t before = 0;
  for (const std::size_t cells : { 500u, 2000u, 6000u })
  {
    octree.splitInto(cells);
    const std::vector<std::int32_t> chosen = octree.representatives();
    EXPECT_EQ(std::set<std::int32_t>(chosen.begin(), chosen.end()).size(), chosen.size());
    EXPECT_LE(octree.leafCount(), cells + cells / 10);
    EXPECT_GT(chosen.size(), before);
    before = chosen.size();
    std::vector<std::uint8_t> taken(octree.leafCount(), 0);
    const std::vector<std::int32_t> leaves = octree.leafOfOrdered();
    std::vector<std::int32_t> leafOf(points.size());
    for (std::size_t k = 0; k < leaves.size(); ++k)
    {
      leafOf[octree.order()[k]] = leaves[k];
    }
    for (const std::int32_t point : chosen)
    {
      EXPECT_EQ(taken[leafOf[point]]++, 0);
    }
  }
}

} // namespace

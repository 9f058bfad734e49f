// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Convection.h"
#include "reconstruction/DynamicReconstruction.h"
#include "reconstruction/FacetSize.h"
#include "reconstruction/Front.h"
#include "reconstruction/LevelOfDetail.h"
#include "reconstruction/Regions.h"
#include "reconstruction/Sides.h"
#include "reconstruction/SolidRepair.h"
#include "reconstruction/Tetrahedralization.h"

#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "tests/reconstruction/Samples.h"
#include "tests/support/CancelAt.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

// What holds for every reconstruction: closed 2-manifold, outward, vertices bit for bit of the
// input, unit normals.
void expectSound(const ReconstructedSurface& surface, const std::vector<Vec3>& points)
{
  const TriangleMesh& mesh = surface.mesh;
  const MeshReport report = checkMesh(mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.unusedPoints, 0u);
  EXPECT_GT(signedVolume(mesh), 0.0);
  ASSERT_EQ(surface.pointIds.size(), mesh.points.size());
  ASSERT_EQ(mesh.normals.size(), mesh.points.size());
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    ASSERT_EQ(mesh.points[k], points.at(surface.pointIds[k])) << "vertex " << k;
    ASSERT_NEAR(mesh.normals[k].norm(), 1.0, 1e-12) << "vertex " << k;
  }
}

TEST(Convection, FindsTheHandleOfATorusDrawnAtRandom)
{
  for (const std::uint64_t seed : { 1u, 2u, 3u })
  {
    const std::vector<Vec3> points = randomTorus(1.0, 0.4, 5000, seed);
    const ReconstructedSurface surface = reconstruct(points);
    expectSound(surface, points);
    EXPECT_EQ(checkMesh(surface.mesh).genus(), 1) << "seed " << seed;
    EXPECT_EQ(checkMesh(surface.mesh).components, 1u) << "seed " << seed;
    const double exact = 2.0 * std::pow(std::acos(-1.0), 2) * 1.0 * 0.4 * 0.4;
    EXPECT_NEAR(signedVolume(surface.mesh), exact, 0.02 * exact);
    for (const Triangle& t : surface.mesh.triangles)
    {
      const auto& p = surface.mesh.points;
      EXPECT_LT(distanceToTorus((p[t[0]] + p[t[1]] + p[t[2]]) / 3.0, 1.0, 0.4), 0.05);
    }
  }
}

TEST(Convection, UsesNearlyAllPointsOfASphere)
{
  const std::vector<Vec3> points = randomSphere(3000, 4);
  const ReconstructedSurface surface = reconstruct(points);
  expectSound(surface, points);
  EXPECT_EQ(checkMesh(surface.mesh).genus(), 0);
  EXPECT_GT(surface.mesh.points.size(), 2900u);
  for (std::size_t k = 0; k < surface.mesh.points.size(); ++k)
  {
    EXPECT_GT(surface.mesh.normals[k].dot(surface.mesh.points[k]), 0.5) << "normal " << k;
  }
}

TEST(Convection, TellsObjectsApart)
{
  std::vector<Vec3> points = randomSphere(2000, 5);
  for (const Vec3& p : randomSphere(2000, 6))
  {
    points.push_back(p + Vec3(3.0, 0.0, 0.0));
  }
  const ReconstructedSurface surface = reconstruct(points);
  expectSound(surface, points);
  EXPECT_EQ(checkMesh(surface.mesh).components, 2u);
  EXPECT_EQ(checkMesh(surface.mesh).genus(), 0);
}

TEST(Convection, OpensADeepHollow)
{
  // A cup, thick walled: the hollow is reached only through its mouth.
  const auto cup = [](Random& random)
  {
    const double pi = std::acos(-1.0);
    const Vec3 d = random.direction();
    const double reach = random.chance(0.6) ? 1.0 : 0.7;
    const Vec3 p = reach * d;
    const double rim = random.uniform(0.7, 1.0);
    const double angle = random.uniform(0.0, 2.0 * pi);
    return p.z() > 0.0 ? Vec3(rim * std::cos(angle), rim * std::sin(angle), 0.0) : p;
  };
  Random random(7);
  std::vector<Vec3> points;
  while (points.size() < 8000)
  {
    points.push_back(cup(random));
  }
  const double exact = 2.0 / 3.0 * std::acos(-1.0) * (1.0 - std::pow(0.7, 3));
  const ReconstructedSurface open = reconstruct(points);
  expectSound(open, points);
  EXPECT_NEAR(signedVolume(open.mesh), exact, 0.05 * exact);
  EXPECT_EQ(checkMesh(open.mesh).genus(), 0);
}

TEST(Convection, DoesNotDependOnPlaceOrScale)
{
  const std::vector<Vec3> points = randomTorus(1.0, 0.4, 3000, 8);
  const ReconstructedSurface here = reconstruct(points);
  std::vector<Vec3> moved = points;
  for (Vec3& p : moved)
  {
    p *= 1024.0; // exact
  }
  const ReconstructedSurface there = reconstruct(moved);
  expectSound(there, moved);
  EXPECT_EQ(here.mesh.triangles.size(), there.mesh.triangles.size());
}

TEST(Convection, SurvivesAnything)
{
  Random random(9);
  const Box3 unit(Vec3::Zero(), Vec3::Ones());
  std::vector<std::vector<Vec3>> inputs;
  for (std::size_t count = 4; count <= 40; ++count)
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
  std::vector<Vec3> filled(3000);
  std::generate(filled.begin(), filled.end(), [&] { return random.inBox(unit); });
  inputs.push_back(filled);
  inputs.push_back(randomSphere(2000, 10));
  inputs.back().push_back({ 1e6, 0.0, 0.0 });
  inputs.push_back(
    { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 }, { 0, 0, 0 }, { 1, 0, 0 } });
  for (std::size_t k = 0; k < inputs.size(); ++k)
  {
    SCOPED_TRACE("input " + std::to_string(k));
    for (const bool openPockets : { true, false })
    {
      ConvectionOptions options;
      options.openPockets = openPockets;
      const ReconstructedSurface surface = reconstruct(inputs[k], options);
      ASSERT_FALSE(surface.mesh.empty());
      expectSound(surface, inputs[k]);
    }
  }
}

std::string messageOf(const std::vector<Vec3>& points)
{
  try
  {
    reconstruct(points);
  }
  catch (const InvalidGeometry& error)
  {
    return error.what();
  }
  return "no error";
}

TEST(Convection, SaysWhatIsWrongWithThePoints)
{
  const std::vector<Vec3> three{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  EXPECT_NE(messageOf({}).find("at least 4"), std::string::npos);
  EXPECT_NE(messageOf(three).find("at least 4"), std::string::npos);
  EXPECT_NE(messageOf(std::vector<Vec3>(9, Vec3::Ones())).find("1 different"), std::string::npos);
  std::vector<Vec3> line;
  std::vector<Vec3> plane;
  for (int k = 0; k < 20; ++k)
  {
    line.push_back({ 1.0 * k, 2.0 * k, 3.0 * k });
    plane.push_back({ k % 5 * 1.0, k / 5 * 1.0, 2.0 });
  }
  EXPECT_NE(messageOf(line).find("one line"), std::string::npos);
  EXPECT_NE(messageOf(plane).find("one plane"), std::string::npos);
  std::vector<Vec3> broken = randomSphere(10, 11);
  broken[7].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(messageOf(broken).find("Point 7 "), std::string::npos);
  broken[7].y() = std::numeric_limits<double>::infinity();
  EXPECT_NE(messageOf(broken).find("Point 7 "), std::string::npos);
  ConvectionOptions options;
  options.pocketFactor = 0.99;
  EXPECT_THROW(reconstruct(randomSphere(10, 12), options), InvalidParameter);
}

TEST(Convection, KeepsToTheRangeOfDouble)
{
  for (const double scale : { 1e-60, 1e-40, 1e40, 1e60 })
  {
    std::vector<Vec3> points = randomSphere(300, 15);
    for (Vec3& p : points)
    {
      p *= scale;
    }
    if (scale < 1e-50 || scale > 1e50)
    {
      EXPECT_NE(messageOf(points).find("scale them"), std::string::npos) << scale;
      EXPECT_THROW(DynamicReconstruction{ points }, InvalidGeometry);
      continue;
    }
    const ReconstructedSurface surface = reconstruct(points);
    EXPECT_TRUE(checkMesh(surface.mesh).closedManifold());
    for (const Vec3& normal : surface.mesh.normals)
    {
      EXPECT_NEAR(normal.norm(), 1.0, 1e-12) << scale;
    }
  }
}

TEST(Convection, SaysWhatItNeedsBeforeItStarts)
{
  ConvectionOptions options;
  options.maxMemory = std::size_t(1) << 20;
  try
  {
    reconstruct(randomSphere(5000, 14), options);
    FAIL() << "5000 points do not fit into 1 MiB";
  }
  catch (const TooLarge& error)
  {
    EXPECT_NE(std::string(error.what()).find("5000 points"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("limit is 1 MiB"), std::string::npos) << error.what();
  }
  EXPECT_FALSE(reconstruct(randomSphere(100, 14), options).mesh.empty());
}

// Each point of one circle with each of another through its middle: a million tetrahedra.
TEST(Convection, StopsWhereTetrahedraAreTooMany)
{
  std::vector<Vec3> circles;
  for (int k = 0; k < 1000; ++k)
  {
    const double x = std::cos(0.0061 * k);
    const double y = std::sin(0.0061 * k);
    circles.emplace_back(x, y, 0.0);
    circles.emplace_back(x + 1.0, 0.0, y);
  }
  ConvectionOptions options;
  options.maxMemory = std::size_t(1) << 24;
  EXPECT_THROW(reconstruct(circles, options), TooLarge);
  EXPECT_THROW(reconstruct(circles, LevelOfDetail{ 0.0, 1900 }, options), TooLarge);
}

TEST(Convection, CanBeCancelledEverywhere)
{
  const std::vector<Vec3> points = randomTorus(1.0, 0.4, 5000, 13);
  int checks = 1;
  for (bool finished = false; !finished; checks *= 2)
  {
    try
    {
      reconstruct(points, {}, CancelAt(checks));
      finished = true;
    }
    catch (const Cancelled&)
    {
    }
  }
  EXPECT_GT(checks, 5);
}

TEST(Convection, EachStepLooksWhetherToGoOn)
{
  const std::vector<Vec3> points = randomSphere(1000, 15);
  EXPECT_THROW(Tetrahedralization(points, CancelAt(0)), Cancelled);
  const Tetrahedralization tetrahedra(points, Progress::none());
  EXPECT_THROW(FacetSize(tetrahedra, CancelAt(0)), Cancelled);
  const FacetSize sizes(tetrahedra);
  EXPECT_THROW(findRegions(tetrahedra, sizes, 1.0, 6.0, CancelAt(0)), Cancelled);
  const std::vector<Region> regions = findRegions(tetrahedra, sizes, 1.0, 6.0);
  EXPECT_THROW(findSides(tetrahedra, sizes, {}, CancelAt(0)), Cancelled);
  EXPECT_THROW(Front(tetrahedra, sizes, regions).run(true, Voids::Filled, CancelAt(0)), Cancelled);
  std::vector<std::uint8_t> inside(tetrahedra.cellCount(), 0);
  EXPECT_THROW(repairSolid(tetrahedra, inside, Voids::Filled, CancelAt(0)), Cancelled);
}

struct MeshCase
{
  const char* name;
  int genus;
  std::size_t points;
};

void PrintTo(const MeshCase& mesh, std::ostream* out)
{
  *out << mesh.name;
}

// Real meshes, points drawn at random: their genus is that of the mesh. Besides scans there are
// shapes of flat faces and sharp edges, where points lie in one plane and tetrahedra are slivers.
class ConvectionOfMesh : public testing::TestWithParam<MeshCase>
{
};

TEST_P(ConvectionOfMesh, HasItsGenus)
{
  const auto [name, genus, count] = GetParam();
  const std::optional<TriangleMesh> source = demoMesh(name);
  if (!source)
  {
    GTEST_SKIP() << name << " needs Debian's libcgal-demo: apt install libcgal-demo";
  }
  for (const std::uint64_t seed : { 1u, 201u })
  {
    const std::vector<Vec3> points = randomSurfacePoints(*source, count, seed);
    const ReconstructedSurface surface = reconstruct(points);
    expectSound(surface, points);
    EXPECT_EQ(checkMesh(surface.mesh).genus(), genus) << "seed " << seed;
    EXPECT_EQ(checkMesh(surface.mesh).components, 1u) << "seed " << seed;
    EXPECT_NEAR(signedVolume(surface.mesh), signedVolume(*source), 0.02 * signedVolume(*source));
  }
}

INSTANTIATE_TEST_SUITE_P(DemoMeshes, ConvectionOfMesh,
  testing::Values(MeshCase{ "elephant.off", 3, 20000 }, MeshCase{ "bear.off", 0, 5000 },
    MeshCase{ "eight.off", 2, 5000 }, MeshCase{ "anchor.off", 4, 20000 },
    MeshCase{ "hand.off", 0, 10000 }, MeshCase{ "small_cube.off", 0, 10000 },
    MeshCase{ "quint_tris.off", 0, 20000 }, MeshCase{ "hole.off", 1, 10000 },
    MeshCase{ "corner.off", 0, 5000 }));

} // namespace

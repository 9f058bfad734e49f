// SPDX-License-Identifier: BSD-3-Clause
// Points scattered about a surface: going through more of them is no reason for handles.
#include "core/mesh/MeshChecks.h"
#include "reconstruction/Convection.h"
#include "reconstruction/PointCloud.h"
#include "reconstruction/SurfaceParts.h"
#include "tests/reconstruction/DemoPoints.h"
#include "tests/reconstruction/Samples.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

// Points drawn from an area, moved up to some mean distances between them, and strays in a box.
struct Noise
{
  double spacings;
  double strays; // for each point
};

std::vector<Vec3> noisy(
  std::vector<Vec3> points, double area, const Noise& noise, std::uint64_t seed)
{
  Random random(seed);
  const double most = noise.spacings * std::sqrt(area / double(points.size()));
  Box3 box;
  for (Vec3& p : points)
  {
    p += most * random.unit() * random.direction();
    box.extend(p);
  }
  const auto strays = static_cast<std::size_t>(noise.strays * double(points.size()));
  const Vec3 reach = 0.6 * box.sizes();
  for (std::size_t k = 0; k < strays; ++k)
  {
    const Vec3 at(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    points.push_back(box.center() + at.cwiseProduct(reach));
  }
  return points;
}

void PrintTo(const Noise& noise, std::ostream* out)
{
  *out << noise.spacings << " distances, " << noise.strays << " strays a point";
}

class Noisy : public testing::TestWithParam<Noise>
{
};

const double kPi = std::acos(-1.0);

TEST_P(Noisy, ASphereStaysASphere)
{
  for (const std::uint64_t seed : { 1u, 2u })
  {
    const std::vector<Vec3> points =
      noisy(randomSphere(5000, seed), 4.0 * kPi, GetParam(), seed + 50);
    const ReconstructedSurface surface = reconstruct(points);
    const MeshReport report = checkMesh(surface.mesh);
    EXPECT_TRUE(report.closedManifold()) << report.describe();
    EXPECT_EQ(report.components, 1u);
    EXPECT_EQ(report.eulerCharacteristic, 2) << "seed " << seed;
    EXPECT_GT(surface.mesh.points.size(), points.size() * 3 / 4);
  }
}

TEST_P(Noisy, ATorusKeepsItsHandle)
{
  const std::vector<Vec3> points =
    noisy(randomTorus(1.0, 0.4, 6000, 7), 4.0 * kPi * kPi * 0.4, GetParam(), 8);
  const ReconstructedSurface surface = reconstruct(points);
  const MeshReport report = checkMesh(surface.mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.components, 1u);
  EXPECT_EQ(report.eulerCharacteristic, 0);
  EXPECT_GT(surface.mesh.points.size(), points.size() * 3 / 4);
}

INSTANTIATE_TEST_SUITE_P(Noises, Noisy,
  testing::Values(Noise{ 0.5, 0.0 }, Noise{ 0.5, 0.05 }, Noise{ 1.5, 0.05 }, Noise{ 3.0, 0.0 },
    Noise{ 3.0, 0.05 }));

class NoisyDemo : public testing::TestWithParam<const char*>
{
};

TEST_P(NoisyDemo, HasNoHandles)
{
  const std::optional<std::vector<Vec3>> points = demoPoints(GetParam());
  if (!points)
  {
    GTEST_SKIP() << GetParam() << " needs Debian's libcgal-demo: apt install libcgal-demo";
  }
  for (const bool close : { true, false })
  {
    ConvectionOptions options;
    options.closeHoles = close;
    const ReconstructedSurface surface = reconstruct(*points, options);
    const MeshReport report = checkMesh(surface.mesh);
    EXPECT_TRUE(report.closedManifold()) << report.describe();
    EXPECT_EQ(report.components, 1u);
    EXPECT_EQ(report.genus(), 0) << "closeHoles " << close;
    EXPECT_GT(surface.mesh.points.size(), points->size() / 2);
  }
}

INSTANTIATE_TEST_SUITE_P(PointSets, NoisyDemo, testing::Values("sphere_20k.xyz", "blobby.xyz"));

// The value that a warning names for a property; none if it does not.
std::optional<double> advised(const std::vector<std::string>& warnings, const std::string& name)
{
  for (const std::string& warning : warnings)
  {
    const std::size_t at = warning.find(name);
    if (at != std::string::npos)
    {
      const std::size_t digit = warning.find_first_of("0123456789", at);
      return std::stod(warning.substr(digit));
    }
  }
  return std::nullopt;
}

double shareUsed(const std::vector<Vec3>& points, const ReconstructedSurface& surface)
{
  return double(surface.mesh.points.size()) / double(points.size());
}

// As the filter does with these properties.
std::vector<Vec3> cleaned(
  std::vector<Vec3> points, double radius, std::optional<double> outlierNeighbors)
{
  std::vector<std::int32_t> chosen = withoutDuplicates(points, allPoints(points));
  if (outlierNeighbors)
  {
    chosen = withoutOutliers(points, chosen, static_cast<int>(*outlierNeighbors), 2.0);
  }
  chosen = thinned(points, smooth(points, chosen, radius), 0.25 * radius);
  std::vector<Vec3> clean;
  for (const std::int32_t point : chosen)
  {
    clean.push_back(points[point]);
  }
  return clean;
}

void expectAdviceHelps(const std::vector<Vec3>& points, double wanted)
{
  const ReconstructedSurface surface = reconstruct(points);
  const std::optional<double> radius = advised(surface.warnings, "SmoothingRadius");
  ASSERT_TRUE(radius);
  const std::vector<Vec3> clean =
    cleaned(points, *radius, advised(surface.warnings, "OutlierNeighbors"));
  const ReconstructedSurface better = reconstruct(clean);
  EXPECT_EQ(checkMesh(better.mesh).eulerCharacteristic, 2);
  EXPECT_GT(shareUsed(clean, better), wanted);
  EXPECT_GT(shareUsed(clean, better), shareUsed(points, surface) + 0.1);
}

TEST(NoiseWarning, ItsAdviceHelps)
{
  for (const double strays : { 0.0, 0.05 })
  {
    SCOPED_TRACE(strays);
    expectAdviceHelps(noisy(randomSphere(5000, 11), 4.0 * kPi, { 3.0, strays }, 12), 0.95);
  }
}

TEST(NoiseWarning, IsOfNoiseOnly)
{
  for (const Noise& noise : { Noise{ 0.0, 0.0 }, Noise{ 0.5, 0.0 }, Noise{ 0.5, 0.05 } })
  {
    EXPECT_TRUE(reconstruct(noisy(randomSphere(5000, 13), 4.0 * kPi, noise, 14)).warnings.empty());
  }
  std::vector<Vec3> twice = randomSphere(1000, 15);
  const std::vector<Vec3> once = twice;
  twice.insert(twice.end(), once.begin(), once.end());
  EXPECT_TRUE(reconstruct(twice).warnings.empty());
}

TEST_P(NoisyDemo, IsHelpedByTheWarningsAdvice)
{
  const std::optional<std::vector<Vec3>> points = demoPoints(GetParam());
  if (!points)
  {
    GTEST_SKIP() << GetParam() << " needs Debian's libcgal-demo: apt install libcgal-demo";
  }
  expectAdviceHelps(*points, 0.6);
}

TEST(SurfaceParts, ArePiecesHandlesAndHalfTheBorders)
{
  const TriangleMesh ball = icosphere(1.0, 2);
  const TriangleMesh ring = torus(1.0, 0.3, 12, 8);
  EXPECT_EQ(partsOfMesh(ball).parts, 1.0);
  EXPECT_EQ(partsOfMesh(ring).parts, 2.0);
  EXPECT_EQ(partsOfMesh(joined(ball, ring)).parts, 3.0);
  EXPECT_EQ(partsOfMesh(withoutTriangles(ball, 0, 1)).parts, 1.5);
  EXPECT_EQ(partsOfMesh(ring).points, ring.points.size());
}

TEST(SurfaceParts, OfATetrahedronAndAHullAreOne)
{
  const std::vector<Vec3> points = randomSphere(300, 3);
  const Tetrahedralization tetrahedra(points, Progress::none());
  std::vector<std::uint8_t> inside(static_cast<std::size_t>(tetrahedra.cellCount()), 0);
  inside[0] = 1;
  const SurfaceParts one = partsOfBoundary(tetrahedra, inside, Progress::none());
  EXPECT_EQ(one.points, 4u);
  EXPECT_EQ(one.parts, 1.0);
  std::fill(inside.begin(), inside.begin() + tetrahedra.finiteCellCount(), 1);
  const SurfaceParts all = partsOfBoundary(tetrahedra, inside, Progress::none());
  EXPECT_EQ(all.points, points.size());
  EXPECT_EQ(all.parts, 1.0);
}

TEST(SurfaceParts, ArePaidByPoints)
{
  const SurfaceParts before{ 1000, 1.0 };
  EXPECT_TRUE(isPaidByPoints({ 900, 1.0 }, before));
  EXPECT_TRUE(isPaidByPoints({ 1100, 3.0 }, before, 50.0));
  EXPECT_FALSE(isPaidByPoints({ 1099, 3.0 }, before, 50.0));
  EXPECT_TRUE(isPaidByPoints({ 1, 0.0 }, before));
}

} // namespace

// SPDX-License-Identifier: BSD-3-Clause
// Of a surface at a Tolerance every point is within it: scans and random points of closed meshes,
// each from coarse to fine.
#include "reconstruction/LevelOfDetail.h"

#include "core/mesh/MeshChecks.h"
#include "tests/reconstruction/DemoPoints.h"
#include "tests/reconstruction/MeshDistances.h"
#include "tests/reconstruction/Samples.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

constexpr double kTolerances[] = { 0.01, 0.003, 0.001 }; // of the diagonal

// Of the name of a mesh points drawn at random; none where libcgal-demo is absent.
std::optional<std::vector<Vec3>> pointsOf(const std::string& name)
{
  if (name.find(".off") == std::string::npos)
  {
    return demoPoints(name);
  }
  const std::optional<TriangleMesh> mesh = demoMesh(name);
  return mesh ? std::optional(randomSurfacePoints(*mesh, 20000, 1)) : std::nullopt;
}

double diagonalOf(const std::vector<Vec3>& points)
{
  Box3 box;
  for (const Vec3& p : points)
  {
    box.extend(p);
  }
  return box.diagonal().norm();
}

class ToleranceOf : public testing::TestWithParam<const char*>
{
};

TEST_P(ToleranceOf, HoldsForEveryPoint)
{
  const std::optional<std::vector<Vec3>> points = pointsOf(GetParam());
  if (!points)
  {
    GTEST_SKIP() << GetParam() << " needs Debian's libcgal-demo: apt install libcgal-demo";
  }
  for (const double share : kTolerances)
  {
    SCOPED_TRACE(share);
    const double tolerance = share * diagonalOf(*points);
    const ReconstructedSurface surface = reconstruct(*points, LevelOfDetail{ tolerance, 0 });
    const MeshReport report = checkMesh(surface.mesh);
    EXPECT_TRUE(report.closedManifold()) << report.describe();
    EXPECT_TRUE(surface.warnings.empty()) << surface.warnings[0];
    EXPECT_LE(farthest(*points, surface.mesh), tolerance * (1.0 + 1e-12));
  }
}

INSTANTIATE_TEST_SUITE_P(DemoSets, ToleranceOf,
  testing::Values("kitten.xyz", "oni.pwn", "elephant.off", "armadillo.off", "bear.off", "eight.off",
    "anchor.off", "hand.off"));

// Noise on both sides of a surface, that passes the tolerance many times: not all can be met by a
// surface that does not touch itself. The warning tells how many were not.
TEST(Tolerance, SaysHowManyPointsAreLeft)
{
  const std::optional<std::vector<Vec3>> points = demoPoints("blobby.xyz");
  if (!points)
  {
    GTEST_SKIP() << "blobby.xyz needs Debian's libcgal-demo: apt install libcgal-demo";
  }
  const double tolerance = 0.001 * diagonalOf(*points);
  const ReconstructedSurface surface = reconstruct(*points, LevelOfDetail{ tolerance, 0 });
  const MeshReport report = checkMesh(surface.mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  const std::vector<double> all = distances(*points, surface.mesh);
  const auto left =
    std::count_if(all.begin(), all.end(), [&](double d) { return d > tolerance * (1.0 + 1e-12); });
  EXPECT_LT(left, 20);
  ASSERT_EQ(surface.warnings.size(), left > 0 ? 1u : 0u);
  if (left > 0)
  {
    EXPECT_EQ(surface.warnings[0].find(std::to_string(left) + " of 3288 points"), 0u)
      << surface.warnings[0];
  }
}

} // namespace

// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/CleanResult.h"

#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree
{
namespace
{

using namespace test;

// What cleanResult() leaves of a mesh whose points are all on the cut.
TriangleMesh cleaned(const TriangleMesh& mesh)
{
  MeshBooleanResult result;
  result.mesh = mesh;
  result.sourceOperand.assign(mesh.triangles.size(), 0);
  result.sourceTriangle.assign(mesh.triangles.size(), -1);
  result.cutPoints.resize(mesh.points.size());
  cleanResult(result, false);
  return result.mesh;
}

// Four points on a line but for rounding.
TriangleMesh needle(Random& random, const Vec3& start)
{
  TriangleMesh mesh;
  const Vec3 way = 0.1 * random.direction();
  for (int k = 0; k < 4; ++k)
  {
    mesh.points.push_back(start + random.uniform(0.0, 1.0) * way);
  }
  mesh.triangles = { { 0, 1, 2 }, { 0, 3, 1 }, { 1, 3, 2 }, { 2, 3, 0 } };
  return mesh;
}

// Two sheets on a triangle of length 1, closed by its border; their inner points are `rise` apart.
TriangleMesh sheets(Random& random, const Vec3& start, double width, double rise)
{
  const Mat3 turn = random.rotation();
  const auto place = [&](double along, double across, double above)
  { return Vec3(start + turn * Vec3(along, across * width, above)); };
  TriangleMesh mesh;
  mesh.points = { place(-0.5, 0.0, 0.0), place(0.5, 0.0, 0.0),
    place(random.uniform(-0.3, 0.3), 1.0, 0.0) };
  const double along = random.uniform(-0.2, 0.2);
  const double across = random.uniform(0.2, 0.4);
  mesh.points.push_back(place(along, across, 0.5 * rise));
  mesh.points.push_back(place(along, across, -0.5 * rise));
  mesh.triangles = { { 0, 1, 3 }, { 1, 2, 3 }, { 2, 0, 3 }, { 1, 0, 4 }, { 2, 1, 4 }, { 0, 2, 4 } };
  return mesh;
}

constexpr double kFar = 3.0;
constexpr double kTolerance = 0x1p-46 * kFar;

// With a needle, as only flat triangles make cleanResult() look at components. The solid reaches to
// kFar, which is the largest coordinate.
TriangleMesh withSolidAndNeedle(Random& random, const TriangleMesh& solid, const TriangleMesh& part)
{
  return joined(solid, joined(needle(random, Vec3(0.5, 0.5, 0.5)), part));
}

// What little volume they have is rounding.
TEST(CleanResult, NeedlesAreDropped)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    Random random(seed);
    const TriangleMesh ball = icosphere(1.0, 1);
    const TriangleMesh flat = needle(random, 0.5 * random.direction());
    EXPECT_EQ(cleaned(joined(ball, flat)).triangles, ball.triangles) << "seed " << seed;
  }
}

// Sums of the products of three lengths are rounded by more than the tolerance times this little
// area, however far from flat the triangles are.
TEST(CleanResult, NarrowSheetsOnEachOtherAreDropped)
{
  Random random(31);
  const TriangleMesh solid = icosphere(0.5, 1, Vec3(kFar - 0.5, 0.0, 0.0));
  for (int round = 0; round < 200; ++round)
  {
    const double width = std::pow(10.0, random.uniform(-10.5, 0.0));
    const TriangleMesh thin = sheets(random, Vec3(1.7, -1.3, 1.1), width, 0.0);
    EXPECT_EQ(cleaned(withSolidAndNeedle(random, solid, thin)).triangles, solid.triangles)
      << "round " << round << ", width " << width;
  }
}

TEST(CleanResult, NarrowPlatesThickerThanTheToleranceStay)
{
  Random random(32);
  const TriangleMesh solid = icosphere(0.5, 1, Vec3(kFar - 0.5, 0.0, 0.0));
  for (int round = 0; round < 200; ++round)
  {
    const double rise = kTolerance * std::pow(10.0, random.uniform(1.2, 4.0));
    const double width = std::pow(10.0, random.uniform(-9.0, 0.0));
    const TriangleMesh plate = sheets(random, Vec3(1.7, -1.3, 1.1), width, rise);
    const TriangleMesh kept = cleaned(withSolidAndNeedle(random, solid, plate));
    EXPECT_EQ(kept.triangles, joined(solid, plate).triangles)
      << "round " << round << ", width " << width << ", rise " << rise;
  }
}

// A solid is one at any size that is not rounding.
TEST(CleanResult, SmallSolidsStay)
{
  Random random(33);
  for (int round = 0; round < 50; ++round)
  {
    const TriangleMesh large = icosphere(0.5, 1, Vec3(kFar - 0.5, 0.0, 0.0));
    const double radius = std::pow(10.0, random.uniform(-11.0, -1.0));
    const TriangleMesh small = icosphere(radius, 1, Vec3(1.7, -1.3, 1.1));
    const TriangleMesh kept = cleaned(withSolidAndNeedle(random, large, small));
    EXPECT_EQ(kept.triangles, joined(large, small).triangles)
      << "round " << round << ", radius " << radius;
  }
}

} // namespace
} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/PatchShape.h"

#include "core/stitch/CheckPatch.h"
#include "tests/support/FunctionField.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace hybridtree::test
{
namespace
{

constexpr double kCell = 1.0;
constexpr int kSide = 8; // squares
constexpr double kStep = 0.4;

/// Squares of two triangles each, in the plane z = 0, seen from above.
TriangleMesh plane()
{
  TriangleMesh mesh;
  for (int k = 0; k < (kSide + 1) * (kSide + 1); ++k)
  {
    mesh.points.push_back(kStep * Vec3(k % (kSide + 1), k / (kSide + 1), 0.0));
  }
  for (int k = 0; k < kSide * kSide; ++k)
  {
    const int a = k % kSide + (kSide + 1) * (k / kSide);
    const int c = a + kSide + 2;
    mesh.triangles.push_back({ a, a + 1, c });
    mesh.triangles.push_back({ a, c, c - 1 });
  }
  mesh.normals.assign(mesh.points.size(), Vec3::UnitZ());
  return mesh;
}

/// Parts a triangle at a point beyond its first side, so that the part at that side is turned over.
void fold(std::size_t t, double beyond, TriangleMesh& mesh)
{
  const auto [a, b, c] = mesh.triangles[t];
  const Vec3 side = mesh.points[b] - mesh.points[a];
  const auto m = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.push_back(mesh.points[a] + 0.5 * side - beyond * Vec3::UnitZ().cross(side));
  mesh.normals.push_back(Vec3::UnitZ());
  mesh.triangles[t] = { a, b, m };
  mesh.triangles.push_back({ b, c, m });
  mesh.triangles.push_back({ c, a, m });
}

/// Upward, of the triangle where that is least, of twice its area; all of them cover the plane.
double leastUpward(const TriangleMesh& mesh)
{
  double area = 0.0;
  double least = kStep;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Vec3 normal = areaNormal(mesh, t);
    least = std::min(least, normal.z());
    area += 0.5 * normal.norm();
  }
  EXPECT_NEAR(area, std::pow(kSide * kStep, 2), 1e-9);
  return least;
}

/// Their angles are none too small; but where they stay, the patch is made anew.
TEST(PatchShape, MendsTurnedTriangles)
{
  const FunctionField below([](const Vec3& p) { return kThreshold - p.z(); }, 1.0);
  Random random(17);
  for (int trial = 0; trial < 50; ++trial)
  {
    TriangleMesh mesh = plane();
    const int row = random.integer(2, kSide - 3);
    const int column = random.integer(2, kSide - 3);
    const auto square = static_cast<std::size_t>(kSide * row + column);
    fold(2 * square, random.uniform(0.2, 0.4), mesh);
    mesh.sourceLeaf.assign(mesh.triangles.size(), -1);
    ASSERT_EQ(turnedTriangles(mesh).size(), 1u);
    std::vector<bool> onCrease(mesh.points.size(), false);
    improveShapes(below, mesh, 0, onCrease, kCell, Folds::Stay);
    EXPECT_GT(leastUpward(mesh), 0.0);
    EXPECT_EQ(onCrease.size(), mesh.points.size());
  }
}

/// Puts a small polygon into a triangle, below a point that is kept: one of its corners is a notch
/// on the wrong side of the others, and the point of its fan lies outside of it.
void notch(std::size_t t, Random& random, TriangleMesh& mesh)
{
  const auto [a, b, c] = mesh.triangles[t];
  const Vec3 center = (mesh.points[a] + mesh.points[b] + mesh.points[c]) / 3.0;
  const Vec3 along = (mesh.points[b] - mesh.points[a]).normalized();
  const Vec3 across = Vec3::UnitZ().cross(along);
  const auto kept = static_cast<std::int32_t>(mesh.points.size());
  const auto add = [&](double x, double y)
  { mesh.points.push_back(center + 0.01 * (x * along + y * across)); };
  add(0.0, 0.0);
  add(random.uniform(1.0, 1.5), -0.5);                        // right,
  add(random.uniform(-0.5, 0.5), random.uniform(-1.3, -0.9)); // notch and
  add(random.uniform(-1.5, -1.0), -0.5);                      // left of it,
  add(random.uniform(-0.7, 0.7), random.uniform(0.5, 3.0));   // and the point of the fan
  mesh.normals.resize(mesh.points.size(), Vec3::UnitZ());
  const std::int32_t right = kept + 1, low = kept + 2, left = kept + 3, middle = kept + 4;
  mesh.triangles[t] = { b, c, kept };
  for (const Triangle& more : { Triangle{ c, a, kept }, { kept, a, left }, { kept, left, low },
         { kept, low, right }, { kept, right, b }, { a, b, right }, { a, right, left },
         { left, right, middle }, { right, low, middle }, { low, left, middle } })
  {
    mesh.triangles.push_back(more);
  }
}

/// Every single collapse or flip there leaves a triangle turned, or is none that keeps a manifold.
TEST(PatchShape, UnfoldsInSeveralSteps)
{
  const FunctionField below([](const Vec3& p) { return kThreshold - p.z(); }, 1.0);
  Random random(23);
  for (int trial = 0; trial < 50; ++trial)
  {
    TriangleMesh mesh = plane();
    const auto kept = mesh.points.size() + 1; // that of the notch, too
    notch(static_cast<std::size_t>(random.integer(40, 60)), random, mesh);
    mesh.sourceLeaf.assign(mesh.triangles.size(), -1);
    ASSERT_GE(turnedTriangles(mesh).size(), 2u);
    const std::vector<Vec3> before(mesh.points.begin(), mesh.points.begin() + std::ptrdiff_t(kept));
    std::vector<bool> onCrease(mesh.points.size(), false);
    improveShapes(below, mesh, kept, onCrease, kCell, Folds::Unfold);
    EXPECT_TRUE(std::equal(before.begin(), before.end(), mesh.points.begin()));
    EXPECT_GE(leastUpward(mesh), 0.0);
  }
}

} // namespace
} // namespace hybridtree::test

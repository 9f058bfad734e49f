// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/PatchShape.h"

#include "core/stitch/CheckPatch.h"
#include "tests/support/FunctionField.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

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
    improveShapes(below, mesh, 0, onCrease, kCell);
    double area = 0.0;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    {
      const Vec3 normal = areaNormal(mesh, t);
      EXPECT_GT(normal.z(), 0.0);
      area += 0.5 * normal.norm();
    }
    EXPECT_NEAR(area, std::pow(kSide * kStep, 2), 1e-9);
    EXPECT_EQ(onCrease.size(), mesh.points.size());
  }
}

} // namespace
} // namespace hybridtree::test

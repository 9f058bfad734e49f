// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/Remesh.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/mesh/MeshChecks.h"
#include "core/polygonize/Polygonize.h"
#include "tests/support/FunctionField.h"
#include "tests/support/TriangleAngles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace hybridtree
{
namespace
{

double torusField(const Vec3& p)
{
  return kThreshold + 0.35 - std::hypot(std::hypot(p.x(), p.y()) - 1.0, p.z());
}

TriangleMesh torusMesh(double cellSize)
{
  PolygonizeOptions options;
  options.cellSize = cellSize;
  return polygonize(
    test::FunctionField(torusField, 1.0), Box3(Vec3::Constant(-1.5), Vec3::Constant(1.5)), options);
}

double longestEdge(const TriangleMesh& mesh)
{
  double longest = 0.0;
  for (const Triangle& c : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      longest = std::max(longest, (mesh.points[c[k]] - mesh.points[c[(k + 1) % 3]]).norm());
    }
  }
  return longest;
}

/// A random stretch, shear and twist, of the points and, by its inverse transpose, the normals.
struct RandomWarp
{
  explicit RandomWarp(std::uint64_t seed)
  {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    for (int axis = 0; axis < 3; ++axis)
    {
      scale[axis] = std::exp(1.5 * unit(random));
    }
    twist = 2.0 * unit(random);
    bulge = 0.4 * unit(random);
  }

  Vec3 operator()(const Vec3& p) const
  {
    const double angle = twist * p.z();
    const double grow = 1.0 + bulge * std::sin(3.0 * p.x());
    const Vec3 twisted(std::cos(angle) * p.x() - std::sin(angle) * p.y(),
      grow * (std::sin(angle) * p.x() + std::cos(angle) * p.y()), p.z());
    return scale.cwiseProduct(twisted);
  }

  Vec3 scale;
  double twist;
  double bulge;
};

/// With the normals as they were.
TriangleMesh warped(TriangleMesh mesh, std::uint64_t seed)
{
  const RandomWarp warp(seed);
  for (Vec3& point : mesh.points)
  {
    point = warp(point);
  }
  return mesh;
}

RemeshOptions optionsFor(double edgeLength)
{
  RemeshOptions options;
  options.edgeLength = edgeLength;
  return options;
}

TEST(Remesh, StretchedMeshesStayManifoldAndGetBetter)
{
  const TriangleMesh original = torusMesh(0.12);
  for (std::uint64_t seed = 1; seed <= 25; ++seed)
  {
    TriangleMesh mesh = warped(original, seed);
    const double volume = signedVolume(mesh);
    const double badBefore = test::shareBelow(mesh, 20.0);
    const double length = 0.15;
    remeshStretched(mesh, optionsFor(length));
    const MeshReport report = checkMesh(mesh);
    ASSERT_TRUE(report.closedManifold()) << "seed " << seed << ": " << report.describe();
    EXPECT_EQ(report.genus(), 1) << seed;
    EXPECT_EQ(report.components, 1u) << seed;
    EXPECT_EQ(report.unusedPoints, 0u);
    EXPECT_EQ(mesh.normals.size(), mesh.points.size());
    EXPECT_LE(longestEdge(mesh), 4.0 / 3.0 * length * (1.0 + 1e-12)) << seed;
    EXPECT_NEAR(signedVolume(mesh), volume, 0.06 * volume) << seed; // some are as thin as an edge
    EXPECT_LT(test::shareBelow(mesh, 20.0), std::max(0.25 * badBefore, 0.02)) << seed;
  }
}

// Triangles are looked at only where something has changed: none may be forgotten.
TEST(Remesh, NothingIsLeftToDoAtTheEnd)
{
  const TriangleMesh original = torusMesh(0.12);
  for (std::uint64_t seed = 1; seed <= 25; ++seed)
  {
    TriangleMesh mesh = warped(original, seed);
    RemeshOptions options = optionsFor(0.15);
    options.maxRounds = 200;
    remeshStretched(mesh, options);
    const TriangleMesh once = mesh;
    remeshStretched(mesh, options);
    EXPECT_EQ(mesh.triangles, once.triangles) << seed;
    EXPECT_EQ(mesh.points, once.points) << seed;
  }
}

TEST(Remesh, ThreadsDoNotChangeTheResult)
{
  const TriangleMesh original = torusMesh(0.03);
  ASSERT_GT(original.triangles.size(), 20000u); // work for several
  std::vector<TriangleMesh> results;
  for (const int threads : { 1, 2, 7 })
  {
    setThreadCount(threads);
    TriangleMesh mesh = warped(original, 4);
    remeshStretched(mesh, optionsFor(0.05));
    results.push_back(std::move(mesh));
  }
  setThreadCount(0);
  for (const TriangleMesh& mesh : results)
  {
    EXPECT_EQ(mesh.triangles, results.front().triangles);
    EXPECT_EQ(mesh.points, results.front().points);
    EXPECT_EQ(mesh.normals, results.front().normals);
  }
}

TEST(Remesh, GoodMeshesKeepTheirBytes)
{
  TriangleMesh mesh = torusMesh(0.12);
  RemeshOptions options = optionsFor(0.3);
  options.badAngle = 0.0;
  const TriangleMesh before = mesh;
  remeshStretched(mesh, options);
  EXPECT_EQ(mesh.triangles, before.triangles);
  EXPECT_EQ(mesh.points, before.points);
  EXPECT_EQ(mesh.normals, before.normals);
}

// Stretched on one side only: the other side keeps its triangles.
TEST(Remesh, WorksOnlyWhereNeeded)
{
  TriangleMesh mesh = torusMesh(0.12);
  for (Vec3& point : mesh.points)
  {
    point.x() = point.x() > 0.0 ? 4.0 * point.x() : point.x();
  }
  const auto untouched = [](const TriangleMesh& m, const Triangle& c) {
    return std::all_of(c.begin(), c.end(), [&](std::int32_t p) { return m.points[p].x() < -0.5; });
  };
  std::vector<std::array<Vec3, 3>> kept;
  for (const Triangle& c : mesh.triangles)
  {
    if (untouched(mesh, c))
    {
      kept.push_back({ mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]] });
    }
  }
  RemeshOptions options = optionsFor(0.16);
  options.badAngle = 0.0; // so that marching cubes' own slivers are not what is mended
  remeshStretched(mesh, options);
  std::size_t found = 0;
  for (const Triangle& c : mesh.triangles)
  {
    const std::array<Vec3, 3> corners{ mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]] };
    found += found < kept.size() && corners == kept[found];
  }
  EXPECT_EQ(found, kept.size());
  EXPECT_GT(kept.size(), 500u);
  EXPECT_TRUE(isClosedManifold(mesh));
}

TEST(Remesh, NewPointsAreProjected)
{
  TriangleMesh mesh = torusMesh(0.25);
  std::size_t asked = 0;
  remeshStretched(mesh, optionsFor(0.1),
    [&](std::vector<Vec3>& points, std::vector<Vec3>& normals)
    {
      ASSERT_EQ(points.size(), normals.size());
      asked += points.size();
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        const Vec3 spine = Vec3(points[k].x(), points[k].y(), 0.0).normalized();
        normals[k] = (points[k] - spine).normalized();
        points[k] = spine + 0.35 * normals[k];
      }
    });
  EXPECT_GT(asked, 1000u);
  EXPECT_TRUE(isClosedManifold(mesh));
  std::size_t off = 0;
  for (const Vec3& point : mesh.points)
  {
    off += std::abs(torusField(point) - kThreshold) > 1e-5;
  }
  EXPECT_LT(off, mesh.points.size() / 100); // those whose move would have folded the mesh
}

TEST(Remesh, LeavesKeepTheirBordersAndProvenance)
{
  TriangleMesh mesh = torusMesh(0.12);
  mesh.sourceLeaf.resize(mesh.triangles.size());
  mesh.sourceTriangle.resize(mesh.triangles.size());
  double area[2] = { 0.0, 0.0 };
  for (Vec3& point : mesh.points)
  {
    point.z() *= 3.0;
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Triangle& c = mesh.triangles[t];
    mesh.sourceLeaf[t] = mesh.points[c[0]].x() + mesh.points[c[1]].x() > 0.1 ? 1 : 0;
    mesh.sourceTriangle[t] = static_cast<std::int32_t>(t);
    area[mesh.sourceLeaf[t]] += areaNormal(mesh, t).norm();
  }
  const TriangleMesh before = mesh;
  remeshStretched(mesh, optionsFor(0.12));
  ASSERT_EQ(mesh.sourceLeaf.size(), mesh.triangles.size());
  ASSERT_EQ(mesh.sourceTriangle.size(), mesh.triangles.size());
  EXPECT_TRUE(isClosedManifold(mesh));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    area[mesh.sourceLeaf[t]] -= areaNormal(mesh, t).norm();
    const std::int32_t source = mesh.sourceTriangle[t];
    if (source < 0)
    {
      continue;
    }
    EXPECT_EQ(mesh.sourceLeaf[t], before.sourceLeaf[source]);
    // It is a part of its source triangle: in its plane, and not larger.
    const Vec3 normal = areaNormal(before, source);
    const Vec3& corner = before.points[before.triangles[source][0]];
    for (const std::int32_t p : mesh.triangles[t])
    {
      EXPECT_NEAR((mesh.points[p] - corner).dot(normal.normalized()), 0.0, 1e-12);
    }
    EXPECT_LE(areaNormal(mesh, t).norm(), normal.norm() * (1.0 + 1e-9));
  }
  EXPECT_NEAR(area[0], 0.0, 0.5);
  EXPECT_NEAR(area[1], 0.0, 0.5);
}

TEST(Remesh, OpenMeshesKeepTheirOutline)
{
  // A strip of long thin triangles.
  TriangleMesh mesh;
  for (int k = 0; k <= 10; ++k)
  {
    mesh.points.emplace_back(0.02 * k, 0.0, 0.0);
    mesh.points.emplace_back(0.02 * k, 1.0, 0.0);
  }
  for (int k = 0; k < 10; ++k)
  {
    mesh.triangles.push_back({ 2 * k, 2 * k + 2, 2 * k + 3 });
    mesh.triangles.push_back({ 2 * k, 2 * k + 3, 2 * k + 1 });
  }
  remeshStretched(mesh, optionsFor(0.1));
  double twiceArea = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    EXPECT_GT(areaNormal(mesh, t).z(), 0.0);
    twiceArea += areaNormal(mesh, t).norm();
  }
  EXPECT_NEAR(twiceArea, 0.4, 1e-12);
  const MeshReport report = checkMesh(mesh);
  EXPECT_TRUE(report.edgeManifold() && report.vertexManifold() && report.oriented());
  EXPECT_EQ(report.eulerCharacteristic, 1);
}

TEST(Remesh, RefusesBadOptions)
{
  TriangleMesh mesh = torusMesh(0.3);
  EXPECT_THROW(remeshStretched(mesh, optionsFor(0.0)), InvalidParameter);
  EXPECT_THROW(remeshStretched(mesh, optionsFor(std::nan(""))), InvalidParameter);
  EXPECT_THROW(remeshStretched(mesh, optionsFor(1e-9)), TooLarge);
  RemeshOptions options = optionsFor(0.1);
  options.badAngle = 60.0;
  EXPECT_THROW(remeshStretched(mesh, options), InvalidParameter);
}

} // namespace
} // namespace hybridtree

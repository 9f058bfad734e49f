// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/RepairMesh.h"

#include "core/base/Error.h"
#include "core/mesh/ContentHash.h"
#include "core/mesh/MeshChecks.h"
#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace hybridtree
{
namespace
{

RepairedMesh repair(const TriangleMesh& mesh)
{
  return repairMesh(mesh.points, mesh.triangles);
}

bool says(const RepairedMesh& result, const std::string& text)
{
  const auto holds = [&](const std::string& told) { return told.find(text) != std::string::npos; };
  return std::any_of(result.warnings.begin(), result.warnings.end(), holds) ||
    std::any_of(result.faults.begin(), result.faults.end(), holds);
}

TriangleMesh turned(TriangleMesh mesh)
{
  for (Triangle& corner : mesh.triangles)
  {
    std::swap(corner[1], corner[2]);
  }
  return mesh;
}

// Every triangle with points of its own, as STL files have it.
TriangleMesh soup(const TriangleMesh& mesh)
{
  TriangleMesh result;
  for (const Triangle& corner : mesh.triangles)
  {
    const std::int32_t first = std::int32_t(result.points.size());
    for (const std::int32_t vertex : corner)
    {
      result.points.push_back(mesh.points[std::size_t(vertex)]);
    }
    result.triangles.push_back({ first, first + 1, first + 2 });
  }
  return result;
}

void expectMapsHold(const TriangleMesh& input, const RepairedMesh& result)
{
  ASSERT_EQ(result.pointMap.size(), input.points.size());
  ASSERT_EQ(result.triangleMap.size(), result.mesh->triangles.size());
  for (std::size_t k = 0; k < input.points.size(); ++k)
  {
    if (result.pointMap[k] >= 0)
    {
      EXPECT_EQ(result.mesh->points[std::size_t(result.pointMap[k])], input.points[k]);
    }
  }
  for (std::size_t t = 0; t < result.triangleMap.size(); ++t)
  {
    Triangle mapped = input.triangles[std::size_t(result.triangleMap[t])];
    Triangle kept = result.mesh->triangles[t];
    for (std::int32_t& vertex : mapped)
    {
      vertex = result.pointMap[std::size_t(vertex)];
    }
    std::sort(mapped.begin(), mapped.end());
    std::sort(kept.begin(), kept.end());
    EXPECT_EQ(mapped, kept);
  }
}

TEST(RepairMesh, LeavesACleanMeshAlone)
{
  const TriangleMesh mesh = test::torus(1.0, 0.25, 20, 10);
  const RepairedMesh result = repair(mesh);
  EXPECT_EQ(result.mesh->points, mesh.points);
  EXPECT_EQ(result.mesh->triangles, mesh.triangles);
  EXPECT_TRUE(result.warnings.empty());
  EXPECT_EQ(contentHash(*result.mesh), contentHash(mesh));
}

TEST(RepairMesh, WeldsEqualPointsAndCloses)
{
  TriangleMesh mesh = soup(test::bumpySphere(1.0, 3));
  for (std::size_t k = 0; k < mesh.points.size(); k += 2)
  {
    mesh.points[k] = mesh.points[k].unaryExpr([](double v) { return v == 0.0 ? -0.0 : v; });
  }
  const RepairedMesh result = repair(mesh);
  EXPECT_TRUE(isClosedManifold(*result.mesh)) << checkMesh(*result.mesh).describe();
  EXPECT_EQ(result.mesh->points.size(), test::bumpySphere(1.0, 3).points.size());
  expectMapsHold(mesh, result);
}

TEST(RepairMesh, OrientsARandomlyTurnedMeshOutward)
{
  test::Random random(11);
  TriangleMesh mesh = test::bumpySphere(2.0, 3);
  const double volume = signedVolume(mesh);
  for (Triangle& corner : mesh.triangles)
  {
    if (random.chance(0.5))
    {
      std::swap(corner[1], corner[2]);
    }
  }
  const RepairedMesh result = repair(mesh);
  EXPECT_TRUE(isClosedManifold(*result.mesh));
  EXPECT_DOUBLE_EQ(signedVolume(*result.mesh), volume);
  EXPECT_TRUE(says(result, "turned to agree"));
  expectMapsHold(mesh, result);
}

TEST(RepairMesh, TurnsAnInsideOutMesh)
{
  const RepairedMesh result = repair(turned(test::icosphere(1.0, 2)));
  EXPECT_GT(signedVolume(*result.mesh), 4.0);
  EXPECT_TRUE(says(result, "1 closed shell turned"));
}

TEST(RepairMesh, CavitiesStayCavities)
{
  const TriangleMesh hollow = test::hollowSphere(1.0, 0.5, 2);
  const TriangleMesh withPearl = test::joined(hollow, test::icosphere(0.25, 1));
  for (const TriangleMesh& mesh : { hollow, turned(hollow), withPearl, turned(withPearl) })
  {
    const RepairedMesh result = repair(mesh);
    const double expected = std::abs(signedVolume(mesh)); // turned as a whole or not at all
    EXPECT_NEAR(signedVolume(*result.mesh), expected, 1e-12);
  }
  EXPECT_TRUE(repair(withPearl).warnings.empty());
  // Two spheres side by side bound no cavity.
  const TriangleMesh apart =
    test::joined(test::icosphere(1.0, 1), test::icosphere(1.0, 1, { 3, 0, 0 }));
  EXPECT_TRUE(repair(apart).warnings.empty());
}

TEST(RepairMesh, DropsFlatAndDuplicateTriangles)
{
  TriangleMesh mesh = test::box({ 0, 0, 0 }, { 1, 1, 1 });
  mesh.points.push_back({ 0.5, 0.0, 0.0 });
  mesh.points.push_back({ 7.0, 7.0, 7.0 });    // unused
  mesh.triangles.push_back({ 0, 1, 1 });       // repeats a point
  mesh.triangles.push_back({ 0, 8, 1 });       // on one line
  mesh.triangles.push_back(mesh.triangles[3]); // again
  std::swap(mesh.triangles.back()[0], mesh.triangles.back()[1]);
  const RepairedMesh result = repair(mesh);
  EXPECT_EQ(result.mesh->triangles.size(), 12u);
  EXPECT_TRUE(isClosedManifold(*result.mesh));
  EXPECT_EQ(result.pointMap[8], -1);
  EXPECT_EQ(result.pointMap[9], -1);
  EXPECT_TRUE(says(result, "1 triangle that repeated a point"));
  EXPECT_TRUE(says(result, "1 triangle with three points on one line"));
  EXPECT_TRUE(says(result, "1 duplicate triangle"));
  expectMapsHold(mesh, result);
}

TEST(RepairMesh, TellsOfTheTJunctionThatAFlatTriangleLeaves)
{
  TriangleMesh mesh = test::box({ 0, 0, 0 }, { 1, 1, 1 });
  // The face z = 0 splits its edge 0-1 at a point 8; a flat triangle joins it to the face y = 0.
  mesh.points.push_back({ 0.5, 0.0, 0.0 });
  mesh.triangles[1] = { 0, 3, 8 };
  mesh.triangles.push_back({ 8, 3, 1 });
  mesh.triangles.push_back({ 0, 8, 1 });
  ASSERT_TRUE(isClosedManifold(mesh) || checkMesh(mesh).degenerateTriangles == 1);
  const RepairedMesh result = repair(mesh);
  EXPECT_TRUE(says(result, "T-junctions"));
  EXPECT_TRUE(says(result, "3 open edges"));
}

// As turned profiles and files in text have them: sides of seams that differ by rounding.
TEST(RepairMesh, JoinsSeamsThatDifferByRounding)
{
  test::Random random(11);
  for (const double scale : { 1e-6, 1.0, 1e6 })
  {
    TriangleMesh mesh = soup(test::bumpySphere(scale, 3));
    for (Vec3& point : mesh.points)
    {
      point += 1e-7 * scale * random.direction();
    }
    const RepairedMesh result = repair(mesh);
    ASSERT_EQ(result.pointMap.size(), mesh.points.size());
    for (std::size_t k = 0; k < mesh.points.size(); ++k)
    {
      const Vec3& kept = result.mesh->points.at(std::size_t(result.pointMap[k]));
      EXPECT_LE((kept - mesh.points[k]).norm(), 3e-7 * scale);
    }
    EXPECT_TRUE(isClosedManifold(*result.mesh)) << checkMesh(*result.mesh).describe();
    EXPECT_TRUE(says(result, "joined with others"));
    EXPECT_TRUE(result.faults.empty());
  }
}

TEST(RepairMesh, JoinsNothingThatIsWiderApart)
{
  TriangleMesh slit = soup(test::icosphere(1.0, 2));
  for (std::size_t k = 0; k < slit.points.size(); k += 3)
  {
    const Vec3 middle = (slit.points[k] + slit.points[k + 1] + slit.points[k + 2]) / 3.0;
    for (std::size_t corner = k; corner < k + 3; ++corner)
    {
      slit.points[corner] += 1e-4 * (middle - slit.points[corner]);
    }
  }
  const RepairedMesh result = repair(slit);
  EXPECT_EQ(result.mesh->points.size(), slit.points.size());
  EXPECT_FALSE(says(result, "joined with others"));
}

TEST(RepairMesh, DropsLooseTrianglesBesideAClosedSurface)
{
  const TriangleMesh solid = test::icosphere(1.0, 3);
  const TriangleMesh flake =
    test::withoutTriangles(test::icosphere(0.1, 0, Vec3(2.0, 0.0, 0.0)), 3, 17);
  ASSERT_EQ(flake.triangles.size(), 3u);
  const TriangleMesh input = test::joined(test::joined(flake, solid), turned(flake));
  const RepairedMesh result = repair(input);
  EXPECT_TRUE(isClosedManifold(*result.mesh)) << checkMesh(*result.mesh).describe();
  EXPECT_EQ(result.mesh->triangles.size(), solid.triangles.size());
  EXPECT_TRUE(says(result, "3 loose triangles dropped"));
  EXPECT_TRUE(result.faults.empty());
  expectMapsHold(input, result);
}

TEST(RepairMesh, KeepsOpenPiecesThatMayBeMeant)
{
  const TriangleMesh solid = test::icosphere(1.0, 3);
  const TriangleMesh far = test::icosphere(0.1, 2, Vec3(2.0, 0.0, 0.0));
  const std::size_t few = 16; // of one face of the icosahedron: they hang together
  const TriangleMesh patch = test::withoutTriangles(far, few, far.triangles.size() - few);
  TriangleMesh fin = solid; // on an edge of the solid
  fin.points.push_back(Vec3(0.0, 0.0, 3.0));
  fin.triangles.push_back(
    { fin.triangles[0][0], fin.triangles[0][1], std::int32_t(fin.points.size()) - 1 });
  const TriangleMesh flake = test::withoutTriangles(far, 1, far.triangles.size() - 1);
  const TriangleMesh small = test::icosphere(1.0, 0); // of which a flake is a large part
  for (const TriangleMesh& input : { test::joined(solid, patch), fin, test::joined(small, flake),
         flake, test::joined(test::withoutTriangles(solid, 0, 1), flake) })
  {
    const RepairedMesh result = repair(input);
    EXPECT_EQ(result.mesh->triangles.size(), input.triangles.size());
    EXPECT_FALSE(says(result, "loose"));
    EXPECT_FALSE(result.faults.empty());
  }
}

TEST(RepairMesh, CountsWhatItCannotRepair)
{
  EXPECT_TRUE(says(repair(test::withoutTriangles(test::icosphere(1.0, 1), 5, 1)), "3 open edges"));
  // Two boxes that share an edge: each closed and turned outward, the edge told.
  const TriangleMesh pair =
    test::joined(test::box({ 0, 0, 0 }, { 1, 1, 1 }), turned(test::box({ 1, 1, 0 }, { 2, 2, 1 })));
  const RepairedMesh boxes = repair(pair);
  EXPECT_TRUE(says(boxes, "1 edge shared by more than two triangles"));
  EXPECT_DOUBLE_EQ(signedVolume(*boxes.mesh), 2.0);
  // A Moebius strip.
  TriangleMesh strip;
  constexpr int count = 12;
  for (int k = 0; k < count; ++k)
  {
    const double u = 6.283185307179586 * k / count;
    for (const double w : { -0.3, 0.3 })
    {
      const double ring = 1.0 + w * std::cos(0.5 * u);
      strip.points.emplace_back(ring * std::cos(u), ring * std::sin(u), w * std::sin(0.5 * u));
    }
    const std::int32_t a = 2 * k;
    const std::int32_t b = 2 * k + 1;
    const bool last = k + 1 == count;
    const std::int32_t c = last ? 1 : 2 * k + 2;
    const std::int32_t d = last ? 0 : 2 * k + 3;
    strip.triangles.push_back({ a, c, b });
    strip.triangles.push_back({ b, c, d });
  }
  EXPECT_TRUE(says(repair(strip), "1 shell cannot be oriented"));
}

TEST(RepairMesh, NamesWhatMakesAMeshUseless)
{
  const auto message = [](const std::vector<Vec3>& points, const std::vector<Triangle>& triangles)
  {
    try
    {
      repairMesh(points, triangles);
    }
    catch (const InvalidGeometry& error)
    {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const std::vector<Vec3> good{ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 } };
  EXPECT_NE(message(good, {}).find("no polygons (3 points)"), std::string::npos);
  EXPECT_NE(message(good, { { 0, 1, 3 } }).find("Triangle 0 refers to point 3"), std::string::npos);
  EXPECT_NE(message(good, { { 0, 1, -1 } }).find("refers to point -1"), std::string::npos);
  std::vector<Vec3> bad = good;
  bad[1].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(message(bad, { { 0, 1, 2 } }).find("Point 1 (of triangle 0)"), std::string::npos);
  bad[1].y() = std::numeric_limits<double>::infinity();
  EXPECT_NE(message(bad, { { 0, 1, 2 } }).find("not finite"), std::string::npos);
  EXPECT_NE(message(good, { { 0, 1, 1 } }).find("All 1 triangles"), std::string::npos);
}

TEST(ContentHash, SeesEveryBitThatCounts)
{
  const TriangleMesh mesh = test::icosphere(1.0, 1);
  TriangleMesh other = mesh;
  other.normals = other.points;
  EXPECT_EQ(contentHash(other), contentHash(mesh));
  other.points[5].z() = std::nextafter(other.points[5].z(), 2.0);
  EXPECT_NE(contentHash(other), contentHash(mesh));
  other = mesh;
  std::swap(other.triangles[3], other.triangles[4]);
  EXPECT_NE(contentHash(other), contentHash(mesh));
  other = mesh;
  std::swap(other.points[3], other.points[4]);
  EXPECT_NE(contentHash(other), contentHash(mesh));
  EXPECT_EQ(contentHashText(mesh).size(), 16u);
  EXPECT_EQ(std::stoull(contentHashText(mesh), nullptr, 16), contentHash(mesh));
}

} // namespace
} // namespace hybridtree

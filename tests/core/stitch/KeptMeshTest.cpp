// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/KeptMesh.h"

#include "core/mesh/MeshChecks.h"
#include "core/stitch/CheckPatch.h"

#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace hybridtree::test
{
namespace
{

Box3 boxOf(const TriangleMesh& mesh, std::size_t t)
{
  Box3 box;
  for (const std::int32_t v : mesh.triangles[t])
  {
    box.extend(mesh.points[v]);
  }
  return box;
}

/// Even triangles, and some that are as long as all of it.
TriangleMesh unevenMesh()
{
  return joined(joined(icosphere(1.0, 4), box(Vec3(-2, -0.1, -0.2), Vec3(2, 0.1, 0.3))),
    icosphere(0.02, 2, Vec3(1.5, 1.5, 0)));
}

TEST(TriangleBlocks, FindAllThatTouchTheBoxes)
{
  Random random(31);
  for (const TriangleMesh& mesh :
    { unevenMesh(), icosphere(0.5, 0), box(Vec3(0, 0, 0), Vec3(1, 1e-9, 3)), TriangleMesh() })
  {
    const TriangleBlocks blocks(mesh);
    for (int trial = 0; trial < 40; ++trial)
    {
      std::vector<Box3> boxes;
      for (int k = random.integer(0, 4); k > 0; --k)
      {
        // Some of them begin exactly at a point of the mesh.
        const bool atPoint = !mesh.empty() && random.chance(0.5);
        const auto last = static_cast<int>(mesh.points.size()) - 1;
        const Vec3 low = atPoint ? mesh.points[static_cast<std::size_t>(random.integer(0, last))]
                                 : random.inBox(Box3(Vec3(-2, -2, -2), Vec3(3, 2, 4)));
        const double side = random.chance(0.3) ? 0.0 : random.uniform(0.0, 0.5);
        boxes.emplace_back(low, Vec3(low + Vec3::Constant(side)));
      }
      const std::vector<std::int32_t> near = blocks.near(boxes);
      EXPECT_TRUE(std::is_sorted(near.begin(), near.end()));
      EXPECT_EQ(std::adjacent_find(near.begin(), near.end()), near.end());
      for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      {
        const Box3 own = boxOf(mesh, t);
        if (std::any_of(
              boxes.begin(), boxes.end(), [&](const Box3& box) { return box.intersects(own); }))
        {
          EXPECT_TRUE(std::binary_search(near.begin(), near.end(), static_cast<std::int32_t>(t)));
        }
      }
    }
  }
}

TEST(TriangleBlocks, LeaveOutMostOfAMesh)
{
  const TriangleMesh mesh = icosphere(1.0, 6);
  const std::vector<std::int32_t> near =
    TriangleBlocks(mesh).near({ Box3(Vec3(0.9, -0.05, -0.05), Vec3(1.1, 0.05, 0.05)) });
  EXPECT_GT(near.size(), 50u);
  EXPECT_LT(near.size(), mesh.triangles.size() / 20);
}

/// Triangles around point 0.
std::vector<FanSide> fan(const std::vector<std::int32_t>& rim)
{
  std::vector<FanSide> sides;
  for (std::size_t k = 0; k < rim.size(); ++k)
  {
    sides.push_back({ 0, rim[k], rim[(k + 1) % rim.size()] });
  }
  return sides;
}

bool isClosed(std::vector<FanSide> sides, std::uint64_t seed)
{
  std::shuffle(sides.begin(), sides.end(), std::mt19937_64(seed));
  return isClosedFan(sides.data(), sides.data() + sides.size());
}

// Small ones are looked at in another way than large ones.
TEST(CheckPatch, ClosedFansAreToldFromAllOthers)
{
  for (const std::int32_t count : { 3, 4, 6, 24, 25, 60 })
  {
    SCOPED_TRACE(count);
    std::vector<std::int32_t> rim;
    for (std::int32_t k = 1; k <= count; ++k)
    {
      rim.push_back(k);
    }
    const std::vector<FanSide> whole = fan(rim);
    for (std::uint64_t seed = 0; seed < 8; ++seed)
    {
      EXPECT_TRUE(isClosed(whole, seed));
      std::vector<FanSide> open = whole;
      open.erase(open.begin() + static_cast<std::ptrdiff_t>(seed % whole.size()));
      EXPECT_FALSE(isClosed(open, seed));
      std::vector<FanSide> twice = whole;
      twice.push_back(whole[seed % whole.size()]);
      EXPECT_FALSE(isClosed(twice, seed));
      std::vector<FanSide> turned = whole;
      std::swap(turned[seed % whole.size()].from, turned[seed % whole.size()].to);
      EXPECT_FALSE(isClosed(turned, seed));
      std::vector<FanSide> two = whole; // closed each, and not connected
      for (const FanSide& side : fan({ 101, 102, 103 }))
      {
        two.push_back(side);
      }
      EXPECT_FALSE(isClosed(two, seed));
      std::vector<std::int32_t> pinched = rim; // comes by the same point twice
      pinched.insert(pinched.begin() + 2, { 201, rim[0], 202 });
      EXPECT_FALSE(isClosed(fan(pinched), seed));
      std::vector<FanSide> flat = whole; // a side from the point to itself
      flat[seed % whole.size()].to = 0;
      EXPECT_FALSE(isClosed(flat, seed));
    }
  }
}

TEST(KeptMesh, SoundMeshesAreClosedManifoldsWithNormals)
{
  Random random(32);
  const TriangleMesh shapes[] = { icosphere(1.0, 2), torus(1.0, 0.3, 12, 8),
    box(Vec3(0, 0, 0), Vec3(1, 2, 3)), joined(icosphere(1.0, 1), icosphere(0.5, 1)) };
  int sound = 0;
  for (int trial = 0; trial < 200; ++trial)
  {
    TriangleMesh mesh = shapes[random.integer(0, 3)];
    mesh.normals.assign(mesh.points.size(), Vec3::UnitX());
    const auto pick = [&]
    {
      return static_cast<std::size_t>(
        random.integer(0, static_cast<int>(mesh.triangles.size()) - 1));
    };
    switch (random.integer(0, 5))
    {
      case 0:
        break; // as it is
      case 1:
        mesh = withoutTriangles(mesh, pick(), 1);
        break;
      case 2:
        std::swap(mesh.triangles[pick()][0], mesh.triangles[pick()][0]);
        break;
      case 3:
        mesh.triangles.push_back(mesh.triangles[pick()]);
        break;
      case 4: // two points become one
        for (Triangle& triangle : mesh.triangles)
        {
          std::replace(triangle.begin(), triangle.end(), 7, 0);
        }
        break;
      default:
        std::swap(mesh.triangles[pick()][1], mesh.triangles[pick()][2]);
    }
    mesh.normals.resize(mesh.points.size(), Vec3::UnitX());
    EXPECT_EQ(KeptMesh(mesh).isSound(), isClosedManifold(mesh));
    sound += KeptMesh(mesh).isSound() ? 1 : 0;
  }
  EXPECT_GT(sound, 20);
  EXPECT_LT(sound, 120);
  EXPECT_FALSE(KeptMesh(shapes[0]).isSound()); // no normals
  TriangleMesh wild = shapes[0];
  wild.normals.assign(wild.points.size(), Vec3::UnitX());
  wild.triangles[3][1] = static_cast<std::int32_t>(wild.points.size());
  EXPECT_FALSE(KeptMesh(wild).isSound());
}

TEST(KeptMesh, CreasesAreTheSharpEdges)
{
  Random random(33);
  for (int trial = 0; trial < 20; ++trial)
  {
    const Vec3 side(random.uniform(0.1, 3.0), random.uniform(0.1, 3.0), random.uniform(0.1, 3.0));
    const double edges = 4.0 * side.sum();
    EXPECT_NEAR(KeptMesh(box(Vec3::Zero(), side)).creaseLength(), edges, 1e-12 * edges);
  }
  const TriangleMesh icosahedron = icosphere(1.0, 0); // 42 degrees
  const double edge = 4.0 / std::sqrt(10.0 + 2.0 * std::sqrt(5.0));
  EXPECT_NEAR(KeptMesh(icosahedron).creaseLength(), 30.0 * edge, 1e-9);
  EXPECT_EQ(KeptMesh(icosphere(1.0, 3)).creaseLength(), 0.0);
}

} // namespace
} // namespace hybridtree::test

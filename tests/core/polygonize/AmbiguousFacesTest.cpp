// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/AmbiguousFaces.h"

#include "core/mesh/MeshChecks.h"
#include "core/polygonize/MarchingCubesTable.h"
#include "core/polygonize/Polygonize.h"
#include "tests/support/FunctionField.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace hybridtree
{
namespace
{

using test::FunctionField;
using test::Random;

using Segment = std::pair<unsigned, unsigned>;
using JoinedLoop = MarchingCubesTable::JoinedLoop;

unsigned facesOf(const JoinedLoop& loop, std::size_t k)
{
  return MarchingCubesTable::facesOf(loop.edges[k % loop.edges.size()]);
}

template <class Body>
void forEachJoined(Body&& body)
{
  const MarchingCubesTable& table = MarchingCubesTable::instance();
  for (unsigned signs = 0; signs < 256; ++signs)
  {
    const unsigned ambiguous = table[signs].ambiguous;
    for (unsigned faces = ambiguous; faces != 0; faces = (faces - 1) & ambiguous)
    {
      body(signs, faces, table.joined(signs, faces));
    }
  }
}

TEST(JoinedFaces, LoopsPassEveryCrossedEdgeOnceAndCutOffTheOutsideCorners)
{
  forEachJoined(
    [](unsigned signs, unsigned faces, const std::vector<JoinedLoop>& loops)
    {
      const MarchingCubesTable::Case& cell = MarchingCubesTable::instance()[signs];
      std::multiset<unsigned> passed;
      std::array<int, 6> joined{};
      for (const JoinedLoop& loop : loops)
      {
        passed.insert(loop.edges.begin(), loop.edges.end());
        for (std::size_t k = 0; k < loop.edges.size(); ++k)
        {
          const auto a = MarchingCubesTable::corners(loop.edges[k]);
          const auto b = MarchingCubesTable::corners(loop.edges[(k + 1) % loop.edges.size()]);
          const unsigned shared = facesOf(loop, k) & facesOf(loop, k + 1);
          ASSERT_NE(shared, 0u);
          for (unsigned face = 0; face < 6; ++face)
          {
            if ((shared & cell.ambiguous & 1u << face) != 0)
            {
              const unsigned corner = a[0] == b[0] || a[0] == b[1] ? a[0] : a[1];
              const bool inside = (signs >> corner & 1u) != 0;
              EXPECT_EQ(inside, (faces >> face & 1u) == 0) << signs << ' ' << faces;
              ++joined[face];
            }
          }
        }
      }
      for (unsigned face = 0; face < 6; ++face)
      {
        EXPECT_EQ(joined[face], (cell.ambiguous >> face & 1u) != 0 ? 2 : 0);
      }
      for (unsigned edge = 0; edge < 12; ++edge)
      {
        EXPECT_EQ(passed.count(edge), cell.edgeMask >> edge & 1u);
      }
    });
}

TEST(JoinedFaces, TrianglesFillTheirLoopWithoutDiagonalsInFaces)
{
  int filled = 0;
  int unfilled = 0;
  forEachJoined(
    [&](unsigned signs, unsigned faces, const std::vector<JoinedLoop>& loops)
    {
      for (const JoinedLoop& loop : loops)
      {
        const auto n = static_cast<unsigned>(loop.edges.size());
        (loop.triangles.empty() ? unfilled : filled) += 1;
        std::map<Segment, int> sides; // directed, by position
        for (std::size_t t = 0; t < loop.triangles.size(); ++t)
        {
          const std::size_t next = t % 3 == 2 ? t - 2 : t + 1;
          ++sides[{ loop.triangles[t], loop.triangles[next] }];
        }
        for (const auto& [side, count] : sides)
        {
          const bool isRim = side.second == (side.first + 1) % n;
          EXPECT_EQ(count, 1) << signs << ' ' << faces;
          EXPECT_TRUE(isRim || sides.count({ side.second, side.first }) == 1);
          EXPECT_TRUE(isRim || side.first == (side.second + 1) % n ||
            (facesOf(loop, side.first) & facesOf(loop, side.second)) == 0);
        }
        EXPECT_EQ(loop.triangleCount(), loop.triangles.empty() ? n : n - 2);
      }
    });
  EXPECT_GT(filled, 4 * unfilled);
  EXPECT_GT(unfilled, 0);
}

// Bands along a line across a face, wide enough to be seen.
TEST(AmbiguousFaces, TheFieldTellsWhichCornersAreJoined)
{
  Random random(5);
  const Lattice lattice{ 0.3, Vec3(0.1, 0.2, 0.3), { -9, -9, -9 }, { 9, 9, 9 } };
  int joinedOnes = 0;
  for (int n = 0; n < 600; ++n)
  {
    AmbiguousFace face{ { random.integer(-5, 5), random.integer(-5, 5), random.integer(-5, 5) },
      unsigned(random.integer(0, 2)), random.chance(0.5) };
    const Vec3 u = 0.3 * Vec3::Unit((face.axis + 1) % 3);
    const Vec3 v = 0.3 * Vec3::Unit((face.axis + 2) % 3);
    const Vec3 low = lattice.point(face.low);
    // From one corner to the one across, over a point beside the middle.
    const bool alongFirst = random.chance(0.5);
    const Vec3 from = alongFirst ? low : Vec3(low + u);
    const Vec3 to = alongFirst ? Vec3(low + u + v) : Vec3(low + v);
    const Vec3 over = low + random.uniform(0.35, 0.65) * u + random.uniform(0.35, 0.65) * v;
    const bool isBand = alongFirst == face.lowInside; // of what is inside
    const auto distance = [](const Vec3& p, const Vec3& a, const Vec3& b)
    {
      const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
      return (p - a - t * (b - a)).norm();
    };
    const FunctionField field(
      [&](const Vec3& p)
      {
        const double depth = 0.06 - std::min(distance(p, from, over), distance(p, over, to));
        return kThreshold + (isBand ? depth : -depth);
      },
      1.0);
    const std::vector<std::uint8_t> joined = joinsInside(field, lattice, { face, face });
    EXPECT_EQ(joined[0] != 0, isBand) << n;
    EXPECT_EQ(joined[0], joined[1]);
    joinedOnes += joined[0];
  }
  EXPECT_GT(joinedOnes, 200);
  EXPECT_LT(joinedOnes, 400);
}

FunctionField disc(const Vec3& normal, double thickness, double radius, double sign)
{
  return FunctionField(
    [=](const Vec3& p)
    {
      const double inDisc = std::min(0.5 * thickness - std::abs(normal.dot(p)), radius - p.norm());
      return kThreshold + (sign > 0.0 ? inDisc : std::min(-inDisc, 1.5 * radius - p.norm()));
    },
    1.0);
}

// A disc, or a gap in a ball, that is a little thicker than a cell is seen whole, however it lies.
TEST(AmbiguousFaces, ThinDiscsAndGapsHaveNoHoles)
{
  Random random(17);
  for (int n = 0; n < 30; ++n)
  {
    const Vec3 normal = random.direction();
    for (const double sign : { 1.0, -1.0 })
    {
      const TriangleMesh mesh = polygonize(
        disc(normal, 0.105, 1.0, sign), Box3(Vec3::Constant(-1.6), Vec3::Constant(1.6)), { 0.1 });
      const MeshReport report = checkMesh(mesh);
      ASSERT_TRUE(report.closedManifold()) << report.describe();
      EXPECT_EQ(report.components, sign > 0.0 ? 1u : 2u) << normal.transpose();
      EXPECT_EQ(report.genus(), 0) << normal.transpose();
    }
  }
}

} // namespace
} // namespace hybridtree

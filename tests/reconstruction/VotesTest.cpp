// SPDX-License-Identifier: BSD-3-Clause
// Walls, gaps and holes of few points across.
#include "reconstruction/Votes.h"

#include "core/mesh/MeshChecks.h"
#include "reconstruction/Convection.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

// At random, on average `density` a unit of area.
void addRectangle(const Vec3& corner, const Vec3& u, const Vec3& v, double density, Random& random,
  std::vector<Vec3>& points)
{
  const int count = static_cast<int>(std::lround(density * u.cross(v).norm()));
  for (int k = 0; k < count; ++k)
  {
    points.push_back(corner + random.unit() * u + random.unit() * v);
  }
}

void addWalls(
  const Vec3& low, const Vec3& size, double density, Random& random, std::vector<Vec3>& points)
{
  const Vec3 x(size.x(), 0.0, 0.0);
  const Vec3 y(0.0, size.y(), 0.0);
  const Vec3 z(0.0, 0.0, size.z());
  addRectangle(low, x, z, density, random, points);
  addRectangle(low + y, x, z, density, random, points);
  addRectangle(low, y, z, density, random, points);
  addRectangle(low + x, y, z, density, random, points);
}

// A block of 10 x 10 x height with a square hole through it, along z.
std::vector<Vec3> blockWithHole(double hole, double height, double density, std::uint64_t seed)
{
  Random random(seed);
  std::vector<Vec3> points;
  const double side = 0.5 * (10.0 - hole);
  addWalls(Vec3::Zero(), { 10.0, 10.0, height }, density, random, points);
  addWalls({ side, side, 0.0 }, { hole, hole, height }, density, random, points);
  for (const double z : { 0.0, height })
  {
    addRectangle({ 0.0, 0.0, z }, { 10.0, 0.0, 0.0 }, { 0.0, side, 0.0 }, density, random, points);
    addRectangle(
      { 0.0, 10.0 - side, z }, { 10.0, 0.0, 0.0 }, { 0.0, side, 0.0 }, density, random, points);
    addRectangle({ 0.0, side, z }, { side, 0.0, 0.0 }, { 0.0, hole, 0.0 }, density, random, points);
    addRectangle(
      { 10.0 - side, side, z }, { side, 0.0, 0.0 }, { 0.0, hole, 0.0 }, density, random, points);
  }
  return points;
}

Vec3 middle(const Tetrahedralization& tetrahedra, std::int32_t cell)
{
  Vec3 sum = Vec3::Zero();
  for (const std::int32_t vertex : tetrahedra.cell(cell))
  {
    sum += tetrahedra.points()[vertex];
  }
  return 0.25 * sum;
}

// Of tetrahedra in the hole, or in the block, how many have the region, in hundredths.
struct Shares
{
  double hole = 0.0;
  double block = 0.0;
};

Shares rightRegions(const std::vector<Vec3>& points, double hole, double height, bool filled)
{
  const Tetrahedralization tetrahedra(points, Progress::none());
  const FacetSize sizes(tetrahedra);
  const double half = 0.5 * hole;
  const auto inHole = [&](std::int32_t cell, double margin)
  {
    const Vec3 p = middle(tetrahedra, cell) - Vec3(5.0, 5.0, 0.0);
    return std::max(std::abs(p.x()), std::abs(p.y())) < half - margin && p.z() > margin &&
      p.z() < height - margin;
  };
  std::vector<std::uint8_t> inside(tetrahedra.cellCount(), 0);
  for (std::int32_t cell = 0; cell < tetrahedra.finiteCellCount(); ++cell)
  {
    inside[cell] = filled || !inHole(cell, 0.0);
  }
  const std::vector<Region> regions = voteOnRegions(tetrahedra, sizes, inside, 1.0);
  double counts[2][2] = { { 0.0, 0.0 }, { 0.0, 0.0 } };
  for (std::int32_t cell = 0; cell < tetrahedra.finiteCellCount(); ++cell)
  {
    const bool empty = inHole(cell, 0.2 * hole);
    if (regions[cell] != Region::Surface && (empty || !inHole(cell, -0.2 * hole)))
    {
      ++counts[empty ? 0 : 1][regions[cell] == (empty ? Region::Outside : Region::Inside) ? 1 : 0];
    }
  }
  return { 100.0 * counts[0][1] / (counts[0][0] + counts[0][1]),
    100.0 * counts[1][1] / (counts[1][0] + counts[1][1]) };
}

class BlockWithHole : public testing::TestWithParam<std::uint64_t>
{
};

// The hole is about three points wide.
TEST_P(BlockWithHole, VotesFindTheHoleThatIsFilledAndLeaveTheBlock)
{
  const std::vector<Vec3> points = blockWithHole(1.5, 5.0, 4.0, GetParam());
  const Shares shares = rightRegions(points, 1.5, 5.0, true);
  EXPECT_GT(shares.hole, 80.0);
  EXPECT_GT(shares.block, 90.0);
}

TEST_P(BlockWithHole, VotesLeaveWhatIsRight)
{
  const std::vector<Vec3> points = blockWithHole(1.5, 5.0, 4.0, GetParam());
  const Shares shares = rightRegions(points, 1.5, 5.0, false);
  EXPECT_GT(shares.hole, 80.0);
  EXPECT_GT(shares.block, 90.0);
}

TEST_P(BlockWithHole, ComesOutWithOneHandle)
{
  for (const double hole : { 1.5, 2.0, 3.0 })
  {
    const MeshReport report =
      checkMesh(reconstruct(blockWithHole(hole, 5.0, 4.0, GetParam())).mesh);
    EXPECT_TRUE(report.closedManifold());
    EXPECT_EQ(report.components, 1u) << hole;
    EXPECT_EQ(report.genus(), 1) << hole;
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, BlockWithHole, testing::Range(std::uint64_t(1), std::uint64_t(6)));

} // namespace

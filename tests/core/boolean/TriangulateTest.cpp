// SPDX-License-Identifier: BSD-3-Clause
#include "core/boolean/Triangulate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace hybridtree
{
namespace
{

using Loops = std::vector<Triangulator::Loop>;

double doubleArea(const PlanarPoint& p, const PlanarPoint& q, const PlanarPoint& r)
{
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
}

// Sides have one triangle, all other edges two that run along them both ways; no triangle is turned
// around, so nothing is covered twice.
void expectCovered(const std::vector<PlanarPoint>& points, const Loops& loops)
{
  std::vector<Triangle> triangles;
  ASSERT_TRUE(Triangulator().triangulate(points, loops, triangles));
  std::map<std::pair<std::int32_t, std::int32_t>, int> edges;
  double turned = 0.0;
  for (const Triangle& t : triangles)
  {
    turned = std::max(turned,
      -doubleArea(points[std::size_t(t[0])], points[std::size_t(t[1])], points[std::size_t(t[2])]));
    for (std::size_t k = 0; k < 3; ++k)
    {
      ++edges[{ t[k], t[(k + 1) % 3] }];
    }
  }
  EXPECT_LE(turned, 1e-15);
  for (const Triangulator::Loop& loop : loops)
  {
    for (std::size_t k = 0; k < loop.size(); ++k)
    {
      ++edges[{ loop[(k + 1) % loop.size()], loop[k] }];
    }
  }
  for (const auto& [edge, count] : edges)
  {
    EXPECT_EQ(count, 1) << edge.first << " to " << edge.second;
    EXPECT_EQ(edges.count({ edge.second, edge.first }), 1u) << edge.first << " to " << edge.second;
  }
}

// Point 4 is inside, and rounded onto the side from 1 to 2 or just across it.
TEST(Triangulate, PointRoundedOntoASideFoldsNothing)
{
  expectCovered({ { 0.37773359512402083, -0.37773359512402083, 1 },
                  { 0.37060241820045348, -0.3817414846013048, 3 },
                  { 0.46937445096587566, -0.45044682073866027, 6 },
                  { 0.48976752186043115, -0.35627092621261658, 4 },
                  { 0.40719533843812461, -0.40719533843812461, 0 } },
    { { 0, 1, 2, 3, 4 } });
}

// Two holes begin at a corner of the triangle: only one order around it folds nothing.
TEST(Triangulate, HolesThatShareACornerAreJoinedInTheirOrderAroundIt)
{
  const std::vector<PlanarPoint> points = { { 0.1696201419227916, -0.88814259346089863, 1 },
    { 0.1696201419227916, -0.88814259346089863, 3 },
    { 0.076595400442839578, -0.75477888610946753, 6 }, { 0, -0.86467245281742822, 5 },
    { 0.11939484396602001, -0.88119297772810312, 1 },
    { 0.11939484396602001, -0.88119297772810312, 0 },
    { 0.076595400442839578, -0.75477888610946753, 0 },
    { 0.1696201419227916, -0.88814259346089863, 0 },
    { 0.11387028941768811, -0.87327277215365884, 0 },
    { 0.10227981076898322, -0.8566562336072765, 0 },
    { 0.084845024775072247, -0.84964565850370977, 0 },
    { 0.076595400442839578, -0.75477888610946753, 0 },
    { 0.034395403601084541, -0.83327112150953409, 0 },
    { 0.031779669834139948, -0.83278175043769975, 0 },
    { 0.028856462616837983, -0.83335294696615625, 0 } };
  expectCovered(points, { { 0, 1, 2, 3, 4, 5 }, { 6, 7, 8, 9, 10 }, { 11, 12, 13, 14 } });
  expectCovered(points, { { 0, 1, 2, 3, 4, 5 }, { 11, 12, 13, 14 }, { 6, 7, 8, 9, 10 } });
}

TEST(Triangulate, HolesOnTheBorderFoldNothing)
{
  expectCovered(
    { { -0.45, -0.27811529493745268, 5 }, { -0.64491023017366089, -0.13285881397994681, 3 },
      { -0.61937186421202817, -0.38279286375841798, 6 }, { -0.45, -0.27811529493745268, 0 },
      { -0.61856959348791363, -0.25632477163337075, 0 },
      { -0.60443714160283712, -0.24011830849818946, 0 },
      { -0.59891989853836025, -0.23326814878936653, 0 }, { -0.45, -0.27811529493745268, 0 },
      { -0.59741486177377323, -0.23103436153919929, 0 },
      { -0.59695312796528144, -0.23010993251138273, 0 },
      { -0.59443144051021868, -0.22090206839813198, 0 } },
    { { 0, 1, 2 }, { 3, 4, 5, 6 }, { 7, 8, 9, 10 } });
}

} // namespace
} // namespace hybridtree

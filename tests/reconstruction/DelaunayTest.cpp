// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Delaunay.h"
#include "reconstruction/DelaunayPredicates.h"
#include "reconstruction/SpatialOrder.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "tests/reconstruction/Samples.h"
#include "tests/support/CancelAt.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <set>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

std::vector<Vec3> cloud(std::size_t count, std::uint64_t seed)
{
  Random random(seed);
  std::vector<Vec3> points(count);
  std::generate(
    points.begin(), points.end(), [&] { return random.inBox(Box3(Vec3::Zero(), Vec3::Ones())); });
  return points;
}

std::vector<Vec3> grid(int side)
{
  std::vector<Vec3> points;
  for (int k = 0; k < side * side * side; ++k)
  {
    points.push_back({ double(k % side), double(k / side % side), double(k / side / side) });
  }
  return points;
}

// Neighbours know each other, no cell is flat or turned, and no vertex is within the ball of a
// neighbouring cell: then the tetrahedralization is Delaunay (Delaunay's lemma). The hull is
// convex.
void expectDelaunay(const Delaunay& delaunay)
{
  const auto& p = delaunay.points();
  for (std::int32_t cell = 0; cell < delaunay.cellCount(); ++cell)
  {
    if (!delaunay.used(cell))
    {
      continue;
    }
    const auto& v = delaunay.cell(cell).vertices;
    if (delaunay.finite(cell))
    {
      ASSERT_EQ(sideOfPlane(p[v[0]], p[v[1]], p[v[2]], p[v[3]]), 1) << "cell " << cell;
    }
    for (std::int32_t facet = 4 * cell; facet < 4 * cell + 4; ++facet)
    {
      const std::int32_t beyond = delaunay.beyond(facet);
      ASSERT_EQ(delaunay.beyond(beyond), facet);
      const auto here = delaunay.facet(facet);
      const auto there = delaunay.facet(beyond);
      ASSERT_EQ(std::set<std::int32_t>(here.begin(), here.end()),
        std::set<std::int32_t>(there.begin(), there.end()));
      const std::int32_t opposite = delaunay.cell(beyond >> 2).vertices[beyond & 3];
      if (opposite >= 0 && delaunay.finite(cell))
      {
        ASSERT_LE(sideOfBall(p[v[0]], p[v[1]], p[v[2]], p[v[3]], p[opposite]), 0);
      }
      if (opposite >= 0 && v[facet & 3] == Delaunay::kInfinite)
      {
        ASSERT_GE(sideOfPlane(p[here[0]], p[here[1]], p[here[2]], p[opposite]), 0);
      }
    }
  }
}

std::set<std::array<double, 3>> differentPlaces(const std::vector<Vec3>& points)
{
  std::set<std::array<double, 3>> places;
  for (const Vec3& p : points)
  {
    places.insert({ p.x(), p.y(), p.z() });
  }
  return places;
}

double volume(const Delaunay& delaunay)
{
  double sum = 0.0;
  for (std::int32_t cell = 0; cell < delaunay.cellCount(); ++cell)
  {
    if (delaunay.used(cell) && delaunay.finite(cell))
    {
      const auto& v = delaunay.cell(cell).vertices;
      const auto at = [&](int k) -> Vec3
      { return delaunay.points()[v[k]] - delaunay.points()[v[0]]; };
      sum += at(1).cross(at(2)).dot(at(3)) / 6.0;
    }
  }
  return sum;
}

TEST(Delaunay, IsDelaunayWhateverThePoints)
{
  std::vector<std::vector<Vec3>> inputs{ cloud(5, 1), cloud(3000, 2), grid(9),
    randomSphere(2000, 3), randomTorus(1.0, 0.4, 3000, 4) };
  // A ring of points on one circle, with its axis; a grid doubled; a sheet with one point off it.
  std::vector<Vec3> ring{ { 0, 0, -1 }, { 0, 0, 1 }, { 0, 0, 0 } };
  for (int k = 0; k < 200; ++k)
  {
    ring.push_back({ std::cos(0.1 * k), std::sin(0.1 * k), 0.0 });
  }
  inputs.push_back(ring);
  std::vector<Vec3> doubled = grid(6);
  doubled.insert(doubled.end(), doubled.begin(), doubled.begin() + 100);
  inputs.push_back(doubled);
  std::vector<Vec3> sheet = cloud(400, 5);
  std::for_each(sheet.begin(), sheet.end() - 1, [](Vec3& p) { p.z() = 0.25; });
  inputs.push_back(sheet);
  std::vector<Vec3> tiny = cloud(300, 6);
  std::for_each(tiny.begin(), tiny.end(), [](Vec3& p) { p = 1e-60 * p + Vec3(1e-60, 0, 0); });
  inputs.push_back(tiny);
  for (std::size_t k = 0; k < inputs.size(); ++k)
  {
    SCOPED_TRACE("input " + std::to_string(k));
    Delaunay delaunay;
    delaunay.insert(inputs[k], Progress::none());
    ASSERT_TRUE(delaunay.spansVolume());
    expectDelaunay(delaunay);
    for (std::size_t point = 0; point < inputs[k].size(); ++point)
    {
      // Of those that coincide, one.
      const auto first = std::find(inputs[k].begin(), inputs[k].end(), inputs[k][point]);
      const auto& p = inputs[k][point];
      const auto in = std::count_if(first, inputs[k].end(),
        [&](const Vec3& q) { return q == p && delaunay.cellOf(&q - inputs[k].data()) >= 0; });
      ASSERT_EQ(in, 1) << "point " << point;
    }
  }
}

// So many that several threads insert them.
TEST(Delaunay, IsTheSameForAnyNumberOfThreads)
{
  std::vector<Vec3> doubled = cloud(9000, 11);
  doubled.insert(doubled.end(), doubled.begin(), doubled.begin() + 3000);
  // Half of them in one plane, across the slabs.
  std::vector<Vec3> sheet = cloud(20000, 12);
  std::for_each(sheet.begin(), sheet.begin() + 10000, [](Vec3& p) { p.z() = 0.5; });
  std::vector<std::vector<Vec3>> inputs{ grid(22), randomSphere(20000, 13),
    randomTorus(1.0, 0.4, 20000, 14), doubled, sheet };
  for (std::size_t k = 0; k < inputs.size(); ++k)
  {
    SCOPED_TRACE("input " + std::to_string(k));
    std::vector<Vec3> ordered;
    for (const std::int32_t point : spatialOrder(inputs[k], Progress::none()))
    {
      ordered.push_back(inputs[k][point]);
    }
    Delaunay parallel;
    setThreadCount(2);
    parallel.insert(ordered, Progress::none());
    expectDelaunay(parallel);
    Delaunay serial;
    setThreadCount(1);
    serial.insert(ordered, Progress::none());
    setThreadCount(0);
    ASSERT_EQ(parallel.cellCount(), serial.cellCount());
    for (std::int32_t cell = 0; cell < serial.cellCount(); ++cell)
    {
      ASSERT_EQ(parallel.used(cell), serial.used(cell));
      ASSERT_TRUE(!serial.used(cell) ||
        (parallel.cell(cell).vertices == serial.cell(cell).vertices &&
          parallel.cell(cell).beyond == serial.cell(cell).beyond));
    }
    const std::set<std::array<double, 3>> different = differentPlaces(ordered);
    std::size_t inserted = 0;
    for (std::size_t point = 0; point < ordered.size(); ++point)
    {
      inserted += serial.cellOf(static_cast<std::int32_t>(point)) >= 0;
    }
    EXPECT_EQ(inserted, different.size());
  }
}

TEST(Delaunay, FillsTheHull)
{
  Delaunay delaunay;
  delaunay.insert(grid(8), Progress::none());
  EXPECT_NEAR(volume(delaunay), 343.0, 1e-9);
}

TEST(Delaunay, GrowsPointByPoint)
{
  const std::vector<Vec3> points = cloud(500, 7);
  Delaunay all;
  all.insert(points, Progress::none());
  Delaunay grown;
  // Flat at first.
  grown.insert({ { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 1, 1, 0 } }, Progress::none());
  EXPECT_FALSE(grown.spansVolume());
  EXPECT_THROW(grown.checkVolume(), InvalidGeometry);
  grown.insert({ points.begin(), points.begin() + 100 }, Progress::none());
  ASSERT_TRUE(grown.spansVolume());
  Delaunay::Cavity cavity;
  for (std::size_t k = 100; k < points.size(); ++k)
  {
    const Delaunay::Place place = grown.locate(points[k], grown.cellOf(static_cast<std::int32_t>(k % 50)));
    ASSERT_EQ(place.vertex, -1);
    grown.findCavity(points[k], place, cavity);
    const std::int32_t vertex = grown.fill(points[k], cavity);
    ASSERT_EQ(grown.points()[vertex], points[k]);
    ASSERT_EQ(grown.locate(points[k], grown.cellOf(0)).vertex, vertex);
    std::vector<std::int32_t> star;
    grown.star(vertex, star);
    std::sort(star.begin(), star.end());
    std::sort(cavity.cells.begin(), cavity.cells.end());
    ASSERT_EQ(star, cavity.cells);
  }
  expectDelaunay(grown);
}

TEST(Delaunay, CanBeCancelled)
{
  Delaunay delaunay;
  EXPECT_THROW(delaunay.insert(cloud(2000, 8), CancelAt(3)), Cancelled);
}

TEST(SpatialOrder, IsAShortWalkThroughAllPoints)
{
  const std::vector<Vec3> points = cloud(4000, 9);
  const std::vector<std::int32_t> order = spatialOrder(points, Progress::none());
  EXPECT_EQ(std::set<std::int32_t>(order.begin(), order.end()).size(), points.size());
  double walk = 0.0;
  for (std::size_t k = 1; k < order.size(); ++k)
  {
    walk += (points[order[k]] - points[order[k - 1]]).norm();
  }
  EXPECT_LT(walk / 4000.0, 2.0 / std::cbrt(4000.0)); // two distances between neighbours
}

TEST(SpatialOrder, InsertsFewFirstAndAllOnce)
{
  for (const std::size_t count : { 0u, 1u, 100u, 20000u })
  {
    const std::vector<std::int32_t> order = insertionOrder(count);
    std::vector<std::int32_t> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::int32_t> all(count);
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(sorted, all);
  }
  const std::vector<std::int32_t> order = insertionOrder(20000);
  std::size_t descents = 0; // a round begins
  for (std::size_t k = 1; k < order.size(); ++k)
  {
    descents += order[k] < order[k - 1];
  }
  EXPECT_GE(descents, 1u);
  EXPECT_LE(descents, 6u);
}

TEST(DelaunayPredicates, AgreeWithExactOnesNearZero)
{
  Random random(10);
  int zeros = 0;
  for (int k = 0; k < 20000; ++k)
  {
    // On a coarse lattice, so that many are on one sphere; where it is scaled, only nearly.
    const double unit = k % 3 == 0 ? 1e-3 : 1.0;
    Vec3 p[5];
    for (Vec3& corner : p)
    {
      const Vec3 at = random.inBox(Box3(Vec3::Zero(), Vec3(3.0, 3.0, 3.0)));
      corner = unit * at.array().round();
    }
    ASSERT_EQ(sideOfPlane(p[0], p[1], p[2], p[3]), exactSideOfPlane(p[0], p[1], p[2], p[3]));
    if (const int side = exactSideOfPlane(p[0], p[1], p[2], p[3]); side != 0)
    {
      if (side < 0)
      {
        std::swap(p[0], p[1]);
      }
      const int ball = exactSideOfBall(p[0], p[1], p[2], p[3], p[4]);
      ASSERT_EQ(sideOfBall(p[0], p[1], p[2], p[3], p[4]), ball);
      ASSERT_EQ(
        sideOfLeastBall(p[0], p[1], p[2], p[4]), exactSideOfLeastBall(p[0], p[1], p[2], p[4]));
      zeros += ball == 0;
    }
  }
  EXPECT_GT(zeros, 100);
}

} // namespace

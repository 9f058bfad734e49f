// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/SkeletonPieces.h"

#include "core/subdivision/Subdivide.h"
#include "tests/support/SkeletonShapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace hybridtree
{
namespace
{

SkeletonPieces piecesOf(const SkeletonGraph& graph)
{
  return findPieces(graph, SkeletonTopology(graph));
}

// Every element is in one piece, and curves run along their segments.
void expectPartition(const SkeletonGraph& graph, const SkeletonPieces& pieces)
{
  std::multiset<std::int32_t> segments;
  for (const CurvePiece& curve : pieces.curves)
  {
    ASSERT_EQ(curve.points.size(), curve.segments.size() + 1);
    EXPECT_EQ(curve.closed, curve.points.front() == curve.points.back());
    for (std::size_t k = 0; k < curve.segments.size(); ++k)
    {
      SkeletonSegment ends = graph.segments[curve.segments[k]];
      SkeletonSegment steps{ curve.points[k], curve.points[k + 1] };
      std::sort(ends.begin(), ends.end());
      std::sort(steps.begin(), steps.end());
      EXPECT_EQ(ends, steps);
      segments.insert(curve.segments[k]);
    }
  }
  std::multiset<std::int32_t> triangles;
  for (const SurfacePiece& surface : pieces.surfaces)
  {
    triangles.insert(surface.triangles.begin(), surface.triangles.end());
  }
  EXPECT_EQ(segments.size(), graph.segments.size());
  EXPECT_EQ(std::set<std::int32_t>(segments.begin(), segments.end()).size(), segments.size());
  EXPECT_EQ(triangles.size(), graph.triangles.size());
  EXPECT_EQ(std::set<std::int32_t>(triangles.begin(), triangles.end()).size(), triangles.size());
}

TEST(SkeletonPieces, Figure7HasFiveCurvesAndTwoSurfaces)
{
  const SkeletonGraph graph = test::figure7();
  const SkeletonPieces pieces = piecesOf(graph);
  EXPECT_EQ(pieces.curves.size(), 5u);
  EXPECT_EQ(pieces.surfaces.size(), 2u);
  expectPartition(graph, pieces);
}

TEST(SkeletonPieces, TheBretzelIsThreeArmsAndThreeArcs)
{
  const SkeletonGraph graph = test::bretzel();
  const SkeletonPieces pieces = piecesOf(graph);
  EXPECT_EQ(pieces.curves.size(), 6u);
  expectPartition(graph, pieces);
}

// Spine below and above the chest, 2 arms, 2 legs, tail, 8 fingers, 6
// toes, 2 antennae; head, 2 ears and the fin, which hangs on the spine without ending it.
TEST(SkeletonPieces, ASurfaceThatHangsOnACurveDoesNotEndIt)
{
  const SkeletonGraph graph = test::alien();
  const SkeletonPieces pieces = piecesOf(graph);
  EXPECT_EQ(pieces.curves.size(), 2u + 2u + 2u + 1u + 8u + 6u + 2u + 2u);
  EXPECT_EQ(pieces.surfaces.size(), 4u);
  expectPartition(graph, pieces);
}

TEST(SkeletonPieces, PiecesDoNotDependOnLevel)
{
  for (const SkeletonGraph& graph : { test::figure7(), test::bretzel(), test::alien() })
  {
    const SkeletonPieces coarse = piecesOf(graph);
    const RefinedSkeleton refined = subdivide(graph, SubdivisionScheme::Approximating, 2);
    const SkeletonPieces fine = piecesOf(refined);
    expectPartition(refined, fine);
    ASSERT_EQ(fine.curves.size(), coarse.curves.size());
    ASSERT_EQ(fine.surfaces.size(), coarse.surfaces.size());
    for (std::size_t k = 0; k < fine.curves.size(); ++k)
    {
      EXPECT_EQ(fine.curves[k].segments.size(), 4 * coarse.curves[k].segments.size());
    }
  }
}

TEST(SkeletonPieces, ARingIsClosedHoweverItsSegmentsLie)
{
  SkeletonGraph graph;
  for (int k = 0; k < 5; ++k)
  {
    graph.points.emplace_back(std::cos(1.2566 * k), std::sin(1.2566 * k), 0.0);
    graph.radii.push_back(0.1);
    const std::int32_t next = (k + 1) % 5;
    graph.segments.push_back(k % 2 ? SkeletonSegment{ k, next } : SkeletonSegment{ next, k });
  }
  const SkeletonPieces pieces = piecesOf(graph);
  ASSERT_EQ(pieces.curves.size(), 1u);
  EXPECT_TRUE(pieces.curves[0].closed);
  expectPartition(graph, pieces);
}

} // namespace
} // namespace hybridtree

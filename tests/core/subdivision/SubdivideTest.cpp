// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/Subdivide.h"

#include "core/base/Error.h"
#include "core/subdivision/SkeletonTopology.h"
#include "tests/support/Random.h"
#include "tests/support/SkeletonShapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace hybridtree
{
namespace
{

using test::alien;
using test::bretzel;
using test::chain;
using test::fan;
using test::figure7;

/// A sheet of two triangles by `n` with a segment over each edge between, and a curve that leaves
/// it.
SkeletonGraph creased(int n)
{
  SkeletonGraph graph;
  for (int k = 0; k <= n; ++k)
  {
    for (int row = -1; row <= 1; ++row)
    {
      graph.points.emplace_back(k, row, 0.4 * std::abs(row) + 0.1 * k * k);
      graph.radii.push_back(0.2 + 0.05 * (row + 1));
    }
  }
  for (int k = 0; k < n; ++k)
  {
    for (int row = 0; row < 2; ++row)
    {
      const std::int32_t a = 3 * k + row;
      graph.triangles.push_back({ a, a + 3, a + 4 });
      graph.triangles.push_back({ a, a + 4, a + 1 });
    }
    graph.segments.push_back({ 3 * k + 1, 3 * k + 4 });
  }
  graph.points.emplace_back(n + 1.5, 0.3, 2.0);
  graph.radii.push_back(0.3);
  graph.segments.push_back({ 3 * n + 1, 3 * n + 3 });
  return graph;
}

struct Case
{
  const char* name;
  SkeletonGraph graph;
};

std::vector<Case> cases()
{
  return { { "bretzel", bretzel() }, { "alien", alien() }, { "figure 7", figure7() },
    { "chain", chain(5) }, { "fan", fan(5, true) }, { "open fan", fan(4, false) },
    { "triangle", fan(1, false) }, { "segment", chain(1) }, { "creased", creased(4) } };
}

constexpr SubdivisionScheme kSchemes[] = { SubdivisionScheme::Approximating,
  SubdivisionScheme::Interpolating };

// points - edges + triangles of the complex, isolated points excepted.
std::int64_t euler(const SkeletonGraph& graph)
{
  const SkeletonTopology topology(graph);
  std::set<std::int32_t> used;
  for (const SkeletonEdge& edge : topology.edges())
  {
    used.insert(edge.ends.begin(), edge.ends.end());
  }
  return std::int64_t(used.size()) - std::int64_t(topology.edges().size()) +
    std::int64_t(graph.triangles.size());
}

TEST(Subdivide, ShapesHaveTheSizesOfThePaper)
{
  EXPECT_EQ(bretzel().segments.size(), 24u);
  EXPECT_EQ(alien().segments.size(), 102u);
  EXPECT_EQ(alien().triangles.size(), 15u);
  EXPECT_EQ(euler(bretzel()), -2); // one piece with three loops
}

TEST(Subdivide, EveryLevelIsAValidSkeletonOfTheSameTopology)
{
  for (const Case& shape : cases())
  {
    const std::int64_t expected = euler(shape.graph);
    for (const SubdivisionScheme scheme : kSchemes)
    {
      for (int level = 0; level <= 3; ++level)
      {
        const RefinedSkeleton refined = subdivide(shape.graph, scheme, level);
        ASSERT_NO_THROW(validate(refined)) << shape.name << " at level " << level;
        EXPECT_EQ(euler(refined), expected) << shape.name << " at level " << level;
        EXPECT_EQ(refined.segments.size(), shape.graph.segments.size() << level);
        EXPECT_EQ(refined.triangles.size(), shape.graph.triangles.size() << (2 * level));
      }
    }
  }
}

TEST(Subdivide, CommutesWithAffineMaps)
{
  test::Random random(11);
  for (const Case& shape : cases())
  {
    Affine3 map = Affine3::Identity();
    map.linear() = random.rotation() * Vec3(1.3, 0.4, 2.1).asDiagonal() * random.rotation();
    map.translation() = 10.0 * random.direction();
    SkeletonGraph mapped = shape.graph;
    for (Vec3& point : mapped.points)
    {
      point = map * point;
    }
    for (const SubdivisionScheme scheme : kSchemes)
    {
      const RefinedSkeleton plain = subdivide(shape.graph, scheme, 3);
      const RefinedSkeleton result = subdivide(mapped, scheme, 3);
      for (std::size_t k = 0; k < plain.points.size(); ++k)
      {
        ASSERT_LT((result.points[k] - map * plain.points[k]).norm(), 1e-11)
          << shape.name << ", point " << k;
      }
    }
  }
}

TEST(Subdivide, RadiiFollowTheMasksOfPointsAndStayPositive)
{
  for (const Case& shape : cases())
  {
    // A radius that is a linear function of the place stays that function where nothing is clamped.
    SkeletonGraph graph = shape.graph;
    const Vec3 slope(0.003, -0.002, 0.001);
    for (std::size_t k = 0; k < graph.points.size(); ++k)
    {
      graph.radii[k] = 1.0 + slope.dot(graph.points[k]);
    }
    for (const SubdivisionScheme scheme : kSchemes)
    {
      const RefinedSkeleton refined = subdivide(graph, scheme, 3);
      for (std::size_t k = 0; k < refined.points.size(); ++k)
      {
        ASSERT_NEAR(refined.radii[k], 1.0 + slope.dot(refined.points[k]), 1e-12) << shape.name;
      }
    }
    const RefinedSkeleton refined = subdivide(shape.graph, SubdivisionScheme::Approximating, 3);
    const auto [least, most] =
      std::minmax_element(shape.graph.radii.begin(), shape.graph.radii.end());
    for (const double radius : refined.radii)
    {
      ASSERT_GE(radius, *least - 1e-12);
      ASSERT_LE(radius, *most + 1e-12);
    }
  }
}

TEST(Subdivide, InterpolatingRadiiNeverVanish)
{
  SkeletonGraph graph = chain(8);
  for (std::size_t k = 0; k < graph.radii.size(); ++k)
  {
    graph.radii[k] = k % 4 < 2 ? 1e-3 : 1.0;
  }
  const RefinedSkeleton refined = subdivide(graph, SubdivisionScheme::Interpolating, 5);
  EXPECT_GT(*std::min_element(refined.radii.begin(), refined.radii.end()), 1e-5);
}

TEST(Subdivide, InterpolatingKeepsThePoints)
{
  for (const Case& shape : cases())
  {
    const RefinedSkeleton refined = subdivide(shape.graph, SubdivisionScheme::Interpolating, 3);
    for (std::size_t k = 0; k < shape.graph.points.size(); ++k)
    {
      EXPECT_EQ(refined.points[k], shape.graph.points[k]) << shape.name;
    }
  }
}

TEST(Subdivide, EndsAndJunctionsOfCurvesStay)
{
  const SkeletonGraph graph = bretzel();
  const SkeletonTopology topology(graph);
  const RefinedSkeleton refined = subdivide(graph, SubdivisionScheme::Approximating, 4);
  int junctions = 0;
  for (std::size_t k = 0; k < graph.points.size(); ++k)
  {
    if (topology.vertices()[k].kind == SkeletonVertex::Kind::Corner)
    {
      EXPECT_EQ(refined.points[k], graph.points[k]);
      ++junctions;
    }
  }
  EXPECT_EQ(junctions, 4);
}

TEST(Subdivide, ChildrenTileTheirParents)
{
  for (const Case& shape : cases())
  {
    const RefinedSkeleton refined = subdivide(shape.graph, SubdivisionScheme::Approximating, 3);
    std::vector<double> length(shape.graph.segments.size(), 0.0);
    for (std::size_t s = 0; s < refined.segments.size(); ++s)
    {
      const auto [from, to] = refined.segmentParameters[s];
      EXPECT_LT(from, to);
      length[refined.segmentParents[s]] += to - from;
    }
    std::vector<double> area(shape.graph.triangles.size(), 0.0);
    for (std::size_t t = 0; t < refined.triangles.size(); ++t)
    {
      const auto& at = refined.triangleParameters[t];
      Eigen::Matrix2d sides;
      sides << at[1] - at[0], at[2] - at[0];
      EXPECT_GT(sides.determinant(), 0.0);
      area[refined.triangleParents[t]] += sides.determinant();
    }
    for (const auto* sums : { &length, &area })
    {
      for (const double sum : *sums)
      {
        EXPECT_NEAR(sum, 1.0, 1e-12) << shape.name;
      }
    }
  }
}

// With parameters as places the scheme of flat, equal elements, so a child's parameters are exact
// linear coordinates: checked on one triangle by the place of its parts at level 1.
TEST(Subdivide, ParametersNameThePlaceOnTheParent)
{
  const SkeletonGraph graph = fan(3, false);
  const RefinedSkeleton refined = subdivide(graph, SubdivisionScheme::Interpolating, 1);
  for (std::size_t t = 0; t < refined.triangles.size(); ++t)
  {
    const Triangle& parent = graph.triangles[refined.triangleParents[t]];
    for (int corner = 0; corner < 3; ++corner)
    {
      const Eigen::Vector2d at = refined.triangleParameters[t][corner];
      const double weight[] = { 1.0 - at.sum(), at.x(), at.y() };
      for (int k = 0; k < 3; ++k)
      {
        if (weight[k] == 1.0)
        {
          EXPECT_EQ(refined.triangles[t][corner], parent[k]);
        }
      }
    }
  }
}

TEST(Subdivide, SegmentsOverEdgesStayEdgesAndMakeCreases)
{
  const SkeletonGraph graph = creased(4);
  for (const SubdivisionScheme scheme : kSchemes)
  {
    const RefinedSkeleton refined = subdivide(graph, scheme, 3);
    const SkeletonTopology topology(refined);
    for (std::size_t s = 0; s < refined.segments.size(); ++s)
    {
      const SkeletonEdge& edge = topology.edges()[topology.segmentEdge(s)];
      EXPECT_EQ(edge.triangles[1] >= 0, refined.segmentParents[s] < 4) << "segment " << s;
    }
    // The fold along the middle row stays one: neighbours on both sides rise from it.
    for (const SkeletonEdge& edge : topology.edges())
    {
      const Vec3 middle = 0.5 * (refined.points[edge.ends[0]] + refined.points[edge.ends[1]]);
      if (edge.segment < 0 || edge.triangles[1] < 0 || middle.x() < 1.0 || middle.x() > 3.0)
      {
        continue;
      }
      for (const std::int32_t t : edge.triangles)
      {
        const Vec3 wing = refined.points[topology.opposite(t, edge)] - middle;
        EXPECT_GT((wing.z() - 0.2 * middle.x() * wing.x()) / std::abs(wing.y()), 0.2);
      }
    }
  }
}

TEST(Subdivide, RefusesLevelsAndSizesByName)
{
  EXPECT_THROW(subdivide(chain(2), SubdivisionScheme::Approximating, -1), InvalidParameter);
  EXPECT_THROW(subdivide(chain(2), SubdivisionScheme::Approximating, 7), InvalidParameter);
  EXPECT_THROW(subdivide(chain(100000), SubdivisionScheme::Approximating, 6), TooLarge);
  EXPECT_THROW(subdivide({}, SubdivisionScheme::Approximating, 1), InvalidGeometry);
}

} // namespace
} // namespace hybridtree

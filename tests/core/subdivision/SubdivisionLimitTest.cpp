// SPDX-License-Identifier: BSD-3-Clause
// What the schemes converge to: Loop 1987; Zorin, Schroeder, Sweldens 1996; Biermann, Levin, Zorin
// 2000; Dyn, Levin, Gregory 1987 and 1990.
#include "core/subdivision/Subdivide.h"
#include "core/subdivision/SubdivisionMasks.h"
#include "core/subdivision/SubdivisionStep.h"
#include "tests/support/SkeletonShapes.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>

namespace hybridtree
{
namespace
{

const double kPi = std::acos(-1.0);
constexpr SubdivisionScheme kLoop = SubdivisionScheme::Approximating;
constexpr SubdivisionScheme kButterfly = SubdivisionScheme::Interpolating;

/// Triangulated sectors around point 0: `rings` rings of the regular grid in each.
class Disk
{
public:
  Disk(int sectors, bool closed, int rings) : sectors_(sectors), closed_(closed), rings_(rings)
  {
    for (int s = 0; s < sectors; ++s)
    {
      for (int i = 0; i < rings; ++i)
      {
        for (int j = 0; i + j < rings; ++j)
        {
          graph.triangles.push_back({ at(s, i, j), at(s, i + 1, j), at(s, i, j + 1) });
          if (i + j + 1 < rings)
          {
            graph.triangles.push_back({ at(s, i + 1, j), at(s, i + 1, j + 1), at(s, i, j + 1) });
          }
        }
      }
    }
    if (graph.points.empty())
    {
      at(0, 0, 0);
    }
  }

  // Point i steps along the first edge of a sector and j along its second.
  std::int32_t at(int sector, int i, int j)
  {
    if (i == 0 && j > 0)
    {
      return at(closed_ ? (sector + 1) % sectors_ : sector + 1, j, 0);
    }
    const auto key = std::array<int, 3>{ i + j == 0 ? 0 : sector, i, j };
    const auto [found, isNew] = number_.try_emplace(key, std::int32_t(graph.points.size()));
    if (isNew)
    {
      const double turn = (closed_ ? 2.0 : 1.0) * kPi / sectors_;
      const auto ray = [&](int k) { return Vec3(std::cos(turn * k), std::sin(turn * k), 0.0); };
      graph.points.push_back(i * ray(sector) + j * ray(sector + 1));
      graph.radii.push_back(1.0);
    }
    return found->second;
  }

  // For each point of this disk the one of the disk after a step that has its place, one ring
  // nearer.
  std::vector<std::int32_t> successors(const SkeletonTopology& topology)
  {
    std::vector<std::int32_t> result(graph.points.size());
    const auto count = std::int32_t(graph.points.size());
    const auto middle = [&](std::int32_t a, std::int32_t b)
    {
      for (auto [e, end] = topology.edgesAt(a); e != end; ++e)
      {
        if (topology.edges()[*e].otherEnd(a) == b)
        {
          return count + *e;
        }
      }
      return std::int32_t(-1);
    };
    for (int s = 0; s < sectors_; ++s)
    {
      for (int i = 0; i <= rings_; ++i)
      {
        for (int j = 0; i + j <= rings_; ++j)
        {
          const std::int32_t low = at(s, i / 2, j / 2);
          const int kind = 2 * (i % 2) + j % 2;
          result[at(s, i, j)] = kind == 0 ? low
            : kind == 1                   ? middle(low, at(s, i / 2, j / 2 + 1))
            : kind == 2                   ? middle(low, at(s, i / 2 + 1, j / 2))
                        : middle(at(s, i / 2 + 1, j / 2), at(s, i / 2, j / 2 + 1));
        }
      }
    }
    return result;
  }

  SkeletonGraph graph;

private:
  int sectors_;
  bool closed_;
  int rings_;
  std::map<std::array<int, 3>, std::int32_t> number_;
};

/// Column by column: what a step makes of a value 1 at one point.
Eigen::MatrixXd subdivisionMatrix(Disk& disk, SubdivisionScheme scheme)
{
  const SkeletonTopology topology(disk.graph);
  const std::vector<std::int32_t> next = disk.successors(topology);
  const std::size_t count = disk.graph.points.size();
  Eigen::MatrixXd matrix(count, count);
  for (std::size_t k = 0; k < count; ++k)
  {
    SkeletonGraph unit = disk.graph;
    std::fill(unit.points.begin(), unit.points.end(), Vec3::Zero());
    unit.points[k].x() = 1.0;
    const SkeletonGraph after = subdividedPoints(unit, topology, scheme);
    for (std::size_t row = 0; row < count; ++row)
    {
      matrix(row, k) = after.points[next[row]].x();
    }
  }
  return matrix;
}

struct Spectrum
{
  std::vector<double> values; // by size, falling
  Eigen::MatrixXd vectors;
};

Spectrum spectrum(const Eigen::MatrixXd& matrix)
{
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(matrix);
  std::vector<int> order(matrix.rows());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [&](int a, int b)
    { return std::abs(solver.eigenvalues()[a]) > std::abs(solver.eigenvalues()[b]); });
  Spectrum result;
  result.vectors.resize(matrix.rows(), 3);
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    result.values.push_back(std::abs(solver.eigenvalues()[order[k]]));
    if (k < 3)
    {
      EXPECT_NEAR(solver.eigenvalues()[order[k]].imag(), 0.0, 1e-7);
      result.vectors.col(k) = solver.eigenvectors().col(order[k]).real();
    }
  }
  return result;
}

/// 1 > l = l > all others, and the plane of the two eigenvectors, which the surface looks like
/// around the point however closely one looks, is covered once: the limit has a tangent plane (Reif
/// 1995).
void expectTangentPlane(
  Disk& disk, const Eigen::MatrixXd& matrix, double lambda, const std::string& what)
{
  const Spectrum s = spectrum(matrix);
  EXPECT_NEAR(s.values[0], 1.0, 1e-9) << what;
  EXPECT_NEAR(s.values[1], lambda, 1e-6) << what;
  EXPECT_NEAR(s.values[2], lambda, 1e-6) << what;
  ASSERT_LT(s.values[3], lambda - 1e-3) << what;
  int positive = 0;
  for (const Triangle& t : disk.graph.triangles)
  {
    const auto at = [&](int corner)
    { return Eigen::Vector2d(s.vectors(t[corner], 1), s.vectors(t[corner], 2)); };
    Eigen::Matrix2d sides;
    sides << at(1) - at(0), at(2) - at(0);
    positive += sides.determinant() > 0.0 ? 1 : 0;
  }
  EXPECT_TRUE(positive == 0 || positive == int(disk.graph.triangles.size()))
    << what << ": " << positive << " of " << disk.graph.triangles.size();
}

TEST(SubdivisionMasks, SumToOneAndAreThePublishedOnes)
{
  for (std::size_t n = 3; n <= 12; ++n)
  {
    const double c = 0.375 + 0.25 * std::cos(2.0 * kPi / n);
    EXPECT_NEAR(1.0 - n * loopNeighbourWeight(n), 0.375 + c * c, 1e-15); // Loop's own form
    const RingMask mask = butterflyRingMask(n);
    EXPECT_NEAR(mask.center, 0.75, 1e-14);
    EXPECT_NEAR(std::accumulate(mask.ring.begin(), mask.ring.end(), mask.center), 1.0, 1e-14);
  }
  EXPECT_NEAR(loopNeighbourWeight(6), 1.0 / 16.0, 1e-15);
  EXPECT_NEAR(loopSectorWeight(3, SectorShape::Straight), 0.375, 1e-15);
  // Zorin, Schroeder, Sweldens 1996: (1/4 + cos + cos / 2) / 6 is 7/24 at the edge itself.
  EXPECT_NEAR(butterflyRingMask(6).ring[0], 7.0 / 24.0, 1e-15);
}

TEST(SubdivisionMasks, SectorMaskIsThePublishedCreaseMask)
{
  // Zorin and Schroeder, course notes 2000, "crease, extraordinary".
  for (std::size_t k = 2; k <= 8; ++k)
  {
    const double t = kPi / k;
    for (std::size_t i = 1; i < k; ++i)
    {
      const RingMask mask = butterflySectorMask(k, i, SectorShape::Straight);
      EXPECT_NEAR(
        mask.center, 1.0 - std::sin(t) * std::sin(i * t) / (k * (1.0 - std::cos(t))), 1e-13);
      const double atBorder = 0.25 * std::cos(i * t) -
        std::sin(2 * t) * std::sin(2 * t * i) / (4.0 * k * (std::cos(t) - std::cos(2 * t)));
      EXPECT_NEAR(mask.ring[0], atBorder, 1e-13);
      EXPECT_NEAR(mask.ring[k], -atBorder, 1e-13);
    }
  }
}

TEST(SubdivisionLimit, InnerPointsHaveATangentPlane)
{
  for (int n = 3; n <= 12; ++n)
  {
    Disk small(n, true, 3);
    const double lambda = n == 3 ? 0.25 : 0.375 + 0.25 * std::cos(2.0 * kPi / n);
    expectTangentPlane(
      small, subdivisionMatrix(small, kLoop), lambda, "Loop, valence " + std::to_string(n));
    Disk large(n, true, 4);
    expectTangentPlane(
      large, subdivisionMatrix(large, kButterfly), 0.5, "butterfly, valence " + std::to_string(n));
  }
}

// A point of one triangle has no inner edge: its border is smooth, the rest shrinks faster.
TEST(SubdivisionLimit, BordersHaveATangentPlane)
{
  for (int k = 2; k <= 8; ++k)
  {
    Disk small(k, false, 3);
    expectTangentPlane(
      small, subdivisionMatrix(small, kLoop), 0.5, "Loop, border of " + std::to_string(k));
    Disk large(k, false, 4);
    expectTangentPlane(large, subdivisionMatrix(large, kButterfly), 0.5,
      "butterfly, border of " + std::to_string(k));
  }
}

TEST(SubdivisionLimit, CornersHaveATangentPlane)
{
  for (const SubdivisionScheme scheme : { kLoop, kButterfly })
  {
    for (int k = 1; k <= 6; ++k)
    {
      Disk disk(k, false, 4);
      // A curve that ends at the border makes the point a corner.
      disk.graph.points.emplace_back(0.0, -1.0, 1.0);
      disk.graph.radii.push_back(1.0);
      disk.graph.segments.push_back({ 0, std::int32_t(disk.graph.points.size() - 1) });
      const SkeletonTopology topology(disk.graph);
      EXPECT_EQ(topology.vertices()[0].kind, SkeletonVertex::Kind::Corner);
      const std::size_t own = disk.graph.points.size() - 1;
      const Eigen::MatrixXd matrix = subdivisionMatrix(disk, scheme);
      expectTangentPlane(disk, matrix.topLeftCorner(own, own), 0.5,
        (scheme == kLoop ? "Loop, corner of " : "butterfly, corner of ") + std::to_string(k));
    }
  }
}

TEST(SubdivisionLimit, CurvesHaveTangentsAtPointsAndEnds)
{
  for (const SubdivisionScheme scheme : { kLoop, kButterfly })
  {
    const RefinedSkeleton coarse = subdivide(test::chain(5), scheme, 4);
    const RefinedSkeleton fine = subdivide(test::chain(5), scheme, 6);
    const auto turn = [](const RefinedSkeleton& curve)
    {
      double most = 0.0;
      for (std::size_t s = 1; s < curve.segments.size(); ++s)
      {
        const auto side = [&](std::size_t n) {
          return (curve.points[curve.segments[n][1]] - curve.points[curve.segments[n][0]])
            .normalized();
        };
        most = std::max(most, (side(s) - side(s - 1)).norm());
      }
      return most;
    };
    // Turning by angles that fall with the length of segments: no kink stays.
    EXPECT_LT(turn(fine), 0.45 * turn(coarse));
  }
}

TEST(SubdivisionLimit, LimitMasksOfLoopDoNotChangeFromLevelToLevel)
{
  const auto limit = [](const SkeletonGraph& graph, std::int32_t point)
  {
    const SkeletonTopology topology(graph);
    const SkeletonVertex& v = topology.vertices()[point];
    if (v.kind == SkeletonVertex::Kind::Curve)
    {
      return Vec3(
        (4.0 * graph.points[point] + graph.points[v.along[0]] + graph.points[v.along[1]]) / 6.0);
    }
    Vec3 sum = Vec3::Zero();
    std::size_t n = 0;
    for (auto [e, end] = topology.edgesAt(point); e != end; ++e, ++n)
    {
      sum += graph.points[topology.edges()[*e].otherEnd(point)];
    }
    const double weight = 1.0 / (0.375 / loopNeighbourWeight(n) + double(n));
    return Vec3((1.0 - double(n) * weight) * graph.points[point] + weight * sum);
  };
  for (int n = 3; n <= 9; ++n)
  {
    // From level 1 on, where inner points and irregular border points are no neighbours any more.
    const SkeletonGraph graph = test::fan(n, true);
    const Vec3 expected = limit(subdivide(graph, kLoop, 1), 0);
    const Vec3 border = limit(graph, 1);
    for (int level = 1; level <= 3; ++level)
    {
      const RefinedSkeleton refined = subdivide(graph, kLoop, level);
      EXPECT_LT((limit(refined, 0) - expected).norm(), 1e-13);
      EXPECT_LT((limit(refined, 1) - border).norm(), 1e-13);
    }
    EXPECT_LT((subdivide(graph, kLoop, 6).points[0] - expected).norm(), 1e-3);
  }
}

/// A function over the regular grid, on which the border is far from the middle.
SkeletonGraph heightField(int half, const std::function<double(double, double)>& height)
{
  SkeletonGraph graph;
  const int side = 2 * half + 1;
  for (int j = -half; j <= half; ++j)
  {
    for (int i = -half; i <= half; ++i)
    {
      const double x = i + 0.5 * j;
      const double y = std::sqrt(0.75) * j;
      graph.points.emplace_back(x, y, height(x, y));
      graph.radii.push_back(1.0);
      const std::int32_t at = (j + half) * side + i + half;
      if (i < half && j < half)
      {
        graph.triangles.push_back({ at, at + 1, at + side });
        graph.triangles.push_back({ at + 1, at + side + 1, at + side });
      }
    }
  }
  return graph;
}

TEST(SubdivisionLimit, ReproducesPolynomialsOverTheRegularGrid)
{
  const auto quadratic = [](double x, double y) { return 0.3 * x * x - 0.7 * x * y + 0.2 * y * y; };
  const auto cubic = [](double x, double y)
  { return x * x * x - 2.0 * x * y * y + 0.5 * y * y * y; };
  // Differences to the polynomial after a step, away from the border: the least and the most.
  const auto off = [](SubdivisionScheme scheme, const std::function<double(double, double)>& height)
  {
    Interval result{ 1.0, -1.0 };
    for (const Vec3& p : subdivide(heightField(5, height), scheme, 1).points)
    {
      const double difference = p.z() - height(p.x(), p.y());
      if (p.head<2>().norm() < 2.0)
      {
        result = { std::min(result.min, difference), std::max(result.max, difference) };
      }
    }
    return result;
  };
  for (const auto& polynomial : { std::function<double(double, double)>(quadratic),
         std::function<double(double, double)>(cubic) })
  {
    EXPECT_GT(off(kButterfly, polynomial).min, -1e-12);
    EXPECT_LT(off(kButterfly, polynomial).max, 1e-12);
  }
  // Loop's box splines have the quadratics with a constant added, the same all over the grid.
  const Interval loop = off(kLoop, quadratic);
  EXPECT_LT(loop.max - loop.min, 1e-12);
  EXPECT_GT(loop.min, 0.01);
}

TEST(SubdivisionLimit, FourPointCurvesReproduceCubics)
{
  SkeletonGraph graph;
  const auto at = [](double t) { return Vec3(t, t * t, 0.1 * t * t * t - t); };
  for (int k = 0; k <= 8; ++k)
  {
    graph.points.push_back(at(k));
    graph.radii.push_back(1.0);
    if (k > 0)
    {
      graph.segments.push_back({ k - 1, k });
    }
  }
  const RefinedSkeleton refined = subdivide(graph, kButterfly, 1);
  for (std::size_t s = 2; s < 14; ++s)
  {
    const Vec3 p = refined.points[refined.segments[s][0]];
    EXPECT_LT((p - at(p.x())).norm(), 1e-12);
  }
}

} // namespace
} // namespace hybridtree

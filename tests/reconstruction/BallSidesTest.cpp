// SPDX-License-Identifier: BSD-3-Clause
// Walls and holes of few points across, told by empty balls.
#include "reconstruction/BallSides.h"
#include "reconstruction/SignedHarmonic.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/mesh/MeshChecks.h"
#include "reconstruction/Convection.h"
#include "tests/reconstruction/Samples.h"
#include "tests/support/CancelAt.h"
#include "tests/support/TestMeshes.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace
{

using namespace hybridtree;
using namespace hybridtree::test;

std::vector<SignedLink> randomLinks(int nodes, int count, Random& random)
{
  std::vector<SignedLink> links;
  while (static_cast<int>(links.size()) < count)
  {
    const auto a = static_cast<std::int32_t>(random.uniform(0.0, nodes));
    const auto b = static_cast<std::int32_t>(random.uniform(0.0, nodes));
    if (a != b)
    {
      const double sign = random.chance(0.2) ? -1.0 : 1.0;
      links.push_back({ a, b, static_cast<float>(sign * random.uniform(0.01, 1.0)) });
    }
  }
  return links;
}

// Against the same equations solved densely.
TEST(SignedHarmonic, SolvesItsEquations)
{
  Random random(1);
  constexpr int kNodes = 60;
  for (int trial = 0; trial < 10; ++trial)
  {
    const std::vector<SignedLink> links = randomLinks(kNodes, 200, random);
    std::vector<float> held(kNodes, 0.0f);
    held[0] = 1.0f;
    held[1] = -0.5f;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(kNodes, kNodes);
    for (const SignedLink& link : links)
    {
      const double weight = link.weight;
      matrix(link.a, link.a) += std::abs(weight);
      matrix(link.b, link.b) += std::abs(weight);
      matrix(link.a, link.b) -= weight;
      matrix(link.b, link.a) -= weight;
    }
    Eigen::VectorXd right = Eigen::VectorXd::Zero(kNodes);
    for (int node = 0; node < 2; ++node)
    {
      matrix.row(node).setZero();
      matrix(node, node) = 1.0;
      right[node] = held[node];
    }
    const Eigen::VectorXd wanted = matrix.fullPivLu().solve(right);
    const std::vector<double> found = signedHarmonic(held, links);
    for (int node = 0; node < kNodes; ++node)
    {
      EXPECT_NEAR(found[node], wanted[node], 1e-4) << "trial " << trial << ", node " << node;
      EXPECT_LE(std::abs(found[node]), 1.0);
    }
  }
}

TEST(SignedHarmonic, NodesThatNothingReachesAreZero)
{
  const std::vector<double> x =
    signedHarmonic({ 1.0f, 0.0f, 0.0f, 0.0f, 0.0f }, { { 0, 1, -0.5f }, { 2, 3, 1.0f } });
  EXPECT_EQ(x[0], 1.0);
  EXPECT_NEAR(x[1], -1.0, 1e-6);
  EXPECT_EQ(x[2], 0.0);
  EXPECT_EQ(x[3], 0.0);
  EXPECT_EQ(x[4], 0.0);
}

TEST(SignedHarmonic, IsTheSameForAnyNumberOfThreads)
{
  Random random(2);
  constexpr int kNodes = 30000;
  const std::vector<SignedLink> links = randomLinks(kNodes, 4 * kNodes, random);
  std::vector<float> held(kNodes, 0.0f);
  held[7] = 1.0f;
  setThreadCount(1);
  const std::vector<double> one = signedHarmonic(held, links);
  setThreadCount(4);
  const std::vector<double> four = signedHarmonic(held, links);
  setThreadCount(0);
  EXPECT_EQ(one, four);
}

TEST(SignedHarmonic, CanBeCancelled)
{
  EXPECT_THROW(signedHarmonic({ 1.0f, 0.0f }, { { 0, 1, 1.0f } }, CancelAt(0)), Cancelled);
}

// Of the tetrahedra the middle of whose ball is well away from the surface, how many are on the
// wrong side.
double shareWrong(const std::vector<Vec3>& points,
  const std::function<double(const Vec3&)>& signedDistance, double away)
{
  const Tetrahedralization tetrahedra(points, Progress::none());
  const FacetSize sizes(tetrahedra);
  const BallSides sides = findSidesByBalls(tetrahedra, sizes);
  EXPECT_LT(sides.contradicted, 0.001);
  int all = 0;
  int wrong = 0;
  for (std::int32_t cell = 0; cell < tetrahedra.finiteCellCount(); ++cell)
  {
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t vertex : tetrahedra.cell(cell))
    {
      middle += 0.25 * points[vertex];
    }
    const double distance = signedDistance(middle);
    if (std::abs(distance) > away)
    {
      ++all;
      wrong += (sides.inside[cell] != 0) != (distance < 0.0);
    }
  }
  EXPECT_GT(all, 1000);
  return double(wrong) / double(all);
}

TEST(BallSides, TellTheSidesOfATorus)
{
  const auto distance = [](const Vec3& p)
  { return std::hypot(std::hypot(p.x(), p.y()) - 1.0, p.z()) - 0.4; };
  EXPECT_EQ(shareWrong(randomTorus(1.0, 0.4, 5000, 3), distance, 0.02), 0.0);
}

// Two shells, whose gap is two to three mean distances of points wide.
TEST(BallSides, TellAThinWallFromBothSides)
{
  constexpr double kInner = 0.88;
  std::vector<Vec3> points = randomSphere(4000, 4);
  for (const Vec3& p : randomSphere(3000, 5))
  {
    if (p.z() < 0.8) // the way in
    {
      points.push_back(kInner * p);
    }
  }
  points.erase(std::remove_if(points.begin(), points.end(),
                 [](const Vec3& p) { return p.norm() > 0.95 && p.z() > 0.82; }),
    points.end());
  const auto distance = [](const Vec3& p)
  {
    const double middle = 0.5 * (1.0 + kInner);
    return p.z() > 0.7 ? 0.0 : std::abs(p.norm() - middle) - 0.5 * (1.0 - kInner);
  };
  EXPECT_LT(shareWrong(points, distance, 0.02), 0.002);
}

// Faces in planes, where balls are half-spaces as far as double can tell.
TEST(BallSides, KnowPlaneFaces)
{
  for (const double turn : { 0.0, 0.3 })
  {
    const Eigen::Matrix3d rotation =
      Eigen::AngleAxisd(turn, Vec3(1.0, 2.0, 3.0).normalized()).toRotationMatrix();
    std::vector<Vec3> points =
      randomSurfacePoints(box(Vec3::Constant(-0.5), Vec3::Constant(0.5)), 6000, 6);
    for (Vec3& p : points)
    {
      p = rotation * p;
    }
    const auto distance = [&](const Vec3& p)
    { return Vec3(rotation.transpose() * p).lpNorm<Eigen::Infinity>() - 0.5; };
    EXPECT_LT(shareWrong(points, distance, 0.02), 0.001) << turn;
  }
}

struct Handles
{
  const char* name;
  std::int64_t genus;
};

void PrintTo(const Handles& mesh, std::ostream* out)
{
  *out << mesh.name;
}

class FineHandles : public testing::TestWithParam<Handles>
{
};

// Holes and gaps of few points across, which sizes of facets do not tell.
TEST_P(FineHandles, AreFound)
{
  const auto [name, genus] = GetParam();
  const std::optional<TriangleMesh> source = demoMesh(name);
  if (!source)
  {
    GTEST_SKIP() << name << " needs Debian's libcgal-demo: apt install libcgal-demo";
  }
  const std::vector<Vec3> points = randomSurfacePoints(*source, 20000, 1);
  const ReconstructedSurface surface = reconstruct(points);
  const MeshReport report = checkMesh(surface.mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.genus(), genus);
  EXPECT_EQ(report.components, 1u);
  EXPECT_GT(surface.mesh.points.size(), points.size() * 999 / 1000);
}

INSTANTIATE_TEST_SUITE_P(DemoMeshes, FineHandles,
  testing::Values(Handles{ "helmet.off", 3 }, Handles{ "turbine.off", 11 },
    Handles{ "bull.off", 0 }, Handles{ "elk.off", 1 }));

} // namespace

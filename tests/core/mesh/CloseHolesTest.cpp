// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/CloseHoles.h"

#include "core/mesh/MeshChecks.h"
#include "core/mesh/RepairMesh.h"
#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace hybridtree
{
using namespace test;

namespace
{

double areaOf(const TriangleMesh& mesh, std::size_t first = 0)
{
  double sum = 0.0;
  for (std::size_t t = first; t < mesh.triangles.size(); ++t)
  {
    sum += 0.5 * areaNormal(mesh, t).norm();
  }
  return sum;
}

// Points and triangles that were there stay; the surface is closed, and nothing else is wrong.
void expectClosedOver(const TriangleMesh& open, const TriangleMesh& closed)
{
  ASSERT_GE(closed.triangles.size(), open.triangles.size());
  EXPECT_TRUE(std::equal(open.points.begin(), open.points.end(), closed.points.begin()));
  EXPECT_TRUE(std::equal(open.triangles.begin(), open.triangles.end(), closed.triangles.begin()));
  const MeshReport report = checkMesh(closed);
  EXPECT_TRUE(report.closed() && report.oriented() && report.edgeManifold()) << report.describe();
  EXPECT_EQ(report.degenerateTriangles, 0u);
}

// A cone without its bottom, of so many points around.
TriangleMesh openCone(std::int32_t around)
{
  TriangleMesh mesh;
  mesh.points.push_back({ 0.0, 0.0, 1.0 });
  for (std::int32_t k = 0; k < around; ++k)
  {
    const double angle = 2.0 * M_PI * k / around;
    mesh.points.push_back({ std::cos(angle), std::sin(angle), 0.0 });
    mesh.triangles.push_back({ 0, k + 1, (k + 1) % around + 1 });
  }
  return mesh;
}

TEST(CloseHoles, PutsTheFaceOfABoxBack)
{
  const TriangleMesh whole = box(Vec3::Zero(), Vec3(1.0, 2.0, 3.0));
  TriangleMesh mesh = withoutTriangles(whole, 4, 2);
  const TriangleMesh open = mesh;
  const ClosedHoles closed = closeHoles(mesh);
  EXPECT_EQ(closed.holes, 1u);
  EXPECT_EQ(closed.left, 0u);
  EXPECT_TRUE(closed.addedFrom.empty());
  expectClosedOver(open, mesh);
  EXPECT_NEAR(signedVolume(mesh), 6.0, 1e-12);
  EXPECT_NEAR(areaOf(mesh), areaOf(whole), 1e-12);
}

TEST(CloseHoles, LeavesAClosedMeshAlone)
{
  TriangleMesh mesh = hollowSphere(1.0, 0.5, 2);
  const TriangleMesh before = mesh;
  EXPECT_EQ(closeHoles(mesh).holes, 0u);
  EXPECT_EQ(mesh.points, before.points);
  EXPECT_EQ(mesh.triangles, before.triangles);
}

TEST(CloseHoles, FillsFlatHolesFlat)
{
  for (const std::int32_t around : { 3, 4, 50, 400, 401, 3000, 100000 })
  {
    TriangleMesh mesh = openCone(around);
    const TriangleMesh open = mesh;
    EXPECT_EQ(closeHoles(mesh).holes, 1u);
    expectClosedOver(open, mesh);
    const double area = 0.5 * around * std::sin(2.0 * M_PI / around);
    EXPECT_NEAR(areaOf(mesh, open.triangles.size()), area, 1e-9) << around << " points";
    EXPECT_NEAR(signedVolume(mesh), area / 3.0, 1e-9) << around << " points";
  }
}

// Long loops and many of them take a while, in which only observers of progress can stop it.
TEST(CloseHoles, ReportsAndStopsInAndBetweenLoops)
{
  class StopsAt final : public Progress
  {
  public:
    explicit StopsAt(int times) : times_(times) {}
    void report(double fraction) const override
    {
      EXPECT_GE(fraction, last);
      EXPECT_LE(fraction, 1.0);
      last = fraction;
      ++reports;
    }
    bool cancelled() const override { return reports >= times_; }
    mutable double last = 0.0;
    mutable int reports = 0;

  private:
    int times_;
  };
  TriangleMesh mesh = openCone(100000);
  const StopsAt tenth(10);
  EXPECT_THROW(closeHoles(mesh, tenth), Cancelled);
  mesh = withoutTriangles(withoutTriangles(icosphere(1.0, 3), 100, 3), 0, 3);
  EXPECT_THROW(closeHoles(mesh, StopsAt(2)), Cancelled);
}

// A saddle: the loop turns up and down. No fan from one of its points has less area, but for what
// good shapes may cost.
TEST(CloseHoles, FillsBentHolesWithLittleArea)
{
  TriangleMesh mesh = openCone(64);
  double squares = 0.0;
  for (std::size_t k = 1; k <= 64; ++k)
  {
    const Vec3 p = mesh.points[k];
    mesh.points[k].z() = -1.0 + 0.7 * (p.x() * p.x() - p.y() * p.y());
    squares += k > 1 ? (mesh.points[k] - mesh.points[k - 1]).squaredNorm() : 0.0;
  }
  squares += (mesh.points[1] - mesh.points[64]).squaredNorm();
  const TriangleMesh open = mesh;
  EXPECT_TRUE(closeHoles(mesh).addedFrom.empty());
  expectClosedOver(open, mesh);
  const double area = areaOf(mesh, open.triangles.size());
  for (std::size_t apex = 1; apex <= 64; ++apex)
  {
    double fan = 0.0;
    for (std::size_t k = 1; k <= 64; ++k)
    {
      const Vec3 a = open.points[k] - open.points[apex];
      const Vec3 b = open.points[k % 64 + 1] - open.points[apex];
      fan += 0.5 * a.cross(b).norm();
    }
    EXPECT_LT(area, fan + 0.1 * squares) << "apex " << apex;
  }
}

TEST(CloseHoles, ClosesWhateverTrianglesAreMissing)
{
  for (unsigned seed = 1; seed <= 40; ++seed)
  {
    Random random(seed);
    const TriangleMesh whole = seed % 2 ? icosphere(1.0, 3) : torus(1.0, 0.4, 30, 12);
    const double percent = seed;
    TriangleMesh part;
    part.points = whole.points;
    for (const Triangle& triangle : whole.triangles)
    {
      if (!random.chance(percent / 100.0))
      {
        part.triangles.push_back(triangle);
      }
    }
    TriangleMesh mesh = *repairMesh(part.points, part.triangles).mesh;
    const TriangleMesh open = mesh;
    const ClosedHoles closed = closeHoles(mesh);
    EXPECT_EQ(closed.left, 0u) << "seed " << seed;
    EXPECT_EQ(closed.addedFrom.size(), mesh.points.size() - open.points.size());
    const MeshReport report = checkMesh(mesh);
    EXPECT_TRUE(report.closed() && report.oriented() && report.edgeManifold())
      << "seed " << seed << ": " << report.describe();
    EXPECT_EQ(report.degenerateTriangles, 0u);
    EXPECT_GT(signedVolume(mesh), 0.0);
  }
}

TEST(CloseHoles, TurnsTheClosedShellOutward)
{
  TriangleMesh mesh = withoutTriangles(icosphere(1.0, 3), 0, 200);
  for (Triangle& corner : mesh.triangles)
  {
    std::swap(corner[0], corner[1]);
  }
  ASSERT_LT(signedVolume(mesh), 0.0);
  EXPECT_EQ(closeHoles(mesh).left, 0u);
  EXPECT_GT(signedVolume(mesh), 0.0);
  EXPECT_TRUE(isClosedManifold(mesh));
}

// No chord of a square may be an edge that is there: a box whose lid was folded inward.
TEST(CloseHoles, AddsAPointWhereEdgesAreInTheWay)
{
  TriangleMesh mesh;
  mesh.points = { { 0, 0, 0 }, { 1, 0, 0.3 }, { 1, 1, 0 }, { 0, 1, 0.3 }, { 0.5, 0.5, -1 } };
  mesh.triangles = { { 1, 0, 4 }, { 2, 1, 4 }, { 3, 2, 4 }, { 0, 3, 4 } };
  // Fins over both diagonals, each closed, that share only an edge's ends with the pit.
  const auto addFin = [&mesh](std::int32_t a, std::int32_t b, const Vec3& top, const Vec3& side)
  {
    const auto c = std::int32_t(mesh.points.size());
    mesh.points.push_back(top);
    mesh.points.push_back(top + side);
    mesh.triangles.insert(
      mesh.triangles.end(), { { a, b, c }, { b, a, c + 1 }, { b, c + 1, c }, { a, c, c + 1 } });
  };
  addFin(0, 2, { 0.5, 0.5, 2.0 }, { 0.1, -0.1, 0.0 });
  addFin(1, 3, { 0.5, 0.5, 3.0 }, { 0.1, 0.1, 0.0 });
  const std::size_t points = mesh.points.size();
  const ClosedHoles closed = closeHoles(mesh);
  EXPECT_EQ(closed.holes, 1u);
  EXPECT_EQ(closed.left, 0u);
  ASSERT_EQ(closed.addedFrom.size(), 1u);
  EXPECT_EQ(mesh.points.size(), points + 1);
  const MeshReport report = checkMesh(mesh);
  EXPECT_TRUE(report.closed() && report.oriented() && report.edgeManifold()) << report.describe();
}

TEST(CloseHoles, LeavesSlitsWithoutAreaOpen)
{
  TriangleMesh mesh = box(Vec3::Zero(), Vec3::Ones());
  // The middle of one edge is a point of the triangle on one side only.
  const Triangle cut = mesh.triangles.front();
  const auto middle = std::int32_t(mesh.points.size());
  mesh.points.push_back(
    0.5 * (mesh.points[std::size_t(cut[0])] + mesh.points[std::size_t(cut[1])]));
  mesh.triangles.front() = { cut[0], middle, cut[2] };
  mesh.triangles.push_back({ middle, cut[1], cut[2] });
  const TriangleMesh before = mesh;
  const ClosedHoles closed = closeHoles(mesh);
  EXPECT_EQ(closed.holes, 0u);
  EXPECT_EQ(closed.left, 1u);
  EXPECT_EQ(mesh.triangles, before.triangles);
}

TEST(CloseHoles, ClosesAScan)
{
  const std::optional<TriangleMesh> elephant = demoMesh("elephant-with-holes.off");
  if (!elephant)
  {
    GTEST_SKIP() << "no demo meshes here";
  }
  TriangleMesh mesh = *repairMesh(elephant->points, elephant->triangles).mesh;
  const TriangleMesh open = mesh;
  ASSERT_FALSE(checkMesh(open).closed());
  const ClosedHoles closed = closeHoles(mesh);
  EXPECT_GT(closed.holes, 0u);
  EXPECT_EQ(closed.left, 0u);
  expectClosedOver(open, mesh);
}

} // namespace
} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/SharpCreases.h"

#include "core/base/Parallel.h"
#include "core/mesh/Crossings.h"
#include "core/mesh/MeshChecks.h"
#include "core/polygonize/Polygonize.h"

#include "tests/support/FeatureEdges.h"
#include "tests/support/FunctionField.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree::test
{
namespace
{

/// Signed distances near the surface, negative inside.
using Shape = std::function<double(const Vec3&)>;

Shape brick(const Mat3& turn, const Vec3& half)
{
  return [=](const Vec3& p) { return ((turn * p).cwiseAbs() - half).maxCoeff(); };
}

Shape rod(const Mat3& turn, double radius, double half)
{
  return [=](const Vec3& p)
  {
    const Vec3 q = turn * p;
    return std::max(std::hypot(q.x(), q.y()) - radius, std::abs(q.z()) - half);
  };
}

FunctionField fieldOf(const Shape& shape)
{
  return FunctionField([=](const Vec3& p) { return kThreshold - shape(p); }, 2.0);
}

struct Sharpened
{
  TriangleMesh before;
  TriangleMesh after;
  std::size_t points = 0;
};

Sharpened sharpened(const FieldSource& field, double cellSize)
{
  PolygonizeOptions options;
  options.cellSize = cellSize;
  const Box3 bounds(Vec3::Constant(-2.0), Vec3::Constant(2.0));
  Sharpened made;
  made.before = polygonize(field, bounds, options);
  made.after = made.before;
  Lattice lattice;
  lattice.cellSize = cellSize;
  made.points = sharpenCreases(field, lattice, 0, made.after);
  return made;
}

/// Edges of the mesh whose middle is further than this from the surface.
int edgesOff(const FunctionField& field, const TriangleMesh& mesh, double distance)
{
  int count = 0;
  for (const Triangle& c : mesh.triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      const Vec3 middle = 0.5 * (mesh.points[c[k]] + mesh.points[c[(k + 1) % 3]]);
      count += std::abs(field(middle) - kThreshold) > distance;
    }
  }
  return count;
}

void expectSound(const Sharpened& made, double cellSize)
{
  const TriangleMesh& mesh = made.after;
  EXPECT_TRUE(isClosedManifold(mesh)) << checkMesh(mesh).describe();
  EXPECT_EQ(checkMesh(mesh).genus(), checkMesh(made.before).genus());
  EXPECT_EQ(mesh.normals.size(), mesh.points.size());
  EXPECT_EQ(mesh.points.size(), made.before.points.size() + made.points);
  for (std::size_t k = 0; k < made.before.points.size(); ++k)
  {
    ASSERT_EQ(mesh.points[k], made.before.points[k]);
  }
  EXPECT_LE(
    newCrossings(mesh, 0, {}, cellSize).size(), newCrossings(made.before, 0, {}, cellSize).size());
  for (std::size_t k = made.before.points.size(); k < mesh.points.size(); ++k)
  {
    EXPECT_NEAR(mesh.normals[k].norm(), 1.0, 1e-9);
  }
}

TEST(SharpCreases, BoxesAreExact)
{
  Random random(17);
  const Vec3 half(0.8, 0.6, 0.7);
  for (int n = 0; n < 10; ++n)
  {
    const double cellSize = random.uniform(0.07, 0.16);
    const Mat3 turn = random.rotation();
    const Sharpened made = sharpened(fieldOf(brick(turn, half)), cellSize);
    expectSound(made, cellSize);
    const double exact = 8.0 * half.prod();
    EXPECT_GT(std::abs(signedVolume(made.before) - exact), 5e-3);
    EXPECT_NEAR(signedVolume(made.after), exact, 2e-3) << n;
    // Every place on an edge of the box is on one of the mesh, nearly.
    const std::vector<FeatureEdge> edges = featureEdges(made.after);
    int covered = 0;
    constexpr int kSamples = 600;
    for (int k = 0; k < kSamples; ++k)
    {
      Vec3 p = random.inBox({ Vec3(-half), half });
      const int axis = random.integer(0, 2);
      p[axis] = std::copysign(half[axis], p[axis]);
      p[(axis + 1) % 3] = std::copysign(half[(axis + 1) % 3], p[(axis + 1) % 3]);
      p = turn.transpose() * p;
      covered += isCovered(edges, p, 0.02 * cellSize);
    }
    EXPECT_GT(covered, 0.97 * kSamples) << n;
  }
}

TEST(SharpCreases, BooleansComeNearer)
{
  Random random(29);
  for (int n = 0; n < 24; ++n)
  {
    const double cellSize = random.uniform(0.06, 0.1);
    const Shape a = n % 2 == 0 ? brick(random.rotation(), Vec3(0.8, 0.7, 0.75))
                               : rod(random.rotation(), 0.7, 0.8);
    const Shape b = rod(random.rotation(), 0.4, 1.3);
    const int operation = n % 3;
    const FunctionField field = fieldOf(
      [=](const Vec3& p)
      {
        return operation == 0 ? std::min(a(p), b(p))
          : operation == 1    ? std::max(a(p), b(p))
                              : std::max(a(p), -b(p));
      });
    const Sharpened made = sharpened(field, cellSize);
    expectSound(made, cellSize);
    // Round sides are as they were.
    EXPECT_LT(edgesOff(field, made.after, 0.15 * cellSize),
      0.2 * edgesOff(field, made.before, 0.15 * cellSize))
      << n;
  }
}

TEST(SharpCreases, RimsAreCovered)
{
  Random random(31);
  for (int n = 0; n < 6; ++n)
  {
    const double cellSize = 0.09;
    const Mat3 turn = random.rotation();
    const Sharpened made = sharpened(fieldOf(rod(turn, 0.6, 0.8)), cellSize);
    expectSound(made, cellSize);
    const std::vector<FeatureEdge> edges = featureEdges(made.after);
    int covered = 0;
    constexpr int kSamples = 600;
    for (int k = 0; k < kSamples; ++k)
    {
      const double angle = random.uniform(0.0, 2.0 * std::acos(-1.0));
      const Vec3 p(0.6 * std::cos(angle), 0.6 * std::sin(angle), random.chance(0.5) ? 0.8 : -0.8);
      const Vec3 place = turn.transpose() * p;
      covered += isCovered(edges, place, 0.05 * cellSize);
    }
    EXPECT_GT(covered, 0.95 * kSamples) << n;
    int off = 0;
    for (const FeatureEdge& edge : edges)
    {
      const Vec3 q = turn * (0.5 * (edge.from + edge.to));
      const double miss = std::hypot(std::hypot(q.x(), q.y()) - 0.6, std::abs(q.z()) - 0.8);
      off += miss > 0.05 * cellSize;
    }
    EXPECT_LT(off, 0.05 * static_cast<double>(edges.size())) << n;
  }
}

TEST(SharpCreases, ConesGetTheirTip)
{
  Random random(37);
  for (int n = 0; n < 10; ++n)
  {
    const Mat3 turn = random.rotation();
    const Vec3 tip = random.inBox({ Vec3::Constant(-0.1), Vec3::Constant(0.1) });
    const FunctionField field = fieldOf(
      [=](const Vec3& p)
      {
        const Vec3 q = turn * (p - tip);
        const double side = (std::hypot(q.x(), q.y()) + q.z()) * std::sqrt(0.5);
        return std::max(side, -q.z() - 0.8);
      });
    const Sharpened made = sharpened(field, 0.1);
    expectSound(made, 0.1);
    const auto nearest = [&](const TriangleMesh& mesh)
    {
      double least = 1.0;
      for (const Vec3& p : mesh.points)
      {
        least = std::min(least, (p - tip).norm());
      }
      return least;
    };
    EXPECT_LT(nearest(made.after), 0.01) << n << ", " << nearest(made.before) << " before";
  }
}

TEST(SharpCreases, SmoothShapesStay)
{
  Random random(41);
  for (int n = 0; n < 20; ++n)
  {
    // As little as 1.5 cells around the tube.
    const double cellSize = random.uniform(0.05, 0.16);
    const Mat3 turn = random.rotation();
    const Vec3 center = random.inBox({ Vec3::Constant(-0.2), Vec3::Constant(0.2) });
    const Sharpened made = sharpened(fieldOf(
                                       [=](const Vec3& p)
                                       {
                                         const Vec3 q = turn * (p - center);
                                         const double ring = std::hypot(q.x(), q.y()) - 0.8;
                                         return std::hypot(ring, q.z()) - 0.24;
                                       }),
      cellSize);
    EXPECT_EQ(made.points, 0u);
    EXPECT_EQ(made.after.points, made.before.points);
    EXPECT_EQ(made.after.normals, made.before.normals);
    EXPECT_EQ(made.after.triangles, made.before.triangles);
  }
}

TEST(SharpCreases, ThreadsMakeNoDifference)
{
  const FunctionField field = fieldOf(rod(Random(5).rotation(), 0.6, 0.8));
  setThreadCount(1);
  const Sharpened one = sharpened(field, 0.05);
  setThreadCount(4);
  const Sharpened four = sharpened(field, 0.05);
  setThreadCount(0);
  EXPECT_GT(one.points, 50u);
  EXPECT_EQ(one.after.points, four.after.points);
  EXPECT_EQ(one.after.triangles, four.after.triangles);
  EXPECT_EQ(one.after.normals, four.after.normals);
}

TEST(SharpCreases, HardlyAnEdgeRunsAcross)
{
  Random random(43);
  constexpr double kCell = 0.11;
  int before = 0;
  int after = 0;
  for (int n = 0; n < 8; ++n)
  {
    const FunctionField field = fieldOf(brick(random.rotation(), Vec3(0.7, 0.75, 0.8)));
    const Sharpened made = sharpened(field, kCell);
    before += edgesOff(field, made.before, 0.1 * kCell);
    after += edgesOff(field, made.after, 0.1 * kCell);
  }
  EXPECT_GT(before, 1000);
  EXPECT_LT(after, 0.05 * before);
}

} // namespace
} // namespace hybridtree::test

// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/CreaseNotches.h"

#include "core/base/Parallel.h"
#include "core/mesh/Crossings.h"
#include "core/mesh/MeshChecks.h"
#include "core/mesh/MeshDistance.h"
#include "core/polygonize/Polygonize.h"
#include "core/polygonize/SharpCreases.h"

#include "tests/support/FunctionField.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <thread>

namespace hybridtree::test
{
namespace
{

struct Plane
{
  Vec3 normal;
  double offset;

  double operator()(const Vec3& p) const { return normal.dot(p) - offset; }
};

using Planes = std::vector<Plane>;

double outside(const Planes& planes, const Vec3& p)
{
  double most = -10.0;
  for (const Plane& plane : planes)
  {
    most = std::max(most, plane(p));
  }
  return most;
}

Planes block(const Mat3& turn, const Vec3& center, const Vec3& half)
{
  Planes planes;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (const double sign : { 1.0, -1.0 })
    {
      const Vec3 normal = sign * turn.row(axis).transpose();
      planes.push_back({ normal, half[axis] + normal.dot(center) });
    }
  }
  return planes;
}

/// Its edge is along z at x = 0, and it is as thick as `width` at x = -1.
Planes wedge(const Mat3& turn, const Vec3& edge, double width)
{
  Planes planes;
  for (const Vec3& normal : { Vec3(0.5 * width, 1.0, 0.0), Vec3(0.5 * width, -1.0, 0.0),
         Vec3(-1.0, 0.0, 0.0), Vec3(0.0, 0.0, 1.0), Vec3(0.0, 0.0, -1.0) })
  {
    const Vec3 turned = turn.transpose() * normal.normalized();
    const double reach = normal.x() > 0.0 ? 0.0 : normal.z() == 0.0 ? 1.0 : 0.7;
    planes.push_back({ turned, reach + turned.dot(edge) });
  }
  return planes;
}

enum class Join
{
  Union,
  Intersection,
  Difference
};

/// Two convex solids.
struct Solid
{
  Planes a;
  Planes b;
  Join join;

  double operator()(const Vec3& p) const
  {
    const double inA = outside(a, p);
    const double inB = outside(b, p);
    return join == Join::Union ? std::min(inA, inB)
                               : std::max(inA, join == Join::Difference ? -inB : inB);
  }

  /// Points of its edges.
  std::vector<Vec3> edges() const
  {
    Planes all = a;
    all.insert(all.end(), b.begin(), b.end());
    std::vector<Vec3> points;
    for (std::size_t m = 0; m < all.size(); ++m)
    {
      for (std::size_t n = m + 1; n < all.size(); ++n)
      {
        this->addLine(all[m], all[n], points);
      }
    }
    return points;
  }

private:
  void addLine(const Plane& m, const Plane& n, std::vector<Vec3>& points) const
  {
    const Vec3 along = m.normal.cross(n.normal);
    if (along.norm() < 0.1)
    {
      return;
    }
    Mat3 matrix;
    matrix << m.normal.transpose(), n.normal.transpose(), along.transpose();
    const Vec3 at = matrix.inverse() * Vec3(m.offset, n.offset, 0.0);
    for (double t = -2.0; t < 2.0; t += 0.01)
    {
      const Vec3 p = at + t * along.normalized();
      if (std::abs((*this)(p)) < 1e-9)
      {
        points.push_back(p);
      }
    }
  }
};

struct Meshes
{
  TriangleMesh lattice;
  TriangleMesh sharp;
};

Meshes meshesOf(const Solid& solid, double cellSize)
{
  const FunctionField field([&](const Vec3& p) { return kThreshold - solid(p); }, 1.0);
  Lattice lattice;
  lattice.cellSize = cellSize;
  PolygonizeOptions options;
  options.cellSize = cellSize;
  Meshes made;
  made.lattice = polygonize(field, { Vec3::Constant(-2.0), Vec3::Constant(2.0) }, options);
  made.sharp = made.lattice;
  sharpenCreases(field, lattice, 0, made.sharp);
  return made;
}

/// How many points are farther from the mesh than this.
std::ptrdiff_t farther(const std::vector<Vec3>& points, const TriangleMesh& mesh, double reach)
{
  const MeshDistance distances(std::make_shared<const TriangleMesh>(mesh));
  std::vector<double> distance(points.size());
  distances.distance(PointList(points), 10.0, distance.data());
  return std::count_if(distance.begin(), distance.end(), [=](double away) { return away > reach; });
}

/// Creases that come nearer to each other than a cell, and wedges of 15 to 60 degrees.
Solid notchedSolid(Random& random, int n)
{
  const Mat3 turn = random.rotation();
  const Planes first = block(random.rotation(), Vec3::Zero(), Vec3(0.7, 0.6, 0.65));
  const Vec3 place = random.inBox({ Vec3::Constant(-0.2), Vec3::Constant(0.2) });
  const Planes second = wedge(turn, place, random.uniform(0.3, 1.1));
  return { first, second, static_cast<Join>(n % 3) };
}

TEST(CreaseNotches, EdgesAreWithinHalfACell)
{
  Random random(71);
  std::ptrdiff_t before = 0;
  std::ptrdiff_t after = 0;
  for (int n = 0; n < 20; ++n)
  {
    const double cellSize = random.uniform(0.06, 0.09);
    const Solid solid = notchedSolid(random, n);
    const Meshes made = meshesOf(solid, cellSize);
    const std::vector<Vec3> edges = solid.edges();
    before += farther(edges, made.lattice, 0.5 * cellSize);
    after += farther(edges, made.sharp, 0.5 * cellSize);
    EXPECT_TRUE(isClosedManifold(made.sharp)) << checkMesh(made.sharp).describe();
    EXPECT_LE(newCrossings(made.sharp, 0, {}, cellSize).size(),
      newCrossings(made.lattice, 0, {}, cellSize).size());
    double off = 0.0;
    for (std::size_t k = made.lattice.points.size(); k < made.sharp.points.size(); ++k)
    {
      off = std::max(off, std::abs(solid(made.sharp.points[k])));
      ASSERT_NEAR(made.sharp.normals[k].norm(), 1.0, 1e-9);
    }
    EXPECT_LT(off, 1e-4 * cellSize) << n;
  }
  EXPECT_GT(before, 1500);
  EXPECT_LT(after, before / 25);
}

TEST(CreaseNotches, SourcesStayWithTheirTriangles)
{
  Random random(73);
  const Solid solid = notchedSolid(random, 2);
  const FunctionField field([&](const Vec3& p) { return kThreshold - solid(p); }, 1.0);
  constexpr double kCell = 0.08;
  TriangleMesh mesh = meshesOf(solid, kCell).lattice;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    mesh.sourceLeaf.push_back(7);
    mesh.sourceTriangle.push_back(static_cast<std::int32_t>(t));
  }
  const TriangleMesh before = mesh;
  const std::size_t points =
    mendNotches(field, { kCell, std::cos(0.5), 0, {} }, mesh, Progress::none());
  EXPECT_GT(points, 10u);
  ASSERT_EQ(mesh.sourceLeaf.size(), mesh.triangles.size());
  ASSERT_EQ(mesh.sourceTriangle.size(), mesh.triangles.size());
  std::int32_t last = -1;
  std::size_t fresh = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const std::int32_t source = mesh.sourceTriangle[t];
    fresh += source < 0;
    EXPECT_EQ(mesh.sourceLeaf[t], source < 0 ? -1 : 7);
    if (source >= 0)
    {
      EXPECT_EQ(fresh, 0u);
      EXPECT_GT(source, last);
      EXPECT_EQ(mesh.triangles[t], before.triangles[static_cast<std::size_t>(source)]);
      last = source;
    }
  }
  EXPECT_GT(fresh, 20u);
}

TEST(CreaseNotches, TrianglesBeforeTheFirstStay)
{
  Random random(79);
  const Solid solid = notchedSolid(random, 2);
  const FunctionField field([&](const Vec3& p) { return kThreshold - solid(p); }, 1.0);
  constexpr double kCell = 0.08;
  const TriangleMesh before = meshesOf(solid, kCell).lattice;
  TriangleMesh mesh = before;
  const std::size_t first = mesh.triangles.size() / 2;
  mendNotches(field, { kCell, std::cos(0.5), first, {} }, mesh, Progress::none());
  EXPECT_GT(mesh.points.size(), before.points.size());
  EXPECT_TRUE(std::equal(before.triangles.begin(),
    before.triangles.begin() + static_cast<std::ptrdiff_t>(first), mesh.triangles.begin()));
  EXPECT_TRUE(isClosedManifold(mesh)) << checkMesh(mesh).describe();
}

TEST(CreaseNotches, ThreadsMakeNoDifference)
{
  Random random(83);
  const Solid solid = notchedSolid(random, 1);
  setThreadCount(1);
  const Meshes one = meshesOf(solid, 0.05);
  setThreadCount(4);
  const Meshes four = meshesOf(solid, 0.05);
  setThreadCount(0);
  EXPECT_EQ(one.sharp.points, four.sharp.points);
  EXPECT_EQ(one.sharp.normals, four.sharp.normals);
  EXPECT_EQ(one.sharp.triangles, four.sharp.triangles);
}

/// Stops once so much is told to be done.
class StopFrom final : public Progress
{
public:
  explicit StopFrom(double fraction) : from_(fraction) {}
  void report(double fraction) const override
  {
    EXPECT_EQ(std::this_thread::get_id(), caller_) << "reports are of the thread that asked";
    EXPECT_GE(fraction, last_);
    last_ = fraction;
    stopped_ = stopped_ || fraction >= from_;
  }
  bool cancelled() const override { return stopped_; }
  bool stopped() const { return stopped_; }

private:
  const double from_;
  const std::thread::id caller_ = std::this_thread::get_id();
  mutable double last_ = 0.0;
  mutable std::atomic<bool> stopped_{ false };
};

// What is asked after the wish to stop is no more than each thread has at hand.
TEST(CreaseNotches, StopsSoonAfterItIsAskedTo)
{
  Random random(89);
  const Solid solid = notchedSolid(random, 2);
  std::atomic<std::size_t> asked(0);
  std::atomic<std::size_t> late(0);
  const StopFrom* listening = nullptr;
  const FunctionField field(
    [&](const Vec3& p)
    {
      ++asked;
      late += listening && listening->stopped();
      return kThreshold - solid(p);
    },
    1.0);
  constexpr double kCell = 0.03;
  const TriangleMesh lattice = meshesOf(solid, kCell).lattice;
  const auto mend = [&](const StopFrom& progress)
  {
    listening = &progress;
    asked = 0;
    late = 0;
    TriangleMesh mesh = lattice;
    mendNotches(field, { kCell, std::cos(0.5), 0, {} }, mesh, progress);
  };
  setThreadCount(2);
  mend(StopFrom(2.0));
  const std::size_t whole = asked;
  for (const double fraction : { 0.1, 0.3, 0.6 })
  {
    const StopFrom progress(fraction);
    EXPECT_THROW(mend(progress), Cancelled);
    EXPECT_LT(late, whole / 20) << fraction;
    EXPECT_LT(asked, whole);
  }
  setThreadCount(0);
}

} // namespace
} // namespace hybridtree::test

// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/MeshDistance.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/mesh/RepairMesh.h"
#include "tests/support/SolidAngles.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace hybridtree
{
namespace
{

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Cloud
{
  std::vector<double> x, y, z;

  void add(const Vec3& p)
  {
    x.push_back(p.x());
    y.push_back(p.y());
    z.push_back(p.z());
  }
  PointBatch batch() const { return { x.data(), y.data(), z.data(), x.size() }; }
};

MeshPtr repaired(const TriangleMesh& mesh)
{
  return repairMesh(mesh.points, mesh.triangles).mesh;
}

Box3 grown(Box3 box, double share)
{
  const Vec3 margin = share * box.sizes();
  return Box3(Vec3(box.min() - margin), Vec3(box.max() + margin));
}

// Scattered points, then points near the surface, then a brick: all that batches are made of.
Cloud samples(const TriangleMesh& mesh, std::uint64_t seed, int count)
{
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const Box3 box = grown(mesh.bounds(), 0.5);
  const auto anywhere = [&]
  {
    return Vec3(
      box.min() + Vec3(unit(random), unit(random), unit(random)).cwiseProduct(box.sizes()));
  };
  Cloud cloud;
  for (int k = 0; k < count; ++k)
  {
    cloud.add(anywhere());
    const Triangle& c = mesh.triangles[random() % mesh.triangles.size()];
    const double u = unit(random);
    const double v = unit(random) * (1.0 - u);
    const Vec3 on = (1.0 - u - v) * mesh.points[std::size_t(c[0])] +
      u * mesh.points[std::size_t(c[1])] + v * mesh.points[std::size_t(c[2])];
    const double away = std::pow(10.0, -1.0 - 6.0 * unit(random));
    cloud.add(on + away * (anywhere() - box.center()));
  }
  const Vec3 corner = anywhere();
  const double step = 0.01 * box.diagonal().norm();
  for (int k = 0; k < 512; ++k)
  {
    cloud.add(corner + step * Vec3(k % 8, k / 8 % 8, k / 64));
  }
  return cloud;
}

// Independent of the project's kernel: Ericson 2005, Real-Time Collision Detection 5.1.5, which
// finds the region by barycentric coordinates, in extended precision.
long double bruteTriangle(const Vec3& pIn, const Vec3& aIn, const Vec3& bIn, const Vec3& cIn)
{
  using Long3 = Eigen::Matrix<long double, 3, 1>;
  const Long3 p = pIn.cast<long double>();
  const Long3 a = aIn.cast<long double>();
  const Long3 b = bIn.cast<long double>();
  const Long3 c = cIn.cast<long double>();
  const Long3 ab = b - a, ac = c - a, ap = p - a;
  const long double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0 && d2 <= 0)
    return ap.norm();
  const Long3 bp = p - b;
  const long double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0 && d4 <= d3)
    return bp.norm();
  const long double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0)
    return (p - (a + d1 / (d1 - d3) * ab)).norm();
  const Long3 cp = p - c;
  const long double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0 && d5 <= d6)
    return cp.norm();
  const long double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0)
    return (p - (a + d2 / (d2 - d6) * ac)).norm();
  const long double va = d3 * d6 - d5 * d4;
  if (va <= 0 && d4 - d3 >= 0 && d5 - d6 >= 0)
    return (p - (b + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (c - b))).norm();
  const long double sum = va + vb + vc;
  return (p - (a + ab * (vb / sum) + ac * (vc / sum))).norm();
}

double bruteDistance(const TriangleMesh& mesh, const Vec3& p)
{
  long double best = std::numeric_limits<long double>::infinity();
  for (const Triangle& c : mesh.triangles)
  {
    best = std::min(best,
      bruteTriangle(p, mesh.points[std::size_t(c[0])], mesh.points[std::size_t(c[1])],
        mesh.points[std::size_t(c[2])]));
  }
  return double(best);
}

struct NamedMesh
{
  const char* name;
  TriangleMesh mesh;
};

void PrintTo(const NamedMesh& mesh, std::ostream* stream)
{
  *stream << mesh.name;
}

class MeshDistanceOf : public testing::TestWithParam<NamedMesh>
{
};

TEST_P(MeshDistanceOf, AgreesWithBruteForce)
{
  const MeshPtr mesh = repaired(GetParam().mesh);
  const MeshDistance distance(mesh);
  const Cloud cloud = samples(*mesh, 1, 300);
  const PointBatch points = cloud.batch();
  const double size = mesh->bounds().diagonal().norm();
  for (const double radius : { kInfinity, 0.1 * size })
  {
    std::vector<double> found(points.size), near(points.size), signedFound(points.size);
    std::vector<std::int32_t> triangle(points.size);
    std::vector<double> x(points.size), y(points.size), z(points.size);
    distance.distance(points, radius, found.data());
    distance.nearest(
      points, radius, near.data(), triangle.data(), { x.data(), y.data(), z.data() });
    distance.signedDistance(points, radius, signedFound.data(), {});
    for (std::size_t k = 0; k < points.size; ++k)
    {
      const double expected = bruteDistance(*mesh, points[k]);
      if (std::abs(expected - radius) < 1e-9 * size)
      {
        continue;
      }
      if (expected > radius)
      {
        EXPECT_EQ(found[k], kInfinity) << "at " << points[k].transpose();
        EXPECT_EQ(near[k], kInfinity);
        EXPECT_EQ(triangle[k], -1);
        EXPECT_TRUE(std::isinf(signedFound[k]));
        continue;
      }
      EXPECT_NEAR(found[k], expected, 1e-12 * size) << "at " << points[k].transpose();
      EXPECT_NEAR(near[k], expected, 1e-12 * size);
      EXPECT_NEAR(std::abs(signedFound[k]), expected, 1e-12 * size);
      EXPECT_NEAR((Vec3(x[k], y[k], z[k]) - points[k]).norm(), expected, 1e-12 * size);
      const Triangle& c = mesh->triangles[std::size_t(triangle[k])];
      EXPECT_NEAR(double(bruteTriangle(points[k], mesh->points[std::size_t(c[0])],
                    mesh->points[std::size_t(c[1])], mesh->points[std::size_t(c[2])])),
        expected, 1e-12 * size);
    }
  }
}

TEST_P(MeshDistanceOf, SideIsThatOfTheWindingNumber)
{
  const MeshPtr mesh = repaired(GetParam().mesh);
  const MeshDistance distance(mesh);
  const Cloud cloud = samples(*mesh, 2, 300);
  const PointBatch points = cloud.batch();
  std::vector<std::int8_t> side(points.size);
  std::vector<double> signedDistance(points.size), limited(points.size);
  distance.side(points, side.data());
  distance.signedDistance(points, kInfinity, signedDistance.data(), {});
  distance.signedDistance(points, 1e-3, limited.data(), {});
  int inside = 0;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const double winding = test::sumOfSolidAngles(*mesh, points[k]);
    if (std::abs(winding - 0.5) < 0.05)
    {
      continue; // on an open mesh the far field decides to about 0.01
    }
    EXPECT_EQ(side[k], winding > 0.5 ? 1 : -1) << "at " << points[k].transpose();
    EXPECT_EQ(signedDistance[k]<0.0, winding> 0.5) << "at " << points[k].transpose();
    EXPECT_EQ(limited[k]<0.0, winding> 0.5) << "at " << points[k].transpose();
    inside += side[k] == 1;
  }
  EXPECT_GT(inside, 10);
}

TEST_P(MeshDistanceOf, RangesHoldAndPartsSuffice)
{
  const MeshPtr mesh = repaired(GetParam().mesh);
  const MeshDistance distance(mesh);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const Box3 whole = grown(mesh->bounds(), 0.3);
  for (int round = 0; round < 60; ++round)
  {
    const Vec3 lower =
      whole.min() + Vec3(unit(random), unit(random), unit(random)).cwiseProduct(whole.sizes());
    const double edge = std::pow(10.0, -2.0 * unit(random)) * 0.3;
    const Box3 box(lower, Vec3(lower + edge * whole.sizes()));
    Cloud cloud;
    for (int k = 0; k < 64; ++k)
    {
      cloud.add(box.min() + Vec3(k % 4, k / 4 % 4, k / 16).cwiseProduct(box.sizes()) / 3.0);
    }
    const PointBatch points = cloud.batch();
    const double radius = round % 2 ? kInfinity : 0.2;
    const MeshPart part = distance.restrictedTo(box, radius);
    std::vector<double> all(points.size), some(points.size), withSide(points.size);
    distance.distance(points, radius, all.data());
    distance.distance(points, radius, some.data(), &part);
    distance.signedDistance(points, kInfinity, withSide.data(), {});
    const Interval range = distance.range(box);
    const Interval signedRange = distance.signedRange(box);
    EXPECT_LE(range.max - range.min, box.diagonal().norm() * (1.0 + 1e-9));
    for (std::size_t k = 0; k < points.size; ++k)
    {
      EXPECT_EQ(all[k], some[k]) << "at " << points[k].transpose();
      EXPECT_TRUE(range.contains(std::abs(withSide[k])));
      EXPECT_TRUE(signedRange.contains(withSide[k]));
    }
  }
}

TEST_P(MeshDistanceOf, GradientIsThatOfTheDistance)
{
  const MeshPtr mesh = repaired(GetParam().mesh);
  const MeshDistance distance(mesh);
  const Cloud cloud = samples(*mesh, 4, 200);
  const PointBatch points = cloud.batch();
  std::vector<double> value(points.size), x(points.size), y(points.size), z(points.size);
  distance.signedDistance(points, kInfinity, value.data(), { x.data(), y.data(), z.data() });
  const double step = 1e-7;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const Vec3 gradient(x[k], y[k], z[k]);
    EXPECT_NEAR(gradient.norm(), 1.0, 1e-9);
    if (std::abs(value[k]) < 1e-4)
    {
      continue;
    }
    // Along its own gradient a distance field grows at rate 1, at kinks too, in one direction.
    const double away = value[k] > 0.0 ? -step : step;
    const Vec3 toward = points[k] + away * gradient;
    Cloud moved;
    moved.add(toward);
    double next = 0.0;
    distance.signedDistance(moved.batch(), kInfinity, &next, {});
    EXPECT_NEAR((next - value[k]) / away, 1.0, 1e-5) << "at " << points[k].transpose();
  }
}

TEST_P(MeshDistanceOf, ThreadsDoNotChangeTheAnswer)
{
  const MeshPtr mesh = repaired(GetParam().mesh);
  const MeshDistance distance(mesh);
  const Cloud cloud = samples(*mesh, 5, 4000);
  std::vector<double> one(cloud.x.size()), many(cloud.x.size());
  std::vector<double> oneSigned(cloud.x.size()), manySigned(cloud.x.size());
  setThreadCount(1);
  distance.distance(cloud.batch(), kInfinity, one.data());
  distance.signedDistance(cloud.batch(), 0.05, oneSigned.data(), {});
  setThreadCount(4);
  distance.distance(cloud.batch(), kInfinity, many.data());
  distance.signedDistance(cloud.batch(), 0.05, manySigned.data(), {});
  setThreadCount(0);
  EXPECT_EQ(one, many);
  EXPECT_EQ(oneSigned, manySigned);
  // Nor does the company of the other points.
  for (std::size_t k = 0; k < cloud.x.size(); k += 7)
  {
    double alone;
    distance.signedDistance(cloud.batch().slice(k, 1), 0.05, &alone, {});
    EXPECT_EQ(alone, oneSigned[k]);
  }
}

INSTANTIATE_TEST_SUITE_P(Meshes, MeshDistanceOf,
  testing::Values(NamedMesh{ "icosphere", test::icosphere(1.0, 2) },
    NamedMesh{ "torus", test::torus(1.0, 0.3, 24, 12) },
    NamedMesh{ "box", test::box({ 0, 0, 0 }, { 1, 2, 3 }) },
    NamedMesh{ "bumpy", test::bumpySphere(1.0, 3) },
    NamedMesh{ "hollow", test::hollowSphere(1.0, 0.9, 2) },
    NamedMesh{ "overlapping",
      test::joined(test::icosphere(1.0, 2), test::icosphere(0.8, 2, { 0.9, 0.1, 0 })) },
    NamedMesh{ "open", test::withoutTriangles(test::icosphere(1.0, 3), 40, 12) }),
  [](const auto& info) { return std::string(info.param.name); });

// Points exactly on vertices, edges and faces, and lattice points in line with edges and faces.
TEST(MeshDistance, ExactHitsOfABox)
{
  const MeshDistance distance(repaired(test::box({ -1, -1, -1 }, { 1, 1, 1 })));
  Cloud cloud;
  for (int k = 0; k < 9 * 9 * 9; ++k)
  {
    cloud.add(0.5 * Vec3(k % 9 - 4, k / 9 % 9 - 4, k / 81 - 4));
  }
  const PointBatch points = cloud.batch();
  std::vector<std::int8_t> side(points.size);
  std::vector<double> found(points.size);
  distance.side(points, side.data());
  distance.signedDistance(points, kInfinity, found.data(), {});
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const double reach = points[k].cwiseAbs().maxCoeff();
    const int expected = reach < 1.0 ? 1 : reach > 1.0 ? -1 : 0;
    EXPECT_EQ(side[k], expected) << "at " << points[k].transpose();
    const double exact =
      reach <= 1.0 ? reach - 1.0 : (points[k].cwiseAbs().array() - 1.0).max(0.0).matrix().norm();
    EXPECT_NEAR(found[k], exact, 1e-15) << "at " << points[k].transpose();
  }
}

// One bit off a vertex or an edge midpoint of a sharp shape is still inside or outside, exactly.
TEST(MeshDistance, SideIsExactNextToEdgesAndVertices)
{
  const MeshPtr mesh = repaired(test::box({ 1, 1, 1 }, { 2, 2, 1.001 }));
  const MeshDistance distance(mesh);
  const double inf = kInfinity;
  Cloud cloud;
  std::vector<int> expected;
  for (const double x : { 1.0, 1.5, 2.0 })
  {
    for (const double z : { 1.0, 1.001 })
    {
      for (const double toX : { -inf, inf })
      {
        for (const double toZ : { -inf, inf })
        {
          const Vec3 p(std::nextafter(x, toX), 1.25, std::nextafter(z, toZ));
          cloud.add(p);
          expected.push_back(p.x() > 1 && p.x() < 2 && p.z() > 1 && p.z() < 1.001 ? 1 : -1);
        }
      }
    }
  }
  std::vector<std::int8_t> side(expected.size());
  distance.side(cloud.batch(), side.data());
  for (std::size_t k = 0; k < expected.size(); ++k)
  {
    EXPECT_EQ(side[k], expected[k]) << "point " << k << " at " << cloud.batch()[k].transpose();
  }
}

TEST(MeshDistance, SizeAndPlaceDoNotMatter)
{
  for (const double scale : { 1e-30, 1e-6, 1e6, 1e30 })
  {
    TriangleMesh mesh = test::bumpySphere(1.0, 2);
    const TriangleMesh plain = mesh;
    for (Vec3& point : mesh.points)
    {
      point *= scale;
    }
    const MeshDistance distance(repaired(mesh));
    const Cloud cloud = samples(plain, 6, 50);
    for (std::size_t k = 0; k < cloud.x.size(); ++k)
    {
      Cloud scaled;
      scaled.add(scale * cloud.batch()[k]);
      double found = 0.0;
      distance.distance(scaled.batch(), kInfinity, &found);
      EXPECT_NEAR(found / scale, bruteDistance(plain, cloud.batch()[k]), 1e-11) << scale;
    }
  }
}

TEST(MeshDistance, PointsFarAwayFindTheMesh)
{
  const MeshDistance distance(repaired(test::icosphere(1.0, 2)));
  for (const double far : { 1e3, 1e9, 1e18, 1e25 })
  {
    Cloud cloud;
    for (int k = 0; k < 5; ++k)
    {
      cloud.add({ far, 0.1 * k, -far });
    }
    std::vector<double> found(5);
    std::vector<std::int8_t> side(5);
    distance.signedDistance(cloud.batch(), kInfinity, found.data(), {});
    distance.side(cloud.batch(), side.data());
    EXPECT_NEAR(found[3] / (std::sqrt(2.0) * far), 1.0, 1e-2);
    EXPECT_EQ(side[3], -1);
  }
}

TEST(MeshDistance, WarnsOfOpenMeshesOnly)
{
  EXPECT_TRUE(MeshDistance(repaired(test::icosphere(1.0, 1))).warnings().empty());
  const MeshDistance open(repaired(test::withoutTriangles(test::icosphere(1.0, 1), 0, 1)));
  ASSERT_EQ(open.warnings().size(), 1u);
  EXPECT_NE(open.warnings()[0].find("3 open edges"), std::string::npos) << open.warnings()[0];
  EXPECT_THROW(MeshDistance(std::make_shared<TriangleMesh>()), InvalidGeometry);
}

TEST(MeshDistance, IsSharedPerMeshObject)
{
  const MeshPtr mesh = repaired(test::icosphere(1.0, 1));
  const auto first = sharedMeshDistance(mesh);
  EXPECT_EQ(sharedMeshDistance(mesh), first);
  EXPECT_NE(sharedMeshDistance(repaired(test::icosphere(1.0, 1))), first);
}

TEST(MeshDistance, RealScanAgreesWithBruteForce)
{
  const std::optional<TriangleMesh> scan = test::demoMesh("elephant.off");
  if (!scan)
  {
    GTEST_SKIP() << "libcgal-demo is not installed: no real mesh to test on";
  }
  const MeshPtr mesh = repaired(*scan);
  const MeshDistance distance(mesh);
  const Cloud cloud = samples(*mesh, 8, 150);
  const PointBatch points = cloud.batch();
  std::vector<double> found(points.size);
  distance.signedDistance(points, kInfinity, found.data(), {});
  for (std::size_t k = 0; k < points.size; ++k)
  {
    EXPECT_NEAR(std::abs(found[k]), bruteDistance(*mesh, points[k]), 1e-12);
    EXPECT_EQ(found[k]<0.0, test::sumOfSolidAngles(*mesh, points[k])> 0.5) << points[k].transpose();
  }
}

} // namespace
} // namespace hybridtree

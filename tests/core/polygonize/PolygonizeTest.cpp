// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/Polygonize.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/mesh/MeshChecks.h"
#include "tests/support/FunctionField.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstring>
#include <random>

namespace hybridtree
{
namespace
{

using test::FunctionField;

constexpr double kPi = 3.14159265358979323846;

/// T + signed distance to a sphere, positive inside.
FunctionField sphere(const Vec3& center, double radius)
{
  return FunctionField(
    [=](const Vec3& p) { return kThreshold + radius - (p - center).norm(); }, 1.0);
}

/// Noise that is trilinear between independent values at the points of a lattice: every case of a
/// cell, and every ambiguity, comes up.
class Noise
{
public:
  Noise(double cellSize, std::uint64_t seed) : cellSize_(cellSize), seed_(seed) {}

  double operator()(const Vec3& p) const
  {
    const Vec3 q = p / cellSize_;
    const Vec3 base(std::floor(q.x()), std::floor(q.y()), std::floor(q.z()));
    double sum = 0.0;
    for (int corner = 0; corner < 8; ++corner)
    {
      const Vec3 at(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
      const Vec3 t = q - base;
      double weight = 1.0;
      for (int axis = 0; axis < 3; ++axis)
      {
        weight *= at[axis] > 0.5 ? t[axis] : 1.0 - t[axis];
      }
      sum += weight * this->value(base + at);
    }
    return sum;
  }

private:
  double value(const Vec3& at) const
  {
    std::uint64_t h = seed_;
    for (const double c : { at.x(), at.y(), at.z() })
    {
      h = (h ^ static_cast<std::uint64_t>(static_cast<std::int64_t>(c))) * 0x9e3779b97f4a7c15u;
      h ^= h >> 29;
    }
    // A few values exactly T.
    return h % 16 == 0 ? kThreshold : static_cast<double>(h >> 11) * 0x1.0p-53;
  }

  double cellSize_;
  std::uint64_t seed_;
};

TriangleMesh make(const FieldSource& field, const Box3& bounds, double cellSize)
{
  PolygonizeOptions options;
  options.cellSize = cellSize;
  return polygonize(field, bounds, options);
}

Box3 cube(double half)
{
  return Box3(Vec3::Constant(-half), Vec3::Constant(half));
}

void expectClosed(const TriangleMesh& mesh)
{
  const MeshReport report = checkMesh(mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.unusedPoints, 0u);
  EXPECT_EQ(mesh.normals.size(), mesh.points.size());
}

TEST(Polygonize, SphereIsExact)
{
  const Vec3 center(0.123, -0.04, 5.2);
  const FunctionField field = sphere(center, 1.0);
  const TriangleMesh mesh =
    make(field, Box3(Vec3(center.array() - 1.5), Vec3(center.array() + 1.5)), 0.07);
  expectClosed(mesh);
  EXPECT_EQ(checkMesh(mesh).eulerCharacteristic, 2);
  EXPECT_NEAR(signedVolume(mesh), 4.0 / 3.0 * kPi, 0.01);
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    const Vec3 radial = mesh.points[k] - center;
    ASSERT_NEAR(radial.norm(), 1.0, 1e-4 * 0.07);
    ASSERT_NEAR((mesh.normals[k] - radial.normalized()).norm(), 0.0, 1e-3);
  }
}

TEST(Polygonize, TorusHasOneHandle)
{
  const FunctionField field([](const Vec3& p)
    { return kThreshold + 0.3 - std::hypot(std::hypot(p.x(), p.y()) - 1.0, p.z()); },
    1.0);
  const TriangleMesh mesh = make(field, cube(1.5), 0.05);
  expectClosed(mesh);
  EXPECT_EQ(checkMesh(mesh).genus(), 1);
}

TEST(Polygonize, NoiseStaysManifold)
{
  for (std::uint64_t seed = 1; seed <= 20; ++seed)
  {
    const Noise noise(0.25, seed);
    // Cut off by the bounds on all sides.
    const TriangleMesh mesh = make(FunctionField(noise), cube(3.0), 0.25);
    expectClosed(mesh);
    EXPECT_GT(checkMesh(mesh).triangles, 10000u);
    EXPECT_GT(signedVolume(mesh), 0.0);
  }
}

TEST(Polygonize, JumpsStayManifold)
{
  const FunctionField field(
    [](const Vec3& p)
    {
      return std::sin(7.0 * p.x()) * std::sin(5.0 * p.y()) * std::sin(6.0 * p.z()) > 0.1
        ? 1.0
        : std::nan("");
    });
  const double cellSize = 0.06;
  const TriangleMesh mesh = make(field, cube(1.0), cellSize);
  expectClosed(mesh);
  for (std::size_t k = 0; k < mesh.points.size(); ++k)
  {
    ASSERT_NEAR(mesh.normals[k].norm(), 1.0, 1e-9);
    if (mesh.points[k].cwiseAbs().maxCoeff() < 1.0)
    {
      // Both sides are met within the least distance from a lattice point, along some axis.
      bool in = false;
      bool out = false;
      for (int axis = 0; axis < 6; ++axis)
      {
        const Vec3 step = (axis % 2 == 0 ? 2e-4 : -2e-4) * cellSize * Vec3::Unit(axis / 2);
        (field(mesh.points[k] + step) >= kThreshold ? in : out) = true;
      }
      ASSERT_TRUE(in && out) << mesh.points[k].transpose();
    }
  }
}

// A plane of the surface in a plane of the lattice: all values there are T up to rounding, and
// differ between the batches of different bricks.
TEST(Polygonize, FlatOnTheLatticeWithRounding)
{
  std::mt19937_64 random(5);
  for (int round = 0; round < 10; ++round)
  {
    const FunctionField field(
      [&](const Vec3& p)
      {
        const double inside = 1.0 - p.cwiseAbs().maxCoeff();
        return kThreshold + inside + 1e-15 * (static_cast<double>(random() % 3) - 1.0);
      },
      std::sqrt(3.0));
    setThreadCount(1); // the random numbers above are not for threads
    const TriangleMesh mesh = make(field, cube(1.2), 0.125);
    setThreadCount(0);
    expectClosed(mesh);
    EXPECT_EQ(checkMesh(mesh).components, 1u);
    for (const Vec3& point : mesh.points)
    {
      ASSERT_NEAR(point.cwiseAbs().maxCoeff(), 1.0, 1.1e-4 * 0.125);
    }
  }
}

/// A sphere of radius 1 whose range is wrong for small boxes on one side of x = 0.
class CarelessSphere final : public FieldSource
{
public:
  explicit CarelessSphere(double side) : side_(side) {}
  void field(PointBatch points, double* value) const override { inner_.field(points, value); }
  void fieldAndGradient(PointBatch points, double* value, VectorBatch gradient) const override
  {
    inner_.fieldAndGradient(points, value, gradient);
  }
  Interval range(const Box3& box) const override
  {
    const bool wrong = box.sizes().x() < 1.0 && side_ * box.center().x() > 0.0;
    return wrong ? Interval{ 0.0, 0.1 } : inner_.range(box);
  }
  FieldSourcePtr restrictedTo(const Box3&) const override
  {
    return FieldSourcePtr(FieldSourcePtr(), this);
  }

private:
  double side_;
  FunctionField inner_ = sphere(Vec3(0.01, 0.02, 0.03), 1.0);
};

TEST(Polygonize, SamplesOverruleAWrongRange)
{
  const TriangleMesh mended = make(CarelessSphere(-1.0), cube(1.5), 0.1);
  expectClosed(mended);
  EXPECT_NEAR(signedVolume(mended), 4.0 / 3.0 * kPi, 0.05);
  // Not noticed, but closed.
  expectClosed(make(CarelessSphere(1.0), cube(1.5), 0.1));
}

TEST(Polygonize, SticksOutAndIsCut)
{
  const TriangleMesh mesh = make(sphere(Vec3(1.0, 0.0, 0.0), 0.9), cube(1.0), 0.05);
  expectClosed(mesh);
  EXPECT_NEAR(mesh.bounds().max().x(), 1.0, 1e-5);
  EXPECT_NEAR(signedVolume(mesh), 2.0 / 3.0 * kPi * std::pow(0.9, 3.0), 0.02);
}

TEST(Polygonize, SameBytesForAnyNumberOfThreads)
{
  const Noise noise(0.3, 77);
  setThreadCount(1);
  const TriangleMesh one = make(FunctionField(noise), cube(3.0), 0.1);
  setThreadCount(2);
  const TriangleMesh two = make(FunctionField(noise), cube(3.0), 0.1);
  setThreadCount(0);
  ASSERT_EQ(one.points.size(), two.points.size());
  EXPECT_EQ(one.triangles, two.triangles);
  const std::size_t bytes = one.points.size() * sizeof(Vec3);
  EXPECT_EQ(std::memcmp(one.points.data(), two.points.data(), bytes), 0);
  EXPECT_EQ(std::memcmp(one.normals.data(), two.normals.data(), bytes), 0);
}

// Meshes of two overlapping boxes have the same vertices where both see the surface.
TEST(Polygonize, BoxesShareTheLattice)
{
  const FunctionField field = sphere(Vec3(0.1, 0.2, 0.3), 1.0);
  const TriangleMesh whole = make(field, cube(1.5), 0.1);
  const TriangleMesh part = make(field, Box3(Vec3(-0.77, -1.5, -1.5), Vec3::Constant(1.6)), 0.1);
  std::size_t shared = 0;
  std::size_t inside = 0;
  for (const Vec3& a : part.points)
  {
    if (a.x() > -0.6)
    {
      ++inside;
      shared += std::any_of(
        whole.points.begin(), whole.points.end(), [&](const Vec3& b) { return a == b; });
    }
  }
  EXPECT_EQ(shared, inside);
  EXPECT_GT(inside, 500u);
}

TEST(Polygonize, NothingIsAnEmptyMesh)
{
  EXPECT_TRUE(make(sphere(Vec3::Zero(), 1.0), Box3(), 0.1).empty());
  EXPECT_TRUE(make(sphere(Vec3(9.0, 0.0, 0.0), 1.0), cube(1.0), 0.1).empty());
  EXPECT_TRUE(make(FunctionField([](const Vec3&) { return 0.0; }, 0.0), cube(1.0), 0.1).empty());
}

template <class Exception>
std::string messageOf(const std::function<void()>& body)
{
  try
  {
    body();
  }
  catch (const Exception& error)
  {
    return error.what();
  }
  return "nothing thrown";
}

TEST(Polygonize, RefusesWhatIsTooLarge)
{
  const FunctionField field = sphere(Vec3::Zero(), 1.0);
  PolygonizeOptions options;
  options.cellSize = 0.001;
  options.maxBytes = std::size_t(1) << 20;
  const std::string message = messageOf<TooLarge>([&] { polygonize(field, cube(1.5), options); });
  EXPECT_NE(message.find("the limit is 1 MiB"), std::string::npos) << message;
  EXPECT_NE(message.find("edge length of 0.001"), std::string::npos) << message;

  for (const double tiny : { 1e-7, 1e-12, 1e-300 })
  {
    options.cellSize = tiny;
    EXPECT_THROW(polygonize(field, cube(1.5), options), TooLarge) << tiny;
  }
  for (const double bad : { 0.0, -1.0, std::nan(""), HUGE_VAL })
  {
    options.cellSize = bad;
    EXPECT_THROW(polygonize(field, cube(1.5), options), InvalidParameter) << bad;
  }
}

TEST(Polygonize, StopsWhenAsked)
{
  class Impatient final : public Progress
  {
  public:
    bool cancelled() const override { return ++asked > 20; }
    void report(double fraction) const override
    {
      EXPECT_GE(fraction, 0.0);
      EXPECT_LE(fraction, 1.0);
    }
    mutable std::atomic<int> asked{ 0 };
  };
  const FunctionField field = sphere(Vec3::Zero(), 1.0);
  PolygonizeOptions options;
  options.cellSize = 0.02;
  EXPECT_THROW(polygonize(field, cube(1.5), options, Impatient()), Cancelled);
}

// A Newton step from one side of a crease misses the surface on the other.
TEST(Polygonize, VerticesAreOnSurfacesBesideACrease)
{
  const double cell = 0.1;
  const Vec3 across = Vec3(1.0, -2.0, 0.5).normalized();
  for (const double share : { -1e-3, -5e-4, -2e-4, 2e-4, 5e-4, 1e-3 })
  {
    for (const double ratio : { 10.0, 0.1 })
    {
      // Falls by 1 up to the crease and by `ratio` from there on; the crease is a share of a cell
      // off the surface.
      const double crease = share * cell;
      const auto depth = [=](double d) { return d < crease ? d - crease : ratio * (d - crease); };
      const FunctionField wedge(
        [=](const Vec3& p) { return kThreshold - depth(p.dot(across)) + depth(0.0); }, 11.0);
      PolygonizeOptions options;
      options.cellSize = cell;
      const TriangleMesh mesh =
        polygonize(wedge, Box3(Vec3(-1.0, -1.0, -1.0), Vec3(1.0, 1.0, 1.0)), options);
      int vertices = 0;
      for (const Vec3& point : mesh.points)
      {
        if (point.cwiseAbs().maxCoeff() < 0.99) // not where the box closes it
        {
          // They keep 1e-4 cells off the ends of their edge, too.
          ASSERT_LE(std::abs(point.dot(across)), 2e-4 * cell) << "share " << share;
          ++vertices;
        }
      }
      EXPECT_GT(vertices, 300);
    }
  }
}

} // namespace
} // namespace hybridtree

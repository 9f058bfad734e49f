// SPDX-License-Identifier: BSD-3-Clause
// Extreme numbers: what double precision or memory cannot hold is refused with its number, what is
// nothing comes out empty, and long work can be stopped at any of its looks.
#include "core/nodes/MeshLimits.h"

#include "core/base/Error.h"
#include "core/mesh/Dust.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/Barr.h"
#include "core/nodes/Blend.h"
#include "core/nodes/Boolean.h"
#include "core/nodes/FreeForm.h"
#include "core/nodes/LocalBlend.h"
#include "core/nodes/MeshNode.h"
#include "core/nodes/Primitive.h"
#include "core/nodes/WarpImage.h"
#include "core/skeletons/Box.h"
#include "core/skeletons/Circle.h"
#include "core/skeletons/Point.h"
#include "core/skeletons/Segment.h"
#include "core/tree/Serialize.h"
#include "tests/support/CancelAt.h"
#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace hybridtree::test
{
namespace
{

constexpr double kPi = 3.14159265358979323846;

NodePtr primitive(SkeletonPtr skeleton, double radius = 0.5, double reach = 1.0)
{
  return makePrimitive(std::move(skeleton), Potential::bySurfaceRadius(radius, reach, 2, false));
}

NodePtr ball(const Vec3& center = Vec3::Zero())
{
  return primitive(std::make_shared<PointSkeleton>(center));
}

NodePtr rod()
{
  return primitive(std::make_shared<SegmentSkeleton>(Vec3(-1.0, 0.0, -1.0), Vec3(1.0, 0.2, 1.0)));
}

NodePtr cube(const Vec3& center)
{
  return primitive(
    std::make_shared<BoxSkeleton>(center, Vec3(1.0, 1.0, 1.0), Mat3::Identity()), 0.0, 0.5);
}

std::string complaintOf(const std::function<void()>& work)
{
  try
  {
    work();
  }
  catch (const Error& error)
  {
    return error.what();
  }
  return "nothing";
}

void expectComplaint(const std::function<void()>& work, const std::vector<std::string>& parts)
{
  const std::string complaint = complaintOf(work);
  for (const std::string& part : parts)
  {
    EXPECT_NE(complaint.find(part), std::string::npos) << "no \"" << part << "\" in: " << complaint;
  }
}

TEST(Limits, FramesTooFarFromTheShapeAreRefused)
{
  const NodePtr shape = rod();
  using Make = std::function<NodePtr(const BarrFrame&)>;
  for (const auto& [kind, make] :
    { std::pair<std::string, Make>{
        "twist", [&](const BarrFrame& f) { return makeTwist(shape, f, 1.0); } },
      { "taper", [&](const BarrFrame& f) { return makeTaper(shape, f, 2.0); } },
      { "bend", [&](const BarrFrame& f) { return makeBend(shape, f, 1.0); } } })
  {
    for (const double distance : { 1e15, 1e100, 1e300 })
    {
      for (int axis = 0; axis < 3; ++axis)
      {
        BarrFrame frame;
        frame.origin[axis] = -distance;
        expectComplaint([&, &make = make] { make(frame); }, { "origin of the " + kind, "at most" });
      }
    }
    BarrFrame near;
    near.origin = Vec3(0.0, 0.0, 1e6);
    EXPECT_FALSE(make(near)->mesh(0.2)->empty());
  }
  BarrFrame frame;
  frame.begin = -1.7e308;
  frame.end = 1.7e308;
  expectComplaint([&] { makeTwist(shape, frame, 1.0); }, { "length of the range", "inf" });
}

TEST(Limits, ADeformationThatMakesTooManyTrianglesNamesTheirNumber)
{
  BarrFrame frame;
  frame.begin = -1.0;
  const NodePtr twisted = makeTwist(rod(), frame, 1998.0 * kPi);
  EXPECT_LT(twisted->surfaceBounds().diagonal().norm(), 10.0) << "turning keeps the radius";
  expectComplaint(
    [&] { twisted->mesh(0.005); }, { "0.005", "triangles", "edge length of", "or more" });

  expectComplaint([&] { makeTwist(rod(), frame, 2e5 * kPi); }, { "twist angle", "turns" });

  FreeFormLattice lattice;
  lattice.origin = Vec3::Constant(-1.5);
  lattice.axes = 3.0 * Mat3::Identity();
  lattice.displacements.assign(64, Vec3::Zero());
  lattice.displacements[21] = Vec3(1e6, 0.0, 0.0);
  expectComplaint([&] { makeFreeForm(rod(), lattice, FieldFrom::DeformedMesh, 0.05)->mesh(); },
    { "triangles", "or more" });
}

TEST(Limits, NumbersThatAreNoneOfTheChoicesAreRefused)
{
  const NodePtr a = ball();
  BlendOptions options;
  options.method = static_cast<BlendMethod>(4);
  expectComplaint([&] { makeBlend({ a, a }, options); }, { "Method", "4", "0 (automatic)" });
  expectComplaint([&] { makeLocalBlend(a, a, a, options); }, { "Method", "4" });
  expectComplaint([&] { makeBoolean(static_cast<BooleanOperation>(-1), a, a); },
    { "Operation", "-1", "2 (difference)" });
  expectComplaint([&] { makeBoolean(BooleanOperation::Union, a, a, static_cast<BooleanForm>(7)); },
    { "Form", "7", "3 (paper)" });
  FreeFormLattice lattice;
  expectComplaint([&] { makeFreeForm(a, lattice, static_cast<FieldFrom>(2)); },
    { "FieldFrom", "2", "1 (inverseMap)" });
  expectComplaint(
    [&] { makeFreeForm(a, lattice, FieldFrom::DeformedMesh, -1.0); }, { "EdgeLength", "-1" });
  expectComplaint([&] { a->mesh(-0.5); }, { "EdgeLength", "-0.5", "> 0" });
}

// Also where the surface runs through lattice points, whose field is exactly T.
TEST(Limits, AShapeLessItselfIsEmpty)
{
  const Vec3 origin = Vec3::Zero();
  const NodePtr shapes[] = { ball(), rod(), cube(origin),
    primitive(std::make_shared<CircleSkeleton>(origin, Vec3::UnitZ(), 1.0), 0.25),
    makeMeshNode(
      std::make_shared<const TriangleMesh>(box(Vec3(-1, -1, -1), Vec3(1, 1, 1))), 1.0, 0.2, 2),
    makeBlend({ ball(), ball(Vec3(0.5, 0.0, 0.0)) }) };
  for (const NodePtr& shape : shapes)
  {
    const auto meshes = meshesOf(*shape);
    const NodePtr equal = fromText(toText(*shape),
      [&](const std::string&) { return meshes.empty() ? nullptr : meshes.front().second; });
    for (const double edgeLength : { 0.0, 0.1, 0.125, 0.25 })
    {
      for (const NodePtr& other : { shape, equal })
      {
        const NodePtr rest = makeBoolean(BooleanOperation::Difference, shape, other);
        EXPECT_TRUE(rest->mesh(edgeLength)->empty()) << shape->kind() << " " << edgeLength;
      }
      // And adds nothing to what stands above it.
      const NodePtr rest = makeBoolean(BooleanOperation::Difference, shape, shape);
      const NodePtr far = ball(Vec3(8.0, 0.0, 0.0));
      EXPECT_EQ(checkMesh(*makeBlend({ rest, far })->mesh(0.25)).components, 1);
    }
  }
}

TEST(Limits, WhatTouchesSharesNothing)
{
  for (const double overlap : { 0.0, 1e-16, 1e-15, 1e-14, 1e-13 })
  {
    const NodePtr a = cube(Vec3(10.0, 0.0, 0.0));
    for (const Vec3& direction : { Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(1, 1, 1) })
    {
      const NodePtr b = cube(Vec3(10.0, 0.0, 0.0) + (1.0 - overlap) * direction);
      const NodePtr shared = makeBoolean(BooleanOperation::Intersection, a, b);
      EXPECT_TRUE(shared->mesh()->empty()) << overlap << " along " << direction.transpose();
      EXPECT_TRUE(shared->mesh(0.25)->empty()) << overlap << " along " << direction.transpose();
    }
  }
}

TEST(Limits, DustGoesAndTheRestStays)
{
  TriangleMesh mesh = icosphere(1.0, 1, Vec3::Zero());
  const TriangleMesh kept = mesh;
  mesh.sourceLeaf.assign(mesh.triangles.size(), 7);
  TriangleMesh flat = icosphere(1.0, 1, Vec3(5.0, 0.0, 0.0));
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  for (const Vec3& point : flat.points)
  {
    mesh.points.insert(mesh.points.begin(), Vec3(point.x(), point.y(), 1e-9 * point.z()));
  }
  for (Triangle& triangle : mesh.triangles)
  {
    for (std::int32_t& corner : triangle)
    {
      corner += first;
    }
  }
  for (const Triangle& t : flat.triangles)
  {
    mesh.triangles.push_back({ first - 1 - t[0], first - 1 - t[1], first - 1 - t[2] });
    mesh.sourceLeaf.push_back(3);
  }
  dropDust(mesh, 1e-4);
  EXPECT_EQ(mesh.points, kept.points);
  EXPECT_EQ(mesh.triangles, kept.triangles);
  EXPECT_EQ(mesh.sourceLeaf, std::vector<std::int32_t>(kept.triangles.size(), 7));
}

/// Doubles lengths: areas are four times as large.
class Doubling final : public SpaceWarp
{
public:
  void forward(PointBatch points, VectorBatch image) const override { scale(points, 2.0, image); }
  void inverse(PointBatch points, VectorBatch preimage) const override
  {
    scale(points, 0.5, preimage);
  }
  void pullBack(PointBatch preimages, VectorBatch gradient) const override
  {
    for (std::size_t k = 0; k < preimages.size; ++k)
    {
      gradient.set(k, 0.5 * gradient[k]);
    }
  }
  double inverseCost() const override { return 0.0; }
  Box3 preimageBounds(const Box3& box) const override
  {
    return { 0.5 * box.min(), 0.5 * box.max() };
  }
  Box3 imageBounds(const Box3& box) const override { return { 2.0 * box.min(), 2.0 * box.max() }; }

private:
  static void scale(PointBatch points, double factor, VectorBatch result)
  {
    for (std::size_t k = 0; k < points.size; ++k)
    {
      result.set(k, factor * points[k]);
    }
  }
};

TEST(Limits, DeformedMeshesMayHaveAsManyTrianglesAsIsSaid)
{
  const TriangleMesh mesh = icosphere(1.0, 2);
  double area = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    area += 4.0 * 0.5 * areaNormal(mesh, t).norm(); // of the image
  }
  const auto check = [&](double triangles)
  {
    const double edgeLength = std::sqrt(area / triangles * 4.0 / std::sqrt(3.0));
    requireCountableImage(mesh, Doubling(), edgeLength, Progress::none());
  };
  EXPECT_NO_THROW(check(1.99e7));
  EXPECT_THROW(check(2.01e7), TooLarge);
  expectComplaint([&] { check(5e7); }, { "some 5e+07 triangles", "at most 2e+07" });
}

// Work that makes many triangles looks often, and stops at whichever look says so.
TEST(Limits, DeformationsStopWhereverTheyAreAsked)
{
  BarrFrame frame;
  frame.begin = -1.0;
  const auto twisted = [&] { return makeTwist(rod(), frame, 20.0); };
  constexpr int kMany = 1 << 30;
  const CancelAt never(kMany);
  const std::size_t triangles = twisted()->mesh(0.1, never)->triangles.size();
  const int looks = kMany - never.looksLeft();
  EXPECT_GT(looks, static_cast<int>(triangles / 1000)) << "one look for 1000 triangles at least";
  for (int share = 0; share < 4; ++share)
  {
    const CancelAt stop(share * looks / 5);
    const NodePtr node = twisted();
    EXPECT_THROW(node->mesh(0.1, stop), Cancelled) << share;
  }
}

// Random trees of extreme numbers.
class Wild
{
public:
  explicit Wild(std::uint64_t seed) : random_(seed) {}

  NodePtr grow(int depth)
  {
    if (depth == 0)
    {
      return this->leaf();
    }
    const NodePtr a = this->grow(depth - 1);
    switch (random_.integer(0, 8))
    {
      case 0:
        return makeBlend({ a, this->grow(depth - 1), a });
      case 1:
        return makeLocalBlend(a, this->leaf(), this->leaf());
      case 2:
      case 3:
        return makeBoolean(static_cast<BooleanOperation>(random_.integer(0, 2)), a,
          random_.chance(0.2) ? a : this->grow(depth - 1),
          static_cast<BooleanForm>(random_.integer(0, 3)));
      case 4:
        return makeTwist(a, this->frame(), this->number());
      case 5:
        return makeTaper(a, this->frame(), std::abs(this->number()));
      case 6:
        return makeBend(a, this->frame(), random_.chance(0.5) ? this->number() : 2.0);
      case 7:
        return a->affine(this->map());
      default:
        return makeFreeForm(a, this->lattice(), static_cast<FieldFrom>(random_.integer(0, 1)),
          random_.chance(0.5) ? 0.0 : this->number());
    }
  }

  double number()
  {
    if (random_.chance(0.7))
    {
      return random_.uniform(-1.5, 1.5);
    }
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const double special[] = { 0.0, 1.0, -1.0, 1e-300, 1e300, -1e300, kInfinity, kNaN, 1e-16, 1e16,
      50.0, 1e4 };
    return random_.chance(0.5) ? special[random_.integer(0, 11)]
                               : std::pow(10.0, random_.uniform(-12.0, 12.0));
  }

private:
  Vec3 vector() { return { this->number(), this->number(), this->number() }; }

  NodePtr leaf()
  {
    SkeletonPtr skeleton;
    switch (random_.integer(0, 3))
    {
      case 0:
        skeleton = std::make_shared<PointSkeleton>(this->vector());
        break;
      case 1:
        skeleton = std::make_shared<SegmentSkeleton>(this->vector(), this->vector());
        break;
      case 2:
        skeleton = std::make_shared<CircleSkeleton>(this->vector(), this->vector(), 0.5);
        break;
      default:
        skeleton = std::make_shared<BoxSkeleton>(
          this->vector(), this->vector().cwiseAbs(), random_.rotation());
        break;
    }
    const double radius = std::abs(this->number());
    return makePrimitive(std::move(skeleton),
      Potential::bySurfaceRadius(radius, 1.5 * radius, random_.integer(2, 5), random_.chance(0.1)));
  }

  BarrFrame frame()
  {
    BarrFrame frame;
    frame.origin = this->vector();
    frame.axis = this->vector();
    frame.normal = this->vector();
    frame.begin = this->number();
    frame.end = random_.chance(0.7) ? frame.begin + std::abs(this->number()) : this->number();
    return frame;
  }

  Affine3 map()
  {
    Affine3 map = Affine3::Identity();
    map.linear().col(0) = this->vector();
    map.linear().col(1) = this->vector();
    map.linear().col(2) = this->vector();
    map.translation() = this->vector();
    return map;
  }

  FreeFormLattice lattice()
  {
    FreeFormLattice lattice;
    lattice.dimensions = { random_.integer(2, 4), random_.integer(2, 4), random_.integer(2, 4) };
    lattice.origin = Vec3::Constant(-2.0);
    lattice.axes = 4.0 * Mat3::Identity();
    lattice.displacements.assign(std::size_t(lattice.dimensions[0]) *
        std::size_t(lattice.dimensions[1]) * std::size_t(lattice.dimensions[2]),
      Vec3::Zero());
    lattice.displacements[lattice.displacements.size() / 2] = this->vector();
    return lattice;
  }

  Random random_;
};

// Whatever the numbers: an answer or an error of ours, and the mesh stops when asked. The looks are
// counted, not timed.
TEST(Limits, ExtremeTreesAnswerOrComplain)
{
  int meshed = 0;
  for (std::uint64_t seed = 0; seed < 1000; ++seed)
  {
    SCOPED_TRACE(seed);
    try
    {
      const NodePtr node = Wild(seed).grow(static_cast<int>(seed % 4));
      const CancelAt stop(1000);
      const MeshPtr mesh = node->mesh(node->defaultEdgeLength() * 4.0, stop);
      for (const Vec3& point : mesh->points)
      {
        ASSERT_TRUE(point.allFinite());
      }
      EXPECT_TRUE(checkMesh(*mesh).closed());
      EXPECT_EQ(toText(*node), toText(*fromText(toText(*node))));
      meshed += mesh->empty() ? 0 : 1;
    }
    catch (const Error& error)
    {
      EXPECT_STRNE(error.what(), "");
    }
  }
  EXPECT_GT(meshed, 100) << "or the numbers are all too wild to test anything";
}

} // namespace
} // namespace hybridtree::test

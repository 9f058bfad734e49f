// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/Primitive.h"

#include "core/base/Error.h"
#include "core/mesh/MeshChecks.h"
#include "core/nodes/Blend.h"
#include "tests/core/skeletons/SkeletonCases.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree
{
namespace
{

using test::PointList;
using test::Random;
using test::SkeletonCase;
using test::VectorList;

Box3 grown(const Box3& box, double reach)
{
  return Box3(Vec3(box.min().array() - reach), Vec3(box.max().array() + reach));
}

double fieldAt(const FieldSource& source, const Vec3& p)
{
  double value;
  source.field(PointList({ p }), &value);
  return value;
}

// Each skeleton as it is, moved by a similarity, and by a map that is none.
struct PrimitiveCase
{
  std::string name;
  SkeletonPtr skeleton;
  Potential potential;
  Affine3 map;
  NodePtr node;
};

std::vector<PrimitiveCase> primitiveCases()
{
  Random random(31);
  std::vector<PrimitiveCase> cases;
  for (const SkeletonCase& item : test::skeletonCases())
  {
    const Affine3 maps[] = { Affine3::Identity(), test::randomSimilarity(random, 1.7),
      test::randomAffine(random) };
    for (const Affine3& map : maps)
    {
      const double radius = random.uniform(0.6, 1.2);
      const Potential potential = Potential::bySurfaceRadius(
        random.uniform(0.1, 0.25), radius, random.integer(2, 5), random.chance(0.2));
      cases.push_back(
        { item.name, item.skeleton, potential, map, makePrimitive(item.skeleton, potential, map) });
    }
  }
  return cases;
}

TEST(Primitive, FieldOfTheImageIsTheFieldAtThePreimage)
{
  Random random(32);
  for (const PrimitiveCase& item : primitiveCases())
  {
    const PointList points =
      randomPoints(random, grown(item.skeleton->bounds(), item.potential.influenceRadius()), 61);
    std::vector<double> distance(points.size());
    item.skeleton->distance(points, distance.data());
    const NodePtr plain = makePrimitive(item.skeleton, item.potential);
    const NodePtr moved = plain->affine(item.map);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const double expected = item.potential.evaluate(distance[k]);
      EXPECT_NEAR(fieldAt(*item.node, item.map * points[k]), expected, 1e-11) << item.name;
      EXPECT_NEAR(fieldAt(*moved, item.map * points[k]), expected, 1e-11) << item.name;
    }
  }
}

TEST(Primitive, ManyMapsInARowAreTheirProduct)
{
  Random random(33);
  for (const PrimitiveCase& item : primitiveCases())
  {
    NodePtr node = item.node;
    Affine3 product = Affine3::Identity();
    for (int round = 0; round < 4; ++round)
    {
      const Affine3 map = round % 2 ? test::randomAffine(random)
                                    : test::randomSimilarity(random, random.uniform(0.5, 2.0));
      node = node->affine(map);
      product = map * product;
    }
    // And back: what was a similarity in all is absorbed again.
    node = node->affine(product.inverse());
    const Box3 box = item.node->influenceBounds();
    for (int k = 0; k < 20; ++k)
    {
      const Vec3 p = random.inBox(box);
      EXPECT_NEAR(fieldAt(*node, p), fieldAt(*item.node, p), 1e-9) << item.name;
    }
  }
}

TEST(Primitive, GradientIsThatOfTheField)
{
  Random random(34);
  for (const PrimitiveCase& item : primitiveCases())
  {
    const PointList points = randomPoints(random, item.node->influenceBounds(), 61);
    std::vector<double> value(points.size()), field(points.size());
    VectorList gradient(points.size());
    item.node->field(points, field.data());
    item.node->fieldAndGradient(points, value.data(), gradient);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      EXPECT_NEAR(value[k], field[k], 1e-12) << item.name;
      const double h = 1e-6;
      for (int axis = 0; axis < 3; ++axis)
      {
        const Vec3 step = h * Vec3::Unit(axis);
        const double slope =
          (fieldAt(*item.node, points[k] + step) - fieldAt(*item.node, points[k] - step)) / (2 * h);
        EXPECT_NEAR(gradient[k][axis], slope, 2e-4 * (1.0 + gradient[k].norm())) << item.name;
      }
    }
  }
}

TEST(Primitive, AddsIntoSums)
{
  Random random(35);
  for (const PrimitiveCase& item : primitiveCases())
  {
    const PointList points = randomPoints(random, item.node->influenceBounds(), 45);
    std::vector<double> field(points.size()), sum(points.size(), 2.0), sumToo(points.size(), 3.0);
    VectorList gradient(points.size()), gradientSum(points.size());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      gradientSum.batch().set(k, Vec3(1, 2, 3));
    }
    item.node->fieldAndGradient(points, field.data(), gradient);
    item.node->addField(points, sum.data());
    item.node->addFieldAndGradient(points, sumToo.data(), gradientSum);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      EXPECT_NEAR(sum[k], 2.0 + field[k], 1e-13);
      EXPECT_NEAR(sumToo[k], 3.0 + field[k], 1e-13);
      EXPECT_LE((gradientSum[k] - gradient[k] - Vec3(1, 2, 3)).norm(), 1e-13);
    }
  }
}

TEST(Primitive, RangeAndRestrictionHoldOverBoxes)
{
  Random random(36);
  int dropped = 0;
  for (const PrimitiveCase& item : primitiveCases())
  {
    for (int round = 0; round < 40; ++round)
    {
      const double size = std::pow(10.0, random.uniform(-5.0, 0.0));
      const Vec3 corner = random.inBox(grown(item.node->influenceBounds(), 0.3));
      const Box3 box(
        corner, Vec3(corner + size * Vec3(random.unit(), random.unit(), random.unit())));
      const Interval range = item.node->range(box);
      const FieldSourcePtr part = item.node->restrictedTo(box);
      dropped += part == nullptr;
      const PointList points = randomPoints(random, box, 30);
      std::vector<double> field(points.size()), there(points.size(), 0.0);
      item.node->field(points, field.data());
      if (part)
      {
        part->field(points, there.data());
      }
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        EXPECT_LE(range.min, field[k]) << item.name;
        EXPECT_GE(range.max, field[k]) << item.name;
        EXPECT_EQ(there[k], field[k]) << item.name;
      }
      const double slope = 20.0; // more than any of these fields has, maps included
      EXPECT_LE(range.max - range.min, slope * size + 1e-9) << item.name << " size " << size;
    }
  }
  EXPECT_GT(dropped, 100);
}

TEST(Primitive, FieldVanishesOutsideTheInfluenceBoundsAndReachesThem)
{
  Random random(37);
  for (const PrimitiveCase& item : primitiveCases())
  {
    const Box3 box = item.node->influenceBounds();
    for (int k = 0; k < 200; ++k)
    {
      const Vec3 p = random.inBox(grown(box, 0.5));
      if (!box.contains(p))
      {
        EXPECT_EQ(fieldAt(*item.node, p), 0.0) << item.name;
      }
    }
  }
}

TEST(Primitive, MembershipIsTheSideOfTheField)
{
  Random random(38);
  for (const PrimitiveCase& item : primitiveCases())
  {
    const PointList points = randomPoints(random, grown(item.node->influenceBounds(), 0.1), 300);
    std::vector<double> field(points.size());
    std::vector<std::int8_t> side(points.size());
    std::vector<std::int32_t> leaf(points.size());
    item.node->field(points, field.data());
    item.node->membership(points, side.data());
    item.node->sourceLeaf(points, leaf.data());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      if (std::abs(field[k] - kThreshold) > 1e-9)
      {
        EXPECT_EQ(side[k], field[k] > kThreshold ? 1 : -1) << item.name;
      }
      EXPECT_EQ(leaf[k], field[k] != 0.0 ? 0 : -1) << item.name;
    }
  }
}

// Otherwise the mesh is that of the lattice, which has tests of its own.
bool hasDirectMesh(const PrimitiveCase& item)
{
  const std::optional<double> radius = item.potential.surfaceRadius();
  return radius && item.skeleton->offsetMesh(*radius, 0.15);
}

TEST(Primitive, PointsOfTheMeshAreOnTheSurface)
{
  for (const PrimitiveCase& item : primitiveCases())
  {
    const MeshPtr mesh = item.node->mesh(0.15);
    if (item.potential.isNegative())
    {
      EXPECT_TRUE(mesh->empty());
      EXPECT_TRUE(item.node->surfaceBounds().isEmpty());
      continue;
    }
    const MeshReport report = checkMesh(*mesh);
    EXPECT_TRUE(report.closedManifold()) << item.name << ": " << report.describe();
    EXPECT_GT(signedVolume(*mesh), 0.0) << item.name;
    EXPECT_EQ(mesh->sourceLeaf, std::vector<std::int32_t>(mesh->triangles.size(), 0));
    // A stretched mesh is mended by single steps along the gradient, which miss inward corners.
    const bool missed = item.name == "revolution with corners" &&
      static_cast<const Primitive&>(*item.node).map().has_value();
    if (missed || !hasDirectMesh(item))
    {
      continue;
    }
    const PointList points(mesh->points);
    std::vector<double> field(points.size());
    std::vector<std::int8_t> side(points.size());
    VectorList gradient(points.size());
    item.node->fieldAndGradient(points, field.data(), gradient);
    item.node->membership(points, side.data());
    ASSERT_EQ(mesh->normals.size(), mesh->points.size());
    const Box3 bounds = grown(item.node->surfaceBounds(), 1e-9);
    int differing = 0;
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      EXPECT_NEAR(field[k], kThreshold, 1e-9) << item.name;
      EXPECT_EQ(side[k], 0) << item.name;
      differing += (mesh->normals[k] + gradient[k].normalized()).norm() > 1e-6;
      EXPECT_TRUE(bounds.contains(points[k])) << item.name;
    }
    // An offset that has grown into itself has tips or creases.
    const bool smooth = *item.potential.surfaceRadius() < item.skeleton->reach();
    EXPECT_LE(differing, smooth ? 0 : int(points.size() / 4)) << item.name;
  }
}

TEST(Primitive, SurfaceBoundsAreTight)
{
  for (const PrimitiveCase& item : primitiveCases())
  {
    if (item.potential.isNegative() || static_cast<const Primitive&>(*item.node).map())
    {
      continue;
    }
    const Box3 box = item.node->mesh(0.02)->bounds();
    EXPECT_LE((item.node->surfaceBounds().max() - box.max()).maxCoeff(), 1e-3) << item.name;
    EXPECT_LE((box.min() - item.node->surfaceBounds().min()).maxCoeff(), 1e-3) << item.name;
  }
}

TEST(Primitive, VolumeUnderAMapIsThatTimesTheDeterminant)
{
  for (const PrimitiveCase& item : primitiveCases())
  {
    if (item.potential.isNegative() || !hasDirectMesh(item))
    {
      continue;
    }
    // Fine enough for shapes of a few hundredths, too.
    const double edge = signedVolume(*item.node->mesh(0.03)) < 0.01 ? 0.01 : 0.03;
    const double before = signedVolume(*makePrimitive(item.skeleton, item.potential)->mesh(edge));
    const double after = signedVolume(*item.node->mesh(edge));
    const double factor = std::abs(item.map.linear().determinant());
    EXPECT_NEAR(after, factor * before, 0.03 * after) << item.name;
  }
}

TEST(Primitive, SignedDistanceIsExactWhereItIsGiven)
{
  Random random(39);
  for (const PrimitiveCase& item : primitiveCases())
  {
    const Primitive& primitive = static_cast<const Primitive&>(*item.node);
    const PointList points = randomPoints(random, grown(item.node->influenceBounds(), 0.5), 20);
    std::vector<double> distance(points.size());
    std::vector<std::int8_t> side(points.size());
    primitive.signedDistance(points, distance.data());
    primitive.membership(points, side.data());
    const bool known = !primitive.map() && !item.potential.isNegative();
    if (!known)
    {
      for (const double value : distance)
      {
        EXPECT_TRUE(std::isnan(value)) << item.name;
      }
      continue;
    }
    const MeshPtr mesh = primitive.mesh(0.03);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      if (std::isnan(distance[k]))
      {
        EXPECT_EQ(side[k], 1) << item.name;
        EXPECT_GE(*item.potential.surfaceRadius(), item.skeleton->reach()) << item.name;
        continue;
      }
      double nearest = std::numeric_limits<double>::infinity();
      for (const Vec3& point : mesh->points)
      {
        nearest = std::min(nearest, (points[k] - point).norm());
      }
      EXPECT_LE(std::abs(distance[k]), nearest + 1e-9) << item.name;
      EXPECT_GE(std::abs(distance[k]), nearest - 0.03) << item.name;
    }
  }
}

TEST(Primitive, AVolumeSkeletonIsInsideEvenWithoutRadius)
{
  const auto box = std::make_shared<BoxSkeleton>(Vec3::Zero(), Vec3(1, 1, 1));
  const NodePtr node = makePrimitive(box, Potential::bySurfaceRadius(0.0, 0.5, 2));
  std::int8_t side[3];
  node->membership(PointList({ Vec3(0.1, 0, 0), Vec3(0.5, 0.2, 0.1), Vec3(0.51, 0, 0) }), side);
  EXPECT_EQ(side[0], 1);
  EXPECT_EQ(side[1], 0);
  EXPECT_EQ(side[2], -1);
  EXPECT_NEAR(signedVolume(*node->mesh(0.3)), 1.0, 1e-12);
}

TEST(Primitive, AWeakFieldHasNoSurfaceButInfluence)
{
  const auto point = std::make_shared<PointSkeleton>(Vec3(1, 2, 3));
  const NodePtr node = makePrimitive(point, Potential(0.4, 1.0, 2));
  EXPECT_TRUE(node->mesh(0.1)->empty());
  EXPECT_TRUE(node->surfaceBounds().isEmpty());
  EXPECT_FALSE(node->isNegative());
  EXPECT_NEAR(node->influenceBounds().volume(), 8.0, 1e-12);
  std::int8_t side;
  node->membership(PointList({ Vec3(1, 2, 3) }), &side);
  EXPECT_EQ(side, -1);
}

TEST(Primitive, AFatTorusIsMeshedByTheLattice)
{
  const auto circle = std::make_shared<CircleSkeleton>(Vec3(0.1, 0.2, 0.3), Vec3(1, 2, 3), 0.5);
  const NodePtr node = makePrimitive(circle, Potential::bySurfaceRadius(0.7, 1.2, 2));
  const MeshPtr mesh = node->mesh(0.1);
  EXPECT_FALSE(mesh->empty());
  EXPECT_TRUE(isClosedManifold(*mesh)) << checkMesh(*mesh).describe();
}

TEST(Primitive, ParametersMakeExactlyTheSameNode)
{
  Random random(40);
  for (const PrimitiveCase& item : primitiveCases())
  {
    const Parameters parameters = item.node->parameters();
    const NodePtr again = primitiveFromParameters(parameters, {}, nullptr);
    EXPECT_STREQ(again->kind(), item.node->kind());
    EXPECT_EQ(again->parameters().entries(), parameters.entries()) << item.name;
    const PointList points = randomPoints(random, item.node->influenceBounds(), 30);
    std::vector<double> before(points.size()), after(points.size());
    item.node->field(points, before.data());
    again->field(points, after.data());
    EXPECT_EQ(before, after) << item.name;
  }
}

TEST(Primitive, BadValuesAreNamed)
{
  const Potential potential(1.0, 1.0, 2);
  const auto point = std::make_shared<PointSkeleton>(Vec3::Zero());
  Affine3 flat = Affine3::Identity();
  flat.linear()(2, 2) = 0.0;
  EXPECT_THROW(makePrimitive(nullptr, potential), InvalidParameter);
  EXPECT_THROW(makePrimitive(point, potential, flat), InvalidParameter);
  EXPECT_THROW(makePrimitive(point, potential)->affine(flat), InvalidParameter);
  EXPECT_THROW(primitiveFromParameters({}, {}, nullptr), InvalidText);
  EXPECT_THROW(primitiveFromParameters(makePrimitive(point, potential)->parameters(),
                 { makePrimitive(point, potential) }, nullptr),
    InvalidText);
}

// What cannot be meshed in double precision is refused, in whichever tree it is; what just can is
// meshed.
TEST(Primitive, WhatDoublePrecisionCannotHoldIsNotMeshed)
{
  const auto ball = [](double center, double size)
  {
    return makePrimitive(
      std::make_shared<PointSkeleton>(Vec3(center, 0.0, 0.0)), Potential(1.0, size, 2));
  };
  const auto rod = makePrimitive(
    std::make_shared<SegmentSkeleton>(Vec3::Zero(), Vec3(1e300, 0.0, 0.0)), Potential(1.0, 1.0, 2));
  EXPECT_THROW(rod->mesh(), InvalidGeometry);
  EXPECT_THROW(ball(1e300, 1.0)->mesh(), InvalidGeometry);
  EXPECT_THROW(ball(1e17, 1.0)->mesh(), InvalidGeometry);
  EXPECT_THROW(ball(0.0, 1e-150)->mesh(), InvalidGeometry);
  EXPECT_THROW(makeBlend({ ball(0.0, 1.0), ball(1e300, 1.0) })->mesh(), InvalidGeometry);
  for (const NodePtr& node : { ball(1e10, 1.0), ball(0.0, 1e-60), ball(0.0, 1e60) })
  {
    EXPECT_TRUE(isClosedManifold(*node->mesh()));
    EXPECT_GT(signedVolume(*node->mesh()), 0.0);
  }
}

TEST(Primitive, DistancesInsideAreKnownWhileTheOffsetKeepsClearOfItself)
{
  const auto tube =
    std::make_shared<HollowCylinderSkeleton>(Vec3(0, 0, -1), Vec3(0, 0, 1), 0.6, 0.2);
  const PointList points({ Vec3(0.4, 0, 0), Vec3(0.4, 0, 1.5), Vec3(0.25, 0, 0) });
  double distance[3];
  makePrimitive(tube, Potential::bySurfaceRadius(0.1, 0.5, 2))->signedDistance(points, distance);
  EXPECT_NEAR(distance[0], -0.3, 1e-12);
  EXPECT_NEAR(distance[1], 0.4, 1e-12);
  EXPECT_NEAR(distance[2], -0.15, 1e-12);
  // The bore is filled: from 0.25 the surface is 0.65 away, not 0.35.
  makePrimitive(tube, Potential::bySurfaceRadius(0.3, 0.5, 2))->signedDistance(points, distance);
  EXPECT_TRUE(std::isnan(distance[0]));
  EXPECT_NEAR(distance[1], 0.2, 1e-12);
  EXPECT_TRUE(std::isnan(distance[2]));
}

TEST(Primitive, SharpRoundSolidsUnderAMapHaveTheirPointsOnTheSurface)
{
  Affine3 map = Affine3::Identity();
  map.linear() << 2.0, 0.4, 0.0, 0.0, 0.5, 0.3, 0.0, 0.0, 1.5;
  const Vec3 a(0.1, -0.4, 0.2);
  const Vec3 b(0.3, 0.5, -0.3);
  const std::vector<SkeletonPtr> solids = { std::make_shared<CylinderSkeleton>(a, b, 0.5),
    std::make_shared<ConeSkeleton>(a, b, 0.6, 0.1),
    std::make_shared<HollowCylinderSkeleton>(a, b, 0.6, 0.3) };
  for (const SkeletonPtr& solid : solids)
  {
    const NodePtr node = makePrimitive(solid, Potential::bySurfaceRadius(0.0, 0.4, 2), map);
    const MeshPtr mesh = node->mesh(0.1);
    EXPECT_TRUE(checkMesh(*mesh).closedManifold()) << solid->kind();
    for (const Vec3& point : mesh->points)
    {
      const Vec3 own = map.inverse() * point;
      double distance;
      solid->signedDistance(PointList({ own }), &distance);
      EXPECT_NEAR(distance, 0.0, 1e-12) << solid->kind();
    }
  }
}

} // namespace
} // namespace hybridtree

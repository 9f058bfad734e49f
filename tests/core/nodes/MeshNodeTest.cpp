// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/MeshNode.h"

#include "core/base/Error.h"
#include "core/mesh/ContentHash.h"
#include "core/mesh/MeshChecks.h"
#include "core/mesh/RepairMesh.h"
#include "tests/support/Random.h"
#include "tests/support/TestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace hybridtree
{
namespace
{

MeshPtr repaired(const TriangleMesh& mesh)
{
  return repairMesh(mesh.points, mesh.triangles).mesh;
}

Box3 grown(Box3 box, double margin)
{
  return Box3(Vec3(box.min().array() - margin), Vec3(box.max().array() + margin));
}

double fieldAt(const FieldSource& source, const Vec3& p)
{
  double value = 0.0;
  source.field({ &p.x(), &p.y(), &p.z(), 1 }, &value);
  return value;
}

std::vector<double> fieldsAt(const FieldSource& source, const test::PointList& points)
{
  std::vector<double> value(points.size());
  source.field(points, value.data());
  return value;
}

Affine3 randomMap(test::Random& random)
{
  Affine3 map = Affine3::Identity();
  map.linear() = random.rotation() *
    Vec3(random.uniform(0.5, 2.0), random.uniform(-2.0, -0.5), random.uniform(0.5, 2.0))
      .asDiagonal() *
    random.rotation();
  map.translation() = 3.0 * random.direction();
  return map;
}

struct Leaf
{
  double maximumField;
  double radius;
  int exponent;
};

class MeshNodeOf : public testing::TestWithParam<Leaf>
{
protected:
  MeshPtr mesh_ = repaired(test::bumpySphere(1.0, 3));
  NodePtr node_ =
    makeMeshNode(mesh_, GetParam().maximumField, GetParam().radius, GetParam().exponent);
};

// [HT] 4.2: with R' the mesh is the surface and the influence ends at R.
TEST_P(MeshNodeOf, FieldIsThresholdOnTheMeshAndEndsAtR)
{
  const double sign = GetParam().maximumField > 0.0 ? 1.0 : -1.0;
  // The slope at the surface turns rounding of points into rounding of fields.
  const double tolerance =
    1e-13 * std::abs(GetParam().maximumField) * GetParam().exponent / GetParam().radius;
  for (const Triangle& c : mesh_->triangles)
  {
    const Vec3& a = mesh_->points[std::size_t(c[0])];
    const Vec3& b = mesh_->points[std::size_t(c[1])];
    const Vec3 middle = (a + b + mesh_->points[std::size_t(c[2])]) / 3.0;
    EXPECT_NEAR(fieldAt(*node_, a), sign * kThreshold, tolerance);
    EXPECT_NEAR(fieldAt(*node_, 0.5 * (a + b)), sign * kThreshold, tolerance);
    EXPECT_NEAR(fieldAt(*node_, middle), sign * kThreshold, tolerance);
  }
  const NodePtr plain = makeMeshNode(mesh_, 1.0, 0.3, 2);
  test::Random random(5);
  const test::PointList points =
    test::randomPoints(random, grown(mesh_->bounds(), GetParam().radius), 2000);
  std::vector<double> distance(points.size());
  plain->signedDistance(points, distance.data());
  const std::vector<double> field = fieldsAt(*node_, points);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (distance[k] > GetParam().radius)
    {
      EXPECT_EQ(field[k], 0.0);
    }
    else if (distance[k] < 0.0)
    {
      EXPECT_GE(sign * field[k], kThreshold);
    }
    else
    {
      EXPECT_LE(sign * field[k], kThreshold);
      EXPECT_GE(sign * field[k], 0.0);
    }
  }
}

TEST_P(MeshNodeOf, InsideIsPlateauOfI)
{
  // r'_T by its definition.
  const double share = std::sqrt(
    1.0 - std::pow(kThreshold / std::abs(GetParam().maximumField), 1.0 / GetParam().exponent));
  const double depth = GetParam().radius / (1.0 - share) * share;
  test::Random random(6);
  const test::PointList points = test::randomPoints(random, mesh_->bounds(), 2000);
  std::vector<double> distance(points.size());
  makeMeshNode(mesh_, 1.0, 0.3, 2)->signedDistance(points, distance.data());
  const std::vector<double> field = fieldsAt(*node_, points);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (distance[k] < -depth * (1.0 + 1e-9))
    {
      EXPECT_EQ(field[k], GetParam().maximumField);
    }
    else
    {
      EXPECT_LE(std::abs(field[k]), std::abs(GetParam().maximumField));
    }
  }
}

TEST_P(MeshNodeOf, GradientIsThatOfTheField)
{
  test::Random random(7);
  const NodePtr node = node_->affine(randomMap(random));
  const test::PointList points = test::randomPoints(random, node->influenceBounds(), 500);
  std::vector<double> value(points.size());
  test::VectorList gradient(points.size());
  node->fieldAndGradient(points, value.data(), gradient);
  int smooth = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    EXPECT_EQ(value[k], fieldAt(*node, points[k]));
    const double step = 1e-6;
    Vec3 central;
    Vec3 oneSided;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vec3 move = step * Vec3::Unit(axis);
      const double after = fieldAt(*node, points[k] + move);
      const double before = fieldAt(*node, points[k] - move);
      central[axis] = (after - before) / (2.0 * step);
      oneSided[axis] = (after - value[k]) / step;
    }
    const double steep =
      GetParam().exponent * std::abs(GetParam().maximumField) / GetParam().radius;
    if ((central - oneSided).norm() < 1e-3 * steep) // not at a kink of the distance
    {
      EXPECT_LT((central - gradient[k]).norm(), 2e-3 * steep) << "at " << points[k].transpose();
      ++smooth;
    }
  }
  EXPECT_GT(smooth, 400);
}

TEST_P(MeshNodeOf, AffineImagesKeepTheFieldExactly)
{
  test::Random random(8);
  const Affine3 map = randomMap(random);
  const NodePtr image = node_->affine(map);
  const test::PointList points = test::randomPoints(random, node_->influenceBounds(), 500);
  const double steep =
    4.0 * GetParam().exponent * std::abs(GetParam().maximumField) / GetParam().radius;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const Vec3 p = map * points[k];
    EXPECT_NEAR(fieldAt(*image, p), fieldAt(*node_, points[k]), 1e-13 * steep);
    if (fieldAt(*image, p) != 0.0)
    {
      EXPECT_TRUE(image->influenceBounds().contains(p));
    }
  }
}

TEST_P(MeshNodeOf, RangesHoldAndRestrictionsAgree)
{
  test::Random random(9);
  for (const NodePtr& node : { node_, node_->affine(randomMap(random)) })
  {
    const Box3 whole = grown(node->influenceBounds(), 0.1);
    for (int round = 0; round < 100; ++round)
    {
      const Vec3 lower = random.inBox(whole);
      const double edge = std::pow(10.0, -2.0 * random.unit()) * 0.3;
      const Box3 box(lower, Vec3(lower + edge * whole.sizes()));
      const Interval range = node->range(box);
      const FieldSourcePtr restricted = node->restrictedTo(box);
      const test::PointList points = test::randomPoints(random, box, 100);
      const std::vector<double> field = fieldsAt(*node, points);
      std::vector<double> inPart(points.size(), 0.0);
      test::VectorList gradient(points.size());
      if (restricted)
      {
        restricted->fieldAndGradient(points, inPart.data(), gradient);
      }
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        EXPECT_TRUE(range.contains(field[k])) << field[k];
        EXPECT_EQ(field[k], inPart[k]) << "at " << points[k].transpose();
      }
    }
    const Vec3 p = random.inBox(node->surfaceBounds().isEmpty() ? whole : node->surfaceBounds());
    const Interval point = node->range(Box3(p, p));
    EXPECT_NEAR(point.min, fieldAt(*node, p), 1e-9);
    EXPECT_NEAR(point.max, fieldAt(*node, p), 1e-9);
  }
}

TEST_P(MeshNodeOf, MembershipIsTheSideOfTheField)
{
  test::Random random(10);
  const NodePtr node = node_->affine(randomMap(random));
  const test::PointList points = test::randomPoints(random, node->influenceBounds(), 1000);
  const std::vector<double> field = fieldsAt(*node, points);
  std::vector<std::int8_t> side(points.size());
  node->membership(points, side.data());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (std::abs(field[k] - kThreshold) > 1e-9)
    {
      EXPECT_EQ(side[k], field[k] > kThreshold ? 1 : -1) << "at " << points[k].transpose();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Leaves, MeshNodeOf,
  testing::Values(Leaf{ 1.0, 0.3, 2 }, Leaf{ 0.7, 0.05, 3 }, Leaf{ 4.0, 0.1, 5 },
    Leaf{ 0.5, 0.2, 2 }, Leaf{ -1.0, 0.3, 2 }));

TEST(MeshNode, MeshIsTheInputItself)
{
  const MeshPtr mesh = repaired(test::bumpySphere(1.0, 2));
  const NodePtr node = makeMeshNode(mesh, 1.0, 0.3, 2);
  const MeshPtr output = node->mesh(0.01);
  EXPECT_EQ(output->points, mesh->points);
  EXPECT_EQ(output->triangles, mesh->triangles);
  ASSERT_EQ(output->normals.size(), mesh->points.size());
  ASSERT_EQ(output->sourceLeaf, std::vector<std::int32_t>(mesh->triangles.size(), 0));
  for (std::size_t t = 0; t < mesh->triangles.size(); ++t)
  {
    EXPECT_EQ(output->sourceTriangle[t], std::int32_t(t));
    for (const std::int32_t vertex : mesh->triangles[t])
    {
      EXPECT_GT(output->normals[std::size_t(vertex)].dot(areaNormal(*mesh, t).normalized()), 0.0);
    }
  }
  for (std::size_t k = 0; k < mesh->points.size(); ++k)
  {
    const VertexOrigin& origin = output->vertexOrigin[k];
    ASSERT_EQ(origin.leaf, 0);
    const Triangle& c = mesh->triangles[std::size_t(origin.triangle)];
    const std::size_t corner = origin.u == 1.0 ? 1 : origin.v == 1.0 ? 2 : 0;
    EXPECT_EQ(c[corner], std::int32_t(k));
    EXPECT_NEAR(output->normals[k].norm(), 1.0, 1e-12);
  }
}

TEST(MeshNode, MirroredMeshStaysOutward)
{
  test::Random random(12);
  const MeshPtr mesh = repaired(test::torus(1.0, 0.3, 20, 10));
  for (int round = 0; round < 4; ++round)
  {
    Affine3 map = randomMap(random); // its middle factor is negative: mirrored
    if (round % 2)
    {
      map.linear() = -map.linear();
    }
    const NodePtr node = makeMeshNode(mesh, 1.0, 0.3, 2)->affine(map);
    const MeshPtr image = node->mesh();
    EXPECT_TRUE(isClosedManifold(*image));
    EXPECT_NEAR(
      signedVolume(*image), std::abs(map.linear().determinant()) * signedVolume(*mesh), 1e-9);
    for (std::size_t k = 0; k < image->points.size(); ++k)
    {
      const Vec3 out = image->points[k] + 1e-3 * image->normals[k];
      const Vec3 in = image->points[k] - 1e-3 * image->normals[k];
      EXPECT_LT(fieldAt(*node, out), kThreshold);
      EXPECT_GT(fieldAt(*node, in), kThreshold);
      EXPECT_TRUE(grown(node->surfaceBounds(), 1e-12).contains(image->points[k]));
    }
  }
}

TEST(MeshNode, SignedDistanceUnderSimilaritiesOnly)
{
  const NodePtr node = makeMeshNode(repaired(test::box({ 0, 0, 0 }, { 1, 1, 1 })), 1.0, 0.3, 2);
  const Vec3 p(4.5, 4.0, 1.0);
  double distance = 0.0;
  const PointBatch batch{ &p.x(), &p.y(), &p.z(), 1 };
  Affine3 map = Affine3::Identity();
  map.linear() *= 2.0;
  node->affine(map)->signedDistance(batch, &distance);
  EXPECT_NEAR(distance, std::hypot(2.5, 2.0), 1e-12);
  map.linear()(0, 0) = 3.0;
  node->affine(map)->signedDistance(batch, &distance);
  EXPECT_TRUE(std::isnan(distance));
}

TEST(MeshNode, NegativeLeafHasNoSurface)
{
  const NodePtr node = makeMeshNode(repaired(test::icosphere(1.0, 1)), -1.0, 0.3, 2);
  EXPECT_TRUE(node->isNegative());
  EXPECT_TRUE(node->mesh()->empty());
  EXPECT_TRUE(node->surfaceBounds().isEmpty());
  EXPECT_FALSE(node->influenceBounds().isEmpty());
}

TEST(MeshNode, ComesBackFromItsParameters)
{
  const MeshPtr mesh = repaired(test::icosphere(1.0, 2));
  test::Random random(13);
  const NodePtr node = makeMeshNode(mesh, 0.9, 0.37, 4, randomMap(random));
  const auto lookup = [&](const std::string& hash)
  { return hash == contentHashText(*mesh) ? mesh : nullptr; };
  const NodePtr again = meshFromParameters(node->parameters(), {}, lookup);
  EXPECT_EQ(again->leafMesh(), mesh);
  const test::PointList points = test::randomPoints(random, node->influenceBounds(), 200);
  EXPECT_EQ(fieldsAt(*again, points), fieldsAt(*node, points));
  EXPECT_THROW(
    meshFromParameters(node->parameters(), {}, [](const std::string&) { return MeshPtr(); }),
    InvalidText);
}

TEST(MeshNode, RefusesParametersWithoutASurface)
{
  const MeshPtr mesh = repaired(test::icosphere(1.0, 1));
  EXPECT_THROW(makeMeshNode(mesh, 0.4, 0.3, 2), InvalidParameter);
  EXPECT_THROW(makeMeshNode(mesh, -0.4, 0.3, 2), InvalidParameter);
  EXPECT_THROW(makeMeshNode(mesh, 1.0, 0.0, 2), InvalidParameter);
  EXPECT_THROW(makeMeshNode(mesh, 1.0, 0.3, 1), InvalidParameter);
  EXPECT_THROW(makeMeshNode(std::make_shared<TriangleMesh>(), 1.0, 0.3, 2), InvalidGeometry);
  EXPECT_THROW(makeMeshNode(nullptr, 1.0, 0.3, 2), InvalidGeometry);
}

TEST(MeshNode, OpenMeshWarnsAndStillHasAnInside)
{
  const MeshPtr mesh = repaired(test::withoutTriangles(test::icosphere(1.0, 3), 0, 8));
  const NodePtr node = makeMeshNode(mesh, 1.0, 0.3, 2);
  EXPECT_EQ(node->warnings().size(), 1u);
  EXPECT_EQ(fieldAt(*node, Vec3::Zero()), 1.0);
  EXPECT_EQ(fieldAt(*node, Vec3(3, 0, 0)), 0.0);
}

} // namespace
} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
// What holds for every kind of node: its queries are views of one field ([HT] 3), so they must
// agree.
#include "core/mesh/MeshChecks.h"
#include "core/mesh/MeshDistance.h"
#include "core/nodes/Barr.h"
#include "core/nodes/FieldCost.h"
#include "core/tree/Serialize.h"
#include "tests/core/nodes/NodeCases.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hybridtree::test
{
namespace
{

std::vector<double> fieldAt(const FieldSource& source, PointBatch points)
{
  std::vector<double> value(points.size);
  source.field(points, value.data());
  return value;
}

std::vector<std::int8_t> membershipAt(const Node& node, PointBatch points)
{
  std::vector<std::int8_t> side(points.size);
  node.membership(points, side.data());
  return side;
}

Box3 grown(const Box3& box, double factor)
{
  const Vec3 center = box.center();
  const Vec3 half = 0.5 * factor * box.sizes();
  return Box3(Vec3(center - half), Vec3(center + half));
}

// A box in and around `whole`, of any size from a thousandth of it to all.
Box3 randomBox(Random& random, const Box3& whole)
{
  const Vec3 center = random.inBox(grown(whole, 1.1));
  Vec3 half;
  for (int axis = 0; axis < 3; ++axis)
  {
    half[axis] = 0.5 * whole.sizes()[axis] * std::pow(10.0, random.uniform(-3.0, 0.0));
  }
  return Box3(Vec3(center - half), Vec3(center + half));
}

// Random points, and the corners.
PointList samplesOf(Random& random, const Box3& box, std::size_t count)
{
  PointList points = randomPoints(random, box, count);
  for (int corner = 0; corner < 8; ++corner)
  {
    points.add(box.corner(static_cast<Box3::CornerType>(corner)));
  }
  return points;
}

// Rotation, reflected similarity, and a map that is neither.
std::vector<Affine3> someMaps()
{
  Random random(11);
  Affine3 rigid = Affine3::Identity();
  rigid.linear() = random.rotation();
  rigid.translation() = Vec3(3.0, -2.0, 1.0);
  Affine3 mirrored = Affine3::Identity();
  mirrored.linear() = 0.3 * random.rotation();
  mirrored.linear().col(0) *= -1.0;
  mirrored.translation() = Vec3(-0.5, 0.7, 0.1);
  Affine3 stretched = Affine3::Identity();
  stretched.linear() = random.rotation() * Vec3(0.5, 1.3, 2.0).asDiagonal() * random.rotation();
  stretched.translation() = Vec3(0.2, 0.4, -0.9);
  return { rigid, mirrored, stretched };
}

class NodeContract : public testing::TestWithParam<NodeCase>
{
protected:
  const Node& node() const { return *this->GetParam().node; }
  Box3 reach() const { return this->node().influenceBounds(); }
  double size() const { return this->reach().diagonal().norm(); }
  double meshEdge() const
  {
    const Box3 box = this->node().surfaceBounds();
    return box.isEmpty() ? 1.0 : box.sizes().maxCoeff() / 40.0;
  }
};

// Between the slopes to both sides along each axis: within the step the field may bend, or have a
// crease.
TEST_P(NodeContract, GradientIsTheSlopeOfTheField)
{
  Random random(1);
  const PointList points = randomPoints(random, grown(this->reach(), 1.05), 600);
  VectorList gradient(points.size());
  std::vector<double> value(points.size());
  this->node().fieldAndGradient(points, value.data(), gradient);
  const double step = 1e-6 * this->size();
  double steepest = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    steepest = std::max(steepest, gradient[k].norm());
  }
  EXPECT_GT(steepest, 0.0);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    PointList around;
    for (int axis = 0; axis < 3; ++axis)
    {
      around.add(points[k] + step * Vec3::Unit(axis));
      around.add(points[k] - step * Vec3::Unit(axis));
    }
    const std::vector<double> f = fieldAt(this->node(), around);
    for (int axis = 0; axis < 3; ++axis)
    {
      const double forward = (f[std::size_t(2 * axis)] - value[k]) / step;
      const double backward = (value[k] - f[std::size_t(2 * axis + 1)]) / step;
      const auto [low, high] = std::minmax({ forward, backward });
      const double rounding = 1e-4 * steepest;
      ASSERT_TRUE(gradient[k][axis] >= low - rounding && gradient[k][axis] <= high + rounding)
        << "at " << points[k].transpose() << ": gradient " << gradient[k].transpose() << ", axis "
        << axis << ": slopes " << backward << " and " << forward;
    }
  }
}

TEST_P(NodeContract, FieldIsTheSameHoweverAsked)
{
  Random random(2);
  const PointList points = randomPoints(random, grown(this->reach(), 1.05), 700);
  const std::vector<double> value = fieldAt(this->node(), points);
  std::vector<double> again(points.size());
  VectorList gradient(points.size());
  this->node().fieldAndGradient(points, again.data(), gradient);
  std::vector<double> sum(points.size(), 1.0);
  this->node().addField(points, sum.data());
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const double rounding = 1e-12 * (1.0 + std::abs(value[k]));
    ASSERT_NEAR(again[k], value[k], rounding) << "at " << points[k].transpose();
    ASSERT_NEAR(sum[k], 1.0 + value[k], rounding) << "at " << points[k].transpose();
    ASSERT_NEAR(fieldAt(this->node(), points.batch().slice(k, 1))[0], value[k], rounding)
      << "alone, at " << points[k].transpose();
  }
}

TEST_P(NodeContract, MembershipIsTheSideOfTheField)
{
  Random random(3);
  const PointList points = randomPoints(random, grown(this->reach(), 1.1), 4000);
  const std::vector<double> value = fieldAt(this->node(), points);
  const std::vector<std::int8_t> side = membershipAt(this->node(), points);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (std::abs(value[k] - kThreshold) > 1e-9)
    {
      ASSERT_EQ(int(side[k]), value[k] > kThreshold ? 1 : -1)
        << "at " << points[k].transpose() << ", field " << value[k];
    }
  }
}

TEST_P(NodeContract, RangeBoundsTheFieldAndShrinksWithTheBox)
{
  Random random(4);
  for (int round = 0; round < 300; ++round)
  {
    const Box3 box = randomBox(random, this->reach());
    const Interval range = this->node().range(box);
    const PointList points = samplesOf(random, box, 60);
    for (const double value : fieldAt(this->node(), points))
    {
      ASSERT_GE(value, range.min - 1e-12);
      ASSERT_LE(value, range.max + 1e-12);
    }
    const Vec3 center = box.center();
    const Vec3 half = Vec3::Constant(1e-7 * this->size());
    const Interval tiny = this->node().range(Box3(Vec3(center - half), Vec3(center + half)));
    ASSERT_LE(tiny.max - tiny.min, 1e-3) << "around " << center.transpose();
  }
}

TEST_P(NodeContract, RestrictionIsTheSameFieldInItsBox)
{
  Random random(5);
  int kept = 0;
  for (int round = 0; round < 200; ++round)
  {
    const Box3 box = randomBox(random, this->reach());
    const FieldSourcePtr restricted = this->node().restrictedTo(box);
    const Box3 inner(random.inBox(box));
    Box3 smaller = inner;
    smaller.extend(random.inBox(box));
    const FieldSourcePtr twice = restricted ? restricted->restrictedTo(smaller) : nullptr;
    const auto compare = [&](const FieldSource* part, const Box3& where)
    {
      const PointList points = samplesOf(random, where, 40);
      const std::vector<double> whole = fieldAt(this->node(), points);
      std::vector<double> value(points.size(), 0.0);
      VectorList gradient(points.size());
      if (part)
      {
        part->fieldAndGradient(points, value.data(), gradient);
        const Interval range = part->range(where);
        ASSERT_LE(range.min, *std::min_element(whole.begin(), whole.end()) + 1e-12);
        ASSERT_GE(range.max, *std::max_element(whole.begin(), whole.end()) - 1e-12);
      }
      VectorList wholeGradient(points.size());
      std::vector<double> again(points.size());
      this->node().fieldAndGradient(points, again.data(), wholeGradient);
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        ASSERT_NEAR(value[k], whole[k], 1e-12) << "at " << points[k].transpose();
        ASSERT_NEAR((gradient[k] - wholeGradient[k]).norm(), 0.0, 1e-9)
          << "at " << points[k].transpose();
      }
      if (part)
      {
        const std::vector<double> alone = fieldAt(*part, points);
        for (std::size_t k = 0; k < points.size(); ++k)
        {
          ASSERT_NEAR(alone[k], whole[k], 1e-12) << "at " << points[k].transpose();
        }
      }
    };
    ASSERT_NO_FATAL_FAILURE(compare(restricted.get(), box));
    ASSERT_NO_FATAL_FAILURE(compare(twice.get(), smaller));
    kept += restricted != nullptr;
  }
  EXPECT_GT(kept, 20);
  const Box3 reach = this->reach();
  const Vec3 outside = reach.max() + reach.sizes();
  EXPECT_EQ(this->node().restrictedTo(Box3(outside, Vec3(outside + reach.sizes()))), nullptr);
}

TEST_P(NodeContract, FieldIsZeroOutsideTheInfluenceBounds)
{
  Random random(6);
  const Box3 reach = this->reach();
  ASSERT_FALSE(reach.isEmpty());
  const PointList points = randomPoints(random, grown(reach, 1.7), 3000);
  const std::vector<double> value = fieldAt(this->node(), points);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (!reach.contains(points[k]))
    {
      ASSERT_EQ(value[k], 0.0) << "at " << points[k].transpose();
    }
  }
}

// So that what is far from a place does not even change how something there is computed.
TEST_P(NodeContract, NothingIsToldOfBoxesOutsideTheInfluenceBounds)
{
  std::vector<Affine3> maps = someMaps();
  maps.push_back(Affine3::Identity());
  Random random(16);
  int outside = 0;
  for (const Affine3& map : maps)
  {
    const NodePtr image = this->node().affine(map);
    const Box3 reach = image->influenceBounds();
    for (int round = 0; round < 200; ++round)
    {
      // Most of them a bit outside of one face.
      Box3 box = randomBox(random, grown(reach, 1.5));
      const int axis = random.integer(0, 2);
      const double gap = reach.sizes()[axis] * std::pow(10.0, random.uniform(-9.0, -1.0));
      box.translate((reach.max()[axis] + gap - box.min()[axis]) * Vec3::Unit(axis));
      ASSERT_FALSE(box.intersects(reach));
      const Interval range = image->range(box);
      ASSERT_TRUE(range.min == 0.0 && range.max == 0.0) << range.min << " to " << range.max;
      ASSERT_EQ(image->restrictedTo(box), nullptr);
      ++outside;
    }
  }
  EXPECT_EQ(outside, 800);
}

TEST_P(NodeContract, SignedDistanceIsThatToTheMeshOrUnknown)
{
  const MeshPtr mesh = this->node().mesh(this->meshEdge());
  Random random(7);
  const PointList points = randomPoints(random, this->reach(), 300);
  std::vector<double> distance(points.size());
  this->node().signedDistance(points, distance.data());
  const std::vector<std::int8_t> side = membershipAt(this->node(), points);
  std::vector<double> nearest(points.size());
  if (!mesh->empty())
  {
    MeshDistance(mesh).distance(points, std::numeric_limits<double>::infinity(), nearest.data());
  }
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    if (std::isnan(distance[k]))
    {
      continue;
    }
    ASSERT_FALSE(mesh->empty());
    ASSERT_NEAR(std::abs(distance[k]), nearest[k], 0.3 * this->meshEdge())
      << "at " << points[k].transpose();
    if (std::abs(distance[k]) > 1e-9)
    {
      ASSERT_EQ(int(side[k]), distance[k] < 0.0 ? 1 : -1) << "at " << points[k].transpose();
    }
  }
}

TEST_P(NodeContract, SourceLeavesAreLeavesOfTheTree)
{
  Random random(8);
  const PointList points = randomPoints(random, grown(this->reach(), 1.1), 1000);
  std::vector<std::int32_t> leaf(points.size());
  this->node().sourceLeaf(points, leaf.data());
  const std::vector<double> value = fieldAt(this->node(), points);
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    ASSERT_GE(leaf[k], -1);
    ASSERT_LT(leaf[k], this->node().leafCount());
    if (this->node().leafCount() == 1 && value[k] != 0.0)
    {
      ASSERT_EQ(leaf[k], 0) << "at " << points[k].transpose();
    }
  }
}

TEST_P(NodeContract, MeshIsAClosedManifoldOnTheSurface)
{
  const double edge = this->meshEdge();
  const MeshPtr mesh = this->node().mesh(edge);
  EXPECT_EQ(this->node().mesh(edge), mesh) << "kept";
  if (this->node().isNegative())
  {
    EXPECT_TRUE(mesh->empty());
    return;
  }
  ASSERT_FALSE(mesh->empty());
  const MeshReport report = checkMesh(*mesh);
  EXPECT_TRUE(report.closedManifold()) << report.describe();
  EXPECT_EQ(report.unusedPoints, 0u);
  EXPECT_GT(signedVolume(*mesh), 0.0);

  Box3 bounds = this->node().surfaceBounds();
  bounds.extend(Vec3(bounds.max() + Vec3::Constant(1e-3 * edge)));
  bounds.extend(Vec3(bounds.min() - Vec3::Constant(1e-3 * edge)));
  const PointList points(mesh->points);
  VectorList gradient(points.size());
  std::vector<double> value(points.size());
  this->node().fieldAndGradient(points, value.data(), gradient);
  ASSERT_EQ(mesh->normals.size(), points.size());
  const double tolerance = this->GetParam().vertexTolerance * edge;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    ASSERT_TRUE(bounds.contains(points[k])) << points[k].transpose();
    ASSERT_LE(std::abs(value[k] - kThreshold), tolerance * std::max(gradient[k].norm(), 1e-3))
      << "at " << points[k].transpose();
    ASSERT_NEAR(mesh->normals[k].norm(), 1.0, 1e-9);
  }
  ASSERT_EQ(mesh->sourceLeaf.size(), mesh->triangles.size());
  for (const std::int32_t leaf : mesh->sourceLeaf)
  {
    ASSERT_GE(leaf, -1);
    ASSERT_LT(leaf, this->node().leafCount());
  }
}

TEST_P(NodeContract, VolumeOfTheMeshIsThatOfTheInside)
{
  const Box3 bounds = this->node().surfaceBounds();
  if (bounds.isEmpty())
  {
    return;
  }
  const MeshPtr mesh = this->node().mesh(this->meshEdge());
  Random random(9);
  const std::size_t count = 40000;
  const std::vector<std::int8_t> side =
    membershipAt(this->node(), randomPoints(random, bounds, count));
  const double part =
    static_cast<double>(std::count(side.begin(), side.end(), std::int8_t(1))) / count;
  const double deviation = std::sqrt(part * (1.0 - part) / count);
  EXPECT_NEAR(signedVolume(*mesh), part * bounds.volume(),
    4.0 * deviation * bounds.volume() + 0.02 * part * bounds.volume());
}

TEST_P(NodeContract, AffineImageHasTheFieldOfTheOriginal)
{
  Random random(10);
  const PointList points = randomPoints(random, grown(this->reach(), 1.1), 1000);
  VectorList gradient(points.size());
  std::vector<double> value(points.size());
  this->node().fieldAndGradient(points, value.data(), gradient);
  const std::vector<std::int8_t> side = membershipAt(this->node(), points);
  for (const Affine3& map : someMaps())
  {
    const NodePtr image = this->node().affine(map);
    PointList mapped;
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      mapped.add(map * points[k]);
    }
    VectorList imageGradient(points.size());
    std::vector<double> imageValue(points.size());
    image->fieldAndGradient(mapped, imageValue.data(), imageGradient);
    const std::vector<std::int8_t> imageSide = membershipAt(*image, mapped);
    EXPECT_EQ(image->leafCount(), this->node().leafCount());
    const Box3 imageReach = grown(image->influenceBounds(), 1.0 + 1e-9);
    int wrongGradients = 0;
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      ASSERT_NEAR(imageValue[k], value[k], 1e-9 * (1.0 + std::abs(value[k])))
        << "at " << points[k].transpose();
      const Vec3 back = map.linear().transpose() * imageGradient[k];
      wrongGradients += (back - gradient[k]).norm() > 1e-6 * (1.0 + gradient[k].norm());
      if (std::abs(value[k] - kThreshold) > 1e-9)
      {
        ASSERT_EQ(int(imageSide[k]), int(side[k])) << "at " << points[k].transpose();
      }
      if (value[k] != 0.0)
      {
        ASSERT_TRUE(imageReach.contains(mapped[k])) << "at " << points[k].transpose();
      }
    }
    EXPECT_EQ(wrongGradients, 0);
  }
}

TEST_P(NodeContract, TextGivesTheSameFieldBitForBit)
{
  const std::string text = toText(this->node());
  const auto meshes = meshesOf(this->node());
  const NodePtr read = fromText(text,
    [&](const std::string& hash)
    {
      for (const auto& [known, mesh] : meshes)
      {
        if (known == hash)
        {
          return mesh;
        }
      }
      return MeshPtr();
    });
  EXPECT_STREQ(read->kind(), this->node().kind());
  EXPECT_EQ(read->leafCount(), this->node().leafCount());
  Random random(12);
  const PointList points = randomPoints(random, grown(this->reach(), 1.05), 500);
  EXPECT_EQ(fieldAt(*read, points), fieldAt(this->node(), points));
  EXPECT_EQ(toText(*read), text);
}

// By which blends choose between ways to mesh: what is free would always be sampled.
TEST_P(NodeContract, ASampleHasItsCost)
{
  const double cost = fieldCost(this->node(), 0.1);
  EXPECT_GT(cost, 0.0);
  EXPECT_LT(cost, 100.0); // microseconds
  for (const NodePtr& child : this->node().children())
  {
    EXPECT_GT(fieldCost(*makeTwist(child, {}, 1.0), 0.1), fieldCost(*child, 0.1));
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, NodeContract, testing::ValuesIn(nodeCases()),
  [](const testing::TestParamInfo<NodeCase>& info) { return info.param.name; });

} // namespace
} // namespace hybridtree::test

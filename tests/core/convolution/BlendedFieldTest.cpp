// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/Error.h"
#include "core/convolution/GraphDistances.h"
#include "core/nodes/SubdivisionSkeleton.h"
#include "core/nodes/SubdivisionSkeletonMesh.h"

#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

// [SUB] 5 and its figures, as properties.
namespace hybridtree::test
{
namespace
{

NodePtr skeleton(const SkeletonGraph& graph, BlendingKind blending, int level = 0)
{
  SubdivisionSkeletonOptions options;
  options.level = level;
  options.blending.kind = blending;
  return makeSubdivisionSkeleton(graph, options);
}

double valueAt(const Node& node, const Vec3& p)
{
  double value;
  node.field({ &p.x(), &p.y(), &p.z(), 1 }, &value);
  return value;
}

Vec3 gradientAt(const Node& node, const Vec3& p)
{
  double value;
  Vec3 gradient;
  node.fieldAndGradient(
    { &p.x(), &p.y(), &p.z(), 1 }, &value, { &gradient.x(), &gradient.y(), &gradient.z() });
  return gradient;
}

SkeletonGraph chain(const std::vector<Vec3>& points, double radius)
{
  SkeletonGraph graph;
  graph.points = points;
  graph.radii.assign(points.size(), radius);
  for (std::size_t k = 0; k + 1 < points.size(); ++k)
  {
    graph.segments.push_back({ static_cast<std::int32_t>(k), static_cast<std::int32_t>(k + 1) });
  }
  return graph;
}

// Points of a gently curved arc.
std::vector<Vec3> arc(int parts)
{
  std::vector<Vec3> points;
  for (int k = 0; k <= parts; ++k)
  {
    const double angle = 1.6 * k / parts;
    points.emplace_back(8.0 * std::cos(angle), 8.0 * std::sin(angle), 0.0);
  }
  return points;
}

// A hairpin: two long limbs side by side, joined far away.
SkeletonGraph hairpin(double gap, double radius)
{
  return chain({ Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(6, 0, 0), Vec3(9, 0, 0), Vec3(9, gap, 0),
                 Vec3(6, gap, 0), Vec3(3, gap, 0), Vec3(0, gap, 0) },
    radius);
}

// The whole and its controlled form, at points around it.
double largestDifference(const SkeletonGraph& graph, BlendingKind blending, int level = 0)
{
  const NodePtr all = skeleton(graph, BlendingKind::All, level);
  const NodePtr controlled = skeleton(graph, blending, level);
  Random random(3);
  const PointList points = randomPoints(random, all->influenceBounds(), 3000);
  std::vector<double> a(points.size());
  std::vector<double> b(points.size());
  all->field(points, a.data());
  controlled->field(points, b.data());
  double largest = 0.0;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    largest = std::max(largest, std::abs(a[k] - b[k]));
  }
  return largest;
}

// [SUB] Figure 15: with the parameter u the object gets thinner, with distances it does not.
TEST(BlendedField, StraightAndGentleSkeletonsKeepTheirField)
{
  for (const int parts : { 2, 5, 40 })
  {
    std::vector<Vec3> line;
    for (int k = 0; k <= parts; ++k)
    {
      line.emplace_back(10.0 * k / parts, 0, 0);
    }
    EXPECT_LT(largestDifference(chain(line, 0.5), BlendingKind::Neighbours), 1e-9) << parts;
    EXPECT_LT(largestDifference(chain(arc(parts), 0.5), BlendingKind::Neighbours, 1), 1e-9)
      << parts;
  }
  EXPECT_GT(largestDifference(chain(arc(12), 0.5), BlendingKind::Paper, 1), 0.05);
}

// [SUB] Figure 16: a short element between two long ones must not keep them from blending, and the
// sizes of elements must not show.
TEST(BlendedField, AShortElementBetweenLongOnesChangesLittle)
{
  const Vec3 corner(0, 0, 0);
  const Vec3 a(-4, 0, 0);
  const Vec3 b(0, 4, 0);
  const SkeletonGraph two = chain({ a, corner, b }, 0.5);
  const SkeletonGraph three = chain({ a, Vec3(-0.05, 0, 0), Vec3(0, 0.05, 0), b }, 0.5);
  const Vec3 outside = 0.3 * Vec3(1, -1, 0);
  const auto loss = [&](BlendingKind kind)
  {
    return valueAt(*skeleton(three, BlendingKind::All), outside) -
      valueAt(*skeleton(three, kind), outside);
  };
  EXPECT_NEAR(loss(BlendingKind::Neighbours), 0.0, 1e-12);
  EXPECT_GT(loss(BlendingKind::Paper), 0.02);
  EXPECT_NEAR(valueAt(*skeleton(two, BlendingKind::Neighbours), outside),
    valueAt(*skeleton(three, BlendingKind::Neighbours), outside), 0.05);
}

// [SUB] Figure 13: limbs that only pass each other are united, not blended.
TEST(BlendedField, LimbsFarApartAlongTheSkeletonAreUnited)
{
  const SkeletonGraph graph = hairpin(1.3, 0.5);
  const SkeletonGraph one = chain({ Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(6, 0, 0) }, 0.5);
  const NodePtr limb = skeleton(one, BlendingKind::All);
  for (const double x : { 1.0, 2.9, 3.0, 4.0 })
  {
    const Vec3 between(x, 0.65, 0.0);
    EXPECT_GT(valueAt(*skeleton(graph, BlendingKind::All), between), 1.5 * valueAt(*limb, between));
    EXPECT_NEAR(
      valueAt(*skeleton(graph, BlendingKind::Neighbours), between), valueAt(*limb, between), 1e-9)
      << x;
  }
}

// Without limbs that touch: no crease along a bend however sharp, at branches and attachments.
void expectSmooth(const SkeletonGraph& graph, const std::vector<Vec3>& path, int level)
{
  const NodePtr node = skeleton(graph, BlendingKind::Neighbours, level);
  double steepest = 0.0;
  double jump = 0.0;
  Vec3 before = Vec3::Zero();
  constexpr int kSteps = 4000;
  for (std::size_t part = 0; part + 1 < path.size(); ++part)
  {
    for (int k = 0; k <= kSteps; ++k)
    {
      const Vec3 p = path[part] + double(k) / kSteps * (path[part + 1] - path[part]);
      const Vec3 gradient = gradientAt(*node, p);
      jump = k == 0 ? jump : std::max(jump, (gradient - before).norm());
      steepest = std::max(steepest, gradient.norm());
      before = gradient;
    }
  }
  EXPECT_GT(steepest, 0.1);
  EXPECT_LT(jump, 0.02 * steepest);
}

TEST(BlendedField, IsSmoothAlongBendsBranchesAndAttachments)
{
  const SkeletonGraph bend = chain({ Vec3(-4, 0, 0), Vec3(0, 0, 0), Vec3(-1, 3.5, 0) }, 0.5);
  expectSmooth(bend, { Vec3(-4, -0.5, 0), Vec3(0.4, -0.4, 0), Vec3(-0.6, 3.5, 0) }, 1);
  SkeletonGraph branch = chain({ Vec3(-4, 0, 0), Vec3(0, 0, 0), Vec3(3, 2, 0) }, 0.5);
  branch.points.push_back(Vec3(3, -2, 0));
  branch.radii.push_back(0.4);
  branch.segments.push_back({ 1, 3 });
  expectSmooth(branch, { Vec3(-4, 0.5, 0), Vec3(0, 0.5, 0), Vec3(3, 2.5, 0) }, 1);
  expectSmooth(branch, { Vec3(3, 1.5, 0), Vec3(1.0, 0, 0), Vec3(3, -1.5, 0) }, 1);
  SkeletonGraph fan;
  fan.points = { Vec3(0, 0, 0), Vec3(3, -1.5, 0), Vec3(3, 1.5, 0), Vec3(-3, 0, 0.5),
    Vec3(5, 0, 2) };
  fan.radii.assign(5, 0.5);
  fan.triangles = { { 0, 1, 2 }, { 1, 4, 2 } };
  fan.segments = { { 0, 3 } };
  expectSmooth(fan, { Vec3(-3, 0, 1.0), Vec3(0, 0, 0.5), Vec3(3, 0, 0.5), Vec3(4.5, 0, 2.2) }, 1);
}

// Before memory ends.
TEST(BlendedField, TooManyDistancesAreRefused)
{
  DistanceCount count;
  EXPECT_NO_THROW(count.add(1000000));
  EXPECT_THROW(count.add(1000000000), TooLarge);
}

// Of a long chain each element but the last few is near eight points: 160 000 in all.
TEST(BlendedField, TooManyDistancesAreRefusedBeforeAnyIsKept)
{
  constexpr int kSegments = 20000;
  GroupedElements elements;
  for (std::int32_t k = 0; k <= kSegments; ++k)
  {
    elements.points.emplace_back(k, 0.0, 0.0);
    elements.reaches.push_back(1.0);
    if (k < kSegments)
    {
      elements.segments.push_back({ { k, k + 1 }, { 1.0, 1.0 }, k });
      elements.groups.push_back({ k, k + 1, -1 });
    }
  }
  const auto require = [&](double piecesAtPoint)
  {
    requireFewDistances(elements, 3.25, std::vector<double>(elements.points.size(), piecesAtPoint));
  };
  EXPECT_NO_THROW(require(370.0)); // just within the limit of 6e7
  EXPECT_THROW(require(600.0), TooLarge);
}

// Not only between pieces, of which there is one here.
TEST(BlendedField, MeshesOfLargePiecesAreCancelledSoon)
{
  class Impatient : public Progress
  {
  public:
    bool cancelled() const override { return ++asked > 20; }
    mutable int asked = 0;
  };
  SkeletonGraph sheet;
  constexpr int kSide = 20;
  for (int j = 0; j <= kSide; ++j)
  {
    for (int i = 0; i <= kSide; ++i)
    {
      sheet.points.emplace_back(i, j, 0.0);
      sheet.radii.push_back(0.4);
      if (i < kSide && j < kSide)
      {
        const int at = j * (kSide + 1) + i;
        sheet.triangles.push_back({ at, at + 1, at + kSide + 2 });
        sheet.triangles.push_back({ at, at + kSide + 2, at + kSide + 1 });
      }
    }
  }
  const NodePtr node = skeleton(sheet, BlendingKind::Neighbours);
  const Impatient progress;
  EXPECT_THROW(
    subdivisionSkeletonPreview(dynamic_cast<const SubdivisionSkeleton&>(*node), progress),
    Cancelled);
  EXPECT_LT(progress.asked, 30);
}

} // namespace
} // namespace hybridtree::test

// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendedField.h"
#include "core/base/Error.h"
#include "core/nodes/SubdivisionSkeleton.h"
#include "core/nodes/SubdivisionSkeletonMesh.h"

#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
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

// Two legs of so many elements each, side by side, joined by a bend.
SkeletonGraph legs(int parts, double gap)
{
  std::vector<Vec3> points;
  for (int k = 0; k <= parts; ++k)
  {
    points.emplace_back(3.0 * k / parts, 0, 0);
  }
  for (int k = 1; k < 4; ++k)
  {
    const double angle = 0.25 * 3.14159265358979 * k;
    points.emplace_back(3.0 + 0.5 * gap * std::sin(angle), 0.5 * gap * (1.0 - std::cos(angle)), 0);
  }
  for (int k = 0; k <= parts; ++k)
  {
    points.emplace_back(3.0 - 3.0 * k / parts, gap, 0);
  }
  return chain(points, 0.5);
}

// How far from the outer end of the axis the web between the legs ends: where the field falls below
// T on the way out, so far aside of the middle.
double webEnd(const Node& node, double gap, double aside)
{
  double end = 3.0 + 0.5 * gap;
  for (double x = 2.8; x > 0.0 && valueAt(node, Vec3(x, 0.5 * gap + aside, 0)) > kThreshold;
       x -= 0.002)
  {
    end = x;
  }
  return 3.0 + 0.5 * gap - end;
}

// No spur: in the middle the web ends where it does beside it. Nor does it matter where elements
// end.
TEST(BlendedField, WebsBetweenLimbsEndAlikeWithAnyElements)
{
  const double gap = 1.2;
  const double middle = webEnd(*skeleton(legs(1, gap), BlendingKind::Neighbours), gap, 0.0);
  EXPECT_GT(middle, 0.6);
  EXPECT_LT(middle, 1.6);
  for (const int parts : { 1, 2, 3, 5, 8, 12 })
  {
    const NodePtr node = skeleton(legs(parts, gap), BlendingKind::Neighbours);
    EXPECT_NEAR(webEnd(*node, gap, 0.0), middle, 0.1) << parts;
    EXPECT_NEAR(webEnd(*node, gap, 0.075), middle, 0.3) << parts;
  }
}

// Wherever both legs have a field: not more than the sum, and hardly less than the stronger leg.
TEST(BlendedField, LimbsThatPassKeepTheirOwnFields)
{
  for (const double gap : { 0.7, 1.0, 1.3 })
  {
    const SkeletonGraph graph = hairpin(gap, 0.5);
    const NodePtr both = skeleton(graph, BlendingKind::Neighbours);
    const NodePtr sum = skeleton(graph, BlendingKind::All);
    const NodePtr first =
      skeleton(chain({ graph.points.begin(), graph.points.begin() + 4 }, 0.5), BlendingKind::All);
    const NodePtr second =
      skeleton(chain({ graph.points.begin() + 4, graph.points.end() }, 0.5), BlendingKind::All);
    Random random(5);
    int smaller = 0;
    const PointList points =
      randomPoints(random, Box3(Vec3(-0.5, -1, -1), Vec3(10, gap + 1, 1)), 3000);
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const Vec3 p = points[k];
      const double value = valueAt(*both, p);
      ASSERT_LE(value, valueAt(*sum, p) + 1e-12);
      ASSERT_GE(value, 0.97 * std::max(valueAt(*first, p), valueAt(*second, p))) << p.transpose();
      smaller += value < valueAt(*sum, p) - 1e-3;
    }
    EXPECT_GT(smaller, 150);
  }
}

// Of a sheet nothing is lost, whether its triangles are wide or narrow beside R.
TEST(BlendedField, PlatesKeepTheSum)
{
  for (const double radius : { 0.15, 0.3, 0.5, 0.8, 1.2, 2.0 })
  {
    SkeletonGraph plate;
    constexpr int kSide = 5;
    for (int j = 0; j <= kSide; ++j)
    {
      for (int i = 0; i <= kSide; ++i)
      {
        plate.points.emplace_back(i + 0.5 * j, 0.87 * j, 0.0);
        plate.radii.push_back(radius);
        if (i < kSide && j < kSide)
        {
          const int at = j * (kSide + 1) + i;
          plate.triangles.push_back({ at, at + 1, at + kSide + 1 });
          plate.triangles.push_back({ at + 1, at + kSide + 2, at + kSide + 1 });
        }
      }
    }
    for (const int level : { 0, 1 })
    {
      EXPECT_LT(largestDifference(plate, BlendingKind::Neighbours, level), 1e-11)
        << radius << " " << level;
    }
    // Squares with diagonals are more narrow.
    for (Vec3& point : plate.points)
    {
      point.x() -= point.y() * 0.5 / 0.87;
    }
    EXPECT_LT(largestDifference(plate, BlendingKind::Neighbours), 1e-11) << radius;
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

// Before memory ends, and before any is kept.
TEST(BlendedField, TooManyDistancesAreRefused)
{
  const auto sheet = [](int side)
  {
    GroupedElements elements;
    for (int j = 0; j <= side; ++j)
    {
      for (int i = 0; i <= side; ++i)
      {
        elements.points.emplace_back(i, j, 0.0);
        elements.reaches.push_back(12.0);
        if (i < side && j < side)
        {
          const int at = j * (side + 1) + i;
          for (const std::array<int, 3>& corners :
            { std::array<int, 3>{ at, at + 1, at + side + 2 },
              { at, at + side + 2, at + side + 1 } })
          {
            const auto group = static_cast<std::int32_t>(elements.groups.size());
            elements.triangles.push_back({ corners, { 12.0, 12.0, 12.0 }, group });
            elements.groups.push_back(corners);
          }
        }
      }
    }
    return elements;
  };
  const BlendingControl control{ BlendingKind::Neighbours };
  EXPECT_NO_THROW(BlendedField({}, control, sheet(20)));
  EXPECT_THROW(BlendedField({}, control, sheet(130)), TooLarge);
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

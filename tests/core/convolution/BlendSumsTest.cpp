// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendedField.h"
#include "core/convolution/PieceCutter.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <ostream>
#include <vector>

// The pruned sums beside their definitions (LimbMeans.h, PaperSums.h).
namespace hybridtree::test
{
namespace
{

// One group each.
void add(GroupedElements& elements, std::int32_t a, std::int32_t b)
{
  const auto reach = [&](std::int32_t k) { return elements.reaches[static_cast<std::size_t>(k)]; };
  elements.segments.push_back(
    { { a, b }, { reach(a), reach(b) }, static_cast<std::int32_t>(elements.groups.size()) });
  elements.groups.push_back({ a, b, -1 });
}

void add(GroupedElements& elements, std::int32_t a, std::int32_t b, std::int32_t c)
{
  const auto reach = [&](std::int32_t k) { return elements.reaches[static_cast<std::size_t>(k)]; };
  elements.triangles.push_back({ { a, b, c }, { reach(a), reach(b), reach(c) },
    static_cast<std::int32_t>(elements.groups.size()) });
  elements.groups.push_back({ a, b, c });
}

// Limbs of random steps from a triangle's corners, through each other.
GroupedElements tangle(Random& random, int limb)
{
  GroupedElements elements;
  const auto point = [&](const Vec3& p)
  {
    elements.points.push_back(p);
    elements.reaches.push_back(random.uniform(0.8, 1.3));
    return static_cast<std::int32_t>(elements.points.size() - 1);
  };
  const std::int32_t a = point(Vec3(0, 0, 0));
  const std::int32_t b = point(Vec3(1, 0, 0));
  const std::int32_t c = point(Vec3(0.3, 0.9, 0));
  add(elements, a, b, c);
  for (std::int32_t at : { a, b, c })
  {
    for (int k = 0; k < limb; ++k)
    {
      const Vec3 step(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
      const std::int32_t next = point(elements.points[static_cast<std::size_t>(at)] + step);
      add(elements, at, next);
      at = next;
    }
  }
  return elements;
}

// Where most of the field is, of whichever kernel.
Box3 around(const GroupedElements& elements)
{
  Box3 box;
  for (const Vec3& p : elements.points)
  {
    box.extend(p);
  }
  return Box3(Vec3(box.min() - Vec3::Ones()), Vec3(box.max() + Vec3::Ones()));
}

double valueOf(const SegmentElement& element, const ConvolutionKernel& kernel, const Vec3& p)
{
  const SegmentElement* pointer = &element;
  double value = 0.0;
  convolutionKernels(kernel.kind)
    .addSegments({ &pointer, 1 }, kernel, { &p.x(), &p.y(), &p.z(), 1 }, &value);
  return value;
}

double valueOf(const TriangleElement& element, const ConvolutionKernel& kernel, const Vec3& p)
{
  const TriangleElement* pointer = &element;
  double value = 0.0;
  convolutionKernels(kernel.kind)
    .addTriangles({ &pointer, 1 }, kernel, { &p.x(), &p.y(), &p.z(), 1 }, &value);
  return value;
}

// S at one point, from all pieces and all distances between them.
class Definition
{
public:
  Definition(const GroupedElements& elements, const BlendingControl& control,
    const ConvolutionKernel& kernel)
    : share_(control)
    , sight_(BlendingControl{ BlendingKind::Neighbours, 1.0 })
    , kernel_(kernel)
    , pieces_(cutIntoPieces(elements))
    , distances_(pieces_.places.size(), std::vector<double>(pieces_.places.size()))
  {
    const PieceGraph graph(pieces_.places, pieces_.contacts, pieces_.sides, elements.points);
    PieceGraph::Search search(graph);
    for (std::uint32_t c = 0; c < graph.size(); ++c)
    {
      search.run(c, 10.0);
      for (std::uint32_t e = 0; e < graph.size(); ++e)
      {
        distances_[c][e] = search.distance(e);
      }
    }
  }

  double operator()(const Vec3& p) const
  {
    const std::vector<double> fields = this->fieldsAt(p);
    double sum = 0.0;
    double weights = 0.0;
    for (std::size_t c = 0; c < fields.size(); ++c)
    {
      double blended = 0.0;
      double seen = 0.0;
      for (std::size_t e = 0; e < fields.size(); ++e)
      {
        blended += share_(distances_[c][e]) * fields[e];
        seen += sight_(distances_[c][e]) * fields[e];
      }
      const double weight = fields[c] * std::pow(seen, 20);
      weights += weight;
      sum += weight * blended;
    }
    const double mean = weights > 0.0 ? sum / weights : 0.0;
    return kernel_.kind == KernelKind::Cauchy ? faded(mean) : mean;
  }

private:
  std::vector<double> fieldsAt(const Vec3& p) const
  {
    std::vector<double> fields(pieces_.places.size(), 0.0);
    const auto add = [&](const auto& elements, const std::vector<std::uint32_t>& of)
    {
      for (std::size_t k = 0; k < elements.size(); ++k)
      {
        fields[of[k]] += valueOf(elements[k], kernel_, p);
      }
    };
    add(pieces_.segments, pieces_.segmentPieces);
    add(pieces_.triangles, pieces_.trianglePieces);
    return fields;
  }

  BlendShare share_;
  BlendShare sight_;
  ConvolutionKernel kernel_;
  CutPieces pieces_;
  std::vector<std::vector<double>> distances_;
};

// The same for [SUB]'s own, of elements that are a group each. Segments come behind the triangle.
class PaperDefinition
{
public:
  PaperDefinition(const GroupedElements& elements, const ConvolutionKernel& kernel)
    : elements_(elements), kernel_(kernel)
  {
  }

  double operator()(const Vec3& p) const
  {
    double best = 0.0;
    for (std::size_t i = 0; i < elements_.groups.size(); ++i)
    {
      best = std::max(best, this->sum(i, p, true));
    }
    return this->end(best);
  }

  /// Of one group by itself.
  double own(std::size_t i, const Vec3& p) const { return this->end(this->sum(i, p, false)); }

private:
  static constexpr double kUnattached = -1000.0;

  double end(double sum) const { return kernel_.kind == KernelKind::Cauchy ? faded(sum) : sum; }

  double sum(std::size_t i, const Vec3& p, bool isCut) const
  {
    const BlendShare share(BlendingControl{ BlendingKind::Paper });
    const double own = this->field(i, p);
    double total = own;
    for (std::size_t j = 0; j < elements_.groups.size(); ++j)
    {
      const double far = j == i ? kUnattached : this->parameter(i, j, p);
      if (far != kUnattached)
      {
        const double other = this->field(j, p);
        total += share(far) * (isCut ? std::min(own, other) : other);
      }
    }
    return total;
  }

  double field(std::size_t group, const Vec3& p) const
  {
    const auto at = [&](std::int32_t k) { return elements_.points[static_cast<std::size_t>(k)]; };
    for (const GroupedElement<2>& s : elements_.segments)
    {
      if (static_cast<std::size_t>(s.group) == group)
      {
        return valueOf(
          makeSegmentElement(at(s.corners[0]), at(s.corners[1]), s.reaches[0], s.reaches[1]),
          kernel_, p);
      }
    }
    for (const GroupedElement<3>& t : elements_.triangles)
    {
      if (static_cast<std::size_t>(t.group) == group)
      {
        return valueOf(
          makeTriangleElement({ at(t.corners[0]), at(t.corners[1]), at(t.corners[2]) }, t.reaches),
          kernel_, p);
      }
    }
    return 0.0;
  }

  // u on i, from where j is attached: by heights, 0 at the corner or edge.
  double parameter(std::size_t i, std::size_t j, const Vec3& p) const
  {
    const auto at = [&](std::int32_t k) { return elements_.points[static_cast<std::size_t>(k)]; };
    std::vector<Vec3> shared;
    std::vector<Vec3> others;
    for (const std::int32_t corner : elements_.groups[i])
    {
      const auto& of = elements_.groups[j];
      if (corner >= 0)
      {
        (std::find(of.begin(), of.end(), corner) != of.end() ? shared : others)
          .push_back(at(corner));
      }
    }
    if (shared.empty())
    {
      return kUnattached;
    }
    if (others.size() + shared.size() == 2)
    {
      const Vec3 way = others[0] - shared[0];
      return (p - shared[0]).dot(way) / way.squaredNorm();
    }
    // In the triangle's plane, across the edge on the side of which u does not change.
    const std::vector<Vec3>& edge = shared.size() == 2 ? shared : others;
    const Vec3& tip = shared.size() == 2 ? others[0] : shared[0];
    const Vec3 along = (edge[1] - edge[0]).normalized();
    const Vec3 across = tip - edge[0] - (tip - edge[0]).dot(along) * along;
    const double height = (p - edge[0]).dot(across) / across.squaredNorm();
    return shared.size() == 2 ? height : 1.0 - height;
  }

  const GroupedElements& elements_;
  ConvolutionKernel kernel_;
};

std::function<double(const Vec3&)> definition(
  const GroupedElements& elements, const BlendingControl& control, const ConvolutionKernel& kernel)
{
  if (control.kind == BlendingKind::Paper)
  {
    return PaperDefinition(elements, kernel);
  }
  return Definition(elements, control, kernel);
}

struct Case
{
  BlendingControl control;
  ConvolutionKernel kernel;
};

void PrintTo(const Case& of, std::ostream* out)
{
  *out << (of.control.kind == BlendingKind::Paper ? "paper" : "neighbours") << " within "
       << of.control.distance
       << (of.kernel.kind == KernelKind::Cauchy ? ", Cauchy kernel" : ", compact kernel");
}

class BlendSumsCases : public testing::TestWithParam<Case>
{
};

// The field at points, with the elements of a selection or, for null, with all.
std::vector<double> valuesAt(
  const BlendedField& field, const BlendSelection* selection, PointBatch points)
{
  std::vector<double> value(points.size, 0.0);
  field.addField(selection, points, value.data());
  return value;
}

double valueAt(const BlendedField& field, const Vec3& p)
{
  return valuesAt(field, nullptr, { &p.x(), &p.y(), &p.z(), 1 }).front();
}

TEST_P(BlendSumsCases, AreThoseOfTheDefinition)
{
  const auto& [control, kernel] = GetParam();
  Random random(11);
  int controlled = 0;
  for (const int limb : { 1, 3, 6 })
  {
    const GroupedElements elements = tangle(random, limb);
    const auto expectedAt = definition(elements, control, kernel);
    const BlendedField field(kernel, control, elements);
    const PointList points = randomPoints(random, around(elements), 500);
    const std::vector<double> scattered = valuesAt(field, nullptr, points);
    BlendSelection selection;
    field.select(field.influenceBounds(), selection);
    const std::vector<double> together = valuesAt(field, &selection, points);
    std::vector<double> sum(points.size(), 0.0);
    field.sum().addField(selection.all, points, sum.data());
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const double expected = expectedAt(points.batch()[k]);
      ASSERT_NEAR(scattered[k], expected, 1e-12);
      ASSERT_NEAR(together[k], expected, 1e-12);
      controlled += expected < sum[k] - 1e-6;
    }
  }
  EXPECT_GT(controlled, 30);
}

TEST_P(BlendSumsCases, GradientsAreThoseOfTheField)
{
  const auto& [control, kernel] = GetParam();
  Random random(12);
  const GroupedElements elements = tangle(random, 4);
  const BlendedField field(kernel, control, elements);
  const PointList points = randomPoints(random, around(elements), 400);
  std::vector<double> value(points.size(), 0.0);
  VectorList gradient(points.size());
  field.addFieldAndGradient(nullptr, points, value.data(), gradient);
  int steep = 0;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    ASSERT_NEAR(value[k], valueAt(field, points[k]), 1e-12);
    constexpr double kStep = 1e-6;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vec3 step = kStep * Vec3::Unit(axis);
      const double slope =
        (valueAt(field, points[k] + step) - valueAt(field, points[k] - step)) / (2.0 * kStep);
      ASSERT_NEAR(gradient.batch()[k][axis], slope, 1e-4) << points[k].transpose();
      steep += std::abs(slope) > 0.01;
    }
  }
  EXPECT_GT(steep, 50);
}

TEST_P(BlendSumsCases, RangesHoldTheField)
{
  const auto& [control, kernel] = GetParam();
  Random random(13);
  const GroupedElements elements = tangle(random, 4);
  const BlendedField field(kernel, control, elements);
  const PointList centers = randomPoints(random, around(elements), 60);
  for (std::size_t k = 0; k < centers.size(); ++k)
  {
    const Vec3 half = random.uniform(0.005, 0.3) * Vec3::Ones();
    const Box3 box(Vec3(centers[k] - half), Vec3(centers[k] + half));
    BlendSelection selection;
    field.select(box, selection);
    const Interval range = field.range(selection, box);
    const std::vector<double> value = valuesAt(field, &selection, randomPoints(random, box, 50));
    EXPECT_LE(range.min, *std::min_element(value.begin(), value.end()));
    EXPECT_GE(range.max, *std::max_element(value.begin(), value.end()));
  }
}

constexpr ConvolutionKernel kQuadratic;
constexpr ConvolutionKernel kCubic{ KernelKind::Compact, 3, 1.7 };
constexpr ConvolutionKernel kCauchy{ KernelKind::Cauchy, 2, 2.0 };

// [SUB]'s setting: which element a point belongs to is known.
TEST(PaperSums, OfOneElementAreThoseOfItsNeighboursAlone)
{
  Random random(14);
  for (const ConvolutionKernel& kernel : { kQuadratic, kCubic, kCauchy })
  {
    const GroupedElements elements = tangle(random, 3);
    const BlendedField field(kernel, { BlendingKind::Paper }, elements);
    const PaperDefinition expected(elements, kernel);
    const PointList points = randomPoints(random, around(elements), 100);
    std::vector<double> value(points.size());
    std::vector<double> alone(points.size());
    VectorList gradient(points.size());
    for (std::size_t group = 0; group < elements.groups.size(); ++group)
    {
      const auto number = static_cast<std::int32_t>(group);
      const VectorBatch slopes = gradient;
      field.ownSum(number, points, value.data(), &slopes);
      field.ownSum(number, points, alone.data(), nullptr);
      for (std::size_t k = 0; k < points.size(); ++k)
      {
        ASSERT_NEAR(value[k], expected.own(group, points[k]), 1e-12);
        ASSERT_NEAR(alone[k], value[k], 1e-14);
        constexpr double kStep = 1e-6;
        for (int axis = 0; axis < 3; ++axis)
        {
          const Vec3 step = kStep * Vec3::Unit(axis);
          const double slope =
            expected.own(group, points[k] + step) - expected.own(group, points[k] - step);
          ASSERT_NEAR(slopes[k][axis], slope / (2.0 * kStep), 1e-4);
        }
      }
    }
  }
}

// But for rounding, also where many groups reach a batch.
TEST(BlendSums, DoNotDependOnWhichPointsAreAskedForTogether)
{
  Random random(16);
  GroupedElements elements = tangle(random, 60);
  for (Vec3& point : elements.points)
  {
    point *= 0.3;
  }
  for (const ConvolutionKernel& kernel : { kQuadratic, kCauchy })
  {
    const BlendedField field(kernel, { BlendingKind::Neighbours, 0.7 }, elements);
    const BlendedField all(kernel, { BlendingKind::All }, elements);
    const PointList points = randomPoints(random, around(elements), 120);
    BlendSelection selection;
    field.select(around(elements), selection);
    std::vector<double> value(points.size(), 0.0);
    VectorList gradient(points.size());
    const VectorBatch slopes = gradient;
    field.addFieldAndGradient(&selection, points.batch(), value.data(), slopes);
    int smaller = 0;
    for (std::size_t k = 0; k < points.size(); ++k)
    {
      const Vec3& p = points[k];
      double alone = 0.0;
      Vec3 slope = Vec3::Zero();
      field.addFieldAndGradient(
        nullptr, { &p.x(), &p.y(), &p.z(), 1 }, &alone, { &slope.x(), &slope.y(), &slope.z() });
      ASSERT_NEAR(value[k], alone, 1e-12 * (1.0 + alone));
      ASSERT_LT((slopes[k] - slope).norm(), 1e-9 * (1.0 + slope.norm()));
      double sum = 0.0;
      all.addField(nullptr, { &p.x(), &p.y(), &p.z(), 1 }, &sum);
      smaller += alone < 0.99 * sum;
    }
    EXPECT_GT(smaller, 20);
  }
}

INSTANTIATE_TEST_SUITE_P(Controls, BlendSumsCases,
  testing::Values(Case{ { BlendingKind::Neighbours, 0.5 }, kQuadratic },
    Case{ { BlendingKind::Neighbours, 1.0 }, kCubic },
    Case{ { BlendingKind::Neighbours, 2.25 }, kQuadratic },
    Case{ { BlendingKind::Paper }, kQuadratic }, Case{ { BlendingKind::Neighbours, 0.7 }, kCauchy },
    Case{ { BlendingKind::Paper }, kCauchy }));

} // namespace
} // namespace hybridtree::test

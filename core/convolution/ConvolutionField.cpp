// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/ConvolutionField.h"

#include "core/convolution/ElementBounds.h"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace hybridtree
{
namespace
{

// Points of a whole query that are handled together: few enough to be near each other.
constexpr std::size_t kPart = 64;

template <class Element>
ElementTree treeOf(const std::vector<Element>& elements)
{
  std::vector<Box3> boxes;
  boxes.reserve(elements.size());
  for (const Element& element : elements)
  {
    const Vec3 reach = Vec3::Constant(largestReach(element));
    const Box3 box = boundsOf(element);
    boxes.emplace_back(Vec3(box.min() - reach), Vec3(box.max() + reach));
  }
  return ElementTree(boxes);
}

template <class Element>
std::vector<Element> inOrder(const std::vector<Element>& elements, const ElementTree& tree)
{
  std::vector<Element> ordered;
  ordered.reserve(elements.size());
  for (const std::uint32_t index : tree.order())
  {
    ordered.push_back(elements[index]);
  }
  return ordered;
}

// Around the box.
struct Ball
{
  Vec3 center;
  double radius;

  explicit Ball(const Box3& box) : center(box.center()), radius(0.5 * box.diagonal().norm()) {}

  template <class Element>
  bool isReachedBy(const Element& element) const
  {
    return distanceTo(element, center) < largestReach(element) + radius;
  }
};

Box3 boundsOf(PointBatch points)
{
  Box3 box;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    box.extend(points[k]);
  }
  return box;
}

} // namespace

ConvolutionField::ConvolutionField(const ConvolutionKernel& kernel,
  const std::vector<SegmentElement>& segments, const std::vector<TriangleElement>& triangles)
  : kernel_(kernel), segmentTree_(treeOf(segments)), triangleTree_(treeOf(triangles))
{
  segments_ = inOrder(segments, segmentTree_);
  triangles_ = inOrder(triangles, triangleTree_);
}

Box3 ConvolutionField::influenceBounds() const
{
  return segmentTree_.bounds().merged(triangleTree_.bounds());
}

void ConvolutionField::select(const Box3& box, ElementSelection& selection) const
{
  selection.segments.clear();
  selection.triangles.clear();
  if (box.isEmpty())
  {
    return;
  }
  const Ball ball(box);
  segmentTree_.visit(box,
    [&](std::uint32_t place)
    {
      if (ball.isReachedBy(segments_[place]))
      {
        selection.segments.push_back(&segments_[place]);
      }
    });
  triangleTree_.visit(box,
    [&](std::uint32_t place)
    {
      if (ball.isReachedBy(triangles_[place]))
      {
        selection.triangles.push_back(&triangles_[place]);
      }
    });
}

void ConvolutionField::select(
  const Box3& box, const ElementSelection& from, ElementSelection& selection) const
{
  const Ball ball(box);
  const auto reached = [&](const auto* element) { return ball.isReachedBy(*element); };
  selection.segments.clear();
  selection.triangles.clear();
  std::copy_if(
    from.segments.begin(), from.segments.end(), std::back_inserter(selection.segments), reached);
  std::copy_if(
    from.triangles.begin(), from.triangles.end(), std::back_inserter(selection.triangles), reached);
}

std::size_t ConvolutionField::index(const SegmentElement* segment) const
{
  return segmentTree_.order()[static_cast<std::size_t>(segment - segments_.data())];
}

std::size_t ConvolutionField::index(const TriangleElement* triangle) const
{
  return triangleTree_.order()[static_cast<std::size_t>(triangle - triangles_.data())];
}

template <typename Body>
void ConvolutionField::forParts(PointBatch points, Body&& body) const
{
  static thread_local ElementSelection selection; // no allocation once warm
  for (std::size_t begin = 0; begin < points.size; begin += kPart)
  {
    const PointBatch part = points.slice(begin, std::min(kPart, points.size - begin));
    this->select(boundsOf(part), selection);
    body(selection, part, begin);
  }
}

void ConvolutionField::addField(
  const ElementSelection* selection, PointBatch points, double* sum) const
{
  if (selection)
  {
    const ConvolutionKernels& kernels = convolutionKernels(kernel_.kind);
    kernels.addSegments(selection->segmentSpan(), kernel_, points, sum);
    kernels.addTriangles(selection->triangleSpan(), kernel_, points, sum);
    return;
  }
  this->forParts(points,
    [&](const ElementSelection& reaching, PointBatch part, std::size_t begin)
    { this->addField(&reaching, part, sum + begin); });
}

void ConvolutionField::addFieldAndGradient(
  const ElementSelection* selection, PointBatch points, double* sum, VectorBatch gradientSum) const
{
  if (selection)
  {
    const ConvolutionKernels& kernels = convolutionKernels(kernel_.kind);
    kernels.addSegmentsWithGradient(selection->segmentSpan(), kernel_, points, sum, gradientSum);
    kernels.addTrianglesWithGradient(selection->triangleSpan(), kernel_, points, sum, gradientSum);
    return;
  }
  this->forParts(points,
    [&](const ElementSelection& reaching, PointBatch part, std::size_t begin)
    { this->addFieldAndGradient(&reaching, part, sum + begin, gradientSum.slice(begin)); });
}

Interval ConvolutionField::range(const ElementSelection& selection, const Box3& box) const
{
  const Ball ball(box);
  FieldBounds bounds;
  const auto add = [&](const auto* element)
  {
    addBounds(
      *element, kernel_, std::max(0.0, distanceTo(*element, ball.center) - ball.radius), bounds);
  };
  std::for_each(selection.segments.begin(), selection.segments.end(), add);
  std::for_each(selection.triangles.begin(), selection.triangles.end(), add);
  if (bounds.value == 0.0)
  {
    return {};
  }
  double center = 0.0;
  Vec3 slope = Vec3::Zero();
  const Vec3& p = ball.center;
  this->addFieldAndGradient(
    &selection, { &p.x(), &p.y(), &p.z(), 1 }, &center, { &slope.x(), &slope.y(), &slope.z() });
  const double linear = 0.5 * slope.cwiseAbs().dot(box.sizes());
  const double most = std::min(
    bounds.slope * ball.radius, linear + 0.5 * bounds.curvature * ball.radius * ball.radius);
  const double rounding = 1e-13 * (1.0 + bounds.value);
  return { std::max(0.0, center - most - rounding),
    std::min(bounds.value, center + most) + rounding };
}

} // namespace hybridtree

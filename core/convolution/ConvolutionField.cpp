// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/ConvolutionField.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

template <class Element>
ElementTree treeOf(const std::vector<Element>& elements, double fadingDistance)
{
  std::vector<Box3> boxes;
  boxes.reserve(elements.size());
  for (const Element& element : elements)
  {
    const Vec3 reach =
      Vec3::Constant(fadingDistance > 0.0 ? fadingDistance : largestReach(element));
    const Box3 box = boundsOf(element);
    boxes.emplace_back(Vec3(box.min() - reach), Vec3(box.max() + reach));
  }
  return ElementTree(boxes);
}

/// Puts elements in the order in which they were given: sums do not change, not even by rounding,
/// with what lies elsewhere in the tree.
template <class Element>
void putInOrder(const std::vector<Element>& all, std::vector<const Element*>& selected)
{
  constexpr std::size_t kBits = 64;
  const std::size_t words = all.size() / kBits + 1;
  if (words > 4 * selected.size())
  {
    std::sort(selected.begin(), selected.end());
    return;
  }
  static thread_local std::vector<std::uint64_t> isSelected; // no allocation once warm
  isSelected.assign(words, 0);
  for (const Element* element : selected)
  {
    const auto index = static_cast<std::size_t>(element - all.data());
    isSelected[index / kBits] |= std::uint64_t(1) << index % kBits;
  }
  std::size_t count = 0;
  for (std::size_t w = 0; w < words; ++w)
  {
    std::uint64_t word = isSelected[w];
    for (std::size_t k = kBits * w; word != 0; ++k, word >>= 1)
    {
      if (word & 1)
      {
        selected[count++] = &all[k];
      }
    }
  }
}

template <class Element>
void selectAll(const std::vector<Element>& elements, std::vector<const Element*>& selected)
{
  for (const Element& element : elements)
  {
    selected.push_back(&element);
  }
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

} // namespace

ConvolutionField::ConvolutionField(const ConvolutionKernel& kernel,
  const std::vector<SegmentElement>& segments, const std::vector<TriangleElement>& triangles)
  : kernel_(kernel)
  , fadingDistance_(
      kernel.kind == KernelKind::Cauchy ? this->fadingDistance(segments, triangles) : 0.0)
  , segments_(segments)
  , triangles_(triangles)
  , segmentTree_(treeOf(segments, fadingDistance_))
  , triangleTree_(treeOf(triangles, fadingDistance_))
{
}

double ConvolutionField::fadingDistance(
  const std::vector<SegmentElement>& segments, const std::vector<TriangleElement>& triangles) const
{
  const auto mostAt = [&](double distance)
  {
    FieldBounds bounds;
    for (const SegmentElement& segment : segments)
    {
      hybridtree::addBounds(segment, kernel_, distance, bounds);
    }
    for (const TriangleElement& triangle : triangles)
    {
      hybridtree::addBounds(triangle, kernel_, distance, bounds);
    }
    return bounds.value;
  };
  double distance = 0.0;
  for (const SegmentElement& segment : segments)
  {
    distance = std::max(distance, largestReach(segment));
  }
  for (const TriangleElement& triangle : triangles)
  {
    distance = std::max(distance, largestReach(triangle));
  }
  while (mostAt(distance) > kFadeEnd)
  {
    distance *= 1.1;
  }
  return distance;
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
  if (fadingDistance_ > 0.0)
  {
    if (box.intersects(this->influenceBounds()))
    {
      selectAll(segments_, selection.segments);
      selectAll(triangles_, selection.triangles);
    }
    return;
  }
  const Ball ball(box);
  segmentTree_.visit(box,
    [&](std::uint32_t index)
    {
      if (ball.isReachedBy(segments_[index]))
      {
        selection.segments.push_back(&segments_[index]);
      }
    });
  triangleTree_.visit(box,
    [&](std::uint32_t index)
    {
      if (ball.isReachedBy(triangles_[index]))
      {
        selection.triangles.push_back(&triangles_[index]);
      }
    });
  putInOrder(segments_, selection.segments);
  putInOrder(triangles_, selection.triangles);
}

std::size_t ConvolutionField::index(const SegmentElement* segment) const
{
  return static_cast<std::size_t>(segment - segments_.data());
}

std::size_t ConvolutionField::index(const TriangleElement* triangle) const
{
  return static_cast<std::size_t>(triangle - triangles_.data());
}

void ConvolutionField::addField(const ElementSpans& elements, PointBatch points, double* sum) const
{
  const ConvolutionKernels& kernels = convolutionKernels(kernel_.kind);
  if (elements.segments.count > 0)
  {
    kernels.addSegments(elements.segments, kernel_, points, sum);
  }
  if (elements.triangles.count > 0)
  {
    kernels.addTriangles(elements.triangles, kernel_, points, sum);
  }
}

void ConvolutionField::addFieldAndGradient(
  const ElementSpans& elements, PointBatch points, double* sum, VectorBatch gradientSum) const
{
  const ConvolutionKernels& kernels = convolutionKernels(kernel_.kind);
  if (elements.segments.count > 0)
  {
    kernels.addSegmentsWithGradient(elements.segments, kernel_, points, sum, gradientSum);
  }
  if (elements.triangles.count > 0)
  {
    kernels.addTrianglesWithGradient(elements.triangles, kernel_, points, sum, gradientSum);
  }
}

void ConvolutionField::addBounds(
  const ElementSpans& elements, const Box3& box, FieldBounds& bounds) const
{
  const Ball ball(box);
  const auto add = [&](const auto* element)
  {
    hybridtree::addBounds(
      *element, kernel_, std::max(0.0, distanceTo(*element, ball.center) - ball.radius), bounds);
  };
  std::for_each_n(elements.segments.elements, elements.segments.count, add);
  std::for_each_n(elements.triangles.elements, elements.triangles.count, add);
}

Interval ConvolutionField::range(const ElementSpans& elements, const Box3& box) const
{
  FieldBounds bounds;
  this->addBounds(elements, box, bounds);
  if (bounds.value == 0.0)
  {
    return {};
  }
  double center = 0.0;
  Vec3 slope = Vec3::Zero();
  const Vec3 p = box.center();
  this->addFieldAndGradient(
    elements, { &p.x(), &p.y(), &p.z(), 1 }, &center, { &slope.x(), &slope.y(), &slope.z() });
  const double radius = 0.5 * box.diagonal().norm();
  const double linear = 0.5 * slope.cwiseAbs().dot(box.sizes());
  const double most =
    std::min(bounds.slope * radius, linear + 0.5 * bounds.curvature * radius * radius);
  const double rounding = 1e-13 * (1.0 + bounds.value);
  return { std::max(0.0, center - most - rounding),
    std::min(bounds.value, center + most) + rounding };
}

} // namespace hybridtree

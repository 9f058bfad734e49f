// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendedField.h"

#include "core/base/Scratch.h"
#include "core/convolution/BlendSelector.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

namespace hybridtree
{
namespace
{

// Points of a whole query that are handled together.
constexpr std::size_t kPart = 64;
constexpr std::size_t kFewPoints = 4;

std::vector<SegmentElement> segmentsOf(const GroupedElements& elements)
{
  std::vector<SegmentElement> segments;
  segments.reserve(elements.segments.size());
  for (const GroupedElement<2>& segment : elements.segments)
  {
    segments.push_back(
      makeSegmentElement(elements.points[static_cast<std::size_t>(segment.corners[0])],
        elements.points[static_cast<std::size_t>(segment.corners[1])], segment.reaches[0],
        segment.reaches[1]));
  }
  return segments;
}

std::vector<TriangleElement> trianglesOf(const GroupedElements& elements)
{
  std::vector<TriangleElement> triangles;
  triangles.reserve(elements.triangles.size());
  for (const GroupedElement<3>& triangle : elements.triangles)
  {
    triangles.push_back(
      makeTriangleElement({ elements.points[static_cast<std::size_t>(triangle.corners[0])],
                            elements.points[static_cast<std::size_t>(triangle.corners[1])],
                            elements.points[static_cast<std::size_t>(triangle.corners[2])] },
        triangle.reaches));
  }
  return triangles;
}

template <std::size_t N>
std::vector<std::int32_t> groupsOf(const std::vector<GroupedElement<N>>& elements)
{
  std::vector<std::int32_t> groups;
  groups.reserve(elements.size());
  for (const GroupedElement<N>& element : elements)
  {
    groups.push_back(element.group);
  }
  return groups;
}

void clear(std::size_t count, double* value, VectorBatch gradient)
{
  for (double* array : { value, gradient.x, gradient.y, gradient.z })
  {
    std::fill_n(array, count, 0.0);
  }
}

// A value and its gradient at each point of a part, in scratch memory, 0 at first.
class Samples
{
public:
  explicit Samples(std::size_t size) : value_(size), gradient_(size)
  {
    clear(size, value_.data(), gradient_.batch());
  }
  double* value() { return value_.data(); }
  double value(std::size_t k) { return value_[k]; }
  VectorBatch gradient() { return gradient_.batch(); }
  Vec3 gradient(std::size_t k) { return gradient_.batch()[k]; }

private:
  ScratchArray value_;
  ScratchVectors gradient_;
};

} // namespace

BlendedField::BlendedField(
  const ConvolutionKernel& kernel, const BlendingControl& control, const GroupedElements& elements)
  : control_(control)
  , share_(control)
  , whole_(kernel, segmentsOf(elements), trianglesOf(elements))
  , partSize_(std::accumulate(elements.reaches.begin(), elements.reaches.end(), 0.0) /
      static_cast<double>(std::max<std::size_t>(1, elements.reaches.size())))
  , segmentGroups_(groupsOf(elements.segments))
  , triangleGroups_(groupsOf(elements.triangles))
{
  if (control.kind != BlendingKind::All)
  {
    places_ = makeBlendPieces(elements, control);
    pieces_ = std::make_unique<const ConvolutionField>(kernel, places_.segments, places_.triangles);
    places_.segments = {};
    places_.triangles = {};
  }
}

void BlendedField::select(const Box3& box, BlendSelection& selection) const
{
  whole_.select(box, selection.all);
  selection.clusters.clear();
  if (pieces_ && !selection.empty())
  {
    selection.clusters = blendClusters(
      { control_, whole_, segmentGroups_, triangleGroups_, *pieces_, places_ }, selection.all, box);
  }
}

// The sums over the pieces of a cluster at a part of the points: of their fields, and of these
// times the distances from the groups of its terms; all with gradients or without. Each piece is
// integrated once.
class BlendedField::PlaceSums
{
public:
  PlaceSums(const BlendedField& field, const BlendSelection::Cluster& cluster, PointBatch points,
    bool withGradient)
    : kernel_(field.kernel())
    , kernels_(convolutionKernels(kernel_.kind))
    , points_(points)
    , withGradient_(withGradient)
    , rows_(withGradient ? 4 : 1)
    , row_(points.size * rows_)
    , sums_(points.size * rows_ * (cluster.terms.size() + 1))
  {
    std::fill_n(sums_.data(), sums_.size(), 0.0);
    std::size_t piece = 0;
    for (const SegmentElement* segment : cluster.pieces.segments)
    {
      this->integrate(segment, kernels_.addSegments, kernels_.addSegmentsWithGradient);
      this->addRow(cluster, piece++);
    }
    for (const TriangleElement* triangle : cluster.pieces.triangles)
    {
      this->integrate(triangle, kernels_.addTriangles, kernels_.addTrianglesWithGradient);
      this->addRow(cluster, piece++);
    }
  }

  ///@{
  /// Sum 0 is that of the fields, sum 1 + t that of term t.
  double value(std::size_t sum, std::size_t k) const { return this->at(sum, 0)[k]; }
  Vec3 gradient(std::size_t sum, std::size_t k) const
  {
    return { this->at(sum, 1)[k], this->at(sum, 2)[k], this->at(sum, 3)[k] };
  }
  ///@}

private:
  const double* at(std::size_t sum, std::size_t row) const
  {
    return sums_.data() + points_.size * (rows_ * sum + row);
  }

  template <class Element, class Add, class AddWithGradient>
  void integrate(const Element* element, Add add, AddWithGradient addWithGradient)
  {
    double* row = row_.data();
    const std::size_t size = points_.size;
    std::fill_n(row, size * rows_, 0.0);
    if (withGradient_)
    {
      addWithGradient(
        { &element, 1 }, kernel_, points_, row, { row + size, row + 2 * size, row + 3 * size });
    }
    else
    {
      add({ &element, 1 }, kernel_, points_, row);
    }
  }

  void addRow(const BlendSelection::Cluster& cluster, std::size_t piece)
  {
    const std::size_t count = points_.size * rows_;
    for (std::size_t sum = 0; sum <= cluster.terms.size(); ++sum)
    {
      const double weight = sum == 0 ? 1.0 : cluster.terms[sum - 1].distances[piece];
      double* to = sums_.data() + count * sum;
      for (std::size_t k = 0; k < count; ++k)
      {
        to[k] += weight * row_[k];
      }
    }
  }

  const ConvolutionKernel& kernel_;
  const ConvolutionKernels& kernels_;
  PointBatch points_;
  bool withGradient_;
  std::size_t rows_;
  ScratchArray row_;
  ScratchArray sums_;
};

void BlendedField::clusterField(
  const BlendSelection::Cluster& cluster, PointBatch points, double* value) const
{
  std::fill_n(value, points.size, 0.0);
  whole_.addField(cluster.plain, points, value);
  for (std::size_t begin = 0; begin < points.size && !cluster.terms.empty(); begin += kPart)
  {
    const PointBatch part = points.slice(begin, std::min(kPart, points.size - begin));
    const PlaceSums sums(*this, cluster, part, false);
    ScratchArray own(part.size);
    for (std::size_t t = 0; t < cluster.terms.size(); ++t)
    {
      std::fill_n(own.data(), part.size, 0.0);
      whole_.addField(cluster.terms[t].own, part, own.data());
      for (std::size_t k = 0; k < part.size; ++k)
      {
        const double here = sums.value(0, k);
        if (here > 0.0)
        {
          value[begin + k] += share_(sums.value(1 + t, k) / here) * this->counted(own[k], here);
        }
      }
    }
  }
}

void BlendedField::clusterField(const BlendSelection::Cluster& cluster, PointBatch points,
  double* value, VectorBatch gradient) const
{
  clear(points.size, value, gradient);
  whole_.addFieldAndGradient(cluster.plain, points, value, gradient);
  for (std::size_t begin = 0; begin < points.size && !cluster.terms.empty(); begin += kPart)
  {
    const PointBatch part = points.slice(begin, std::min(kPart, points.size - begin));
    const PlaceSums sums(*this, cluster, part, true);
    for (std::size_t t = 0; t < cluster.terms.size(); ++t)
    {
      Samples own(part.size);
      whole_.addFieldAndGradient(cluster.terms[t].own, part, own.value(), own.gradient());
      for (std::size_t k = 0; k < part.size; ++k)
      {
        const double here = sums.value(0, k);
        if (!(here > 0.0))
        {
          continue;
        }
        const double distance = sums.value(1 + t, k) / here;
        const Vec3 steps = (sums.gradient(1 + t, k) - distance * sums.gradient(0, k)) / here;
        const double counted = this->counted(own.value(k), here);
        const Vec3 slope = counted < own.value(k) ? sums.gradient(0, k) : own.gradient(k);
        value[begin + k] += share_(distance) * counted;
        gradient.set(begin + k,
          gradient[begin + k] + share_(distance) * slope +
            counted * share_.slope(distance) * steps);
      }
    }
  }
}

// Points, as few as it takes to keep them together, and body(part, selection, index): index[k] says
// which point of the query the k-th of the part is.
template <typename Body>
void BlendedField::forCompactParts(PointBatch points, Body&& body) const
{
  static thread_local BlendSelection selection; // no allocation once warm
  std::array<std::size_t, kPart> index;
  ScratchVectors gathered(std::min(kPart, points.size));
  const VectorBatch to = gathered.batch();
  // Parts that are too large are halved along their longest side.
  const auto handle = [&](auto&& self, std::size_t* begin, std::size_t* end) -> void
  {
    Box3 box;
    std::for_each(begin, end, [&](std::size_t k) { box.extend(points[k]); });
    const auto count = static_cast<std::size_t>(end - begin);
    if (count > kFewPoints && box.diagonal().norm() > partSize_)
    {
      Eigen::Index axis;
      box.sizes().maxCoeff(&axis);
      std::size_t* middle = begin + count / 2;
      std::nth_element(begin, middle, end,
        [&](std::size_t a, std::size_t b) { return points[a][axis] < points[b][axis]; });
      self(self, begin, middle);
      self(self, middle, end);
      return;
    }
    this->select(box, selection);
    if (selection.empty())
    {
      return;
    }
    for (std::size_t k = 0; k < count; ++k)
    {
      to.set(k, points[begin[k]]);
    }
    body(PointBatch{ to.x, to.y, to.z, count }, selection, begin);
  };
  for (std::size_t begin = 0; begin < points.size; begin += kPart)
  {
    const std::size_t count = std::min(kPart, points.size - begin);
    std::iota(index.begin(), index.begin() + count, begin);
    handle(handle, index.data(), index.data() + count);
  }
}

void BlendedField::addField(const BlendSelection* selection, PointBatch points, double* sum) const
{
  if (!selection)
  {
    this->forCompactParts(points,
      [&](PointBatch part, const BlendSelection& reaching, const std::size_t* index)
      {
        ScratchArray value(part.size);
        std::fill_n(value.data(), part.size, 0.0);
        this->addField(&reaching, part, value.data());
        for (std::size_t k = 0; k < part.size; ++k)
        {
          sum[index[k]] += value[k];
        }
      });
    return;
  }
  const bool fades = this->kernel().kind == KernelKind::Cauchy;
  if (selection->clusters.empty() && !fades)
  {
    whole_.addField(selection->all, points, sum);
    return;
  }
  ScratchArray best(points.size);
  std::fill_n(best.data(), points.size, 0.0);
  if (selection->clusters.empty())
  {
    whole_.addField(selection->all, points, best.data());
  }
  ScratchArray value(points.size);
  for (const BlendSelection::Cluster& cluster : selection->clusters)
  {
    this->clusterField(cluster, points, value.data());
    std::transform(best.data(), best.data() + points.size, value.data(), best.data(),
      [](double a, double b) { return std::max(a, b); });
  }
  for (std::size_t k = 0; k < points.size; ++k)
  {
    sum[k] += fades ? faded(best[k]) : best[k];
  }
}

void BlendedField::addFieldAndGradient(
  const BlendSelection* selection, PointBatch points, double* sum, VectorBatch gradientSum) const
{
  if (!selection)
  {
    this->forCompactParts(points,
      [&](PointBatch part, const BlendSelection& reaching, const std::size_t* index)
      {
        Samples own(part.size);
        this->addFieldAndGradient(&reaching, part, own.value(), own.gradient());
        for (std::size_t k = 0; k < part.size; ++k)
        {
          sum[index[k]] += own.value(k);
          gradientSum.set(index[k], gradientSum[index[k]] + own.gradient(k));
        }
      });
    return;
  }
  const bool fades = this->kernel().kind == KernelKind::Cauchy;
  if (selection->clusters.empty() && !fades)
  {
    whole_.addFieldAndGradient(selection->all, points, sum, gradientSum);
    return;
  }
  Samples best(points.size);
  if (selection->clusters.empty())
  {
    whole_.addFieldAndGradient(selection->all, points, best.value(), best.gradient());
  }
  Samples own(points.size);
  for (const BlendSelection::Cluster& cluster : selection->clusters)
  {
    this->clusterField(cluster, points, own.value(), own.gradient());
    for (std::size_t k = 0; k < points.size; ++k)
    {
      if (own.value(k) > best.value(k))
      {
        best.value()[k] = own.value(k);
        best.gradient().set(k, own.gradient(k));
      }
    }
  }
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const double value = best.value(k);
    sum[k] += fades ? faded(value) : value;
    gradientSum.set(k, gradientSum[k] + (fades ? fadedSlope(value) : 1.0) * best.gradient(k));
  }
}

Interval BlendedField::clusterRange(const BlendSelection::Cluster& cluster, const Box3& box) const
{
  if (cluster.terms.empty())
  {
    return whole_.range(cluster.plain, box);
  }
  FieldBounds bounds;
  whole_.addBounds(cluster.plain, box, bounds);
  FieldBounds places;
  pieces_->addBounds(cluster.pieces, box, places);
  // sum of f_j |grad alpha_j| <= sum of f_j / F |sum of (d_c - D_j) grad f_c|, F = sum of f_c. Of
  // neighbours the f_j are parts of F; as [SUB], each alone is no larger.
  const bool paper = control_.kind == BlendingKind::Paper;
  double shift = 0.0;
  for (const BlendSelection::Term& term : cluster.terms)
  {
    whole_.addBounds(term.own, box, bounds);
    const double own = BlendShare::kSteepest * term.span;
    shift = paper ? shift + own + 1.0 : std::max(shift, own);
  }
  bounds.slope += shift * places.slope;
  const Vec3 p = box.center();
  double center;
  this->clusterField(cluster, { &p.x(), &p.y(), &p.z(), 1 }, &center);
  const double most = 0.5 * bounds.slope * box.diagonal().norm();
  const double rounding = 1e-13 * (1.0 + bounds.value);
  return { std::max(0.0, center - most - rounding),
    std::min(bounds.value, center + most) + rounding };
}

Interval BlendedField::range(const BlendSelection& selection, const Box3& box) const
{
  Interval range;
  if (selection.clusters.empty())
  {
    range = whole_.range(selection.all, box);
  }
  for (const BlendSelection::Cluster& cluster : selection.clusters)
  {
    const Interval own = this->clusterRange(cluster, box);
    range = { std::max(range.min, own.min), std::max(range.max, own.max) };
  }
  return this->kernel().kind == KernelKind::Cauchy ? Interval{ faded(range.min), faded(range.max) }
                                                   : range;
}

} // namespace hybridtree

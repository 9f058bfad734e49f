// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendedField.h"

#include "core/base/Scratch.h"
#include "core/convolution/BlendSelector.h"
#include "core/convolution/BlendSums.h"
#include "core/convolution/FarBlends.h"
#include "core/convolution/OwnBlend.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>

namespace hybridtree
{
namespace
{

// Points of a whole query that are handled together.
constexpr std::size_t kPart = 64;
constexpr std::size_t kFewPoints = 4;
constexpr std::size_t kFewFarPoints = 32; // with the Cauchy kernel, of which everything reaches

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

// What faded() does, to sums of the Cauchy kernel. Mostly nothing: that is told without branches.
void fade(std::size_t count, double* value, const VectorBatch* gradient)
{
  std::uint64_t fading = 0;
  for (std::size_t k = 0; k < count; ++k)
  {
    fading += value[k] <= 2.0 * kFadeEnd ? 1 : 0;
  }
  for (std::size_t k = 0; fading > 0 && k < count; ++k)
  {
    if (gradient)
    {
      gradient->set(k, fadedSlope(value[k]) * (*gradient)[k]);
    }
    value[k] = faded(value[k]);
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

std::vector<FarGroup> farGroups(
  const ConvolutionField& pieces, const BlendPieces& places, double farthest)
{
  std::vector<FarGroup> groups(places.neighbours.size());
  ElementSelection all;
  pieces.select(pieces.influenceBounds(), all);
  const auto add = [&](const auto* element, const BlendPieces::Place& place, auto list)
  {
    FarGroup& group = groups[static_cast<std::size_t>(place.group)];
    (group.*list).push_back(element);
    group.places.push_back(&place);
    group.bound.add(*element, pieces.kernel());
  };
  for (const SegmentElement* segment : all.segments)
  {
    add(segment, places.segmentPlaces[pieces.index(segment)], &FarGroup::segments);
  }
  for (const TriangleElement* triangle : all.triangles)
  {
    add(triangle, places.trianglePlaces[pieces.index(triangle)], &FarGroup::triangles);
  }
  for (std::size_t k = 0; k < groups.size(); ++k)
  {
    FarGroup& group = groups[k];
    group.members = places.neighbours[k];
    const auto own = static_cast<std::int32_t>(k);
    group.members.insert(std::upper_bound(group.members.begin(), group.members.end(), own), own);
    group.findNear(farthest);
  }
  return groups;
}

} // namespace

BlendedField::BlendedField(
  const ConvolutionKernel& kernel, const BlendingControl& control, const GroupedElements& elements)
  : control_(control)
  , whole_(kernel, segmentsOf(elements), trianglesOf(elements))
  , partSize_(std::accumulate(elements.reaches.begin(), elements.reaches.end(), 0.0) /
      static_cast<double>(std::max<std::size_t>(1, elements.reaches.size())))
  , segmentGroups_(groupsOf(elements.segments))
  , triangleGroups_(groupsOf(elements.triangles))
  , groupCount_(elements.groups.size())
{
  if (control.kind == BlendingKind::Paper)
  {
    paper_ = std::make_unique<const PaperSums>(elements, whole_);
  }
  if (control.kind == BlendingKind::Neighbours)
  {
    places_ = makeBlendPieces(elements, control);
    pieces_ = std::make_unique<const ConvolutionField>(kernel, places_.segments, places_.triangles);
    places_.segments = {};
    places_.triangles = {};
    if (kernel.kind == KernelKind::Cauchy)
    {
      farGroups_ = farGroups(*pieces_, places_, BlendShare(control).farthest());
    }
  }
}

double BlendedField::meanNeighbours() const
{
  std::size_t count = 0;
  for (const std::vector<std::int32_t>& others : places_.neighbours)
  {
    count += others.size();
  }
  return static_cast<double>(count) /
    static_cast<double>(std::max<std::size_t>(1, places_.neighbours.size()));
}

ElementGroups BlendedField::elementGroups() const
{
  return { whole_, segmentGroups_, triangleGroups_, groupCount_ };
}

BlendGroups BlendedField::groups() const
{
  return { control_, whole_, this->elementGroups(), *pieces_, places_, farGroups_ };
}

void BlendedField::select(const Box3& box, BlendSelection& selection) const
{
  whole_.select(box, selection.all);
  selection.isControlled = false;
  if (pieces_)
  {
    selectBlends(this->groups(), selection);
  }
  if (paper_)
  {
    selectGroups(this->elementGroups(), selection);
  }
}

void BlendedField::sumControlled(const BlendSelection& selection, PointBatch points, double* value,
  const VectorBatch* gradient) const
{
  if (paper_)
  {
    paper_->largest(selection, whole_, points, value, gradient);
  }
  else
  {
    sumBlends(this->groups(), selection, points, value, gradient);
  }
}

void BlendedField::ownBlend(std::int32_t group, const BlendSelection* selection, PointBatch points,
  double* value, const VectorBatch* gradient) const
{
  const BlendGroups groups = this->groups();
  if (!groups.isLocal())
  {
    ownFarBlend(groups, group, points, value, gradient);
  }
  else if (!selection)
  {
    Box3 box;
    for (std::size_t k = 0; k < points.size; ++k)
    {
      box.extend(points[k]);
    }
    hybridtree::ownBlend(PiecesNear(groups, box), group, points, value, gradient);
  }
  else if (selection->isControlled)
  {
    sumBlends(groups, *selection, points, value, gradient, group);
  }
  else
  {
    std::fill_n(value, points.size, 0.0);
    if (gradient)
    {
      clear(points.size, value, *gradient);
      whole_.addFieldAndGradient(selection->all, points, value, *gradient);
    }
    else
    {
      whole_.addField(selection->all, points, value);
    }
  }
}

void BlendedField::ownSum(std::int32_t group, const BlendSelection* selection, PointBatch points,
  double* value, const VectorBatch* gradient) const
{
  if (paper_)
  {
    paper_->evaluate(group, this->kernel(), points, value, gradient);
  }
  else
  {
    this->ownBlend(group, selection, points, value, gradient);
  }
  if (this->kernel().kind == KernelKind::Cauchy)
  {
    fade(points.size, value, gradient);
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
  const std::size_t few = this->kernel().kind == KernelKind::Cauchy ? kFewFarPoints : kFewPoints;
  // Parts that are too large are halved along their longest side.
  const auto handle = [&](auto&& self, std::size_t* begin, std::size_t* end) -> void
  {
    Box3 box;
    std::for_each(begin, end, [&](std::size_t k) { box.extend(points[k]); });
    const auto count = static_cast<std::size_t>(end - begin);
    if (count > few && box.diagonal().norm() > partSize_)
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
  if (!selection->isControlled && !fades)
  {
    whole_.addField(selection->all, points, sum);
    return;
  }
  ScratchArray value(points.size);
  if (!selection->isControlled)
  {
    std::fill_n(value.data(), points.size, 0.0);
    whole_.addField(selection->all, points, value.data());
  }
  else
  {
    this->sumControlled(*selection, points, value.data(), nullptr);
  }
  for (std::size_t k = 0; k < points.size; ++k)
  {
    sum[k] += fades ? faded(value[k]) : value[k];
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
  if (!selection->isControlled && !fades)
  {
    whole_.addFieldAndGradient(selection->all, points, sum, gradientSum);
    return;
  }
  Samples own(points.size);
  const VectorBatch gradient = own.gradient();
  if (!selection->isControlled)
  {
    whole_.addFieldAndGradient(selection->all, points, own.value(), gradient);
  }
  else
  {
    this->sumControlled(*selection, points, own.value(), &gradient);
  }
  for (std::size_t k = 0; k < points.size; ++k)
  {
    const double value = own.value(k);
    sum[k] += fades ? faded(value) : value;
    gradientSum.set(k, gradientSum[k] + (fades ? fadedSlope(value) : 1.0) * gradient[k]);
  }
}

// Of the length of the gradient; 0 where the field is the sum. See BlendMixture.cpp for the
// gradient: the s_j (d(c, j) - D_j) are at most alpha' f_j / F times the largest distance, and the
// f_j add up to F.
double BlendedField::mixedSlope(const BlendSelection& selection, const Box3& box) const
{
  const BlendShare share(control_);
  if (selection.units.empty())
  {
    FieldBounds all;
    whole_.addBounds(selection.all, box, all);
    return (1.0 + BlendShare::kSteepest * share.farthest()) * all.slope;
  }
  std::vector<FieldBounds> bounds(selection.units.size());
  double slope = 0.0;
  for (std::size_t unit = 0; unit < bounds.size(); ++unit)
  {
    whole_.addBounds(selection.elementsOf(unit), box, bounds[unit]);
    slope += bounds[unit].slope;
  }
  if (paper_)
  {
    return paper_->slope(selection, bounds);
  }
  double distance = 0.0;
  for (std::size_t a = selection.hasRest ? 1 : 0; a < bounds.size(); ++a)
  {
    for (std::size_t b = a + 1; bounds[a].value > 0.0 && b < bounds.size(); ++b)
    {
      const double between = std::max(
        selection.farthest[a * bounds.size() + b], selection.farthest[b * bounds.size() + a]);
      if (between > share.begin() && bounds[b].value > 0.0)
      {
        distance = std::max(distance, between);
      }
    }
  }
  return distance > 0.0 ? (1.0 + BlendShare::kSteepest * distance) * slope : 0.0;
}

Interval BlendedField::mixedRange(const BlendSelection& selection, const Box3& box) const
{
  const Interval sum = whole_.range(selection.all, box);
  const double slope = sum.max > 0.0 ? this->mixedSlope(selection, box) : 0.0;
  if (slope == 0.0)
  {
    return sum;
  }
  const Vec3 p = box.center();
  double center;
  this->sumControlled(selection, { &p.x(), &p.y(), &p.z(), 1 }, &center, nullptr);
  const double most = 0.5 * slope * box.diagonal().norm();
  const double rounding = 1e-13 * (1.0 + sum.max);
  return { std::max(0.0, center - most - rounding), std::min(sum.max, center + most + rounding) };
}

Interval BlendedField::range(const BlendSelection& selection, const Box3& box) const
{
  const Interval range =
    selection.isControlled ? this->mixedRange(selection, box) : whole_.range(selection.all, box);
  return this->kernel().kind == KernelKind::Cauchy ? Interval{ faded(range.min), faded(range.max) }
                                                   : range;
}

} // namespace hybridtree

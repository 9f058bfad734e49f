// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendedField.h"

#include "core/base/Scratch.h"
#include "core/convolution/BlendSelector.h"
#include "core/convolution/LimbMeans.h"

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

} // namespace

BlendedField::BlendedField(
  const ConvolutionKernel& kernel, const BlendingControl& control, const GroupedElements& elements)
  : whole_(kernel, segmentsOf(elements), trianglesOf(elements))
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
    pieces_ = std::make_unique<const BlendPieces>(elements, control, kernel);
  }
}

BlendedField::BlendedField(BlendedField&&) noexcept = default;
BlendedField::~BlendedField() = default;

double BlendedField::meanNeighbours() const
{
  return pieces_ ? pieces_->meanNear() : 0.0;
}

ElementGroups BlendedField::elementGroups() const
{
  return { whole_, segmentGroups_, triangleGroups_, groupCount_ };
}

LimbMeans BlendedField::limbs() const
{
  return LimbMeans(whole_, this->elementGroups(), *pieces_);
}

void BlendedField::select(const Box3& box, BlendSelection& selection) const
{
  whole_.select(box, selection.all);
  selection.isControlled = false;
  if (pieces_)
  {
    this->limbs().select(box, selection);
  }
  if (paper_ && !selection.all.empty())
  {
    selection.isControlled = true;
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
    this->limbs().evaluate(selection, points, value, gradient);
  }
}

void BlendedField::ownSum(
  std::int32_t group, PointBatch points, double* value, const VectorBatch* gradient) const
{
  paper_->evaluate(group, this->kernel(), points, value, gradient);
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

// From its slope.
Interval BlendedField::paperRange(const BlendSelection& selection, const Box3& box) const
{
  const Interval sum = whole_.range(selection.all, box);
  if (sum.max <= 0.0)
  {
    return sum;
  }
  std::vector<FieldBounds> bounds(selection.units.size());
  for (std::size_t unit = 0; unit < bounds.size(); ++unit)
  {
    whole_.addBounds(selection.elementsOf(unit), box, bounds[unit]);
  }
  const Vec3 p = box.center();
  double center;
  this->sumControlled(selection, { &p.x(), &p.y(), &p.z(), 1 }, &center, nullptr);
  const double most = 0.5 * paper_->slope(selection, bounds) * box.diagonal().norm();
  const double rounding = 1e-13 * (1.0 + sum.max);
  return { std::max(0.0, center - most - rounding), std::min(sum.max, center + most + rounding) };
}

Interval BlendedField::range(const BlendSelection& selection, const Box3& box) const
{
  const Interval range = !selection.isControlled ? whole_.range(selection.all, box)
    : paper_                                     ? this->paperRange(selection, box)
                                                 : this->limbs().range(selection, box);
  return this->kernel().kind == KernelKind::Cauchy ? Interval{ faded(range.min), faded(range.max) }
                                                   : range;
}

} // namespace hybridtree

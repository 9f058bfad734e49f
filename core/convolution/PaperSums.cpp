// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/PaperSums.h"

#include "core/base/Scratch.h"
#include "core/convolution/BlendGroups.h"

#include <algorithm>
#include <numeric>

namespace hybridtree
{
namespace
{

constexpr std::size_t kMostNumbers = 1 << 18; // kept at once
constexpr std::size_t kMostPoints = 64;
constexpr double kFlat = 1e-12; // squared area of a triangle beside its edges

// The groups that have a corner in common with each, ascending.
std::vector<std::vector<std::int32_t>> groupsThatTouch(
  const std::vector<std::array<std::int32_t, 3>>& corners, std::size_t points)
{
  std::vector<std::vector<std::int32_t>> atPoint(points);
  for (std::size_t group = 0; group < corners.size(); ++group)
  {
    for (const std::int32_t point : corners[group])
    {
      if (point >= 0)
      {
        atPoint[static_cast<std::size_t>(point)].push_back(static_cast<std::int32_t>(group));
      }
    }
  }
  std::vector<std::vector<std::int32_t>> touching(corners.size());
  for (std::size_t group = 0; group < corners.size(); ++group)
  {
    std::vector<std::int32_t>& list = touching[group];
    for (const std::int32_t point : corners[group])
    {
      if (point >= 0)
      {
        const auto& others = atPoint[static_cast<std::size_t>(point)];
        list.insert(list.end(), others.begin(), others.end());
      }
    }
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    list.erase(std::find(list.begin(), list.end(), static_cast<std::int32_t>(group)));
  }
  return touching;
}

// Gradients of the barycentric coordinates on the line or in the plane of an element; 0 where it
// has no length or area.
std::array<Vec3, 3> coordinateSlopes(const GroupedElements& elements, std::size_t group)
{
  const std::array<std::int32_t, 3>& corners = elements.groups[group];
  const auto at = [&](std::size_t k)
  { return elements.points[static_cast<std::size_t>(corners[k])]; };
  const Vec3 first = at(1) - at(0);
  Vec3 one = Vec3::Zero();
  Vec3 two = Vec3::Zero();
  if (corners[2] < 0)
  {
    one = first.squaredNorm() > 0.0 ? Vec3(first / first.squaredNorm()) : one;
  }
  else
  {
    const Vec3 second = at(2) - at(0);
    const double product = first.squaredNorm() * second.squaredNorm();
    const double between = first.dot(second);
    const double area = product - between * between;
    if (area > kFlat * product)
    {
      one = (second.squaredNorm() * first - between * second) / area;
      two = (first.squaredNorm() * second - between * first) / area;
    }
  }
  return { Vec3(-one - two), one, two };
}

void clear(std::size_t count, double* value, const VectorBatch* gradient)
{
  std::fill_n(value, count, 0.0);
  if (gradient)
  {
    for (double* array : { gradient->x, gradient->y, gradient->z })
    {
      std::fill_n(array, count, 0.0);
    }
  }
}

} // namespace

template <class Element, typename GroupOf>
PaperSums::Members<Element> PaperSums::sortByGroups(
  const std::vector<const Element*>& elements, std::size_t groupCount, const GroupOf& groupOf)
{
  Members<Element> members;
  members.begin.assign(groupCount + 1, 0);
  for (const Element* element : elements)
  {
    ++members.begin[static_cast<std::size_t>(groupOf(element)) + 1];
  }
  std::partial_sum(members.begin.begin(), members.begin.end(), members.begin.begin());
  members.elements.resize(elements.size());
  std::vector<std::size_t> next = members.begin;
  for (const Element* element : elements)
  {
    members.elements[next[static_cast<std::size_t>(groupOf(element))]++] = element;
  }
  return members;
}

PaperSums::PaperSums(const GroupedElements& elements, const ConvolutionField& whole)
  : share_(BlendingControl{ BlendingKind::Paper })
  , neighbours_(elements.groups.size())
  , shared_(elements.groups.size())
{
  ElementSelection all;
  whole.select(whole.influenceBounds(), all);
  segments_ = sortByGroups(all.segments, elements.groups.size(),
    [&](const SegmentElement* element) { return elements.segments[whole.index(element)].group; });
  triangles_ = sortByGroups(all.triangles, elements.groups.size(),
    [&](const TriangleElement* element) { return elements.triangles[whole.index(element)].group; });
  const auto touching = groupsThatTouch(elements.groups, elements.points.size());
  for (std::size_t group = 0; group < touching.size(); ++group)
  {
    const auto own = static_cast<std::int32_t>(group);
    shared_[group].push_back({ segments_.of(own), triangles_.of(own), Vec3::Zero(), 0.0 });
    for (const std::int32_t other : touching[group])
    {
      const Neighbour& added = neighbours_[group].emplace_back(neighbour(elements, group, other));
      shared_[group].push_back(
        { segments_.of(other), triangles_.of(other), added.slope, added.offset });
    }
  }
}

// 1 minus the coordinates of the corners that are shared, so 0 at each of them.
PaperSums::Neighbour PaperSums::neighbour(
  const GroupedElements& elements, std::size_t group, std::int32_t other)
{
  const std::array<std::int32_t, 3>& own = elements.groups[group];
  const std::array<std::int32_t, 3>& others = elements.groups[static_cast<std::size_t>(other)];
  const std::array<Vec3, 3> slopes = coordinateSlopes(elements, group);
  Neighbour result{ other, Vec3::Zero(), 0.0 };
  std::int32_t corner = -1;
  for (std::size_t k = 0; k < 3; ++k)
  {
    if (own[k] >= 0 && std::find(others.begin(), others.end(), own[k]) != others.end())
    {
      result.slope -= slopes[k];
      corner = own[k];
    }
  }
  result.offset = -result.slope.dot(elements.points[static_cast<std::size_t>(corner)]);
  return result;
}

void PaperSums::evaluate(std::int32_t group, const ConvolutionKernel& kernel, PointBatch points,
  double* value, const VectorBatch* gradient) const
{
  const std::vector<SharedElements>& parts = shared_[static_cast<std::size_t>(group)];
  const ConvolutionKernels& kernels = convolutionKernels(kernel.kind);
  clear(points.size, value, gradient);
  if (gradient)
  {
    kernels.addSharedWithGradient(parts, kernel, points, value, *gradient);
  }
  else
  {
    kernels.addShared(parts, kernel, points, value);
  }
}

// The fields of some groups at some points, and the sums of them.
class PaperSums::Largest
{
public:
  Largest(const PaperSums& sums, const BlendSelection& selection, const ConvolutionField& whole,
    PointBatch points, bool haveGradients)
    : sums_(sums)
    , points_(points)
    , haveGradients_(haveGradients)
    , numbers_(sums.neighbours_.size())
    , rows_(selection.units.size() * this->step())
  {
    std::fill_n(rows_.data(), rows_.size(), 0.0);
    for (std::size_t unit = 0; unit < selection.units.size(); ++unit)
    {
      numbers_.add(selection.groups[unit].group);
      if (haveGradients)
      {
        whole.addFieldAndGradient(
          selection.elementsOf(unit), points, this->field(unit), this->gradient(unit));
      }
      else
      {
        whole.addField(selection.elementsOf(unit), points, this->field(unit));
      }
    }
  }

  /// The largest sum at a point, and its gradient unless null.
  double at(std::size_t k, Vec3* gradient)
  {
    std::size_t winner = 0;
    for (std::size_t unit = 1; unit < numbers_.size(); ++unit)
    {
      winner = this->field(unit)[k] > this->field(winner)[k] ? unit : winner;
    }
    double best = this->sum(winner, k, nullptr);
    for (std::size_t unit = 0; unit < numbers_.size(); ++unit)
    {
      // No f_j counts more than f_i.
      if (unit != winner &&
        this->field(unit)[k] * static_cast<double>(1 + this->neighbours(unit).size()) > best)
      {
        const double other = this->sum(unit, k, nullptr);
        winner = other > best ? unit : winner;
        best = std::max(best, other);
      }
    }
    return gradient ? this->sum(winner, k, gradient) : best;
  }

private:
  std::size_t step() const { return (haveGradients_ ? 4 : 1) * points_.size; }
  double* field(std::size_t unit) { return rows_.data() + unit * this->step(); }
  VectorBatch gradient(std::size_t unit)
  {
    double* first = this->field(unit) + points_.size;
    return { first, first + points_.size, first + 2 * points_.size };
  }
  const std::vector<Neighbour>& neighbours(std::size_t unit) const
  {
    return sums_.neighbours_[static_cast<std::size_t>(numbers_.group(unit))];
  }

  double sum(std::size_t unit, std::size_t k, Vec3* gradient)
  {
    const double own = this->field(unit)[k];
    double total = own;
    Vec3 slope = gradient ? this->gradient(unit)[k] : Vec3(Vec3::Zero());
    for (const Neighbour& neighbour : this->neighbours(unit))
    {
      if (numbers_.find(neighbour.group) < 0)
      {
        continue;
      }
      const auto other = static_cast<std::size_t>(numbers_.find(neighbour.group));
      const double u = neighbour.parameter(points_[k]);
      const double share = sums_.share_(u);
      const bool isCut = own < this->field(other)[k];
      const double field = isCut ? own : this->field(other)[k];
      total += share * field;
      if (gradient)
      {
        slope += share * this->gradient(isCut ? unit : other)[k] +
          sums_.share_.slope(u) * field * neighbour.slope;
      }
    }
    if (gradient)
    {
      *gradient = slope;
    }
    return total;
  }

  const PaperSums& sums_;
  PointBatch points_;
  bool haveGradients_;
  GroupNumbers numbers_; // those of units
  ScratchArray rows_;    // per unit
};

void PaperSums::largest(const BlendSelection& selection, const ConvolutionField& whole,
  PointBatch points, double* value, const VectorBatch* gradient) const
{
  const std::size_t part =
    std::clamp<std::size_t>(kMostNumbers / (4 * selection.units.size()), 8, kMostPoints);
  for (std::size_t begin = 0; begin < points.size; begin += part)
  {
    const PointBatch some = points.slice(begin, std::min(part, points.size - begin));
    Largest largest(*this, selection, whole, some, gradient != nullptr);
    for (std::size_t k = 0; k < some.size; ++k)
    {
      Vec3 slope;
      value[begin + k] = largest.at(k, gradient ? &slope : nullptr);
      if (gradient)
      {
        gradient->set(begin + k, slope);
      }
    }
  }
}

// |grad min(f_j, f_i)| is at most the larger of both.
double PaperSums::slope(
  const BlendSelection& selection, const std::vector<FieldBounds>& bounds) const
{
  GroupNumbers numbers(neighbours_.size());
  for (const BlendSelection::Group& group : selection.groups)
  {
    numbers.add(group.group);
  }
  double most = 0.0;
  for (std::size_t unit = 0; unit < bounds.size(); ++unit)
  {
    double slope = bounds[unit].slope;
    for (const Neighbour& neighbour : neighbours_[static_cast<std::size_t>(numbers.group(unit))])
    {
      if (numbers.find(neighbour.group) >= 0)
      {
        const FieldBounds& other = bounds[static_cast<std::size_t>(numbers.find(neighbour.group))];
        slope += std::max(bounds[unit].slope, other.slope) +
          BlendShare::kSteepest * neighbour.slope.norm() *
            std::min(bounds[unit].value, other.value);
      }
    }
    most = std::max(most, slope);
  }
  return most;
}

} // namespace hybridtree

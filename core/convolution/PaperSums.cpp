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
  // In the order in which they are stored, so that sums do not change with the rest of a skeleton.
  std::sort(all.segments.begin(), all.segments.end());
  std::sort(all.triangles.begin(), all.triangles.end());
  segments_ = sortByGroups(all.segments, elements.groups.size(),
    [&](const SegmentElement* element) { return elements.segments[whole.index(element)].group; });
  triangles_ = sortByGroups(all.triangles, elements.groups.size(),
    [&](const TriangleElement* element) { return elements.triangles[whole.index(element)].group; });
  const auto touching = groupsThatTouch(elements.groups, elements.points.size());
  for (std::size_t group = 0; group < touching.size(); ++group)
  {
    for (const std::int32_t other : touching[group])
    {
      neighbours_[group].push_back(neighbour(elements, group, other));
    }
  }
  this->findShared();
}

void PaperSums::findShared()
{
  const auto append = [](const auto& span, auto& list)
  { list.insert(list.end(), span.elements, span.elements + span.count); };
  // Lists may move while they grow: pointers follow.
  for (std::size_t group = 0; group < neighbours_.size(); ++group)
  {
    std::vector<Neighbour> others = neighbours_[group];
    const auto key = [](const Neighbour& of) {
      return std::array<double, 4>{ of.slope.x(), of.slope.y(), of.slope.z(), of.offset };
    };
    std::stable_sort(others.begin(), others.end(),
      [&](const Neighbour& a, const Neighbour& b) { return key(a) < key(b); });
    others.insert(others.begin(), { static_cast<std::int32_t>(group), Vec3::Zero(), 0.0 });
    for (std::size_t k = 0; k < others.size(); ++k)
    {
      const std::array<std::size_t, 2> before = { sharedSegments_.size(), sharedTriangles_.size() };
      append(segments_.of(others[k].group), sharedSegments_);
      append(triangles_.of(others[k].group), sharedTriangles_);
      if (k < 2 || key(others[k]) != key(others[k - 1]))
      {
        shared_[group].push_back({ {}, {}, others[k].slope, others[k].offset });
      }
      SharedElements& part = shared_[group].back();
      part.segments.count += sharedSegments_.size() - before[0];
      part.triangles.count += sharedTriangles_.size() - before[1];
    }
  }
  const SegmentElement* const* segments = sharedSegments_.data();
  const TriangleElement* const* triangles = sharedTriangles_.data();
  for (std::vector<SharedElements>& parts : shared_)
  {
    for (SharedElements& part : parts)
    {
      part.segments.elements = segments;
      part.triangles.elements = triangles;
      segments += part.segments.count;
      triangles += part.triangles.count;
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

// The largest sums at some points. Groups are integrated when their sum, or one that they are in,
// may be the largest.
class PaperSums::Largest
{
public:
  Largest(const PaperSums& sums, const BlendSelection& selection, const ConvolutionField& whole,
    PointBatch points, bool haveGradients)
    : sums_(sums)
    , selection_(selection)
    , whole_(whole)
    , points_(points)
    , haveGradients_(haveGradients)
    , numbers_(sums.neighbours_.size())
    , isKnown_(selection.units.size(), 0)
    , rows_(selection.units.size() * this->step())
    , best_(points.size)
    , total_(points.size)
    , winners_(points.size, 0)
  {
    for (const BlendSelection::Group& group : selection.groups)
    {
      numbers_.add(group.group);
    }
    std::fill_n(best_.data(), best_.size(), -1.0);
    this->findBest();
  }

  double value(std::size_t k) const { return best_.data()[k]; }

  Vec3 gradient(std::size_t k)
  {
    const std::size_t unit = winners_[k];
    const double own = this->field(unit)[k];
    Vec3 slope = this->gradients(unit)[k];
    this->forNeighbours(unit,
      [&](const Neighbour& neighbour, std::size_t other)
      {
        const double u = neighbour.parameter(points_[k]);
        const double field = this->field(other)[k];
        const bool isCut = own < field;
        slope += sums_.share_(u) * this->gradients(isCut ? unit : other)[k] +
          sums_.share_.slope(u) * std::min(own, field) * neighbour.slope;
      });
    return slope;
  }

private:
  std::size_t step() const { return (haveGradients_ ? 4 : 1) * points_.size; }
  VectorBatch gradients(std::size_t unit)
  {
    double* first = rows_.data() + unit * this->step() + points_.size;
    return { first, first + points_.size, first + 2 * points_.size };
  }

  const double* field(std::size_t unit)
  {
    double* row = rows_.data() + unit * this->step();
    if (!isKnown_[unit])
    {
      isKnown_[unit] = 1;
      std::fill_n(row, this->step(), 0.0);
      if (haveGradients_)
      {
        whole_.addFieldAndGradient(
          selection_.elementsOf(unit), points_, row, this->gradients(unit));
      }
      else
      {
        whole_.addField(selection_.elementsOf(unit), points_, row);
      }
    }
    return row;
  }

  // Those that have a field here.
  template <typename Body>
  void forNeighbours(std::size_t unit, const Body& body) const
  {
    for (const Neighbour& neighbour :
      sums_.neighbours_[static_cast<std::size_t>(numbers_.group(unit))])
    {
      const std::int32_t other = numbers_.find(neighbour.group);
      if (other >= 0)
      {
        body(neighbour, static_cast<std::size_t>(other));
      }
    }
  }

  // Of the field of each unit at the points. What reaches a place is integrated in any case; fields
  // without end mostly need not be.
  std::vector<double> bounds()
  {
    Box3 box;
    for (std::size_t k = 0; k < points_.size; ++k)
    {
      box.extend(points_[k]);
    }
    std::vector<double> bounds;
    for (std::size_t unit = 0; unit < isKnown_.size(); ++unit)
    {
      FieldBounds of;
      if (whole_.kernel().kind == KernelKind::Cauchy)
      {
        whole_.addBounds(selection_.elementsOf(unit), box, of);
      }
      else
      {
        const double* field = this->field(unit);
        of.value = *std::max_element(field, field + points_.size);
      }
      bounds.push_back(of.value);
    }
    return bounds;
  }

  void findBest()
  {
    const std::vector<double> bounds = this->bounds();
    std::vector<double> most = bounds; // of the sums
    std::vector<std::size_t> order(bounds.size());
    for (std::size_t unit = 0; unit < bounds.size(); ++unit)
    {
      order[unit] = unit;
      this->forNeighbours(unit,
        [&](const Neighbour&, std::size_t other)
        { most[unit] += std::min(bounds[unit], bounds[other]); });
    }
    std::sort(
      order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return most[a] > most[b]; });
    double least = -1.0;
    for (const std::size_t unit : order)
    {
      if (most[unit] <= least)
      {
        return;
      }
      this->tryOut(unit);
      least = *std::min_element(best_.data(), best_.data() + points_.size);
    }
  }

  void tryOut(std::size_t unit)
  {
    const double* own = this->field(unit);
    std::copy_n(own, points_.size, total_.data());
    this->forNeighbours(unit,
      [&](const Neighbour& neighbour, std::size_t other)
      {
        const double* field = this->field(other);
        for (std::size_t k = 0; k < points_.size; ++k)
        {
          total_[k] += sums_.share_(neighbour.parameter(points_[k])) * std::min(own[k], field[k]);
        }
      });
    for (std::size_t k = 0; k < points_.size; ++k)
    {
      if (total_[k] > best_[k])
      {
        best_[k] = total_[k];
        winners_[k] = unit;
      }
    }
  }

  const PaperSums& sums_;
  const BlendSelection& selection_;
  const ConvolutionField& whole_;
  PointBatch points_;
  bool haveGradients_;
  GroupNumbers numbers_; // those of units
  std::vector<char> isKnown_;
  ScratchArray rows_; // per unit
  ScratchArray best_;
  ScratchArray total_;
  std::vector<std::size_t> winners_;
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
      value[begin + k] = largest.value(k);
      if (gradient)
      {
        gradient->set(begin + k, largest.gradient(k));
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

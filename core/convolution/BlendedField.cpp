// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendedField.h"

#include "core/base/Scratch.h"

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

// Finds which groups blend in a box.
class BlendedField::Selector
{
public:
  using Groups = std::vector<std::int32_t>;

  Selector(const BlendedField& field, const ElementSelection& all) : field_(field), all_(all)
  {
    for (const SegmentElement* segment : all.segments)
    {
      segmentGroups_.push_back(field.segmentGroups_[field.whole_.index(segment)]);
    }
    for (const TriangleElement* triangle : all.triangles)
    {
      triangleGroups_.push_back(field.triangleGroups_[field.whole_.index(triangle)]);
    }
    groups_ = segmentGroups_;
    groups_.insert(groups_.end(), triangleGroups_.begin(), triangleGroups_.end());
    makeUnique(groups_);
  }

  std::vector<BlendSelection::Cluster> clusters(const Box3& box)
  {
    const std::vector<Groups> sets = this->groupSets();
    field_.pieces_->select(box, pieces_);
    for (const SegmentElement* segment : pieces_.segments)
    {
      segmentPlaces_.push_back(&field_.places_.segmentPlaces[field_.pieces_->index(segment)]);
    }
    for (const TriangleElement* triangle : pieces_.triangles)
    {
      trianglePlaces_.push_back(&field_.places_.trianglePlaces[field_.pieces_->index(triangle)]);
    }
    std::vector<BlendSelection::Cluster> clusters;
    for (const Groups& set : sets)
    {
      clusters.push_back(this->cluster(set));
      if (clusters.back().terms.empty() && set == groups_)
      {
        return {}; // no sum is larger than that of all
      }
    }
    return clusters;
  }

private:
  static void makeUnique(Groups& groups)
  {
    std::sort(groups.begin(), groups.end());
    groups.erase(std::unique(groups.begin(), groups.end()), groups.end());
  }

  const Groups& neighboursOf(std::int32_t group) const
  {
    return field_.places_.neighbours[static_cast<std::size_t>(group)];
  }
  bool isPaper() const { return field_.control_.kind == BlendingKind::Paper; }

  // Per candidate i: the groups in reach that its sum may have. As [SUB]: i first.
  std::vector<Groups> groupSets() const
  {
    Groups candidates = groups_;
    if (!this->isPaper())
    {
      for (const std::int32_t group : groups_)
      {
        const Groups& others = this->neighboursOf(group);
        candidates.insert(candidates.end(), others.begin(), others.end());
      }
      makeUnique(candidates);
    }
    std::vector<Groups> sets;
    for (const std::int32_t candidate : candidates)
    {
      const Groups& others = this->neighboursOf(candidate);
      Groups& set = sets.emplace_back();
      for (const std::int32_t group : groups_)
      {
        if (group == candidate || std::binary_search(others.begin(), others.end(), group))
        {
          set.push_back(group);
        }
      }
      if (this->isPaper())
      {
        std::iter_swap(set.begin(), std::find(set.begin(), set.end(), candidate));
      }
    }
    std::sort(sets.begin(), sets.end());
    sets.erase(std::unique(sets.begin(), sets.end()), sets.end());
    // Large sets first: they may make the others needless.
    std::stable_sort(sets.begin(), sets.end(),
      [](const Groups& a, const Groups& b) { return a.size() > b.size(); });
    return sets;
  }

  BlendSelection::Cluster cluster(const Groups& set) const
  {
    Groups around = this->isPaper() ? Groups{ set.front() } : set;
    Groups plain;
    BlendSelection::Cluster result;
    std::vector<const BlendPieces::Place*> places;
    this->collectPieces(around, result.pieces, places);
    for (const std::int32_t group : set)
    {
      BlendSelection::Term term = this->term(group, places);
      if (this->isPaper() ? group == set.front() : this->countsInFull(term))
      {
        plain.push_back(group);
        continue;
      }
      this->collect({ group }, term.own);
      result.terms.push_back(std::move(term));
    }
    std::sort(plain.begin(), plain.end());
    this->collect(plain, result.plain);
    if (result.terms.empty())
    {
      result.pieces = {};
    }
    return result;
  }

  BlendSelection::Term term(
    std::int32_t group, const std::vector<const BlendPieces::Place*>& places) const
  {
    BlendSelection::Term term;
    for (const BlendPieces::Place* place : places)
    {
      term.distances.push_back(place->distanceTo(group, field_.share_.end()));
    }
    const auto [least, largest] = std::minmax_element(term.distances.begin(), term.distances.end());
    term.span = places.empty() ? 0.0 : *largest - *least;
    return term;
  }

  bool countsInFull(const BlendSelection::Term& term) const
  {
    return std::all_of(term.distances.begin(), term.distances.end(),
      [this](double distance) { return distance <= field_.share_.begin(); });
  }

  void collect(const Groups& groups, ElementSelection& selection) const
  {
    const auto wanted = [&](std::int32_t group)
    { return std::binary_search(groups.begin(), groups.end(), group); };
    for (std::size_t k = 0; k < segmentGroups_.size(); ++k)
    {
      if (wanted(segmentGroups_[k]))
      {
        selection.segments.push_back(all_.segments[k]);
      }
    }
    for (std::size_t k = 0; k < triangleGroups_.size(); ++k)
    {
      if (wanted(triangleGroups_[k]))
      {
        selection.triangles.push_back(all_.triangles[k]);
      }
    }
  }

  void collectPieces(const Groups& groups, ElementSelection& selection,
    std::vector<const BlendPieces::Place*>& places) const
  {
    const auto wanted = [&](const BlendPieces::Place* place)
    { return std::binary_search(groups.begin(), groups.end(), place->group); };
    for (std::size_t k = 0; k < segmentPlaces_.size(); ++k)
    {
      if (wanted(segmentPlaces_[k]))
      {
        selection.segments.push_back(pieces_.segments[k]);
        places.push_back(segmentPlaces_[k]);
      }
    }
    for (std::size_t k = 0; k < trianglePlaces_.size(); ++k)
    {
      if (wanted(trianglePlaces_[k]))
      {
        selection.triangles.push_back(pieces_.triangles[k]);
        places.push_back(trianglePlaces_[k]);
      }
    }
  }

  const BlendedField& field_;
  const ElementSelection& all_;
  Groups segmentGroups_; // per element of all_
  Groups triangleGroups_;
  Groups groups_; // those in reach
  ElementSelection pieces_;
  std::vector<const BlendPieces::Place*> segmentPlaces_; // per piece
  std::vector<const BlendPieces::Place*> trianglePlaces_;
};

void BlendedField::select(const Box3& box, BlendSelection& selection) const
{
  whole_.select(box, selection.all);
  selection.clusters.clear();
  if (pieces_ && !selection.empty())
  {
    selection.clusters = Selector(*this, selection.all).clusters(box);
  }
}

void BlendedField::clusterField(
  const BlendSelection::Cluster& cluster, PointBatch points, double* value) const
{
  const std::size_t size = points.size;
  std::fill_n(value, size, 0.0);
  whole_.addField(cluster.plain, points, value);
  if (cluster.terms.empty())
  {
    return;
  }
  ScratchArray here(size);
  std::fill_n(here.data(), size, 0.0);
  pieces_->addField(cluster.pieces, points, here.data());
  ScratchArray own(size);
  ScratchArray moment(size);
  for (const BlendSelection::Term& term : cluster.terms)
  {
    std::fill_n(own.data(), size, 0.0);
    std::fill_n(moment.data(), size, 0.0);
    whole_.addField(term.own, points, own.data());
    pieces_->addField(cluster.pieces, points, moment.data(), term.distances.data());
    for (std::size_t k = 0; k < size; ++k)
    {
      if (here[k] > 0.0)
      {
        value[k] += share_(moment[k] / here[k]) * this->counted(own[k], here[k]);
      }
    }
  }
}

void BlendedField::clusterField(const BlendSelection::Cluster& cluster, PointBatch points,
  double* value, VectorBatch gradient) const
{
  const std::size_t size = points.size;
  clear(size, value, gradient);
  whole_.addFieldAndGradient(cluster.plain, points, value, gradient);
  if (cluster.terms.empty())
  {
    return;
  }
  Samples here(size);
  pieces_->addFieldAndGradient(cluster.pieces, points, here.value(), here.gradient());
  for (const BlendSelection::Term& term : cluster.terms)
  {
    Samples own(size);
    Samples moment(size);
    whole_.addFieldAndGradient(term.own, points, own.value(), own.gradient());
    pieces_->addFieldAndGradient(
      cluster.pieces, points, moment.value(), moment.gradient(), term.distances.data());
    for (std::size_t k = 0; k < size; ++k)
    {
      if (!(here.value(k) > 0.0))
      {
        continue;
      }
      const double distance = moment.value(k) / here.value(k);
      const Vec3 steps = (moment.gradient(k) - distance * here.gradient(k)) / here.value(k);
      const double counted = this->counted(own.value(k), here.value(k));
      const Vec3 slope = counted < own.value(k) ? here.gradient(k) : own.gradient(k);
      value[k] += share_(distance) * counted;
      gradient.set(
        k, gradient[k] + share_(distance) * slope + counted * share_.slope(distance) * steps);
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
  if (selection->clusters.empty())
  {
    whole_.addField(selection->all, points, sum);
    return;
  }
  ScratchArray best(points.size);
  std::fill_n(best.data(), points.size, 0.0);
  ScratchArray value(points.size);
  for (const BlendSelection::Cluster& cluster : selection->clusters)
  {
    this->clusterField(cluster, points, value.data());
    std::transform(best.data(), best.data() + points.size, value.data(), best.data(),
      [](double a, double b) { return std::max(a, b); });
  }
  std::transform(sum, sum + points.size, best.data(), sum, std::plus<>());
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
  if (selection->clusters.empty())
  {
    whole_.addFieldAndGradient(selection->all, points, sum, gradientSum);
    return;
  }
  Samples best(points.size);
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
    sum[k] += best.value(k);
    gradientSum.set(k, gradientSum[k] + best.gradient(k));
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
  if (selection.clusters.empty())
  {
    return whole_.range(selection.all, box);
  }
  Interval range;
  for (const BlendSelection::Cluster& cluster : selection.clusters)
  {
    const Interval own = this->clusterRange(cluster, box);
    range = { std::max(range.min, own.min), std::max(range.max, own.max) };
  }
  return range;
}

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/MixBlends.h"

#include "core/convolution/BlendMixture.h"

#include <algorithm>
#include <numeric>

namespace hybridtree
{
namespace
{

constexpr std::size_t kMostNumbers = 1 << 20; // in the largest array

Box3 boxOf(PointBatch points)
{
  Box3 box;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    box.extend(points[k]);
  }
  return box;
}

void clear(std::size_t count, double* value, const VectorBatch* gradient)
{
  std::fill_n(value, count, 0.0);
  for (double* array : { gradient ? gradient->x : value, gradient ? gradient->y : value,
         gradient ? gradient->z : value })
  {
    std::fill_n(array, count, 0.0);
  }
}

// Where fields end: from the pieces that reach the points.
void mixNear(
  const PiecesNear& pieces, PointBatch points, double* value, const VectorBatch* gradient)
{
  PieceFields fields(pieces, points);
  std::vector<double> bounds(pieces.groupCount());
  ScratchArray sum(points.size);
  std::fill_n(sum.data(), points.size, 0.0);
  for (std::size_t number = 0; number < bounds.size(); ++number)
  {
    const double* field = fields.field(number);
    bounds[number] = *std::max_element(field, field + points.size);
    for (std::size_t k = 0; k < points.size; ++k)
    {
      sum[k] += field[k];
    }
  }
  BlendMixture mixture(fields, bounds, nullptr);
  std::vector<std::size_t> changed;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    if (mixture.best(k) < sum[k])
    {
      value[k] = mixture.best(k);
      changed.push_back(k);
    }
  }
  if (gradient && !changed.empty())
  {
    mixture.findGradients(changed, *gradient);
  }
}

// Where they do not: with bounds of the sums first.
class FarMixer
{
public:
  FarMixer(const BlendGroups& groups, PointBatch points)
    : groups_(groups), points_(points), bounds_(groups.size()), sums_(groups.size(), 0.0)
  {
    const Box3 box = boxOf(points);
    for (std::size_t group = 0; group < groups.size(); ++group)
    {
      bounds_[group] = this->mostInBox(groups.farGroups[group], box);
    }
    for (std::size_t center = 0; center < groups.size(); ++center)
    {
      sums_[center] = bounds_[center];
      for (const std::int32_t other : groups.places.neighbours[center])
      {
        sums_[center] += bounds_[static_cast<std::size_t>(other)];
      }
    }
  }

  void mix(double* value, const VectorBatch* gradient) const
  {
    // One sum says which others may be larger.
    const auto first = std::max_element(sums_.begin(), sums_.end());
    double least = 0.0;
    this->mix({ static_cast<std::int32_t>(first - sums_.begin()) },
      [&](BlendMixture& mixture) { least = mixture.leastBest(); });
    std::vector<std::int32_t> centers;
    for (std::size_t center = 0; center < sums_.size(); ++center)
    {
      if (sums_[center] >= least)
      {
        centers.push_back(static_cast<std::int32_t>(center));
      }
    }
    this->mix(centers,
      [&](BlendMixture& mixture)
      {
        std::vector<std::size_t> all(points_.size);
        std::iota(all.begin(), all.end(), std::size_t(0));
        for (const std::size_t k : all)
        {
          value[k] = mixture.best(k);
        }
        if (gradient)
        {
          mixture.findGradients(all, *gradient);
        }
      });
  }

private:
  double mostInBox(const FarGroup& group, const Box3& box) const
  {
    const double distance = group.bound.distanceTo(box);
    if (distance > group.bound.largestReach())
    {
      return group.bound.most(distance);
    }
    FieldBounds bounds;
    for (const BlendPiece& piece : group.pieces)
    {
      const std::size_t isSegment = piece.segment ? 1 : 0;
      groups_.pieces.addBounds(
        { { &piece.segment, isSegment }, { &piece.triangle, 1 - isSegment } }, box, bounds);
    }
    return bounds.value;
  }

  template <typename Use>
  void mix(const std::vector<std::int32_t>& centers, const Use& use) const
  {
    std::vector<std::int32_t> members = centers;
    for (const std::int32_t center : centers)
    {
      const auto& others = groups_.places.neighbours[static_cast<std::size_t>(center)];
      members.insert(members.end(), others.begin(), others.end());
    }
    std::sort(members.begin(), members.end());
    members.erase(std::unique(members.begin(), members.end()), members.end());
    std::vector<double> bounds;
    for (const std::int32_t member : members)
    {
      bounds.push_back(bounds_[static_cast<std::size_t>(member)]);
    }
    const PiecesNear pieces(groups_, members);
    PieceFields fields(pieces, points_);
    BlendMixture mixture(fields, bounds, &centers);
    use(mixture);
  }

  const BlendGroups& groups_;
  PointBatch points_;
  std::vector<double> bounds_; // per group: of its field
  std::vector<double> sums_;   // per group: of its sum
};

// mix(points, value, gradient) for parts of them.
template <typename Mix>
void forParts(
  std::size_t step, PointBatch points, double* value, const VectorBatch* gradient, const Mix& mix)
{
  for (std::size_t begin = 0; begin < points.size; begin += step)
  {
    const std::size_t count = std::min(step, points.size - begin);
    const VectorBatch slopes = gradient ? gradient->slice(begin) : VectorBatch{};
    mix(points.slice(begin, count), value + begin, gradient ? &slopes : nullptr);
  }
}

} // namespace

void mixBlends(
  const BlendGroups& groups, PointBatch points, double* value, const VectorBatch* gradient)
{
  if (groups.farGroups.empty())
  {
    mixBlends(PiecesNear(groups, boxOf(points)), points, value, gradient);
    return;
  }
  forParts(BlendMixture::kMostPoints, points, value, gradient,
    [&](PointBatch part, double* values, const VectorBatch* slopes)
    { FarMixer(groups, part).mix(values, slopes); });
}

void mixBlends(
  const PiecesNear& pieces, PointBatch points, double* value, const VectorBatch* gradient)
{
  if (pieces.size() == 0)
  {
    clear(points.size, value, gradient);
    return;
  }
  forParts(std::clamp<std::size_t>(kMostNumbers / pieces.size(), 8, BlendMixture::kMostPoints),
    points, value, gradient,
    [&](PointBatch part, double* values, const VectorBatch* slopes)
    { mixNear(pieces, part, values, slopes); });
}

} // namespace hybridtree

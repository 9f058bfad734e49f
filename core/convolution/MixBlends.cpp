// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/MixBlends.h"

#include "core/convolution/BlendMixture.h"
#include "core/convolution/BlendRows.h"
#include "core/convolution/OwnBlend.h"

#include <algorithm>

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
  BlendMixture mixture(fields, bounds);
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
    const double least = this->leastOf(
      static_cast<std::int32_t>(std::max_element(sums_.begin(), sums_.end()) - sums_.begin()));
    std::vector<std::int32_t> centers;
    for (std::size_t center = 0; center < sums_.size(); ++center)
    {
      if (sums_[center] >= least)
      {
        centers.push_back(static_cast<std::int32_t>(center));
      }
    }
    const std::vector<std::int32_t> members = this->membersOf(centers);
    std::vector<double> bounds;
    for (const std::int32_t member : members)
    {
      bounds.push_back(bounds_[static_cast<std::size_t>(member)]);
    }
    const PiecesNear pieces(groups_, members);
    const BlendSets sets(pieces, bounds, &centers);
    BlendRows rows(
      pieces, std::vector<char>(members.size(), 1), BlendRows::kMany, points_, gradient != nullptr);
    std::vector<std::size_t> winners(points_.size, 0);
    std::fill_n(value, points_.size, 0.0);
    for (std::size_t set = 0;
         set < sets.size() && sets[set].bound > *std::min_element(value, value + points_.size);
         ++set)
    {
      if (this->mayBeLarger(rows, sets[set], value))
      {
        const double* sum = rows.sum(sets[set].begin, sets[set].end);
        for (std::size_t k = 0; k < points_.size; ++k)
        {
          winners[k] = sum[k] > value[k] ? set : winners[k];
          value[k] = std::max(value[k], sum[k]);
        }
      }
    }
    if (gradient)
    {
      this->findGradients(rows, sets, winners, *gradient);
    }
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

  // Of the sum of one group at the points.
  double leastOf(std::int32_t center) const
  {
    ScratchArray value(points_.size);
    ownBlend(
      PiecesNear(groups_, this->membersOf({ center })), center, points_, value.data(), nullptr);
    return *std::min_element(value.data(), value.data() + points_.size);
  }

  // Of the sums of some groups, ascending.
  std::vector<std::int32_t> membersOf(const std::vector<std::int32_t>& centers) const
  {
    std::vector<char> isMember(groups_.size(), 0);
    for (const std::int32_t center : centers)
    {
      isMember[static_cast<std::size_t>(center)] = 1;
      for (const std::int32_t other : groups_.places.neighbours[static_cast<std::size_t>(center)])
      {
        isMember[static_cast<std::size_t>(other)] = 1;
      }
    }
    std::vector<std::int32_t> members;
    for (std::size_t group = 0; group < isMember.size(); ++group)
    {
      if (isMember[group])
      {
        members.push_back(static_cast<std::int32_t>(group));
      }
    }
    return members;
  }

  // Shares are at most 1.
  bool mayBeLarger(const BlendRows& rows, const BlendSets::Set& set, const double* best) const
  {
    ScratchArray sum(points_.size);
    std::fill_n(sum.data(), points_.size, 0.0);
    for (const std::size_t* member = set.begin; member != set.end; ++member)
    {
      const double* field = rows.field(*member);
      for (std::size_t k = 0; k < points_.size; ++k)
      {
        sum[k] += field[k];
      }
    }
    for (std::size_t k = 0; k < points_.size; ++k)
    {
      if (sum[k] > best[k])
      {
        return true;
      }
    }
    return false;
  }

  // Of the largest sums: set by set.
  void findGradients(BlendRows& rows, const BlendSets& sets,
    const std::vector<std::size_t>& winners, const VectorBatch& gradient) const
  {
    std::vector<std::size_t> winning = winners;
    std::sort(winning.begin(), winning.end());
    winning.erase(std::unique(winning.begin(), winning.end()), winning.end());
    for (const std::size_t set : winning)
    {
      rows.sum(sets[set].begin, sets[set].end);
      const VectorBatch slopes = rows.gradient();
      for (std::size_t k = 0; k < points_.size; ++k)
      {
        if (winners[k] == set)
        {
          gradient.set(k, slopes[k]);
        }
      }
    }
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

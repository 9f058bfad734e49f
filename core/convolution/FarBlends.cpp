// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/FarBlends.h"

#include "core/convolution/FarSums.h"

#include <algorithm>
#include <limits>

namespace hybridtree
{
namespace
{

Box3 boxOf(PointBatch points)
{
  Box3 box;
  for (std::size_t k = 0; k < points.size; ++k)
  {
    box.extend(points[k]);
  }
  return box;
}

// The largest sums at some points. Bounds of ever more work tell which sums may be the largest: of
// all fields in the box of the points, of those that are not yet known, and of the shares.
class FarMixer
{
public:
  FarMixer(const BlendGroups& groups, PointBatch points, double* value, const VectorBatch* gradient)
    : groups_(groups)
    , points_(points)
    , value_(value)
    , sums_(groups, points, gradient != nullptr)
    , winners_(points.size, 0)
  {
    std::fill_n(value, points.size, std::numeric_limits<double>::lowest());
    this->findBounds();
    this->findLargest();
    if (gradient)
    {
      this->findGradients(*gradient);
    }
  }

private:
  struct Center
  {
    std::int32_t group;
    double most; // of its sum
  };

  const FarGroup& group(std::int32_t number) const
  {
    return groups_.farGroups[static_cast<std::size_t>(number)];
  }

  void findBounds()
  {
    const Box3 box = boxOf(points_);
    for (const FarGroup& group : groups_.farGroups)
    {
      bounds_.push_back(this->mostInBox(group, box));
    }
    for (std::size_t center = 0; center < bounds_.size(); ++center)
    {
      double most = 0.0;
      for (const std::int32_t member : groups_.farGroups[center].members)
      {
        most += bounds_[static_cast<std::size_t>(member)];
      }
      centers_.push_back({ static_cast<std::int32_t>(center), most });
    }
  }

  double mostInBox(const FarGroup& group, const Box3& box) const
  {
    const double distance = group.bound.distanceTo(box);
    if (distance > group.bound.largestReach())
    {
      return group.bound.most(distance);
    }
    FieldBounds bounds;
    groups_.pieces.addBounds({ { group.segments.data(), group.segments.size() },
                               { group.triangles.data(), group.triangles.size() } },
      box, bounds);
    return bounds.value;
  }

  void findLargest()
  {
    // One sum says which others may be larger.
    this->tryOut(static_cast<std::int32_t>(
      std::max_element(bounds_.begin(), bounds_.end()) - bounds_.begin()));
    const double least = this->leastValue();
    centers_.erase(std::remove_if(centers_.begin(), centers_.end(),
                     [&](const Center& center) { return center.most <= least; }),
      centers_.end());
    std::sort(centers_.begin(), centers_.end(),
      [](const Center& a, const Center& b)
      { return a.most != b.most ? a.most > b.most : a.group < b.group; });
    for (std::size_t k = 0; k < centers_.size(); ++k)
    {
      const Center& center = centers_[k];
      if (!this->isLikeAnother(k) && center.most > this->leastValue() &&
        this->staysPossible(center.group) && this->isLarger(sums_.most(center.group)))
      {
        this->tryOut(center.group);
      }
    }
  }

  double leastValue() const { return *std::min_element(value_, value_ + points_.size); }

  // Members ascend in all sums, so those of the same have the same bound.
  bool isLikeAnother(std::size_t k) const
  {
    for (std::size_t before = k; before-- > 0 && centers_[before].most == centers_[k].most;)
    {
      if (this->group(centers_[before].group).members == this->group(centers_[k].group).members)
      {
        return true;
      }
    }
    return false;
  }

  bool isLarger(const double* sum) const
  {
    for (std::size_t k = 0; k < points_.size; ++k)
    {
      if (sum[k] > value_[k])
      {
        return true;
      }
    }
    return false;
  }

  // Integrates the members one after another, as long as it may. Shares are at most 1.
  bool staysPossible(std::int32_t center)
  {
    ScratchArray most(points_.size);
    double unknown = 0.0;
    std::fill_n(most.data(), points_.size, 0.0);
    const auto add = [&](std::int32_t member, double without)
    {
      const double* field = sums_.field(member);
      for (std::size_t k = 0; k < points_.size; ++k)
      {
        most[k] += field[k] - without;
      }
    };
    std::vector<std::int32_t> missing;
    for (const std::int32_t member : this->group(center).members)
    {
      if (sums_.isKnown(member))
      {
        add(member, 0.0);
      }
      else
      {
        missing.push_back(member);
        unknown += bounds_[static_cast<std::size_t>(member)];
      }
    }
    for (std::size_t k = 0; k < points_.size; ++k)
    {
      most[k] += unknown;
    }
    for (const std::int32_t member : missing)
    {
      if (!this->isLarger(most.data()))
      {
        return false;
      }
      add(member, bounds_[static_cast<std::size_t>(member)]);
    }
    return this->isLarger(most.data());
  }

  void tryOut(std::int32_t center)
  {
    const double* sum = sums_.sum(center);
    for (std::size_t k = 0; k < points_.size; ++k)
    {
      winners_[k] = sum[k] > value_[k] ? center : winners_[k];
      value_[k] = std::max(value_[k], sum[k]);
    }
  }

  // Sum by sum.
  void findGradients(const VectorBatch& gradient)
  {
    std::vector<std::int32_t> winning = winners_;
    std::sort(winning.begin(), winning.end());
    winning.erase(std::unique(winning.begin(), winning.end()), winning.end());
    for (const std::int32_t center : winning)
    {
      sums_.sum(center);
      const VectorBatch slopes = sums_.gradient();
      for (std::size_t k = 0; k < points_.size; ++k)
      {
        if (winners_[k] == center)
        {
          gradient.set(k, slopes[k]);
        }
      }
    }
  }

  const BlendGroups& groups_;
  PointBatch points_;
  double* value_;
  FarSums sums_;
  std::vector<std::int32_t> winners_;
  std::vector<double> bounds_; // per group: of its field
  std::vector<Center> centers_;
};

// mix(points, value, gradient) for parts of them.
template <typename Mix>
void forParts(PointBatch points, double* value, const VectorBatch* gradient, const Mix& mix)
{
  for (std::size_t begin = 0; begin < points.size; begin += FarSums::kMostPoints)
  {
    const std::size_t count = std::min(FarSums::kMostPoints, points.size - begin);
    const VectorBatch slopes = gradient ? gradient->slice(begin) : VectorBatch{};
    mix(points.slice(begin, count), value + begin, gradient ? &slopes : nullptr);
  }
}

} // namespace

void mixFarBlends(
  const BlendGroups& groups, PointBatch points, double* value, const VectorBatch* gradient)
{
  forParts(points, value, gradient,
    [&](PointBatch part, double* values, const VectorBatch* slopes)
    { FarMixer(groups, part, values, slopes); });
}

void ownFarBlend(const BlendGroups& groups, std::int32_t group, PointBatch points, double* value,
  const VectorBatch* gradient)
{
  forParts(points, value, gradient,
    [&](PointBatch part, double* values, const VectorBatch* slopes)
    {
      FarSums sums(groups, part, slopes != nullptr);
      std::copy_n(sums.sum(group), part.size, values);
      if (slopes)
      {
        const VectorBatch own = sums.gradient();
        for (std::size_t k = 0; k < part.size; ++k)
        {
          slopes->set(k, own[k]);
        }
      }
    });
}

} // namespace hybridtree

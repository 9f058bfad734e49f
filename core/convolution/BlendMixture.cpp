// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendMixture.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr std::size_t kFewGroups = 16; // of which one sum is found without what all are to another

} // namespace

BlendMixture::BlendMixture(PieceFields& fields, const std::vector<double>& bounds)
  : fields_(fields)
  , share_(fields.pieces().groups().control)
  , bounds_(bounds)
  , sets_(fields.pieces(), bounds)
  , points_(fields.points().size)
  , best_(points_)
  , total_(points_)
  , here_(points_)
  , distance_(points_)
  , near_(fields.pieces().groupCount() * points_)
  , all_(points_)
{
  std::fill_n(best_.data(), points_, 0.0);
  if (bounds.size() > kFewGroups)
  {
    this->findNearness();
  }
  for (std::size_t set = 0; set < sets_.size() && this->leastBest() < sets_[set].bound; ++set)
  {
    if (this->staysPossible(sets_[set]) && (set == 0 || this->mayBeBestByShares(sets_[set])))
    {
      this->tryOut(set);
    }
  }
}

double BlendMixture::leastBest() const
{
  return *std::min_element(best_.data(), best_.data() + points_);
}

void BlendMixture::clear(ScratchArray& row) const
{
  std::fill_n(row.data(), points_, 0.0);
}

void BlendMixture::add(const double* from, ScratchArray& row) const
{
  double* to = row.data();
  for (std::size_t k = 0; k < points_; ++k)
  {
    to[k] += from[k];
  }
}

// Shares are at most 1.
bool BlendMixture::mayBeBest(const BlendSets::Set& set)
{
  double unknown = 0.0;
  this->clear(total_);
  for (const std::size_t* member = set.begin; member != set.end; ++member)
  {
    if (!fields_.isKnown(*member))
    {
      unknown += bounds_[*member];
    }
    else
    {
      this->add(fields_.field(*member), total_);
    }
  }
  for (std::size_t k = 0; k < points_; ++k)
  {
    if (total_[k] + unknown > best_[k])
    {
      return true;
    }
  }
  return false;
}

// Integrates the members one after another, as long as it may.
bool BlendMixture::staysPossible(const BlendSets::Set& set)
{
  bool isPossible = this->mayBeBest(set);
  for (const std::size_t* member = set.begin; isPossible && member != set.end; ++member)
  {
    if (!fields_.isKnown(*member))
    {
      fields_.field(*member);
      isPossible = this->mayBeBest(set);
    }
  }
  return isPossible;
}

void BlendMixture::findNearness()
{
  fields_.findNearness(near_.data());
  isNearKnown_ = true;
  this->clear(all_);
  for (std::size_t number = 0; number < bounds_.size(); ++number)
  {
    this->add(fields_.field(number), all_);
  }
}

// All pieces are at least as near to a group as those of one set are.
bool BlendMixture::mayBeBestByShares(const BlendSets::Set& set)
{
  if (!isNearKnown_)
  {
    this->findNearness();
  }
  this->sumPlaces(set);
  this->clear(total_);
  for (const std::size_t* member = set.begin; member != set.end; ++member)
  {
    const double* own = fields_.field(*member);
    const double* near = near_.data() + *member * points_;
    for (std::size_t k = 0; k < points_; ++k)
    {
      if (own[k] > 0.0)
      {
        total_[k] += share_(share_.farthest() - near[k] / here_[k]) * own[k];
      }
    }
  }
  for (std::size_t k = 0; k < points_; ++k)
  {
    if (total_[k] > best_[k])
    {
      return true;
    }
  }
  return false;
}

void BlendMixture::sumPlaces(const BlendSets::Set& set)
{
  this->clear(here_);
  for (const std::size_t* place = set.begin; place != set.end; ++place)
  {
    this->add(fields_.field(*place), here_);
  }
}

void BlendMixture::findOthers(const BlendSets::Set& set)
{
  others_.clear();
  const std::size_t* next = set.begin;
  for (std::size_t number = 0; number < bounds_.size(); ++number)
  {
    if (next != set.end && *next == number)
    {
      ++next;
    }
    else if (bounds_[number] > 0.0)
    {
      others_.push_back(number);
    }
  }
}

// D of one member: from its set, or from all without the others, which are often few.
void BlendMixture::findDistance(const BlendSets::Set& set, std::size_t member)
{
  if (isNearKnown_ && others_.size() < static_cast<std::size_t>(set.end - set.begin))
  {
    const double* near = near_.data() + member * points_;
    for (std::size_t k = 0; k < points_; ++k)
    {
      distance_[k] = share_.farthest() * all_[k] - near[k];
    }
    for (const std::size_t other : others_)
    {
      const double* far = fields_.far(other, member);
      for (std::size_t k = 0; k < points_; ++k)
      {
        distance_[k] -= far[k];
      }
    }
  }
  else
  {
    this->clear(distance_);
    for (const std::size_t* place = set.begin; place != set.end; ++place)
    {
      if (*place != member)
      {
        this->add(fields_.far(*place, member), distance_);
      }
    }
  }
  for (std::size_t k = 0; k < points_; ++k)
  {
    distance_[k] = here_[k] > 0.0 ? distance_[k] / here_[k] : share_.farthest();
  }
}

void BlendMixture::tryOut(std::size_t set)
{
  const BlendSets::Set of = sets_[set];
  this->sumPlaces(of);
  this->findOthers(of);
  this->clear(total_);
  for (const std::size_t* member = of.begin; member != of.end; ++member)
  {
    const double* own = fields_.field(*member);
    this->findDistance(of, *member);
    for (std::size_t k = 0; k < points_; ++k)
    {
      total_[k] += share_(distance_[k]) * own[k];
    }
  }
  for (std::size_t k = 0; k < points_; ++k)
  {
    if (total_[k] > best_[k])
    {
      best_[k] = total_[k];
      winners_[k] = set;
    }
  }
}

// Of the pieces' gradients in that of the largest sum: with F the sum of f_c over the places, and
// s_j = f_j alpha'(D_j) / F,
//   grad G = sum of alpha(D_j) grad f_j + sum over places c of (sum of s_j (d(c, j) - D_j)) grad
//   f_c.
class BlendMixture::Weights
{
public:
  Weights(BlendMixture& mixture, const std::vector<std::size_t>& some)
    : fields_(mixture.fields_)
    , groups_(fields_.pieces().groupCount())
    , points_(some.size())
    , shares_(groups_ * points_)
    , steps_(groups_ * points_)
    , isPlace_(groups_ * points_)
    , shift_(points_)
  {
    for (ScratchArray* array : { &shares_, &steps_, &isPlace_, &shift_ })
    {
      std::fill_n(array->data(), array->size(), 0.0);
    }
    for (std::size_t k = 0; k < points_; ++k)
    {
      if (mixture.best_[some[k]] > 0.0)
      {
        this->addSum(mixture, some[k], k);
      }
    }
  }

  /// Of a piece of a group, per point. False: all 0.
  bool find(std::size_t group, std::size_t piece, double* weight)
  {
    const double* isPlace = this->row(isPlace_, group);
    std::copy_n(this->row(shares_, group), points_, weight);
    for (std::size_t k = 0; k < points_; ++k)
    {
      weight[k] -= isPlace[k] * shift_[k];
    }
    const double* distances = fields_.distances(piece);
    for (const std::size_t other : varying_)
    {
      const double* steps = this->row(steps_, other);
      for (std::size_t k = 0; k < points_; ++k)
      {
        weight[k] += isPlace[k] * distances[other] * steps[k];
      }
    }
    return std::any_of(weight, weight + points_, [](double w) { return w != 0.0; });
  }
  bool isUsed(std::size_t group)
  {
    const auto isSet = [](double x) { return x != 0.0; };
    const double* shares = this->row(shares_, group);
    const double* isPlace = this->row(isPlace_, group);
    return std::any_of(shares, shares + points_, isSet) ||
      std::any_of(isPlace, isPlace + points_, isSet);
  }

private:
  double* row(ScratchArray& rows, std::size_t group) { return rows.data() + group * points_; }

  // The point has the place `at` among all, `k` among those wanted.
  void addSum(BlendMixture& mixture, std::size_t at, std::size_t k)
  {
    const BlendSets::Set set = mixture.sets_[mixture.winners_[at]];
    double here = 0.0;
    for (const std::size_t* place = set.begin; place != set.end; ++place)
    {
      here += fields_.field(*place)[at];
      this->row(isPlace_, *place)[k] = 1.0;
    }
    for (const std::size_t* member = set.begin; member != set.end; ++member)
    {
      double distance = 0.0;
      for (const std::size_t* place = set.begin; place != set.end; ++place)
      {
        distance += *place == *member ? 0.0 : fields_.far(*place, *member)[at];
      }
      distance /= here;
      const double own = fields_.field(*member)[at];
      this->row(shares_, *member)[k] = mixture.share_(distance);
      const double step = own * mixture.share_.slope(distance) / here;
      if (step != 0.0)
      {
        this->row(steps_, *member)[k] = step;
        shift_[k] += step * distance;
        varying_.push_back(*member);
        std::inplace_merge(varying_.begin(), varying_.end() - 1, varying_.end());
        varying_.erase(std::unique(varying_.begin(), varying_.end()), varying_.end());
      }
    }
  }

  PieceFields& fields_;
  std::size_t groups_;
  std::size_t points_;
  ScratchArray shares_;              // per group: alpha
  ScratchArray steps_;               // per group: s_j
  ScratchArray isPlace_;             // per group: 1 or 0
  ScratchArray shift_;               // sum of s_j D_j
  std::vector<std::size_t> varying_; // groups with any s_j, ascending
};

void BlendMixture::findGradients(const std::vector<std::size_t>& some, const VectorBatch& gradient)
{
  const std::size_t count = some.size();
  Weights weights(*this, some);
  ScratchVectors at(count);
  ScratchArray weight(count);
  ScratchArray rows(8 * count);
  std::fill_n(rows.data(), rows.size(), 0.0);
  double* total = rows.data() + 4 * count;
  for (std::size_t k = 0; k < count; ++k)
  {
    at.batch().set(k, fields_.points()[some[k]]);
  }
  const PiecesNear& pieces = fields_.pieces();
  for (std::size_t group = 0; group < pieces.groupCount(); ++group)
  {
    if (!weights.isUsed(group))
    {
      continue;
    }
    for (std::size_t piece = pieces.begin(group); piece < pieces.end(group); ++piece)
    {
      if (!weights.find(group, piece, weight.data()))
      {
        continue;
      }
      std::fill_n(rows.data(), 4 * count, 0.0);
      const auto row = [&](std::size_t k) { return rows.data() + k * count; };
      fields_.addFieldAndGradient(piece, at.points(), row(0), { row(1), row(2), row(3) });
      for (std::size_t axis = 1; axis < 4; ++axis)
      {
        for (std::size_t k = 0; k < count; ++k)
        {
          total[axis * count + k] += weight[k] * row(axis)[k];
        }
      }
    }
  }
  for (std::size_t k = 0; k < count; ++k)
  {
    gradient.set(some[k], { total[count + k], total[2 * count + k], total[3 * count + k] });
  }
}

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendSets.h"

#include <algorithm>
#include <numeric>

namespace hybridtree
{
namespace
{

// Per center i the members of its sum, as bits.
class Candidates
{
public:
  Candidates(const PiecesNear& pieces, const std::vector<double>& bounds)
    : pieces_(pieces)
    , groups_(pieces.groups())
    , words_((bounds.size() + 63) / 64)
    , centers_(groups_.size(), GroupNumbers::kCenters)
  {
    for (std::size_t number = 0; number < bounds.size(); ++number)
    {
      if (bounds[number] > 0.0)
      {
        this->addMember(number, bounds);
      }
    }
  }

  std::size_t size() const { return bounds_.size(); }
  double bound(std::size_t center) const { return bounds_[center]; }
  std::int32_t group(std::size_t center) const { return centers_.group(center); }
  const std::uint64_t* bits(std::size_t center) const { return bits_.data() + center * words_; }
  std::size_t words() const { return words_; }

private:
  void addCenter(std::int32_t group)
  {
    if (centers_.add(group) == bounds_.size())
    {
      bounds_.push_back(0.0);
      bits_.resize(bits_.size() + words_, 0);
    }
  }

  void addMember(std::size_t number, const std::vector<double>& bounds)
  {
    const auto add = [&](std::int32_t center)
    {
      this->addCenter(center);
      const auto at = static_cast<std::size_t>(centers_.find(center));
      bits_[at * words_ + number / 64] |= std::uint64_t(1) << (number % 64);
      // Members ascend in all sets, so equal sets have equal bounds.
      bounds_[at] += bounds[number];
    };
    const std::int32_t group = pieces_.group(number);
    add(group);
    const auto& others = groups_.places.neighbours[static_cast<std::size_t>(group)];
    std::for_each(others.begin(), others.end(), add);
  }

  const PiecesNear& pieces_;
  const BlendGroups& groups_;
  std::size_t words_;
  GroupNumbers centers_;
  std::vector<double> bounds_;
  std::vector<std::uint64_t> bits_;
};

} // namespace

BlendSets::BlendSets(const PiecesNear& pieces, const std::vector<double>& bounds)
{
  const Candidates candidates(pieces, bounds);
  const std::size_t words = candidates.words();
  std::vector<std::size_t> order(candidates.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
    [&](std::size_t a, std::size_t b)
    {
      return candidates.bound(a) != candidates.bound(b)
        ? candidates.bound(a) > candidates.bound(b)
        : std::lexicographical_compare(candidates.bits(a), candidates.bits(a) + words,
            candidates.bits(b), candidates.bits(b) + words);
    });
  order.erase(
    std::unique(order.begin(), order.end(),
      [&](std::size_t a, std::size_t b)
      { return std::equal(candidates.bits(a), candidates.bits(a) + words, candidates.bits(b)); }),
    order.end());
  for (const std::size_t candidate : order)
  {
    Range range{ members_.size(), 0, candidates.bound(candidate) };
    for (std::size_t number = 0; number < bounds.size(); ++number)
    {
      if (candidates.bits(candidate)[number / 64] >> (number % 64) & 1)
      {
        members_.push_back(number);
      }
    }
    range.end = members_.size();
    ranges_.push_back(range);
  }
}

BlendSets::Set BlendSets::operator[](std::size_t k) const
{
  const Range& range = ranges_[k];
  return { members_.data() + range.begin, members_.data() + range.end, range.bound };
}

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#include "core/convolution/BlendSets.h"

#include <algorithm>

namespace hybridtree
{

BlendSets::BlendSets(const PiecesNear& pieces, const std::vector<double>& bounds)
{
  const BlendGroups& groups = pieces.groups();
  const bool isPaper = groups.control.kind == BlendingKind::Paper;
  std::vector<std::int32_t> centers;
  for (std::size_t number = 0; number < bounds.size(); ++number)
  {
    if (bounds[number] > 0.0)
    {
      const std::int32_t group = pieces.group(number);
      centers.push_back(group);
      if (!isPaper)
      {
        const auto& others = groups.places.neighbours[static_cast<std::size_t>(group)];
        centers.insert(centers.end(), others.begin(), others.end());
      }
    }
  }
  std::sort(centers.begin(), centers.end());
  centers.erase(std::unique(centers.begin(), centers.end()), centers.end());
  for (const std::int32_t group : centers)
  {
    this->add(pieces, bounds, group);
  }
  const auto at = [&](std::size_t k) { return members_.begin() + std::ptrdiff_t(k); };
  std::sort(order_.begin(), order_.end(),
    [&](const Range& a, const Range& b)
    {
      return a.bound != b.bound
        ? a.bound > b.bound
        : std::lexicographical_compare(at(a.begin), at(a.end), at(b.begin), at(b.end));
    });
  if (!isPaper)
  {
    order_.erase(std::unique(order_.begin(), order_.end(),
                   [&](const Range& a, const Range& b)
                   { return std::equal(at(a.begin), at(a.end), at(b.begin), at(b.end)); }),
      order_.end());
  }
}

void BlendSets::add(const PiecesNear& pieces, const std::vector<double>& bounds, std::int32_t group)
{
  Range range{ members_.size(), 0, 0, 0.0 };
  const auto addMember = [&](std::int32_t member)
  {
    const std::int32_t number = pieces.find(member);
    if (number >= 0 && bounds[static_cast<std::size_t>(number)] > 0.0)
    {
      members_.push_back(static_cast<std::size_t>(number));
    }
  };
  addMember(group);
  range.center = members_.size() > range.begin ? members_.back() : 0;
  for (const std::int32_t other :
    pieces.groups().places.neighbours[static_cast<std::size_t>(group)])
  {
    addMember(other);
  }
  const auto begin = members_.begin() + std::ptrdiff_t(range.begin);
  std::sort(begin, members_.end());
  // One order for all sets, so equal sets have equal bounds.
  std::for_each(begin, members_.end(), [&](std::size_t number) { range.bound += bounds[number]; });
  range.end = members_.size();
  order_.push_back(range);
}

BlendSets::Set BlendSets::operator[](std::size_t k) const
{
  const Range& range = order_[k];
  return { members_.data() + range.begin, members_.data() + range.end, range.center, range.bound };
}

} // namespace hybridtree

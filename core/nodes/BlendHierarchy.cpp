// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BlendHierarchy.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGroupSize = 4;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

float roundedDown(double value)
{
  const float nearest = static_cast<float>(std::clamp(value, -3e38, 3e38));
  return static_cast<double>(nearest) <= value && std::abs(value) < 3e38
    ? nearest
    : std::nextafter(std::abs(value) < 3e38 ? nearest : -kInfinity, -kInfinity);
}

float roundedUp(double value)
{
  return -roundedDown(-value);
}

/// Numbers rise as the doubles do, and differ at the higher places the further apart these are.
std::uint64_t orderedBits(double value)
{
  std::uint64_t bits;
  value += 0.0; // -0 is 0
  std::memcpy(&bits, &value, sizeof bits);
  constexpr std::uint64_t kSign = std::uint64_t(1) << 63;
  return (bits & kSign) != 0 ? ~bits : bits | kSign;
}

/// Before one another along a curve that fills space (Morton's order): by the axis that differs at
/// the highest binary place. It is told by the two boxes alone.
bool isBefore(const Box3& a, const Box3& b)
{
  const Vec3 centerA = a.center();
  const Vec3 centerB = b.center();
  std::uint64_t highest = 0;
  bool before = false;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::uint64_t bitsA = orderedBits(centerA[axis]);
    const std::uint64_t bitsB = orderedBits(centerB[axis]);
    const std::uint64_t differing = bitsA ^ bitsB;
    // Whether its highest place is above that of the highest so far.
    if (highest < differing && highest < (highest ^ differing))
    {
      highest = differing;
      before = bitsA < bitsB;
    }
  }
  return before;
}

} // namespace

BlendHierarchy::BlendHierarchy(std::vector<Term> terms)
{
  std::vector<std::pair<Box3, Term>> items;
  items.reserve(terms.size());
  Box3 all;
  for (const Term& term : terms)
  {
    const Box3 box = term.node->influenceBounds();
    if (!box.isEmpty()) // a field of 0 adds nothing
    {
      items.emplace_back(box, term);
      all.extend(box);
    }
  }
  if (items.empty())
  {
    return;
  }
  origin_ = all.center();
  std::sort(items.begin(), items.end(),
    [](const auto& a, const auto& b)
    {
      return isBefore(a.first, b.first) ||
        (!isBefore(b.first, a.first) && a.second.firstLeaf < b.second.firstLeaf);
    });
  terms_.reserve(items.size());
  this->build(items, 0, items.size());
  groups_.shrink_to_fit();
}

BlendHierarchy::FloatBox BlendHierarchy::rounded(const Box3& box) const
{
  FloatBox result;
  for (int axis = 0; axis < 3; ++axis)
  {
    // The subtraction rounds too, by less than the float does: one more step outward pays for it.
    result.min[axis] = std::nextafter(roundedDown(box.min()[axis] - origin_[axis]), -kInfinity);
    result.max[axis] = std::nextafter(roundedUp(box.max()[axis] - origin_[axis]), kInfinity);
  }
  return result;
}

void BlendHierarchy::build(
  const std::vector<std::pair<Box3, Term>>& items, std::size_t begin, std::size_t end)
{
  Box3 bounds;
  for (std::size_t k = begin; k < end; ++k)
  {
    bounds.extend(items[k].first);
  }
  const std::size_t index = groups_.size();
  groups_.push_back({ this->rounded(bounds), static_cast<std::uint32_t>(terms_.size()), 0, 0 });
  if (end - begin <= kGroupSize)
  {
    for (std::size_t k = begin; k < end; ++k)
    {
      terms_.push_back(items[k].second);
    }
    groups_[index].count = static_cast<std::uint32_t>(end - begin);
  }
  else
  {
    const std::size_t middle = begin + (end - begin) / 2;
    this->build(items, begin, middle);
    this->build(items, middle, end);
  }
  groups_[index].next = static_cast<std::uint32_t>(groups_.size());
}

} // namespace hybridtree

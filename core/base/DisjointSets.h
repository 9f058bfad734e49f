// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace hybridtree
{

/// Disjoint sets over 0 .. size - 1; the smallest member stands for its set.
class DisjointSets
{
public:
  explicit DisjointSets(std::size_t size) : parent_(size)
  {
    std::iota(parent_.begin(), parent_.end(), std::uint32_t(0));
  }

  std::uint32_t find(std::uint32_t member)
  {
    while (parent_[member] != member)
    {
      parent_[member] = parent_[parent_[member]];
      member = parent_[member];
    }
    return member;
  }

  void join(std::uint32_t a, std::uint32_t b)
  {
    a = this->find(a);
    b = this->find(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<std::uint32_t> parent_;
};

} // namespace hybridtree

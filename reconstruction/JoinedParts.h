// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace hybridtree
{

/// What the parts of a parallel loop have found, one after the other.
template <typename Item>
std::vector<Item> joined(const std::vector<std::vector<Item>>& parts)
{
  std::vector<Item> all;
  for (const std::vector<Item>& part : parts)
  {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Parallel.h"
#include "core/base/Progress.h"

#include <cstddef>
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

/// What a parallel loop finds, in the order of its range for any number of threads.
/// \param collect is given begin and end of a part of [0, count) and the items of that part.
/// \throws Cancelled.
template <typename Item, typename Collect>
std::vector<Item> collectInParts(
  std::size_t count, std::size_t grain, const Progress& progress, const Collect& collect)
{
  std::vector<std::vector<Item>> parts((count + grain - 1) / grain);
  parallelFor(count, grain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      collect(begin, end, parts[begin / grain]);
    });
  return joined(parts);
}

} // namespace hybridtree

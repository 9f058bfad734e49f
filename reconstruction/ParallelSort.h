// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Parallel.h"
#include "core/base/Progress.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace hybridtree
{

/// Sorts on all threads, and looks at whether to go on at least once in some milliseconds. The same
/// result for any number of threads if no two items are equal.
/// \throws Cancelled, with the items in any order.
template <typename Item>
void parallelSort(std::vector<Item>& items, const Progress& progress)
{
  constexpr std::size_t kBlock = 65536;
  const std::size_t count = items.size();
  const auto at = [&](std::size_t k)
  { return items.begin() + static_cast<std::ptrdiff_t>(std::min(k, count)); };
  parallelFor(count, kBlock,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      std::sort(at(begin), at(end));
    });
  std::vector<Item> merged(count);
  for (std::size_t width = kBlock; width < count; width *= 2)
  {
    parallelFor((count + 2 * width - 1) / (2 * width), 1,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t pair = begin; pair < end; ++pair)
        {
          progress.check();
          const std::size_t first = 2 * width * pair;
          std::merge(at(first), at(first + width), at(first + width), at(first + 2 * width),
            merged.begin() + static_cast<std::ptrdiff_t>(first));
        }
      });
    items.swap(merged);
  }
}

} // namespace hybridtree

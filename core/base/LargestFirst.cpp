// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/LargestFirst.h"

#include "core/base/Parallel.h"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace hybridtree
{

void forLargestFirst(
  const std::vector<std::size_t>& sizes, const std::function<void(std::size_t)>& body)
{
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(
    order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return sizes[a] > sizes[b]; });
  std::atomic<std::size_t> next{ 0 };
  // A thread takes the next task when it is done with one: ranges that are halved, as in a plain
  // parallel loop, would give the largest ones all to the same thread.
  const std::size_t threads = std::min(order.size(), static_cast<std::size_t>(threadCount()));
  parallelFor(threads, 1,
    [&](std::size_t, std::size_t)
    {
      try
      {
        for (std::size_t k = next++; k < order.size(); k = next++)
        {
          body(order[k]);
        }
      }
      catch (...)
      {
        next = order.size();
        throw;
      }
    });
}

} // namespace hybridtree

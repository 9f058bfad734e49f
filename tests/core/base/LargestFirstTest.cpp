// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/LargestFirst.h"

#include "core/base/Parallel.h"
#include "tests/support/Random.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>

namespace hybridtree
{
namespace
{

std::vector<std::size_t> randomSizes(std::size_t count)
{
  test::Random random(3);
  std::vector<std::size_t> sizes(count);
  for (std::size_t& size : sizes)
  {
    size = static_cast<std::size_t>(random.integer(0, 5));
  }
  return sizes;
}

TEST(LargestFirst, EachIsDoneOnceByAnyNumberOfThreads)
{
  for (const int threads : { 1, 2, 5 })
  {
    setThreadCount(threads);
    for (const std::size_t count : { 0u, 1u, 3u, 200u })
    {
      std::vector<std::atomic<int>> done(count);
      forLargestFirst(randomSizes(count), [&](std::size_t k) { ++done[k]; });
      for (const std::atomic<int>& times : done)
      {
        EXPECT_EQ(times, 1);
      }
    }
  }
  setThreadCount(0);
}

TEST(LargestFirst, OneThreadTakesThemBySizeAndEqualOnesInTurn)
{
  setThreadCount(1);
  std::vector<std::size_t> order;
  forLargestFirst({ 2, 7, 7, 1, 9 }, [&](std::size_t k) { order.push_back(k); });
  setThreadCount(0);
  EXPECT_EQ(order, (std::vector<std::size_t>{ 4, 1, 2, 0, 3 }));
}

TEST(LargestFirst, AnExceptionStopsTheLoopAndComesOut)
{
  for (const int threads : { 1, 3 })
  {
    setThreadCount(threads);
    std::atomic<int> done{ 0 };
    EXPECT_THROW(forLargestFirst(std::vector<std::size_t>(100000, 1),
                   [&](std::size_t)
                   {
                     if (++done == 10)
                     {
                       throw std::runtime_error("enough");
                     }
                   }),
      std::runtime_error);
    EXPECT_LT(done, 100000);
  }
  setThreadCount(0);
}

} // namespace
} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#include "core/base/Parallel.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <thread>

namespace hybridtree
{
namespace
{

int defaultThreadCount()
{
  const char* text = std::getenv("VTK_SMP_MAX_THREADS");
  const int wanted = text ? std::atoi(text) : 0;
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return wanted > 0 ? std::min(wanted, cores) : cores;
}

struct Arena
{
  std::mutex mutex;
  std::shared_ptr<tbb::task_arena> arena;
  int count = 0;

  std::shared_ptr<tbb::task_arena> get()
  {
    const std::lock_guard<std::mutex> lock(mutex);
    if (!arena)
    {
      count = defaultThreadCount();
      arena = std::make_shared<tbb::task_arena>(count);
    }
    return arena;
  }
};

Arena& arena()
{
  static Arena instance;
  return instance;
}

} // namespace

int threadCount()
{
  arena().get();
  return arena().count;
}

void setThreadCount(int count)
{
  const std::lock_guard<std::mutex> lock(arena().mutex);
  arena().count = count > 0 ? count : defaultThreadCount();
  arena().arena = std::make_shared<tbb::task_arena>(arena().count);
}

void parallelFor(
  std::size_t count, std::size_t grain, const std::function<void(std::size_t, std::size_t)>& body)
{
  grain = std::max<std::size_t>(1, grain);
  const std::size_t parts = (count + grain - 1) / grain;
  const auto part = [&](std::size_t index)
  { body(index * grain, std::min(count, (index + 1) * grain)); };
  if (parts <= 1 || threadCount() == 1)
  {
    for (std::size_t index = 0; index < parts; ++index)
    {
      part(index);
    }
    return;
  }
  // Isolated: while it waits, a thread that may hold a node's mutex must not pick up foreign work that
  // asks for the same mutex.
  arena().get()->execute(
    [&]
    {
      tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t(0), parts, part); });
    });
}

} // namespace hybridtree

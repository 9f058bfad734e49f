// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace hybridtree
{

/// Threads that parallel loops use: VTK_SMP_MAX_THREADS if set to a positive number, else all cores.
/// Read once, at the first parallel loop.
int threadCount();

/// For tests and benchmarks: replaces the number of threads from here on; 0 returns to the default.
void setThreadCount(int count);

/// Calls body(begin, end) on disjoint parts of [0, count), in parallel, each of at least `grain`
/// elements but the last. The parts are the same whatever the number of threads when `grain` is
/// given by the caller from the data alone: a body whose result depends only on its part gives the
/// same bytes for any number of threads. An exception in a body stops the loop and comes out.
void parallelFor(std::size_t count, std::size_t grain,
  const std::function<void(std::size_t, std::size_t)>& body);

} // namespace hybridtree

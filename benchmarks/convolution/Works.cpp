// SPDX-License-Identifier: BSD-3-Clause
#include "benchmarks/convolution/Works.h"

#include <algorithm>
#include <time.h>

namespace hybridtree::test
{
namespace
{

// Of the processor, of this thread alone.
double threadSeconds()
{
  timespec now;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return double(now.tv_sec) + 1e-9 * double(now.tv_nsec);
}

} // namespace

std::vector<double> times(const std::vector<Work>& works, int rounds)
{
  std::vector<std::vector<double>> seconds(works.size());
  for (int round = -1; round < rounds; ++round)
  {
    for (std::size_t k = 0; k < works.size(); ++k)
    {
      const double start = threadSeconds();
      works[k]();
      const double end = threadSeconds();
      if (round >= 0)
      {
        seconds[k].push_back(end - start);
      }
    }
  }
  std::vector<double> medians;
  for (std::vector<double>& of : seconds)
  {
    std::nth_element(of.begin(), of.begin() + of.size() / 2, of.end());
    medians.push_back(of[of.size() / 2]);
  }
  return medians;
}

NodePtr skeleton(const SkeletonGraph& graph, int level, KernelKind kernel, BlendingKind blending)
{
  SubdivisionSkeletonOptions options;
  options.level = level;
  options.kernel.kind = kernel;
  options.blending.kind = blending;
  return makeSubdivisionSkeleton(graph, options);
}

} // namespace hybridtree::test

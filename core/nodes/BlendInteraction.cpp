// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/BlendInteraction.h"

#include <algorithm>

namespace hybridtree
{

bool SumInteraction::marks(
  const std::vector<MarkTerm>& terms, const std::vector<int>& present) const
{
  const auto isPositive = [&](int k) { return !terms[k].node->isNegative(); };
  const auto givesUp = [&](int k) { return isPositive(k) && !terms[k].kept; };
  return present.size() > 1 ? std::any_of(present.begin(), present.end(), isPositive)
                            : present.size() == 1 && givesUp(present.front());
}

Interval SumInteraction::range(const std::vector<int>&, const std::vector<Interval>& ranges) const
{
  Interval sum;
  for (const Interval& range : ranges)
  {
    sum = sum + range;
  }
  return sum;
}

bool LocalInteraction::marks(
  const std::vector<MarkTerm>& terms, const std::vector<int>& present) const
{
  bool has[4] = {};
  for (const int k : present)
  {
    has[k] = true;
  }
  return (has[0] && has[1] && has[2]) || (has[3] && !terms[3].kept);
}

Interval LocalInteraction::range(
  const std::vector<int>& present, const std::vector<Interval>& ranges) const
{
  // Between the least of the union, and the sum.
  Interval all{ 0.0, 0.0 };
  for (std::size_t k = 0; k < present.size(); ++k)
  {
    if (present[k] != 2)
    {
      all = { all.min + std::min(ranges[k].min, 0.0), all.max + std::max(ranges[k].max, 0.0) };
    }
  }
  return all;
}

} // namespace hybridtree

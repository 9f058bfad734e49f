// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/convolution/GroupedElements.h"

namespace hybridtree
{

/// How far a point of the skeleton is from a group along segments and the edges of triangles, a
/// length counting in units of R there.
struct GroupDistance
{
  std::int32_t group;
  double distance;
};

/// Per point, ascending by group: every group within `limit`, and those that an edge from a point
/// within the limit leads to.
std::vector<std::vector<GroupDistance>> groupDistances(
  const GroupedElements& elements, double limit);

} // namespace hybridtree

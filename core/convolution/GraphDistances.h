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

/// Counts distances that are kept, so that a skeleton of too many is refused before memory ends.
class DistanceCount
{
public:
  /// \throws TooLarge
  void add(std::size_t distances);

private:
  std::size_t count_ = 0;
};

/// Refuses what would clearly be too many, from a sample of the groups, before any are kept.
/// \param piecesAt per point: its part of the pieces, cut from the elements at it, that keep their
/// distances from groups (BlendPieces.h). \throws TooLarge
void requireFewDistances(
  const GroupedElements& elements, double limit, const std::vector<double>& piecesAt);

/// Per point, ascending by group: every group within `limit`, and those that an edge from a point
/// within the limit leads to. \throws TooLarge
std::vector<std::vector<GroupDistance>> groupDistances(
  const GroupedElements& elements, double limit);

} // namespace hybridtree

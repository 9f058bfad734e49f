// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Scratch.h"
#include "core/nodes/Node.h"

#include <algorithm>
#include <array>

namespace hybridtree
{

/// Side of the surface of a field value; 0 within rounding of the threshold.
inline std::int8_t sideOf(double field)
{
  constexpr double kRounding = 1e-14;
  return field > kThreshold + kRounding ? 1 : field < kThreshold - kRounding ? -1 : 0;
}

/// Gathers the points k with chosen(k) and hands them on in parts: body(PointBatch, index), where
/// index[i] says which point the i-th of the part was.
template <typename Chosen, typename Body>
void forPointsWhere(PointBatch points, Chosen&& chosen, Body&& body)
{
  constexpr std::size_t kPart = 256;
  std::array<std::size_t, kPart> index;
  ScratchVectors gathered(std::min(kPart, points.size));
  const VectorBatch to = gathered.batch();
  std::size_t count = 0;
  const auto flush = [&]
  {
    body(PointBatch{ to.x, to.y, to.z, count }, index.data());
    count = 0;
  };
  for (std::size_t k = 0; k < points.size; ++k)
  {
    if (chosen(k))
    {
      to.set(count, points[k]);
      index[count] = k;
      if (++count == kPart)
      {
        flush();
      }
    }
  }
  if (count > 0)
  {
    flush();
  }
}

/// side[k] = the node's membership at the points with chosen(k), and nothing at the others.
template <typename Chosen>
void membershipWhere(const Node& node, PointBatch points, Chosen&& chosen, std::int8_t* side)
{
  forPointsWhere(points, chosen,
    [&](PointBatch part, const std::size_t* index)
    {
      std::array<std::int8_t, 256> answer;
      node.membership(part, answer.data());
      for (std::size_t i = 0; i < part.size; ++i)
      {
        side[index[i]] = answer[i];
      }
    });
}

/// leaf[k] = firstLeaf + the node's source leaf at the points with chosen(k), -1 staying -1, and
/// nothing at the others.
template <typename Chosen>
void sourceLeafWhere(
  const Node& node, PointBatch points, Chosen&& chosen, std::int32_t firstLeaf, std::int32_t* leaf)
{
  forPointsWhere(points, chosen,
    [&](PointBatch part, const std::size_t* index)
    {
      std::array<std::int32_t, 256> answer;
      node.sourceLeaf(part, answer.data());
      for (std::size_t i = 0; i < part.size; ++i)
      {
        leaf[index[i]] = answer[i] < 0 ? -1 : firstLeaf + answer[i];
      }
    });
}

} // namespace hybridtree

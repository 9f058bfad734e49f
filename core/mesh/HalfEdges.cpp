// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/HalfEdges.h"

#include <algorithm>
#include <utility>

namespace hybridtree
{
namespace
{

struct Keyed
{
  std::uint64_t edge; // smaller vertex, larger vertex
  std::int32_t half;
};

std::int32_t origin(const std::vector<Triangle>& triangles, std::int32_t half)
{
  return triangles[std::size_t(half / 3)][std::size_t(half % 3)];
}

// All half-edges, those of one edge side by side and in order. Bucketed by the smaller vertex
// (counting sort), because comparing sorts of millions of keys are slow.
std::vector<Keyed> byEdge(const std::vector<Triangle>& triangles)
{
  std::int32_t last = -1;
  for (const Triangle& corner : triangles)
  {
    last = std::max({ last, corner[0], corner[1], corner[2] });
  }
  std::vector<std::int32_t> begin(std::size_t(last + 2), 0);
  const auto ends = [](const Triangle& corner, std::size_t k)
  { return std::minmax(corner[k], corner[(k + 1) % 3]); };
  for (const Triangle& corner : triangles)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      ++begin[std::size_t(std::min(corner[k], corner[(k + 1) % 3])) + 1];
    }
  }
  for (std::size_t v = 1; v < begin.size(); ++v)
  {
    begin[v] += begin[v - 1];
  }
  std::vector<Keyed> keyed(3 * triangles.size());
  std::vector<std::int32_t> next(begin.begin(), begin.end() - (begin.empty() ? 0 : 1));
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    for (std::size_t k = 0; k < 3; ++k)
    {
      const auto [low, high] = ends(triangles[t], k);
      const std::uint64_t edge = std::uint64_t(low) << 32 | std::uint64_t(high);
      keyed[std::size_t(next[std::size_t(low)]++)] = { edge, std::int32_t(3 * t + k) };
    }
  }
  for (std::size_t v = 0; v + 1 < begin.size(); ++v)
  {
    std::sort(keyed.begin() + begin[v], keyed.begin() + begin[v + 1],
      [](const Keyed& a, const Keyed& b)
      { return a.edge != b.edge ? a.edge < b.edge : a.half < b.half; });
  }
  return keyed;
}

} // namespace

HalfEdges halfEdges(const std::vector<Triangle>& triangles)
{
  HalfEdges result;
  result.opposite.assign(3 * triangles.size(), HalfEdges::kOpen);
  const std::vector<Keyed> keyed = byEdge(triangles);
  for (std::size_t begin = 0, end = 0; begin < keyed.size(); begin = end)
  {
    while (end < keyed.size() && keyed[end].edge == keyed[begin].edge)
    {
      ++end;
    }
    const std::int32_t first = keyed[begin].half;
    if (end - begin == 1)
    {
      ++result.openEdges;
    }
    else if (end - begin == 2)
    {
      const std::int32_t second = keyed[begin + 1].half;
      result.opposite[std::size_t(first)] = second;
      result.opposite[std::size_t(second)] = first;
      result.flippedEdges += origin(triangles, first) == origin(triangles, second);
    }
    else
    {
      ++result.nonManifoldEdges;
      for (std::size_t k = begin; k < end; ++k)
      {
        result.opposite[std::size_t(keyed[k].half)] = HalfEdges::kNonManifold;
      }
    }
  }
  return result;
}

} // namespace hybridtree

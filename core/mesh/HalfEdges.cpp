// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/HalfEdges.h"

#include "core/base/Parallel.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 4096;

/// A half-edge among those of the same smaller vertex.
struct Keyed
{
  std::int32_t high; ///< the larger vertex
  std::int32_t half;
};

struct Counts
{
  std::size_t open = 0;
  std::size_t flipped = 0;
  std::size_t nonManifold = 0;
};

std::int32_t origin(const std::vector<Triangle>& triangles, std::int32_t half)
{
  return triangles[std::size_t(half / 3)][std::size_t(half % 3)];
}

/// All half-edges in buckets by their smaller vertex (counting sort), because comparing sorts of
/// millions of keys are slow.
struct Buckets
{
  explicit Buckets(const std::vector<Triangle>& triangles)
  {
    std::int32_t last = -1;
    for (const Triangle& corner : triangles)
    {
      last = std::max({ last, corner[0], corner[1], corner[2] });
    }
    begin.resize(std::size_t(last + 2), 0);
    const auto lowOf = [](const Triangle& corner, std::size_t k)
    { return std::size_t(std::min(corner[k], corner[(k + 1) % 3])); };
    for (const Triangle& corner : triangles)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        ++begin[lowOf(corner, k) + 1];
      }
    }
    for (std::size_t v = 1; v < begin.size(); ++v)
    {
      begin[v] += begin[v - 1];
    }
    keyed.resize(3 * triangles.size());
    std::vector<std::int32_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t t = 0; t < triangles.size(); ++t)
    {
      for (std::size_t k = 0; k < 3; ++k)
      {
        const std::int32_t high = std::max(triangles[t][k], triangles[t][(k + 1) % 3]);
        keyed[std::size_t(next[lowOf(triangles[t], k)]++)] = { high, std::int32_t(3 * t + k) };
      }
    }
  }

  std::size_t size() const { return begin.size() - 1; }

  std::vector<std::int32_t> begin; ///< of each vertex and of none
  std::vector<Keyed> keyed;
};

/// Finds the neighbours within a bucket, where those of one edge are brought side by side.
void pair(const std::vector<Triangle>& triangles, Keyed* first, Keyed* last,
  std::vector<std::int32_t>& opposite, Counts& counts)
{
  std::sort(first, last,
    [](const Keyed& a, const Keyed& b)
    { return a.high != b.high ? a.high < b.high : a.half < b.half; });
  for (Keyed *begin = first, *end = first; begin != last; begin = end)
  {
    while (end != last && end->high == begin->high)
    {
      ++end;
    }
    if (end - begin == 1)
    {
      ++counts.open;
    }
    else if (end - begin == 2)
    {
      opposite[std::size_t(begin[0].half)] = begin[1].half;
      opposite[std::size_t(begin[1].half)] = begin[0].half;
      counts.flipped += origin(triangles, begin[0].half) == origin(triangles, begin[1].half);
    }
    else
    {
      ++counts.nonManifold;
      for (const Keyed* k = begin; k != end; ++k)
      {
        opposite[std::size_t(k->half)] = HalfEdges::kNonManifold;
      }
    }
  }
}

} // namespace

HalfEdges halfEdges(const std::vector<Triangle>& triangles)
{
  HalfEdges result;
  result.opposite.assign(3 * triangles.size(), HalfEdges::kOpen);
  Buckets buckets(triangles);
  std::vector<Counts> parts((buckets.size() + kGrain - 1) / kGrain);
  parallelFor(buckets.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t v = begin; v < end; ++v)
      {
        pair(triangles, buckets.keyed.data() + buckets.begin[v],
          buckets.keyed.data() + buckets.begin[v + 1], result.opposite, parts[begin / kGrain]);
      }
    });
  for (const Counts& counts : parts)
  {
    result.openEdges += counts.open;
    result.flippedEdges += counts.flipped;
    result.nonManifoldEdges += counts.nonManifold;
  }
  return result;
}

} // namespace hybridtree

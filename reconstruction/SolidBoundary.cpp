// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/SolidBoundary.h"

#include "reconstruction/JoinedParts.h"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 16384;

// An edge opposite to a vertex in a triangle around it.
struct LinkEdge
{
  std::int32_t from;
  std::int32_t to;
  bool operator<(const LinkEdge& other) const
  {
    return from != other.from ? from < other.from : to < other.to;
  }
};

// Whether the edges, which are sorted for it, are one simple loop.
bool isLoop(LinkEdge* begin, LinkEdge* end)
{
  std::sort(begin, end);
  const LinkEdge* at = begin;
  std::ptrdiff_t steps = 0;
  do
  {
    at = std::lower_bound(begin, end, LinkEdge{ at->to, -1 });
    if (at == end)
    {
      return false;
    }
    ++steps;
  } while (at != begin && steps <= end - begin);
  // Who is back after as many steps as there are edges has met each, so each starts elsewhere.
  return at == begin && steps == end - begin;
}

} // namespace

std::vector<std::int32_t> boundaryFacets(const Tetrahedralization& tetrahedra,
  const std::vector<std::uint8_t>& inside, const Progress& progress)
{
  const auto count = static_cast<std::size_t>(tetrahedra.cellCount());
  return collectInParts<std::int32_t>(count, kGrain, progress,
    [&](std::size_t begin, std::size_t end, std::vector<std::int32_t>& facets)
    {
      for (std::size_t k = begin; k < end; ++k)
      {
        const auto cell = static_cast<std::int32_t>(k);
        for (int facet = 0; inside[k] != 0 && facet < 4; ++facet)
        {
          if (inside[tetrahedra.neighbor(cell, facet)] == 0 &&
            (tetrahedra.finite(cell) ||
              tetrahedra.cell(cell)[facet] == Tetrahedralization::kInfinite))
          {
            facets.push_back(4 * cell + facet);
          }
        }
      }
    });
}

std::vector<std::int32_t> pinchedVertices(const Tetrahedralization& tetrahedra,
  const std::vector<std::uint8_t>& inside, const Progress& progress)
{
  const std::vector<std::int32_t> facets = boundaryFacets(tetrahedra, inside, progress);
  const std::size_t count = tetrahedra.points().size();
  std::vector<std::size_t> offset(count + 1, 0);
  for (const std::int32_t facet : facets)
  {
    for (const std::int32_t vertex : tetrahedra.facet(facet >> 2, facet & 3))
    {
      ++offset[vertex + 1];
    }
  }
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  progress.check();
  std::vector<LinkEdge> edges(offset.back());
  std::vector<std::size_t> next(offset.begin(), offset.end() - 1);
  for (const std::int32_t facet : facets)
  {
    const auto v = tetrahedra.facet(facet >> 2, facet & 3);
    for (int corner = 0; corner < 3; ++corner)
    {
      edges[next[v[corner]]++] = { v[(corner + 1) % 3], v[(corner + 2) % 3] };
    }
  }
  return collectInParts<std::int32_t>(count, kGrain, progress,
    [&](std::size_t begin, std::size_t end, std::vector<std::int32_t>& pinched)
    {
      for (std::size_t vertex = begin; vertex < end; ++vertex)
      {
        LinkEdge* first = edges.data() + offset[vertex];
        LinkEdge* last = edges.data() + offset[vertex + 1];
        if (first != last && !isLoop(first, last))
        {
          pinched.push_back(static_cast<std::int32_t>(vertex));
        }
      }
    });
}

} // namespace hybridtree

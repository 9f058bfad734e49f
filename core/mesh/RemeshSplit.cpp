// SPDX-License-Identifier: BSD-3-Clause
#include "core/mesh/RemeshSteps.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

using Index = RemeshSurface::Index;

constexpr int kMaxPasses = 40;

/// A strict order that both triangles of an edge see alike.
bool isLonger(const RemeshSurface& surface, Index h, Index other)
{
  const double a = surface.squaredLength(h);
  const double b = surface.squaredLength(other);
  if (a != b)
  {
    return a > b;
  }
  const auto ends = [&](Index edge) {
    return std::minmax({ surface.links().from(edge), surface.links().to(edge) });
  };
  return ends(h) > ends(other);
}

Index longestOf(const RemeshSurface& surface, std::size_t t)
{
  auto best = static_cast<Index>(3 * t);
  for (Index h = best + 1; h < static_cast<Index>(3 * t + 3); ++h)
  {
    best = isLonger(surface, h, best) ? h : best;
  }
  return best;
}

/// The long edges that are the longest of their triangles, one half-edge of each: no two of them
/// share a triangle, and triangles get no worse by much.
std::vector<Index> edgesToSplit(const RemeshSurface& surface)
{
  std::vector<Index> edges;
  const IndexSet& set = surface.withLongEdge();
  std::size_t step = 0;
  for (std::size_t t = set.next(0); t < set.size(); t = set.next(t + 1))
  {
    surface.lookForStop(step++);
    const Index h = longestOf(surface, t);
    const Index twin = surface.links().twin(h);
    if (twin == MeshLinks::kNone ||
      (h < twin && longestOf(surface, static_cast<std::size_t>(twin / 3)) == twin))
    {
      edges.push_back(h);
    }
  }
  return edges;
}

} // namespace

bool splitLongEdges(RemeshSurface& surface, RemeshPoints& points, const Progress& progress)
{
  for (int pass = 0; pass < kMaxPasses; ++pass)
  {
    progress.check();
    const std::vector<Index> edges = edgesToSplit(surface);
    if (edges.empty())
    {
      return pass > 0;
    }
    for (const Index h : edges)
    {
      surface.split(h, points.addMiddle(surface.links().from(h), surface.links().to(h)));
    }
    points.project(surface);
  }
  return true;
}

} // namespace hybridtree

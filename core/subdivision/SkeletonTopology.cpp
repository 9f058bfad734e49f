// SPDX-License-Identifier: BSD-3-Clause
#include "core/subdivision/SkeletonTopology.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

struct EdgeUse
{
  std::array<std::int32_t, 2> ends; // sorted
  std::int32_t element;             // segment, or 3 * triangle + corner
  bool isSegment;
};

std::vector<EdgeUse> edgeUses(const SkeletonGraph& graph)
{
  std::vector<EdgeUse> uses;
  uses.reserve(graph.segments.size() + 3 * graph.triangles.size());
  const auto add = [&](std::int32_t a, std::int32_t b, std::size_t element, bool isSegment) {
    uses.push_back({ { std::min(a, b), std::max(a, b) }, std::int32_t(element), isSegment });
  };
  for (std::size_t s = 0; s < graph.segments.size(); ++s)
  {
    add(graph.segments[s][0], graph.segments[s][1], s, true);
  }
  for (std::size_t t = 0; t < graph.triangles.size(); ++t)
  {
    for (std::size_t corner = 0; corner < 3; ++corner)
    {
      add(graph.triangles[t][corner], graph.triangles[t][(corner + 1) % 3], 3 * t + corner, false);
    }
  }
  std::sort(uses.begin(), uses.end(),
    [](const EdgeUse& a, const EdgeUse& b)
    { return a.ends != b.ends ? a.ends < b.ends : a.element < b.element; });
  return uses;
}

} // namespace

std::int32_t SkeletonVertex::beyond(std::int32_t neighbour) const
{
  if (kind != Kind::Curve)
  {
    return -1;
  }
  return along[0] == neighbour ? along[1] : along[1] == neighbour ? along[0] : -1;
}

SkeletonTopology::SkeletonTopology(const SkeletonGraph& graph)
  : graph_(graph), segmentEdges_(graph.segments.size()), triangleEdges_(graph.triangles.size())
{
  makeEdges();
  makeEdgesAt();
  vertices_.resize(graph.points.size());
  for (std::size_t k = 0; k < vertices_.size(); ++k)
  {
    vertices_[k] = classify(std::int32_t(k));
  }
}

void SkeletonTopology::makeEdges()
{
  for (const EdgeUse& use : edgeUses(graph_))
  {
    if (edges_.empty() || edges_.back().ends != use.ends)
    {
      edges_.push_back({ use.ends });
    }
    const auto index = std::int32_t(edges_.size() - 1);
    SkeletonEdge& edge = edges_.back();
    if (use.isSegment)
    {
      edge.segment = use.element;
      segmentEdges_[use.element] = index;
    }
    else
    {
      edge.triangles[edge.triangles[0] < 0 ? 0 : 1] = use.element / 3;
      triangleEdges_[use.element / 3][use.element % 3] = index;
    }
  }
}

void SkeletonTopology::makeEdgesAt()
{
  firstEdgeAt_.assign(graph_.points.size() + 1, 0);
  for (const SkeletonEdge& edge : edges_)
  {
    ++firstEdgeAt_[edge.ends[0] + 1];
    ++firstEdgeAt_[edge.ends[1] + 1];
  }
  for (std::size_t k = 1; k < firstEdgeAt_.size(); ++k)
  {
    firstEdgeAt_[k] += firstEdgeAt_[k - 1];
  }
  edgesAt_.resize(firstEdgeAt_.back());
  std::vector<std::int32_t> next(firstEdgeAt_.begin(), firstEdgeAt_.end() - 1);
  for (std::size_t e = 0; e < edges_.size(); ++e)
  {
    edgesAt_[next[edges_[e].ends[0]]++] = std::int32_t(e);
    edgesAt_[next[edges_[e].ends[1]]++] = std::int32_t(e);
  }
}

std::int32_t SkeletonTopology::triangleEdge(
  std::int32_t triangle, std::int32_t a, std::int32_t b) const
{
  const std::array<std::int32_t, 2> ends{ std::min(a, b), std::max(a, b) };
  const auto& candidates = triangleEdges_[triangle];
  return *std::find_if(
    candidates.begin(), candidates.end(), [&](std::int32_t e) { return edges_[e].ends == ends; });
}

std::int32_t SkeletonTopology::opposite(std::int32_t triangle, const SkeletonEdge& edge) const
{
  const Triangle& corners = graph_.triangles[triangle];
  return *std::find_if(corners.begin(), corners.end(),
    [&](std::int32_t p) { return p != edge.ends[0] && p != edge.ends[1]; });
}

std::vector<std::int32_t> SkeletonTopology::walk(
  std::int32_t center, const SkeletonEdge& edge, std::int32_t triangle, bool overCreases) const
{
  std::vector<std::int32_t> met;
  const SkeletonEdge* at = &edge;
  do
  {
    const std::int32_t next = opposite(triangle, *at);
    met.push_back(next);
    at = &edges_[triangleEdge(triangle, center, next)];
    if (at->triangles[1] < 0 || (!overCreases && at->sharp()))
    {
      break;
    }
    triangle = at->triangles[at->triangles[0] == triangle ? 1 : 0];
  } while (at != &edge);
  return met;
}

SkeletonSector SkeletonTopology::sector(
  std::int32_t center, const SkeletonEdge& edge, std::size_t& place) const
{
  const std::int32_t far = edge.otherEnd(center);
  SkeletonSector result;
  result.ring = walk(center, edge, edge.triangles[0], false);
  if (result.ring.back() == far)
  {
    result.closed = true;
    place = result.ring.size() - 1;
    return result;
  }
  std::reverse(result.ring.begin(), result.ring.end());
  place = result.ring.size();
  result.ring.push_back(far);
  const std::vector<std::int32_t> rest = walk(center, edge, edge.triangles[1], false);
  result.ring.insert(result.ring.end(), rest.begin(), rest.end());
  if (vertices_[center].kind == SkeletonVertex::Kind::Surface)
  {
    // The only crease ends here: for the rings of its masks it is an edge like others.
    result.closed = true;
    result.ring.pop_back();
  }
  return result;
}

std::size_t SkeletonTopology::fanCount(std::int32_t point) const
{
  // Every open fan has two borders; closed ones are met only once all open ones are counted.
  std::size_t borders = 0;
  std::size_t triangleEnds = 0;
  std::size_t inOpenFans = 0;
  const SkeletonEdge* inner = nullptr;
  for (auto [e, end] = edgesAt(point); e != end; ++e)
  {
    const SkeletonEdge& edge = edges_[*e];
    triangleEnds += std::size_t(edge.triangles[0] >= 0) + std::size_t(edge.triangles[1] >= 0);
    if (edge.onSurface() && edge.triangles[1] < 0)
    {
      ++borders;
      inOpenFans += walk(point, edge, edge.triangles[0], true).size();
    }
    else if (edge.onSurface())
    {
      inner = &edge;
    }
  }
  // Each triangle of an open fan is met from both of its borders, and has two edges at the point.
  if (triangleEnds == inOpenFans)
  {
    return borders / 2;
  }
  const bool onlyOne =
    borders == 0 && 2 * walk(point, *inner, inner->triangles[0], true).size() == triangleEnds;
  return onlyOne ? 1 : 2 + borders;
}

bool SkeletonTopology::isSurrounded(std::int32_t point) const
{
  const auto [begin, end] = edgesAt(point);
  const bool noBorder = std::none_of(begin, end,
    [&](std::int32_t e) { return edges_[e].onSurface() && edges_[e].triangles[1] < 0; });
  return noBorder && fanCount(point) == 1;
}

SkeletonVertex SkeletonTopology::classify(std::int32_t point) const
{
  using Kind = SkeletonVertex::Kind;
  std::vector<std::int32_t> bySegment;
  std::vector<std::int32_t> onSurface; // along sharp edges of surfaces
  bool freeSegment = false;
  for (auto [e, end] = edgesAt(point); e != end; ++e)
  {
    const SkeletonEdge& edge = edges_[*e];
    if (edge.segment >= 0)
    {
      bySegment.push_back(edge.otherEnd(point));
      freeSegment = freeSegment || !edge.onSurface();
    }
    if (edge.onSurface() && edge.sharp())
    {
      onSurface.push_back(edge.otherEnd(point));
    }
  }
  if (isSurrounded(point))
  {
    return onSurface.size() < 2 ? SkeletonVertex{ Kind::Surface }
      : onSurface.size() == 2   ? SkeletonVertex{ Kind::Curve, { onSurface[0], onSurface[1] } }
                                : SkeletonVertex{};
  }
  if (bySegment.size() == 2)
  {
    return { Kind::Curve, { bySegment[0], bySegment[1] } };
  }
  if (!freeSegment && onSurface.size() == 2 && fanCount(point) == 1)
  {
    return { Kind::Curve, { onSurface[0], onSurface[1] } };
  }
  return {};
}

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/FacetSize.h"

#include "core/base/Parallel.h"

#include <algorithm>
#include <limits>

namespace hybridtree
{
namespace
{

constexpr std::size_t kNeighbor = 6;
constexpr std::size_t kGrain = 4096;

struct Neighbor
{
  double distance;
  std::int32_t vertex;
  bool operator<(const Neighbor& other) const { return distance < other.distance; }
};

// The shortest kNeighbor Delaunay edges of a vertex, unordered but for the longest of them at the
// end. \param all scratch
void nearestNeighbors(const Tetrahedralization& tetrahedra, std::int32_t vertex,
  std::vector<std::int32_t>& all, std::vector<Neighbor>& nearest)
{
  all.clear();
  nearest.clear();
  for (const std::int32_t cell : tetrahedra.star(vertex))
  {
    for (const std::int32_t other : tetrahedra.cell(cell))
    {
      if (other != vertex && other != Tetrahedralization::kInfinite)
      {
        all.push_back(other);
      }
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  const auto& points = tetrahedra.points();
  for (const std::int32_t other : all)
  {
    nearest.push_back({ (points[other] - points[vertex]).norm(), other });
  }
  const std::size_t count = std::min(kNeighbor, nearest.size());
  if (count > 0)
  {
    std::nth_element(nearest.begin(), nearest.begin() + (count - 1), nearest.end());
  }
  nearest.resize(count);
}

template <typename Body>
void forEachVertex(const Tetrahedralization& tetrahedra, const Body& body)
{
  parallelFor(tetrahedra.points().size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      std::vector<std::int32_t> all;
      std::vector<Neighbor> nearest;
      for (std::size_t vertex = begin; vertex < end; ++vertex)
      {
        nearestNeighbors(tetrahedra, static_cast<std::int32_t>(vertex), all, nearest);
        body(vertex, nearest);
      }
    });
}

} // namespace

FacetSize::FacetSize(const Tetrahedralization& tetrahedra) : tetrahedra_(tetrahedra)
{
  const std::size_t count = tetrahedra.points().size();
  std::vector<double> sixth(count, std::numeric_limits<double>::infinity());
  spacing_ = sixth;
  forEachVertex(tetrahedra,
    [&](std::size_t vertex, const std::vector<Neighbor>& nearest)
    {
      if (!nearest.empty())
      {
        sixth[vertex] = nearest.back().distance;
      }
    });
  forEachVertex(tetrahedra,
    [&](std::size_t vertex, const std::vector<Neighbor>& nearest)
    {
      double sum = sixth[vertex];
      for (const Neighbor& neighbor : nearest)
      {
        sum += sixth[neighbor.vertex];
      }
      spacing_[vertex] = sum / static_cast<double>(nearest.size() + 1);
    });
}

double FacetSize::ofEdge(std::int32_t a, std::int32_t b) const
{
  return (tetrahedra_.points()[a] - tetrahedra_.points()[b]).norm() /
    std::min(spacing_[a], spacing_[b]);
}

double FacetSize::ofFacet(std::int32_t cell, int facet) const
{
  const auto v = tetrahedra_.facet(cell, facet);
  return std::max({ this->ofEdge(v[0], v[1]), this->ofEdge(v[1], v[2]), this->ofEdge(v[2], v[0]) });
}

double FacetSize::ofCell(std::int32_t cell) const
{
  const auto& v = tetrahedra_.cell(cell);
  return std::max({ this->ofFacet(cell, 3), this->ofEdge(v[0], v[3]), this->ofEdge(v[1], v[3]),
    this->ofEdge(v[2], v[3]) });
}

double FacetSize::lengthOfFacet(std::int32_t cell, int facet) const
{
  const auto& p = tetrahedra_.points();
  const auto v = tetrahedra_.facet(cell, facet);
  return std::max(
    { (p[v[0]] - p[v[1]]).norm(), (p[v[1]] - p[v[2]]).norm(), (p[v[2]] - p[v[0]]).norm() });
}

double FacetSize::lengthOfCell(std::int32_t cell) const
{
  double length = 0.0;
  for (int facet = 0; facet < 3; ++facet) // three facets have all six edges
  {
    length = std::max(length, this->lengthOfFacet(cell, facet));
  }
  return length;
}

} // namespace hybridtree

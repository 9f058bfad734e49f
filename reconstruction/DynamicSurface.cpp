// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/DynamicSurface.h"

#include "reconstruction/DelaunayPredicates.h"
#include "reconstruction/JoinedParts.h"

#include "core/base/Parallel.h"
#include "core/geometry/PointTriangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace hybridtree
{
void DynamicSurface::insert(const std::vector<Vec3>& points, const Progress& progress)
{
  delaunay_.insert(points, progress);
}

Tetrahedralization DynamicSurface::tetrahedralization(const Progress& progress) const
{
  return Tetrahedralization(delaunay_, progress);
}

void DynamicSurface::setInside(
  const Tetrahedralization& tetrahedra, const std::vector<std::uint8_t>& inside)
{
  inside_.assign(delaunay_.cellCount(), 0);
  marks_.assign(delaunay_.cellCount(), 0);
  steps_.clear();
  replaced_.clear();
  replacedInside_.clear();
  removed_.clear();
  renamed_.clear();
  for (std::int32_t cell = 0; cell < tetrahedra.cellCount(); ++cell)
  {
    inside_[tetrahedra.source(cell)] = inside[cell];
  }
}

DynamicSurface::Outcome DynamicSurface::place(
  const Vec3& point, std::int32_t near, double tolerance, Way way)
{
  const Delaunay::Place where = delaunay_.locate(point, near);
  if (where.vertex >= 0)
  {
    return this->surfaceAt(where.vertex, tolerance, way);
  }
  delaunay_.findCavity(point, where, cavity_);
  Hole hole = this->holeOf(cavity_.cells);
  std::int32_t dent = -1;
  if (hole.triangles.empty())
  {
    dent = this->facetTowards(point, cavity_.border, way);
    if (dent < 0)
    {
      return way == Way::Any && this->approach(cavity_.cells) ? Outcome::Prepared
                                                              : Outcome::Refused;
    }
    hole.triangles.push_back(this->triangleOf(dent));
  }
  for (const std::int32_t triangle : hole.triangles)
  {
    if (this->isNear(triangle, point, tolerance))
    {
      return Outcome::Near;
    }
  }
  if (dent < 0 && !this->keepsManifold(hole))
  {
    const bool any = way == Way::Any;
    const bool prepared = this->prepare(point, tolerance, 1) ||
      (any &&
        (this->prepare(point, tolerance, 2) || this->prepare(point, tolerance, 3) ||
          this->clear(cavity_.cells)));
    return prepared ? Outcome::Prepared : Outcome::Refused;
  }
  change_.removed = hole.triangles;
  this->fill(point, dent);
  return Outcome::Placed;
}

// The number of the triangle that is this half-facet or its opposite.
std::int32_t DynamicSurface::triangleOf(std::int32_t halfFacet) const
{
  return inside_[halfFacet >> 2] != 0 ? halfFacet : delaunay_.beyond(halfFacet);
}

DynamicSurface::Hole DynamicSurface::holeOf(const std::vector<std::int32_t>& cells)
{
  Hole hole;
  for (const std::int32_t cell : cells)
  {
    marks_[cell] = 1;
  }
  for (const std::int32_t cell : cells)
  {
    for (std::int32_t facet = 4 * cell; inside_[cell] != 0 && facet < 4 * cell + 4; ++facet)
    {
      const std::int32_t beyond = delaunay_.beyond(facet) >> 2;
      const Triangle corner = delaunay_.facet(facet);
      if (marks_[beyond] == 0)
      {
        for (int k = 0; k < 3; ++k)
        {
          hole.edges.push_back({ corner[k], corner[(k + 1) % 3] });
        }
      }
      else if (inside_[beyond] == 0)
      {
        hole.triangles.push_back(facet);
      }
    }
  }
  for (const std::int32_t cell : cells)
  {
    marks_[cell] = 0;
  }
  return hole;
}

// The new tetrahedra are inside where the old ones at their bases were, but for that at the dent.
void DynamicSurface::fill(const Vec3& point, std::int32_t dent)
{
  change_.added.clear();
  change_.renamed.clear();
  std::vector<std::uint8_t> inside(cavity_.border.size());
  for (std::size_t k = 0; k < inside.size(); ++k)
  {
    const std::int32_t facet = cavity_.border[k];
    inside[k] = inside_[facet >> 2] ^ std::uint8_t(facet == dent);
    if (facet != dent && inside[k] != 0 && inside_[delaunay_.beyond(facet) >> 2] == 0)
    {
      change_.renamed.emplace_back(facet, static_cast<std::int32_t>(k));
    }
  }
  this->remember(-1);
  for (const std::int32_t cell : cavity_.cells)
  {
    replaced_.push_back({ cell, delaunay_.cell(cell) });
    replacedInside_.push_back(inside_[cell]);
    inside_[cell] = 0;
  }
  delaunay_.fill(point, cavity_);
  inside_.resize(delaunay_.cellCount(), 0);
  marks_.resize(delaunay_.cellCount(), 0);
  for (std::size_t k = 0; k < inside.size(); ++k)
  {
    inside_[cavity_.cells[k]] = inside[k];
  }
  for (auto& name : change_.renamed)
  {
    name.second = cavity_.border[name.second];
  }
  renamed_.insert(renamed_.end(), change_.renamed.begin(), change_.renamed.end());
  for (const std::int32_t cell : cavity_.cells)
  {
    for (std::int32_t facet = 4 * cell + 1; inside_[cell] != 0 && facet < 4 * cell + 4; ++facet)
    {
      if (inside_[delaunay_.beyond(facet) >> 2] == 0)
      {
        change_.added.push_back(facet);
      }
    }
  }
}

void DynamicSurface::remember(std::int32_t flipped)
{
  steps_.push_back({ flipped, replaced_.size(), removed_.size(), renamed_.size() });
  removed_.insert(removed_.end(), change_.removed.begin(), change_.removed.end());
}

bool DynamicSurface::undo()
{
  const Step step = steps_.back();
  steps_.pop_back();
  if (step.flipped >= 0)
  {
    this->flip(step.flipped);
  }
  else
  {
    this->takeBack(step);
  }
  replaced_.resize(step.replaced);
  replacedInside_.resize(step.replaced);
  removed_.resize(step.removed);
  renamed_.resize(step.renamed);
  return step.flipped < 0;
}

// The cells around the last site have it as their vertex 0.
void DynamicSurface::takeBack(const Step& step)
{
  change_.removed.clear();
  change_.renamed.clear();
  delaunay_.star(static_cast<std::int32_t>(this->sites().size()) - 1, cavity_.cells);
  for (const std::int32_t cell : cavity_.cells)
  {
    for (std::int32_t facet = 4 * cell + 1; inside_[cell] != 0 && facet < 4 * cell + 4; ++facet)
    {
      if (inside_[delaunay_.beyond(facet) >> 2] == 0)
      {
        change_.removed.push_back(facet);
      }
    }
  }
  for (const std::int32_t cell : cavity_.cells)
  {
    inside_[cell] = 0;
  }
  delaunay_.takeBack(
    cavity_.cells, replaced_.data() + step.replaced, replaced_.data() + replaced_.size());
  for (std::size_t k = step.replaced; k < replaced_.size(); ++k)
  {
    inside_[replaced_[k].number] = replacedInside_[k];
  }
  change_.added.assign(removed_.begin() + std::ptrdiff_t(step.removed), removed_.end());
  for (std::size_t k = step.renamed; k < renamed_.size(); ++k)
  {
    change_.renamed.emplace_back(renamed_[k].second, renamed_[k].first);
  }
}

bool DynamicSurface::isNear(std::int32_t triangle, const Vec3& point, double tolerance)
{
  const Triangle t = this->triangle(triangle);
  const std::vector<Vec3>& sites = this->sites();
  nearTriangle_ = triangle;
  nearDistance_ =
    std::sqrt(nearestOnTriangle(point, sites[t[0]], sites[t[1]], sites[t[2]]).squaredDistance);
  return nearDistance_ <= tolerance;
}

std::vector<std::int32_t> DynamicSurface::surface() const
{
  constexpr std::size_t kGrain = 16384;
  const auto count = static_cast<std::size_t>(delaunay_.cellCount());
  std::vector<std::vector<std::int32_t>> parts((count + kGrain - 1) / kGrain);
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      for (auto cell = static_cast<std::int32_t>(begin); cell < static_cast<std::int32_t>(end);
           ++cell)
      {
        for (std::int32_t facet = 4 * cell; inside_[cell] != 0 && facet < 4 * cell + 4; ++facet)
        {
          if (inside_[delaunay_.beyond(facet) >> 2] == 0)
          {
            parts[begin / kGrain].push_back(facet);
          }
        }
      }
    });
  return joined(parts);
}

// Where all that a point replaces is on one side of the surface: the surface's nearest facet on the
// border that, if it is to be convected, is not oriented Gabriel for the point, so that the flow
// would step on to it. That is one facet replaced by three about a new vertex, and never changes
// the topology.
std::int32_t DynamicSurface::facetTowards(
  const Vec3& point, const std::vector<std::int32_t>& border, Way way) const
{
  const std::vector<Vec3>& sites = this->sites();
  std::int32_t best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (const std::int32_t facet : border)
  {
    if (inside_[delaunay_.beyond(facet) >> 2] == inside_[facet >> 2])
    {
      continue;
    }
    const Triangle t = delaunay_.facet(facet);
    if (t[0] < 0 || t[1] < 0 || t[2] < 0) // infinite
    {
      continue;
    }
    const double squared =
      nearestOnTriangle(point, sites[t[0]], sites[t[1]], sites[t[2]]).squaredDistance;
    if (squared < least &&
      (way == Way::Any || sideOfLeastBall(sites[t[0]], sites[t[1]], sites[t[2]], point) > 0))
    {
      least = squared;
      best = facet;
    }
  }
  return best;
}

// Whether the hole's border is divided by one simple loop, and its part of the surface is a disc.
bool DynamicSurface::keepsManifold(const Hole& hole) const
{
  // Edges that facets on both sides have cancel; the others part inside from outside.
  std::vector<std::uint64_t> edges(hole.edges.size()); // lower end, higher end, which is first
  std::transform(hole.edges.begin(), hole.edges.end(), edges.begin(),
    [](const Edge& edge)
    {
      const auto [low, high] = std::minmax({ edge.from + 1, edge.to + 1 }); // kInfinite is -1
      return std::uint64_t(low) << 32 | std::uint64_t(high) << 1 |
        std::uint64_t(edge.to < edge.from);
    });
  std::sort(edges.begin(), edges.end());
  std::vector<Edge> loop;
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    if (k + 1 < edges.size() && edges[k] >> 1 == edges[k + 1] >> 1)
    {
      ++k;
      continue;
    }
    const auto low = static_cast<std::int32_t>(edges[k] >> 32) - 1;
    const auto high = static_cast<std::int32_t>(edges[k] >> 1 & 0x7fffffffu) - 1;
    loop.push_back((edges[k] & 1) != 0 ? Edge{ high, low } : Edge{ low, high });
  }
  // One loop: each of its vertices is left once, and who walks along it is back after all edges.
  std::sort(loop.begin(), loop.end(), [](const Edge& a, const Edge& b) { return a.from < b.from; });
  const auto sameStart = [](const Edge& a, const Edge& b) { return a.from == b.from; };
  if (loop.size() < 3 || std::adjacent_find(loop.begin(), loop.end(), sameStart) != loop.end())
  {
    return false;
  }
  std::size_t steps = 0;
  auto at = loop.begin();
  do
  {
    at = std::lower_bound(loop.begin(), loop.end(), at->to,
      [](const Edge& edge, std::int32_t site) { return edge.from < site; });
    ++steps;
  } while (at != loop.end() && at != loop.begin() && steps < loop.size());
  if (at != loop.begin() || steps != loop.size())
  {
    return false;
  }
  // Euler's formula for a disc whose border is the loop.
  std::vector<std::int32_t> sites;
  for (const std::int32_t triangle : hole.triangles)
  {
    const Triangle t = this->triangle(triangle);
    sites.insert(sites.end(), t.begin(), t.end());
  }
  std::sort(sites.begin(), sites.end());
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  return hole.triangles.size() + 2 + loop.size() == 2 * sites.size();
}

} // namespace hybridtree

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
  const Tetrahedralization& tetrahedra, std::vector<std::uint8_t> inside)
{
  delaunay_.renumber(tetrahedra.cells());
  inside_ = std::move(inside);
  own_.history_ = {};
}

DynamicSurface::Outcome DynamicSurface::place(
  Hand& hand, const Vec3& point, std::int32_t triangle, double tolerance, Way way)
{
  hand.marks_.resize(delaunay_.cellCount(), 0);
  const Delaunay::Place where = this->locate(hand, point, triangle);
  if (where.vertex >= 0 && hand.alone_)
  {
    return this->surfaceAt(where.vertex, tolerance, way);
  }
  if (where.vertex >= 0 || where.cell < 0 || !this->findCavity(hand, point, where))
  {
    return Outcome::Left;
  }
  const Delaunay::Cavity& cavity = hand.cavity_;
  this->findHole(hand);
  std::vector<std::int32_t>& hole = hand.hole_;
  std::int32_t dent = -1;
  if (hole.empty())
  {
    dent = this->facetTowards(point, cavity.border, way);
    if (dent < 0)
    {
      return way == Way::Any && this->approach(cavity.cells) ? Outcome::Prepared : Outcome::Refused;
    }
    hole.push_back(this->triangleOf(dent));
  }
  for (const std::int32_t replaced : hole)
  {
    if (this->isNear(hand, replaced, point, tolerance))
    {
      return Outcome::Near;
    }
  }
  if (dent < 0 && !this->keepsManifold(hand))
  {
    return this->makeReady(hand, point, tolerance, way);
  }
  hand.change_.removed = hole;
  this->fill(hand, point, dent);
  return Outcome::Placed;
}

Delaunay::Place DynamicSurface::locate(Hand& hand, const Vec3& point, std::int32_t triangle)
{
  for (const std::int32_t cell : { triangle >> 2, delaunay_.beyond(triangle) >> 2 })
  {
    if (delaunay_.holds(cell, point))
    {
      return { cell, -1 };
    }
  }
  const std::int32_t start = triangle >> 2;
  return hand.alone_ ? delaunay_.locate(point, start)
                     : delaunay_.locate(hand.worker_, point, start);
}

// \returns whether the hand may fill it.
bool DynamicSurface::findCavity(Hand& hand, const Vec3& point, const Delaunay::Place& where)
{
  if (hand.alone_)
  {
    delaunay_.findCavity(point, where, hand.cavity_);
    return true;
  }
  return delaunay_.findCavity(hand.worker_, point, where, hand.cavity_) &&
    delaunay_.hasCells(hand.worker_, hand.cavity_);
}

// The number of the triangle that is this half-facet or its opposite.
std::int32_t DynamicSurface::triangleOf(std::int32_t halfFacet) const
{
  return inside_[halfFacet >> 2] != 0 ? halfFacet : delaunay_.beyond(halfFacet);
}

void DynamicSurface::findHole(Hand& hand) const
{
  const std::vector<std::int32_t>& cells = hand.cavity_.cells;
  hand.hole_.clear();
  for (const std::int32_t cell : cells)
  {
    hand.marks_[cell] = 1;
  }
  for (const std::int32_t cell : cells)
  {
    for (std::int32_t facet = 4 * cell; inside_[cell] != 0 && facet < 4 * cell + 4; ++facet)
    {
      const std::int32_t beyond = delaunay_.beyond(facet) >> 2;
      if (inside_[beyond] == 0 && hand.marks_[beyond] != 0)
      {
        hand.hole_.push_back(facet);
      }
    }
  }
  for (const std::int32_t cell : cells)
  {
    hand.marks_[cell] = 0;
  }
}

// The new tetrahedra are inside where the old ones at their bases were, but for that at the dent.
void DynamicSurface::fill(Hand& hand, const Vec3& point, std::int32_t dent)
{
  Change& change = hand.change_;
  Delaunay::Cavity& cavity = hand.cavity_;
  change.added.clear();
  change.renamed.clear();
  std::vector<std::uint8_t>& inside = hand.inside_;
  inside.resize(cavity.border.size());
  for (std::size_t k = 0; k < inside.size(); ++k)
  {
    const std::int32_t facet = cavity.border[k];
    inside[k] = inside_[facet >> 2] ^ std::uint8_t(facet == dent);
    if (facet != dent && inside[k] != 0 && inside_[delaunay_.beyond(facet) >> 2] == 0)
    {
      change.renamed.emplace_back(facet, static_cast<std::int32_t>(k));
    }
  }
  const std::int32_t site =
    hand.alone_ ? static_cast<std::int32_t>(this->sites().size()) : hand.nextSite_++;
  remember(hand, -1, site);
  History& history = hand.history_;
  for (const std::int32_t cell : cavity.cells)
  {
    history.replaced.push_back({ cell, delaunay_.cell(cell) });
    history.replacedInside.push_back(inside_[cell]);
    inside_[cell] = 0;
  }
  if (hand.alone_)
  {
    delaunay_.fill(point, cavity);
    inside_.resize(delaunay_.cellCount(), 0);
  }
  else
  {
    delaunay_.fill(hand.worker_, site, point, cavity);
  }
  for (std::size_t k = 0; k < inside.size(); ++k)
  {
    inside_[cavity.cells[k]] = inside[k];
  }
  for (auto& name : change.renamed)
  {
    name.second = cavity.border[name.second];
  }
  history.renamed.insert(history.renamed.end(), change.renamed.begin(), change.renamed.end());
  this->collectBases(cavity.cells, change.added);
}

// Triangles of the surface that have the vertex 0 of cells around it. They are on the cells' own
// side.
void DynamicSurface::collectBases(
  const std::vector<std::int32_t>& star, std::vector<std::int32_t>& triangles) const
{
  for (const std::int32_t cell : star)
  {
    for (std::int32_t facet = 4 * cell + 1; inside_[cell] != 0 && facet < 4 * cell + 4; ++facet)
    {
      if (inside_[delaunay_.beyond(facet) >> 2] == 0)
      {
        triangles.push_back(facet);
      }
    }
  }
}

void DynamicSurface::remember(Hand& hand, std::int32_t flipped, std::int32_t site)
{
  History& history = hand.history_;
  history.steps.push_back(
    { flipped, site, history.replaced.size(), history.removed.size(), history.renamed.size() });
  history.removed.insert(
    history.removed.end(), hand.change_.removed.begin(), hand.change_.removed.end());
}

void DynamicSurface::undo()
{
  const Step step = own_.history_.steps.back();
  if (step.flipped >= 0)
  {
    this->flip(step.flipped, own_.change_);
  }
  else
  {
    this->takeBack(step);
  }
  own_.history_.forgetFrom(step);
}

void DynamicSurface::History::forgetFrom(const Step& step)
{
  steps.pop_back();
  replaced.resize(step.replaced);
  replacedInside.resize(step.replaced);
  removed.resize(step.removed);
  renamed.resize(step.renamed);
}

// The cells around the site have it as their vertex 0.
void DynamicSurface::takeBack(const Step& step)
{
  Change& change = own_.change_;
  const History& history = own_.history_;
  std::vector<std::int32_t>& star = own_.cavity_.cells;
  change.removed.clear();
  change.renamed.clear();
  delaunay_.star(step.site, star);
  this->collectBases(star, change.removed);
  for (const std::int32_t cell : star)
  {
    inside_[cell] = 0;
  }
  const Delaunay::Replaced* replaced = history.replaced.data();
  delaunay_.takeBack(step.site, star, replaced + step.replaced, replaced + history.replaced.size());
  for (std::size_t k = step.replaced; k < history.replaced.size(); ++k)
  {
    inside_[replaced[k].number] = history.replacedInside[k];
  }
  change.added.assign(
    history.removed.begin() + std::ptrdiff_t(step.removed), history.removed.end());
  for (std::size_t k = step.renamed; k < history.renamed.size(); ++k)
  {
    change.renamed.emplace_back(history.renamed[k].second, history.renamed[k].first);
  }
}

bool DynamicSurface::isNear(
  Hand& hand, std::int32_t triangle, const Vec3& point, double tolerance) const
{
  const Triangle t = this->triangle(triangle);
  const std::vector<Vec3>& sites = this->sites();
  hand.nearTriangle_ = triangle;
  hand.nearDistance_ =
    std::sqrt(nearestOnTriangle(point, sites[t[0]], sites[t[1]], sites[t[2]]).squaredDistance);
  return hand.nearDistance_ <= tolerance;
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

// Whether the hole's triangles are a disc, bordered by one simple loop.
bool DynamicSurface::keepsManifold(Hand& hand) const
{
  std::vector<Edge>& edges = hand.edges_;
  std::vector<std::int32_t>& sites = hand.sites_;
  edges.clear();
  sites.clear();
  for (const std::int32_t triangle : hand.hole_)
  {
    const Triangle t = this->triangle(triangle);
    for (int k = 0; k < 3; ++k)
    {
      edges.push_back({ t[k], t[(k + 1) % 3] });
      sites.push_back(t[k]);
    }
  }
  std::sort(sites.begin(), sites.end());
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  std::sort(
    edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.key() < b.key(); });
  // Those that two triangles share cancel.
  std::size_t loop = 0;
  for (std::size_t k = 0; k < edges.size();)
  {
    const std::size_t first = k;
    while (++k < edges.size() && edges[k].key() == edges[first].key())
    {
    }
    if (k > first + 2)
    {
      return false;
    }
    if (k == first + 1)
    {
      edges[loop++] = edges[first];
    }
  }
  edges.resize(loop);
  // Euler's formula for a disc whose border is the loop.
  return hand.hole_.size() + 2 + loop == 2 * sites.size() && isLoop(edges);
}

// Whether each vertex is left once, and who walks along the edges is back after all.
bool DynamicSurface::isLoop(std::vector<Edge>& edges)
{
  std::sort(
    edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.from < b.from; });
  const auto sameStart = [](const Edge& a, const Edge& b) { return a.from == b.from; };
  if (edges.size() < 3 || std::adjacent_find(edges.begin(), edges.end(), sameStart) != edges.end())
  {
    return false;
  }
  std::size_t steps = 0;
  auto at = edges.begin();
  do
  {
    at = std::lower_bound(edges.begin(), edges.end(), at->to,
      [](const Edge& edge, std::int32_t site) { return edge.from < site; });
    ++steps;
  } while (at != edges.end() && at != edges.begin() && steps < edges.size());
  return at == edges.begin() && steps == edges.size();
}

} // namespace hybridtree

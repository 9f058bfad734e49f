// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/DynamicSurface.h"

#include "reconstruction/DelaunayPredicates.h"

#include "core/geometry/PointTriangle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace hybridtree
{
namespace
{

struct Edge
{
  std::int32_t from; // sites
  std::int32_t to;
};

bool sameEnds(const Edge& a, const Edge& b)
{
  return std::minmax({ a.from, a.to }) == std::minmax({ b.from, b.to });
}

} // namespace

// What a point to be added would replace.
struct DynamicSurface::Hole
{
  std::vector<Edge> edges; // of the border's facets whose cell is inside, each turned outward
  std::vector<Triangle> triangles; // of the surface within it
};

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
  for (std::int32_t cell = 0; cell < tetrahedra.cellCount(); ++cell)
  {
    inside_[tetrahedra.source(cell)] = inside[cell];
  }
}

DynamicSurface::Outcome DynamicSurface::place(
  const Vec3& point, std::int32_t near, double tolerance)
{
  const Delaunay::Place where = delaunay_.locate(point, near);
  if (where.vertex >= 0)
  {
    return this->surfaceAt(where.vertex, tolerance);
  }
  delaunay_.findCavity(point, where, cavity_);
  Hole hole = this->holeOf(cavity_.cells);
  std::int32_t dent = -1;
  if (hole.triangles.empty())
  {
    dent = this->facetTowards(point, cavity_.border);
    if (dent < 0)
    {
      return Outcome::Refused;
    }
    hole.triangles.push_back(delaunay_.facet(dent));
  }
  for (const Triangle& triangle : hole.triangles)
  {
    if (this->isNear(triangle, point, tolerance))
    {
      return Outcome::Near;
    }
  }
  if (dent < 0 && !this->keepsManifold(hole))
  {
    return Outcome::Refused;
  }
  for (const Triangle& triangle : hole.triangles)
  {
    touched_.insert(touched_.end(), triangle.begin(), triangle.end());
  }
  this->fill(point, dent);
  return Outcome::Placed;
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
        hole.triangles.push_back(corner);
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
  std::vector<std::uint8_t> inside(cavity_.border.size());
  for (std::size_t k = 0; k < inside.size(); ++k)
  {
    const std::int32_t facet = cavity_.border[k];
    inside[k] = inside_[facet >> 2] ^ std::uint8_t(facet == dent);
  }
  for (const std::int32_t cell : cavity_.cells)
  {
    inside_[cell] = 0;
  }
  touched_.push_back(delaunay_.fill(point, cavity_));
  inside_.resize(delaunay_.cellCount(), 0);
  marks_.resize(delaunay_.cellCount(), 0);
  for (std::size_t k = 0; k < inside.size(); ++k)
  {
    inside_[cavity_.cells[k]] = inside[k];
  }
}

bool DynamicSurface::isNear(const Triangle& triangle, const Vec3& point, double tolerance)
{
  nearTriangle_ = triangle;
  nearDistance_ = std::sqrt(nearestOnTriangle(
    point, this->sites()[triangle[0]], this->sites()[triangle[1]], this->sites()[triangle[2]])
                              .squaredDistance);
  return nearDistance_ <= tolerance;
}

// Lets the surface step on to a site that it has passed by, or not come to.
DynamicSurface::Outcome DynamicSurface::surfaceAt(std::int32_t site, double tolerance)
{
  std::vector<std::int32_t>& star = cavity_.cells;
  std::vector<std::int32_t>& border = cavity_.border;
  delaunay_.star(site, star);
  border.clear();
  for (const std::int32_t cell : star)
  {
    if (inside_[cell] != inside_[star[0]])
    {
      return Outcome::Coincides; // it is on the surface
    }
    const auto& v = delaunay_.cell(cell).vertices;
    border.push_back(
      4 * cell + static_cast<std::int32_t>(std::find(v.begin(), v.end(), site) - v.begin()));
  }
  const Vec3& point = this->sites()[site];
  const std::int32_t facet = this->facetTowards(point, border);
  if (facet < 0)
  {
    return Outcome::Refused;
  }
  const Triangle t = delaunay_.facet(facet);
  if (this->isNear(t, point, tolerance))
  {
    return Outcome::Near;
  }
  inside_[facet >> 2] ^= 1;
  touched_.insert(touched_.end(), { site, t[0], t[1], t[2] });
  return Outcome::Surfaced;
}

std::vector<std::int32_t> DynamicSurface::takeTouched()
{
  return std::exchange(touched_, {});
}

std::vector<Triangle> DynamicSurface::surface() const
{
  std::vector<Triangle> triangles;
  for (std::int32_t facet = 0; facet < 4 * delaunay_.cellCount(); ++facet)
  {
    if (inside_[facet >> 2] != 0 && inside_[delaunay_.beyond(facet) >> 2] == 0)
    {
      triangles.push_back(delaunay_.facet(facet));
    }
  }
  return triangles;
}

// Where all that a point replaces is on one side of the surface: the surface's nearest facet on the
// border that is not oriented Gabriel for the point, so that convection would step on to it. That
// is one facet replaced by three about a new vertex, and never changes the topology.
std::int32_t DynamicSurface::facetTowards(
  const Vec3& point, const std::vector<std::int32_t>& border) const
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
    if (squared < least && sideOfLeastBall(sites[t[0]], sites[t[1]], sites[t[2]], point) > 0)
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
  std::vector<Edge> edges = hole.edges;
  std::sort(edges.begin(), edges.end(),
    [](const Edge& a, const Edge& b) {
      return std::minmax({ a.from, a.to }) < std::minmax({ b.from, b.to });
    });
  std::vector<Edge> loop;
  for (std::size_t k = 0; k < edges.size(); ++k)
  {
    if (k + 1 < edges.size() && sameEnds(edges[k], edges[k + 1]))
    {
      ++k;
    }
    else
    {
      loop.push_back(edges[k]);
    }
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
  for (const Triangle& triangle : hole.triangles)
  {
    sites.insert(sites.end(), triangle.begin(), triangle.end());
  }
  std::sort(sites.begin(), sites.end());
  sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
  return hole.triangles.size() + 2 + loop.size() == 2 * sites.size();
}

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/DynamicSurface.h"

#include "reconstruction/DelaunayTypes.h"

#include "core/base/Error.h"
#include "core/geometry/PointTriangle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace hybridtree
{
namespace
{

using Cell = Delaunay::Cell_handle;
using Facet = Delaunay::Facet;
using Vertex = Delaunay::Vertex_handle;

struct Edge
{
  std::int32_t from; // sites
  std::int32_t to;
};

bool sameEnds(const Edge& a, const Edge& b)
{
  return std::minmax({ a.from, a.to }) == std::minmax({ b.from, b.to });
}

// Corners of a facet of a finite cell, counter-clockwise seen from outside.
Triangle corners(const Cell cell, int facet)
{
  Triangle triangle;
  for (int k = 0; k < 3; ++k)
  {
    triangle[k] = cell->vertex(Tetrahedralization::kFacetCorners[facet][k])->info();
  }
  return triangle;
}

} // namespace

struct DynamicSurface::Mesh
{
  DelaunayTriangulation delaunay;
  std::vector<Vertex> vertices; // per site; null where it coincides with an earlier one
  std::vector<Cell> conflicts;  // scratch
  std::vector<Cell> sorted;
  std::vector<Facet> border;

  Facet facetTowards(const Vec3& point, const std::vector<Vec3>& sites) const;
};

// What a point to be added would replace.
struct DynamicSurface::Hole
{
  std::vector<Edge> edges; // of the border's facets whose cell is inside, each turned outward
  std::vector<Triangle> triangles; // of the surface within it
};

DynamicSurface::DynamicSurface() : mesh_(std::make_unique<Mesh>()) {}

DynamicSurface::~DynamicSurface() = default;

void DynamicSurface::insert(const std::vector<Vec3>& points, const Progress& progress)
{
  Delaunay& delaunay = mesh_->delaunay;
  Cell near;
  for (std::size_t k = 0; k < points.size(); ++k)
  {
    const std::size_t known = delaunay.number_of_vertices();
    const Vertex vertex = delaunay.insert(toCgal(points[k]), near);
    const bool added = delaunay.number_of_vertices() > known;
    if (added)
    {
      vertex->info() = static_cast<std::int32_t>(sites_.size());
    }
    mesh_->vertices.push_back(added ? vertex : Vertex());
    sites_.push_back(points[k]);
    near = vertex->cell();
    if (k % 256 == 0)
    {
      progress.check();
      progress.report(double(k) / double(points.size()));
    }
  }
}

bool DynamicSurface::spansVolume() const
{
  return mesh_->delaunay.dimension() == 3;
}

Tetrahedralization DynamicSurface::tetrahedralization(const Progress& progress) const
{
  return Tetrahedralization(sites_, mesh_->delaunay, progress);
}

void DynamicSurface::setInside(const std::vector<std::uint8_t>& inside)
{
  for (const Cell cell : mesh_->delaunay.all_cell_handles())
  {
    cell->info().inside = inside[cell->info().number] != 0;
  }
}

DynamicSurface::Outcome DynamicSurface::place(
  const Vec3& point, std::int32_t near, double tolerance)
{
  Delaunay& delaunay = mesh_->delaunay;
  const auto site = toCgal(point);
  Delaunay::Locate_type where;
  int i = 0;
  int j = 0;
  const Vertex nearVertex = mesh_->vertices[near];
  const Cell start =
    delaunay.locate(site, where, i, j, nearVertex == Vertex() ? Cell() : nearVertex->cell());
  if (where == Delaunay::VERTEX)
  {
    return this->surfaceAt(start->vertex(i)->info(), tolerance);
  }
  std::vector<Cell>& conflicts = mesh_->conflicts;
  std::vector<Facet>& border = mesh_->border;
  conflicts.clear();
  border.clear();
  delaunay.find_conflicts(site, start, std::back_inserter(border), std::back_inserter(conflicts));

  Hole hole;
  // To tell them from others. Sorted aside: by address, which must not decide on anything.
  std::vector<Cell>& sorted = mesh_->sorted;
  sorted = conflicts;
  std::sort(sorted.begin(), sorted.end());
  for (const Cell cell : conflicts)
  {
    for (int facet = 0; cell->info().inside && facet < 4; ++facet)
    {
      const Cell beyond = cell->neighbor(facet);
      if (!beyond->info().inside && std::binary_search(sorted.begin(), sorted.end(), beyond))
      {
        hole.triangles.push_back(corners(cell, facet));
      }
    }
  }
  Facet dent;
  if (hole.triangles.empty())
  {
    dent = mesh_->facetTowards(point, sites_);
    if (dent.first == Cell())
    {
      return Outcome::Refused;
    }
    hole.triangles.push_back(corners(dent.first, dent.second));
  }
  for (const Triangle& triangle : hole.triangles)
  {
    if (this->isNear(triangle, point, tolerance))
    {
      return Outcome::Near;
    }
  }
  for (const Facet& facet : border)
  {
    if (facet.first->info().inside)
    {
      const Triangle corner = corners(facet.first, facet.second);
      for (int k = 0; k < 3; ++k)
      {
        hole.edges.push_back({ corner[k], corner[(k + 1) % 3] });
      }
    }
  }
  if (dent.first == Cell() && !this->keepsManifold(hole))
  {
    return Outcome::Refused;
  }
  for (const Triangle& triangle : hole.triangles)
  {
    touched_.insert(touched_.end(), triangle.begin(), triangle.end());
  }

  struct Base
  {
    Cell outer;
    int facet;
    bool inside;
  };
  std::vector<Base> bases;
  bases.reserve(border.size());
  for (const Facet& facet : border)
  {
    const Facet outer = delaunay.mirror_facet(facet);
    const bool inside = facet.first->info().inside;
    bases.push_back({ outer.first, outer.second, facet == dent ? !inside : inside });
  }
  const Vertex vertex = delaunay.insert_in_hole(
    site, conflicts.begin(), conflicts.end(), border.front().first, border.front().second);
  vertex->info() = static_cast<std::int32_t>(sites_.size());
  touched_.push_back(vertex->info());
  sites_.push_back(point);
  mesh_->vertices.push_back(vertex);
  for (const Base& base : bases)
  {
    base.outer->neighbor(base.facet)->info() = { -1, base.inside };
  }
  return Outcome::Placed;
}

bool DynamicSurface::isNear(const Triangle& triangle, const Vec3& point, double tolerance)
{
  nearTriangle_ = triangle;
  nearDistance_ = std::sqrt(
    nearestOnTriangle(point, sites_[triangle[0]], sites_[triangle[1]], sites_[triangle[2]])
      .squaredDistance);
  return nearDistance_ <= tolerance;
}

// Lets the surface step on to a site that it has passed by, or not come to.
DynamicSurface::Outcome DynamicSurface::surfaceAt(std::int32_t site, double tolerance)
{
  const Vertex vertex = mesh_->vertices[site];
  std::vector<Cell>& star = mesh_->conflicts;
  std::vector<Facet>& border = mesh_->border;
  star.clear();
  border.clear();
  mesh_->delaunay.incident_cells(vertex, std::back_inserter(star));
  for (const Cell cell : star)
  {
    if (cell->info().inside != star[0]->info().inside)
    {
      return Outcome::Coincides; // it is on the surface
    }
    border.emplace_back(cell, cell->index(vertex));
  }
  const Facet facet = mesh_->facetTowards(sites_[site], sites_);
  if (facet.first == Cell())
  {
    return Outcome::Refused;
  }
  const Triangle t = corners(facet.first, facet.second);
  if (this->isNear(t, sites_[site], tolerance))
  {
    return Outcome::Near;
  }
  facet.first->info().inside = !facet.first->info().inside;
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
  for (const Cell cell : mesh_->delaunay.finite_cell_handles())
  {
    for (int facet = 0; cell->info().inside && facet < 4; ++facet)
    {
      if (!cell->neighbor(facet)->info().inside)
      {
        triangles.push_back(corners(cell, facet));
      }
    }
  }
  return triangles;
}

// Where all that a point replaces is on one side of the surface: the surface's nearest facet on the
// border that is not oriented Gabriel for the point, so that convection would step on to it. That
// is one facet replaced by three about a new vertex, and never changes the topology.
Facet DynamicSurface::Mesh::facetTowards(const Vec3& point, const std::vector<Vec3>& sites) const
{
  const auto site = toCgal(point);
  Facet best;
  double least = std::numeric_limits<double>::infinity();
  for (const Facet& facet : border)
  {
    const Cell outer = facet.first->neighbor(facet.second);
    if (outer->info().inside == facet.first->info().inside || delaunay.is_infinite(facet))
    {
      continue;
    }
    const Triangle t = corners(facet.first, facet.second);
    const double squared =
      nearestOnTriangle(point, sites[t[0]], sites[t[1]], sites[t[2]]).squaredDistance;
    if (squared < least &&
      Kernel().side_of_bounded_sphere_3_object()(toCgal(sites[t[0]]), toCgal(sites[t[1]]),
        toCgal(sites[t[2]]), site) == CGAL::ON_BOUNDED_SIDE)
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

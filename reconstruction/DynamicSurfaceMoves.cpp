// SPDX-License-Identifier: BSD-3-Clause
// How DynamicSurface moves single tetrahedra to the other side of its surface.
#include "reconstruction/DynamicSurface.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace hybridtree
{

// Moves one tetrahedron that the last point would replace to the other side of the surface, if
// then, or after so many moves in all, the point can be placed.
bool DynamicSurface::prepare(const Vec3& point, double tolerance, int moves)
{
  const std::int32_t cell = this->firstMove(point, tolerance, moves);
  if (cell >= 0)
  {
    this->flip(cell);
    this->remember(cell);
  }
  return cell >= 0;
}

// \returns a cell; -1: there is none.
std::int32_t DynamicSurface::firstMove(const Vec3& point, double tolerance, int moves)
{
  for (const std::int32_t cell : cavity_.cells)
  {
    if (!this->mayFlip(cell))
    {
      continue;
    }
    inside_[cell] ^= 1;
    const bool prepared = moves > 1 ? this->firstMove(point, tolerance, moves - 1) >= 0
                                    : this->mayPlace(point, tolerance);
    inside_[cell] ^= 1;
    if (prepared)
    {
      return cell;
    }
  }
  return -1;
}

// What is prepared is placed, else two points could push the surface to and fro for ever.
bool DynamicSurface::mayPlace(const Vec3& point, double tolerance)
{
  const Hole hole = this->holeOf(cavity_.cells);
  const bool near = std::any_of(hole.triangles.begin(), hole.triangles.end(),
    [&](std::int32_t triangle) { return this->isNear(triangle, point, tolerance); });
  return !hole.triangles.empty() && !near && this->keepsManifold(hole);
}

// Moves the nearest tetrahedron that may to the other side of the surface, near by steps from cells
// that are all on one side. Not a spike: its tip would be no vertex any more.
bool DynamicSurface::approach(const std::vector<std::int32_t>& from)
{
  constexpr std::size_t kMostCells = 512;
  std::vector<std::int32_t> cells = from;
  for (const std::int32_t cell : from)
  {
    marks_[cell] = 1;
  }
  std::int32_t found = -1;
  for (std::size_t k = 0; found < 0 && k < cells.size() && k < kMostCells; ++k)
  {
    const int open = this->openFacets(cells[k]);
    if ((open == 1 || open == 2) && this->mayFlip(cells[k]))
    {
      found = cells[k];
    }
    for (std::int32_t facet = 4 * cells[k]; facet < 4 * cells[k] + 4; ++facet)
    {
      const std::int32_t beyond = delaunay_.beyond(facet) >> 2;
      if (marks_[beyond] == 0 && inside_[beyond] == inside_[cells[k]])
      {
        marks_[beyond] = 1;
        cells.push_back(beyond);
      }
    }
  }
  for (const std::int32_t cell : cells)
  {
    marks_[cell] = 0;
  }
  if (found < 0)
  {
    return false;
  }
  this->flip(found);
  this->remember(found);
  return true;
}

// Moves one of cells on both sides of the surface, best one of the side that has fewer, so that in
// the end it passes them once or not at all; if no other may, a spike, whose tip then is no vertex.
bool DynamicSurface::clear(const std::vector<std::int32_t>& cells)
{
  const auto inside = static_cast<std::size_t>(std::count_if(
    cells.begin(), cells.end(), [&](std::int32_t cell) { return inside_[cell] != 0; }));
  const std::uint8_t fewer = 2 * inside <= cells.size() ? 1 : 0;
  // Else two moves could undo each other for ever.
  constexpr std::size_t kLately = 32; // steps
  const auto lately = steps_.end() - static_cast<std::ptrdiff_t>(std::min(kLately, steps_.size()));
  const auto movedLately = [&](std::int32_t cell)
  {
    return std::any_of(
      lately, steps_.end(), [&](const Step& step) { return step.flipped == cell; });
  };
  std::int32_t best = -1;
  int bestRank = 3;
  for (const std::int32_t cell : cells)
  {
    const int rank = this->openFacets(cell) == 3 ? 1 : inside_[cell] == fewer ? 0 : 2;
    if (rank < bestRank && !movedLately(cell) && this->mayFlip(cell))
    {
      best = cell;
      bestRank = rank;
    }
  }
  if (best < 0)
  {
    return false;
  }
  this->flip(best);
  this->remember(best);
  return true;
}

int DynamicSurface::openFacets(std::int32_t cell) const
{
  int open = 0;
  for (std::int32_t facet = 4 * cell; facet < 4 * cell + 4; ++facet)
  {
    open += inside_[delaunay_.beyond(facet) >> 2] != inside_[cell];
  }
  return open;
}

// Whether the surface stays a manifold of the same genus. The same moves as the flow's (Front.cpp).
bool DynamicSurface::mayFlip(std::int32_t cell)
{
  if (!delaunay_.finite(cell))
  {
    return false;
  }
  std::array<int, 4> open{};
  int openCount = 0;
  for (std::int32_t facet = 0; facet < 4; ++facet)
  {
    if (inside_[delaunay_.beyond(4 * cell + facet) >> 2] != inside_[cell])
    {
      open[openCount++] = facet;
    }
  }
  const auto& v = delaunay_.cell(cell).vertices;
  return openCount == 3 || (openCount == 1 && !this->onSurface(v[open[0]], v[open[0]])) ||
    (openCount == 2 && !this->onSurface(v[open[0]], v[open[1]]));
}

// Whether a vertex, or an edge between two, is part of the surface.
bool DynamicSurface::onSurface(std::int32_t site, std::int32_t other)
{
  delaunay_.star(site, star_);
  std::array<bool, 2> seen{};
  for (const std::int32_t cell : star_)
  {
    const auto& v = delaunay_.cell(cell).vertices;
    if (std::find(v.begin(), v.end(), other) != v.end())
    {
      seen[inside_[cell] != 0 ? 1 : 0] = true;
    }
  }
  return seen[0] && seen[1];
}

// Moves a tetrahedron to the other side of the surface.
void DynamicSurface::flip(std::int32_t cell)
{
  const auto facets = [&](std::vector<std::int32_t>& triangles)
  {
    triangles.clear();
    for (std::int32_t facet = 4 * cell; facet < 4 * cell + 4; ++facet)
    {
      if (inside_[cell] != inside_[delaunay_.beyond(facet) >> 2])
      {
        triangles.push_back(this->triangleOf(facet));
      }
    }
  };
  facets(change_.removed);
  inside_[cell] ^= 1;
  facets(change_.added);
  change_.renamed.clear();
}

// One of those around a site on the surface. \pre cavity_.cells is the cells around it.
std::int32_t DynamicSurface::triangleAt(std::int32_t site) const
{
  for (const std::int32_t cell : cavity_.cells)
  {
    for (std::int32_t facet = 4 * cell; facet < 4 * cell + 4; ++facet)
    {
      if (delaunay_.cell(cell).vertices[facet & 3] != site &&
        inside_[cell] != inside_[delaunay_.beyond(facet) >> 2])
      {
        return this->triangleOf(facet);
      }
    }
  }
  return -1;
}

// Lets the surface step on to a site that it has passed by, or not come to.
DynamicSurface::Outcome DynamicSurface::surfaceAt(std::int32_t site, double tolerance, Way way)
{
  std::vector<std::int32_t>& star = cavity_.cells;
  std::vector<std::int32_t>& border = cavity_.border;
  delaunay_.star(site, star);
  border.clear();
  for (const std::int32_t cell : star)
  {
    if (inside_[cell] != inside_[star[0]]) // it is on the surface
    {
      nearTriangle_ = this->triangleAt(site);
      nearDistance_ = 0.0;
      return Outcome::Coincides;
    }
    const auto& v = delaunay_.cell(cell).vertices;
    border.push_back(
      4 * cell + static_cast<std::int32_t>(std::find(v.begin(), v.end(), site) - v.begin()));
  }
  const Vec3& point = this->sites()[site];
  const std::int32_t facet = this->facetTowards(point, border, way);
  if (facet < 0)
  {
    return way == Way::Any && this->approach(star) ? Outcome::Prepared : Outcome::Refused;
  }
  if (this->isNear(this->triangleOf(facet), point, tolerance))
  {
    return Outcome::Near;
  }
  this->flip(facet >> 2);
  this->remember(facet >> 2);
  return Outcome::Surfaced;
}

} // namespace hybridtree

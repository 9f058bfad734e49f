// SPDX-License-Identifier: BSD-3-Clause
// How DynamicSurface moves single tetrahedra to the other side of its surface.
#include "reconstruction/DynamicSurface.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace hybridtree
{

// Moves tetrahedra so that a point can be placed that now would not leave the surface a manifold.
DynamicSurface::Outcome DynamicSurface::makeReady(
  Hand& hand, const Vec3& point, double tolerance, Way way)
{
  const bool any = way == Way::Any;
  const bool ready = this->prepare(hand, point, tolerance, 1) ||
    (any &&
      (this->prepare(hand, point, tolerance, 2) || this->prepare(hand, point, tolerance, 3) ||
        this->clear(hand.cavity_.cells)));
  return ready ? Outcome::Prepared : Outcome::Refused;
}

// Moves one tetrahedron that the last point would replace to the other side of the surface, if
// then, or after so many moves in all, the point can be placed.
bool DynamicSurface::prepare(Hand& hand, const Vec3& point, double tolerance, int moves)
{
  const std::int32_t cell = this->firstMove(hand, point, tolerance, moves);
  if (cell >= 0)
  {
    this->move(hand, cell);
  }
  return cell >= 0;
}

// \returns a cell; -1: there is none.
std::int32_t DynamicSurface::firstMove(Hand& hand, const Vec3& point, double tolerance, int moves)
{
  for (const std::int32_t cell : hand.cavity_.cells)
  {
    if (!this->mayFlip(hand, cell))
    {
      continue;
    }
    inside_[cell] ^= 1;
    const bool prepared = moves > 1 ? this->firstMove(hand, point, tolerance, moves - 1) >= 0
                                    : this->mayPlace(hand, point, tolerance);
    inside_[cell] ^= 1;
    if (prepared)
    {
      return cell;
    }
  }
  return -1;
}

// What is prepared is placed, else two points could push the surface to and fro for ever.
bool DynamicSurface::mayPlace(Hand& hand, const Vec3& point, double tolerance)
{
  this->findHole(hand);
  const bool near = std::any_of(hand.hole_.begin(), hand.hole_.end(),
    [&](std::int32_t triangle) { return this->isNear(hand, triangle, point, tolerance); });
  return !hand.hole_.empty() && !near && this->keepsManifold(hand);
}

// Moves the nearest tetrahedron that may to the other side of the surface, near by steps from cells
// that are all on one side. Not a spike: its tip would be no vertex any more.
bool DynamicSurface::approach(const std::vector<std::int32_t>& from)
{
  constexpr std::size_t kMostCells = 512;
  std::vector<std::int32_t> cells = from;
  for (const std::int32_t cell : from)
  {
    own_.marks_[cell] = 1;
  }
  std::int32_t found = -1;
  for (std::size_t k = 0; found < 0 && k < cells.size() && k < kMostCells; ++k)
  {
    const int open = this->openFacets(cells[k]);
    if ((open == 1 || open == 2) && this->mayFlip(own_, cells[k]))
    {
      found = cells[k];
    }
    for (std::int32_t facet = 4 * cells[k]; facet < 4 * cells[k] + 4; ++facet)
    {
      const std::int32_t beyond = delaunay_.beyond(facet) >> 2;
      if (own_.marks_[beyond] == 0 && inside_[beyond] == inside_[cells[k]])
      {
        own_.marks_[beyond] = 1;
        cells.push_back(beyond);
      }
    }
  }
  for (const std::int32_t cell : cells)
  {
    own_.marks_[cell] = 0;
  }
  if (found < 0)
  {
    return false;
  }
  this->move(own_, found);
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
  const std::vector<Step>& steps = own_.history_.steps;
  const auto lately = steps.end() - static_cast<std::ptrdiff_t>(std::min(kLately, steps.size()));
  const auto movedLately = [&](std::int32_t cell)
  {
    return std::any_of(lately, steps.end(), [&](const Step& step) { return step.flipped == cell; });
  };
  std::int32_t best = -1;
  int bestRank = 3;
  for (const std::int32_t cell : cells)
  {
    const int rank = this->openFacets(cell) == 3 ? 1 : inside_[cell] == fewer ? 0 : 2;
    if (rank < bestRank && !movedLately(cell) && this->mayFlip(own_, cell))
    {
      best = cell;
      bestRank = rank;
    }
  }
  if (best < 0)
  {
    return false;
  }
  this->move(own_, best);
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
bool DynamicSurface::mayFlip(Hand& hand, std::int32_t cell) const
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
  return openCount == 3 || (openCount == 1 && !this->vertexOnSurface(hand, cell, open[0])) ||
    (openCount == 2 && !this->edgeOnSurface(cell, open[0], open[1]));
}

// Whether there are cells on both sides around a vertex of one.
bool DynamicSurface::vertexOnSurface(Hand& hand, std::int32_t cell, int vertex) const
{
  const std::int32_t site = delaunay_.cell(cell).vertices[vertex];
  constexpr std::uint8_t kSeen = 2; // 1 may be in use
  std::vector<std::int32_t>& star = hand.star_;
  bool all = true;
  star.assign(1, cell);
  hand.marks_[cell] |= kSeen;
  for (std::size_t k = 0; all && k < star.size(); ++k)
  {
    const Delaunay::Cell& at = delaunay_.cell(star[k]);
    for (int facet = 0; facet < 4; ++facet)
    {
      const std::int32_t beyond = at.beyond[facet] >> 2;
      if (at.vertices[facet] != site && (hand.marks_[beyond] & kSeen) == 0)
      {
        hand.marks_[beyond] |= kSeen;
        star.push_back(beyond);
        all = all && inside_[beyond] == inside_[cell];
      }
    }
  }
  for (const std::int32_t seen : star)
  {
    hand.marks_[seen] ^= kSeen;
  }
  return !all;
}

// Whether there are cells on both sides around an edge of one.
bool DynamicSurface::edgeOnSurface(std::int32_t cell, int from, int to) const
{
  const std::array<std::int32_t, 2> ends{ delaunay_.cell(cell).vertices[from],
    delaunay_.cell(cell).vertices[to] };
  int leave = 0;
  while (leave == from || leave == to)
  {
    ++leave;
  }
  std::int32_t at = cell;
  do
  {
    const std::int32_t next = delaunay_.beyond(4 * at + leave);
    at = next >> 2;
    if (inside_[at] != inside_[cell])
    {
      return true;
    }
    // Of the four facets two are around the edge: go on through the other of them.
    const auto& v = delaunay_.cell(at).vertices;
    const auto indexOf = [&](std::int32_t site)
    { return static_cast<int>(std::find(v.begin(), v.end(), site) - v.begin()); };
    leave = 6 - indexOf(ends[0]) - indexOf(ends[1]) - (next & 3);
  } while (at != cell);
  return false;
}

void DynamicSurface::move(Hand& hand, std::int32_t cell)
{
  this->flip(cell, hand.change_);
  remember(hand, cell, -1);
}

// Moves a tetrahedron to the other side of the surface.
void DynamicSurface::flip(std::int32_t cell, Change& change)
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
  facets(change.removed);
  inside_[cell] ^= 1;
  facets(change.added);
  change.renamed.clear();
}

// One of those around a site on the surface. \pre own_.cavity_.cells is the cells around it.
std::int32_t DynamicSurface::triangleAt(std::int32_t site) const
{
  for (const std::int32_t cell : own_.cavity_.cells)
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
  std::vector<std::int32_t>& star = own_.cavity_.cells;
  std::vector<std::int32_t>& border = own_.cavity_.border;
  delaunay_.star(site, star);
  border.clear();
  for (const std::int32_t cell : star)
  {
    if (inside_[cell] != inside_[star[0]]) // it is on the surface
    {
      own_.nearTriangle_ = this->triangleAt(site);
      own_.nearDistance_ = 0.0;
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
  if (this->isNear(own_, this->triangleOf(facet), point, tolerance))
  {
    return Outcome::Near;
  }
  this->move(own_, facet >> 2);
  return Outcome::Surfaced;
}

} // namespace hybridtree

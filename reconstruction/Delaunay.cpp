// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Delaunay.h"

#include "reconstruction/DelaunayPredicates.h"

#include "core/base/Error.h"
#include "core/geometry/Predicates.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

namespace hybridtree
{
namespace
{

// A cavity with more vertices on its border is joined by sorting instead of a table.
constexpr std::size_t kMostLocals = 64;

} // namespace

Delaunay::Place Delaunay::locate(const Vec3& point, std::int32_t start)
{
  return this->locate(anywhere_, point, start);
}

Delaunay::Place Delaunay::locate(Worker& worker, const Vec3& point, std::int32_t start) const
{
  const std::int32_t cell = this->walk(worker, point, start);
  return cell < 0 ? Place{ -1, -1 } : this->placeIn(cell, point);
}

Delaunay::Place Delaunay::placeIn(std::int32_t cell, const Vec3& point) const
{
  for (const std::int32_t vertex : cells_[cell].vertices)
  {
    if (vertex != kInfinite && points_[vertex] == point)
    {
      return { cell, vertex };
    }
  }
  return { cell, -1 };
}

std::int32_t Delaunay::startOfWalk(std::int32_t near) const
{
  std::int32_t start = near >= 0 ? cellOf_[near] : -1;
  if (start < 0)
  {
    start = 0;
    while (!this->used(start))
    {
      ++start;
    }
  }
  return start;
}

// Whether nobody else may be changing what is beyond a facet: one whose vertices are of several
// slabs is between cells that belong to none.
bool Delaunay::mayCross(const Worker& worker, std::int32_t halfFacet) const
{
  if (this->belongs(worker, halfFacet >> 2))
  {
    return true;
  }
  int first = 0;
  for (const std::int32_t vertex : this->facet(halfFacet))
  {
    const int slab = vertex == kInfinite ? first : slabs_[vertex];
    if (slab == worker.slab_ || (first != 0 && slab != first))
    {
      return true;
    }
    first = slab;
  }
  return false;
}

// Through facets that part the cell from the point, to a cell that holds it. Which of several is
// taken turns, so that cells of one ball make no circle. \returns -1 if it may not get there.
std::int32_t Delaunay::walk(Worker& worker, const Vec3& point, std::int32_t cell) const
{
  if (!this->finite(cell))
  {
    const auto& v = cells_[cell].vertices;
    cell = cells_[cell].beyond[std::find(v.begin(), v.end(), kInfinite) - v.begin()] >> 2;
  }
  std::int32_t entered = -1;
  while (true)
  {
    worker.turn = worker.turn * 1664525u + 1013904223u;
    const Cell& at = cells_[cell];
    std::int32_t through = -1;
    for (std::uint32_t k = 0; through < 0 && k < 4; ++k)
    {
      const auto facet = static_cast<std::int32_t>((k + (worker.turn >> 30)) & 3u);
      if (facet == entered)
      {
        continue;
      }
      const int* corner = kFacetCorners[facet];
      if (sideOfPlane(points_[at.vertices[corner[0]]], points_[at.vertices[corner[1]]],
            points_[at.vertices[corner[2]]], point) > 0)
      {
        through = facet;
      }
    }
    if (through < 0)
    {
      return cell;
    }
    if (!this->mayCross(worker, 4 * cell + through))
    {
      return -1;
    }
    const std::int32_t next = at.beyond[through];
    cell = next >> 2;
    entered = next & 3;
    if (!this->finite(cell))
    {
      return cell;
    }
  }
}

bool Delaunay::inConflict(const Cell& cell, const Vec3& point) const
{
  const auto& v = cell.vertices;
  if (v[0] >= 0 && v[1] >= 0 && v[2] >= 0 && v[3] >= 0)
  {
    return sideOfBall(points_[v[0]], points_[v[1]], points_[v[2]], points_[v[3]], point) > 0;
  }
  // The ball of an infinite cell is the half-space outside of its facet of the hull; in the plane
  // of the facet, the disc.
  const auto infinite = std::find(v.begin(), v.end(), kInfinite) - v.begin();
  const int* corner = kFacetCorners[infinite];
  const int side =
    sideOfPlane(points_[v[corner[0]]], points_[v[corner[1]]], points_[v[corner[2]]], point);
  return side < 0 || (side == 0 && this->inConflict(cells_[cell.beyond[infinite] >> 2], point));
}

void Delaunay::findCavity(const Vec3& point, const Place& place, Cavity& cavity)
{
  this->findCavity(anywhere_, point, place.cell, cavity);
}

bool Delaunay::findCavity(Worker& worker, const Vec3& point, const Place& place, Cavity& cavity)
{
  return this->findCavity(worker, point, place.cell, cavity);
}

// \returns whether all of it belongs to the worker.
bool Delaunay::findCavity(Worker& worker, const Vec3& point, std::int32_t start, Cavity& cavity)
{
  cavity.cells.clear();
  cavity.border.clear();
  worker.marked.clear();
  bool whole = this->belongs(worker, start);
  if (whole)
  {
    cavity.cells.push_back(start);
    marks_[start] |= kInCavity;
  }
  for (std::size_t k = 0; whole && k < cavity.cells.size(); ++k)
  {
    const std::int32_t cell = cavity.cells[k];
    for (std::int32_t facet = 0; facet < 4; ++facet)
    {
      const std::int32_t beyond = cells_[cell].beyond[facet] >> 2;
      const int flag = marks_[beyond] & kFlags;
      bool outside = flag == kOutside;
      if (!this->belongs(worker, beyond)) // so it may not be marked
      {
        outside = !this->inConflict(cells_[beyond], point);
        whole = whole && outside;
      }
      else if (flag == 0)
      {
        outside = !this->inConflict(cells_[beyond], point);
        marks_[beyond] |= outside ? kOutside : kInCavity;
        (outside ? worker.marked : cavity.cells).push_back(beyond);
      }
      if (outside)
      {
        cavity.border.push_back(4 * cell + facet);
      }
    }
  }
  this->unmark(worker.marked);
  this->unmark(cavity.cells);
  return whole;
}

void Delaunay::unmark(const std::vector<std::int32_t>& cells)
{
  for (const std::int32_t cell : cells)
  {
    marks_[cell] &= static_cast<std::uint8_t>(~kFlags);
  }
}

void Delaunay::star(std::int32_t vertex, std::vector<std::int32_t>& cells)
{
  cells.assign(1, cellOf_[vertex]);
  marks_[cells[0]] |= kInCavity;
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    const Cell& cell = cells_[cells[k]];
    for (int facet = 0; facet < 4; ++facet)
    {
      const std::int32_t beyond = cell.beyond[facet] >> 2;
      if (cell.vertices[facet] != vertex && (marks_[beyond] & kFlags) == 0)
      {
        marks_[beyond] |= kInCavity;
        cells.push_back(beyond);
      }
    }
  }
  this->unmark(cells);
}

void Delaunay::renumber(const RawVector<Cell>& cells)
{
  cells_ = cells;
  marks_.assign(cells_.size(), 0);
  anywhere_.unused.clear();
  for (std::int32_t cell = this->cellCount(); cell-- > 0;)
  {
    for (const std::int32_t vertex : cells_[cell].vertices)
    {
      if (vertex != kInfinite)
      {
        cellOf_[vertex] = cell;
      }
    }
  }
}

void Delaunay::removePoints(const std::vector<std::uint8_t>& kept)
{
  std::vector<std::int32_t> number(kept.size());
  std::int32_t next = 0;
  for (std::size_t point = 0; point < kept.size(); ++point)
  {
    number[point] = next;
    points_[next] = points_[point];
    cellOf_[next] = cellOf_[point];
    next += kept[point];
  }
  points_.resize(next);
  cellOf_.resize(next);
  local_.resize(next);
  for (Cell& cell : cells_)
  {
    for (std::int32_t& vertex : cell.vertices)
    {
      vertex = cell.vertices[0] >= kInfinite && vertex >= 0 ? number[vertex] : vertex;
    }
  }
}

std::int32_t Delaunay::fill(const Vec3& point, Cavity& cavity)
{
  const auto vertex = static_cast<std::int32_t>(points_.size());
  points_.push_back(point);
  cellOf_.push_back(-1);
  local_.push_back(0);
  if (!slabs_.empty())
  {
    slabs_.push_back(static_cast<std::uint8_t>(this->slabOf(point)));
  }
  this->fill(anywhere_, vertex, cavity);
  for (std::size_t k = 0; k < cavity.cells.size() && !slabs_.empty(); ++k)
  {
    this->markSlab(cavity.cells[k]);
  }
  return vertex;
}

void Delaunay::fill(Worker& worker, std::int32_t vertex, const Vec3& point, Cavity& cavity)
{
  points_[vertex] = point;
  this->fill(worker, vertex, cavity);
}

bool Delaunay::hasCells(const Worker& worker, const Cavity& cavity) const
{
  return worker.slab_ == 0 || cavity.cells.size() + worker.cellsLeft() >= cavity.border.size();
}

void Delaunay::fill(Worker& worker, std::int32_t point, Cavity& cavity)
{
  worker.bases.clear();
  for (const std::int32_t inner : cavity.border)
  {
    worker.bases.push_back({ this->facet(inner), this->beyond(inner), {} });
  }
  this->takeCells(worker, cavity);
  this->makeCells(worker, point, cavity);
  cellOf_[point] = cavity.cells[0];
}

// As many as there are bases: their own places first, then those that were given up, then new ones.
void Delaunay::takeCells(Worker& worker, Cavity& cavity)
{
  const std::size_t wanted = worker.bases.size();
  const std::int32_t unused = worker.slab_ == 0 ? kUnused : kGiven;
  while (cavity.cells.size() > wanted)
  {
    worker.unused.push_back(cavity.cells.back());
    cells_[cavity.cells.back()].vertices[0] = unused;
    cavity.cells.pop_back();
  }
  while (cavity.cells.size() < wanted && !worker.unused.empty())
  {
    const std::int32_t cell = worker.unused.back();
    worker.unused.pop_back();
    if (cells_[cell].vertices[0] == unused) // it may be listed twice, and used since
    {
      cells_[cell].vertices[0] = 0;
      cavity.cells.push_back(cell);
    }
  }
  if (worker.slab_ == 0 && cavity.cells.size() < wanted)
  {
    const std::size_t end = cells_.size() + wanted - cavity.cells.size();
    if (end > mostCells_)
    {
      throw TooLarge("The points have more than " + std::to_string(mostCells_) +
        " tetrahedra, more than can be kept: they may lie along curves instead of a surface. Thin "
        "them by a larger Spacing.");
    }
    worker.nextCell = this->cellCount();
    cells_.resize(end);
    marks_.resize(end, 0);
  }
  while (cavity.cells.size() < wanted)
  {
    cavity.cells.push_back(worker.nextCell++);
  }
}

void Delaunay::takeBack(std::int32_t vertex, const std::vector<std::int32_t>& star,
  const Replaced* begin, const Replaced* end)
{
  for (const std::int32_t cell : star)
  {
    cells_[cell].vertices[0] = kUnused;
    anywhere_.unused.push_back(cell);
  }
  for (const Replaced* old = begin; old != end; ++old)
  {
    cells_[old->number] = old->cell;
  }
  for (const Replaced* old = begin; old != end; ++old)
  {
    for (std::int32_t facet = 0; facet < 4; ++facet)
    {
      const std::int32_t beyond = old->cell.beyond[facet];
      cells_[beyond >> 2].beyond[beyond & 3] = 4 * old->number + facet;
      if (old->cell.vertices[facet] >= 0)
      {
        cellOf_[old->cell.vertices[facet]] = old->number;
      }
    }
  }
  points_.resize(vertex);
  cellOf_.resize(vertex);
  local_.resize(vertex);
}

std::int32_t Delaunay::localOf(Worker& worker, std::int32_t vertex)
{
  std::vector<std::int32_t>& locals = worker.locals;
  std::int32_t& local = vertex == kInfinite ? worker.infiniteLocal : local_[vertex];
  if (static_cast<std::size_t>(local) >= locals.size() || locals[local] != vertex)
  {
    local = static_cast<std::int32_t>(locals.size());
    locals.push_back(vertex);
  }
  return local;
}

// A cell on each base, with the point at its top.
void Delaunay::makeCells(Worker& worker, std::int32_t point, Cavity& cavity)
{
  worker.locals.clear();
  for (std::size_t k = 0; k < worker.bases.size(); ++k)
  {
    Worker::Base& base = worker.bases[k];
    const std::int32_t number = cavity.cells[k];
    Cell& cell = cells_[number];
    cell.vertices = { point, base.corners[0], base.corners[1], base.corners[2] };
    cell.beyond[0] = base.outer;
    cells_[base.outer >> 2].beyond[base.outer & 3] = 4 * number;
    cavity.border[k] = 4 * number;
    for (int corner = 0; corner < 3; ++corner)
    {
      base.local[corner] = this->localOf(worker, base.corners[corner]);
      if (base.corners[corner] >= 0)
      {
        cellOf_[base.corners[corner]] = number;
      }
    }
  }
  if (worker.locals.size() <= kMostLocals)
  {
    this->joinSmall(worker, cavity.cells);
  }
  else
  {
    this->joinLarge(worker, cavity.cells);
  }
}

// Two cells share the facet at an edge of their bases, which one has forward, one backward.
void Delaunay::joinSmall(Worker& worker, const std::vector<std::int32_t>& cells)
{
  // Facet of the edge from the k-th corner of a base to the next: the one opposite to the third.
  constexpr int kFacet[3] = { 3, 1, 2 };
  const std::size_t count = worker.locals.size();
  std::vector<std::int32_t>& edgeFacets = worker.edges;
  edgeFacets.resize(std::max(edgeFacets.size(), count * count));
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    const auto& local = worker.bases[k].local;
    for (int corner = 0; corner < 3; ++corner)
    {
      edgeFacets[local[corner] * count + local[(corner + 1) % 3]] = 4 * cells[k] + kFacet[corner];
    }
  }
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    const auto& local = worker.bases[k].local;
    for (int corner = 0; corner < 3; ++corner)
    {
      cells_[cells[k]].beyond[kFacet[corner]] =
        edgeFacets[local[(corner + 1) % 3] * count + local[corner]];
    }
  }
}

void Delaunay::joinLarge(const Worker& worker, const std::vector<std::int32_t>& cells)
{
  constexpr int kFacet[3] = { 3, 1, 2 };
  std::vector<std::pair<std::uint64_t, std::int32_t>> edges;
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    const auto& local = worker.bases[k].local;
    for (int corner = 0; corner < 3; ++corner)
    {
      const auto [low, high] = std::minmax(local[corner], local[(corner + 1) % 3]);
      edges.emplace_back(
        std::uint64_t(low) << 32 | std::uint64_t(high), 4 * cells[k] + kFacet[corner]);
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t k = 0; k + 1 < edges.size(); k += 2)
  {
    const std::int32_t a = edges[k].second;
    const std::int32_t b = edges[k + 1].second;
    cells_[a >> 2].beyond[a & 3] = b;
    cells_[b >> 2].beyond[b & 3] = a;
  }
}

} // namespace hybridtree

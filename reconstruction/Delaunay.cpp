// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Delaunay.h"

#include "reconstruction/DelaunayPredicates.h"
#include "reconstruction/SpatialOrder.h"

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

// How many insertions between two looks at whether to go on.
constexpr std::size_t kBreath = 256;
// Half-facets are 32-bit numbers.
constexpr std::size_t kMostCells = std::size_t(1) << 29;
// Tetrahedra about a point of a surface, with the infinite ones, and some to spare.
constexpr std::size_t kCellsPerPoint = 7;
// A cavity with more vertices on its border is joined by sorting instead of a table.
constexpr std::size_t kMostLocals = 64;

enum Mark : std::uint8_t
{
  Unmarked,
  InCavity,
  Outside
};

} // namespace

bool Delaunay::finite(std::int32_t cell) const
{
  const auto& v = cells_[cell].vertices;
  return v[0] >= 0 && v[1] >= 0 && v[2] >= 0 && v[3] >= 0;
}

std::array<std::int32_t, 3> Delaunay::facet(std::int32_t halfFacet) const
{
  const auto& v = cells_[halfFacet >> 2].vertices;
  const int* corner = kFacetCorners[halfFacet & 3];
  return { v[corner[0]], v[corner[1]], v[corner[2]] };
}

void Delaunay::insert(const std::vector<Vec3>& points, const Progress& progress)
{
  std::size_t first = points_.size();
  points_.insert(points_.end(), points.begin(), points.end());
  cellOf_.resize(points_.size(), -1);
  local_.resize(points_.size() + 1, 0);
  if (!this->spansVolume())
  {
    if (!this->insertFirst())
    {
      return;
    }
    first = 0; // those that had to wait, too
  }
  cells_.reserve(kCellsPerPoint * points_.size());
  std::int32_t near = -1;
  std::size_t step = 0;
  for (const std::int32_t k : insertionOrder(points_.size() - first))
  {
    if (++step % kBreath == 0)
    {
      progress.check();
      progress.report(double(step) / double(points_.size() - first));
    }
    this->insertPoint(static_cast<std::int32_t>(first) + k, near);
  }
}

void Delaunay::insertPoint(std::int32_t point, std::int32_t& near)
{
  if (cellOf_[point] >= 0) // one of the first four
  {
    return;
  }
  const Place place = this->locate(points_[point], near);
  if (place.vertex < 0)
  {
    this->findCavity(points_[point], place, cavity_);
    this->fill(point, cavity_);
  }
  near = place.vertex < 0 ? point : place.vertex;
}

// Four points that span a volume, if there are, else -1 from the first on that does not add a
// dimension.
std::array<std::int32_t, 4> Delaunay::independent() const
{
  std::array<std::int32_t, 4> chosen{ -1, -1, -1, -1 };
  std::size_t found = 0;
  const auto at = [&](std::size_t k) -> const Vec3& { return points_[chosen[k]]; };
  for (std::size_t k = 0; found < 4 && k < points_.size(); ++k)
  {
    const Vec3& p = points_[k];
    const bool adds = found == 0 || (found == 1 && p != at(0)) ||
      (found == 2 && !collinear(at(0), at(1), p)) ||
      (found == 3 && sideOfPlane(at(0), at(1), at(2), p) != 0);
    if (adds)
    {
      chosen[found++] = static_cast<std::int32_t>(k);
    }
  }
  return chosen;
}

bool Delaunay::insertFirst()
{
  std::array<std::int32_t, 4> v = this->independent();
  if (v[3] < 0)
  {
    return false;
  }
  if (sideOfPlane(points_[v[0]], points_[v[1]], points_[v[2]], points_[v[3]]) < 0)
  {
    std::swap(v[2], v[3]);
  }
  cells_.push_back({ v, { -1, -1, -1, -1 } });
  cavity_.cells.clear();
  bases_.clear();
  for (std::int32_t facet = 0; facet < 4; ++facet)
  {
    cellOf_[v[facet]] = 0;
    const auto corners = this->facet(facet);
    bases_.push_back({ { corners[0], corners[2], corners[1] }, facet, {} });
    cavity_.cells.push_back(facet + 1);
  }
  cells_.resize(5);
  cavity_.border.resize(4);
  marks_.assign(5, Unmarked);
  this->makeCells(kInfinite, cavity_);
  return true;
}

void Delaunay::checkVolume() const
{
  if (this->spansVolume())
  {
    return;
  }
  const auto chosen = this->independent();
  std::size_t different = 0;
  for (std::size_t k = 0; different < 4 && k < points_.size(); ++k)
  {
    different += std::find(points_.begin(), points_.begin() + std::ptrdiff_t(k), points_[k]) ==
      points_.begin() + std::ptrdiff_t(k);
  }
  if (different < 4)
  {
    throw InvalidGeometry("The point set has " + std::to_string(different) +
      " different points: a closed surface needs at least 4.");
  }
  throw InvalidGeometry(std::string("All points lie on one ") + (chosen[2] < 0 ? "line" : "plane") +
    ": a closed surface needs points that span a volume.");
}

Delaunay::Place Delaunay::locate(const Vec3& point, std::int32_t near)
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
  const std::int32_t cell = this->walk(point, start);
  for (const std::int32_t vertex : cells_[cell].vertices)
  {
    if (vertex != kInfinite && points_[vertex] == point)
    {
      return { cell, vertex };
    }
  }
  return { cell, -1 };
}

// Through facets that part the cell from the point, to a cell that holds it. Which of several is
// taken turns, so that cells of one ball make no circle.
std::int32_t Delaunay::walk(const Vec3& point, std::int32_t cell)
{
  if (!this->finite(cell))
  {
    const auto& v = cells_[cell].vertices;
    cell = cells_[cell].beyond[std::find(v.begin(), v.end(), kInfinite) - v.begin()] >> 2;
  }
  std::int32_t entered = -1;
  while (true)
  {
    turn_ = turn_ * 1664525u + 1013904223u;
    const Cell& at = cells_[cell];
    std::int32_t next = -1;
    for (std::uint32_t k = 0; next < 0 && k < 4; ++k)
    {
      const auto facet = static_cast<std::int32_t>((k + (turn_ >> 30)) & 3u);
      if (facet == entered)
      {
        continue;
      }
      const int* corner = kFacetCorners[facet];
      if (sideOfPlane(points_[at.vertices[corner[0]]], points_[at.vertices[corner[1]]],
            points_[at.vertices[corner[2]]], point) > 0)
      {
        next = at.beyond[facet];
      }
    }
    if (next < 0)
    {
      return cell;
    }
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
  cavity.cells.assign(1, place.cell);
  cavity.border.clear();
  marked_.clear();
  marks_[place.cell] = InCavity;
  for (std::size_t k = 0; k < cavity.cells.size(); ++k)
  {
    const std::int32_t cell = cavity.cells[k];
    for (std::int32_t facet = 0; facet < 4; ++facet)
    {
      const std::int32_t beyond = cells_[cell].beyond[facet] >> 2;
      std::uint8_t& mark = marks_[beyond];
      if (mark == Unmarked)
      {
        const bool conflict = this->inConflict(cells_[beyond], point);
        mark = conflict ? InCavity : Outside;
        (conflict ? cavity.cells : marked_).push_back(beyond);
      }
      if (mark == Outside)
      {
        cavity.border.push_back(4 * cell + facet);
      }
    }
  }
  for (const std::int32_t cell : marked_)
  {
    marks_[cell] = Unmarked;
  }
  for (const std::int32_t cell : cavity.cells)
  {
    marks_[cell] = Unmarked;
  }
}

void Delaunay::star(std::int32_t vertex, std::vector<std::int32_t>& cells)
{
  cells.assign(1, cellOf_[vertex]);
  marks_[cells[0]] = InCavity;
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    const Cell& cell = cells_[cells[k]];
    for (int facet = 0; facet < 4; ++facet)
    {
      const std::int32_t beyond = cell.beyond[facet] >> 2;
      if (cell.vertices[facet] != vertex && marks_[beyond] == Unmarked)
      {
        marks_[beyond] = InCavity;
        cells.push_back(beyond);
      }
    }
  }
  for (const std::int32_t cell : cells)
  {
    marks_[cell] = Unmarked;
  }
}

std::int32_t Delaunay::fill(const Vec3& point, Cavity& cavity)
{
  const auto vertex = static_cast<std::int32_t>(points_.size());
  points_.push_back(point);
  cellOf_.push_back(-1);
  local_.push_back(0);
  this->fill(vertex, cavity);
  return vertex;
}

void Delaunay::fill(std::int32_t point, Cavity& cavity)
{
  bases_.clear();
  for (const std::int32_t inner : cavity.border)
  {
    bases_.push_back({ this->facet(inner), this->beyond(inner), {} });
  }
  // Their own places first, then those that were given up, then new ones.
  while (cavity.cells.size() > bases_.size())
  {
    unused_.push_back(cavity.cells.back());
    cells_[cavity.cells.back()].vertices[0] = kUnused;
    cavity.cells.pop_back();
  }
  while (cavity.cells.size() < bases_.size() && !unused_.empty())
  {
    const std::int32_t cell = unused_.back();
    unused_.pop_back();
    if (!this->used(cell)) // it may be listed twice, and used since
    {
      cells_[cell].vertices[0] = point;
      cavity.cells.push_back(cell);
    }
  }
  if (const std::size_t missing = bases_.size() - cavity.cells.size(); missing > 0)
  {
    std::size_t next = cells_.size();
    if (next + missing > kMostCells)
    {
      throw TooLarge("The points have more than " + std::to_string(kMostCells) +
        " tetrahedra, more than can be counted: thin them by a larger Spacing.");
    }
    cells_.resize(next + missing);
    marks_.resize(next + missing, Unmarked);
    for (; next < cells_.size(); ++next)
    {
      cavity.cells.push_back(static_cast<std::int32_t>(next));
    }
  }
  this->makeCells(point, cavity);
  cellOf_[point] = cavity.cells[0];
}

void Delaunay::takeBack(const Replaced* begin, const Replaced* end)
{
  const auto vertex = static_cast<std::int32_t>(points_.size()) - 1;
  this->star(vertex, cavity_.cells);
  for (const std::int32_t cell : cavity_.cells)
  {
    cells_[cell].vertices[0] = kUnused;
    unused_.push_back(cell);
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
  points_.pop_back();
  cellOf_.pop_back();
  local_.pop_back();
}

std::int32_t Delaunay::localOf(std::int32_t vertex)
{
  std::int32_t& local = local_[vertex + 1];
  if (static_cast<std::size_t>(local) >= locals_.size() || locals_[local] != vertex)
  {
    local = static_cast<std::int32_t>(locals_.size());
    locals_.push_back(vertex);
  }
  return local;
}

// A cell on each of bases_, with the point at its top.
void Delaunay::makeCells(std::int32_t point, Cavity& cavity)
{
  locals_.clear();
  for (std::size_t k = 0; k < bases_.size(); ++k)
  {
    Base& base = bases_[k];
    const std::int32_t number = cavity.cells[k];
    Cell& cell = cells_[number];
    cell.vertices = { point, base.corners[0], base.corners[1], base.corners[2] };
    cell.beyond[0] = base.outer;
    cells_[base.outer >> 2].beyond[base.outer & 3] = 4 * number;
    cavity.border[k] = 4 * number;
    for (int corner = 0; corner < 3; ++corner)
    {
      base.local[corner] = this->localOf(base.corners[corner]);
      if (base.corners[corner] >= 0)
      {
        cellOf_[base.corners[corner]] = number;
      }
    }
  }
  if (locals_.size() <= kMostLocals)
  {
    this->joinSmall(cavity.cells);
  }
  else
  {
    this->joinLarge(cavity.cells);
  }
}

// Two cells share the facet at an edge of their bases, which one has forward, one backward.
void Delaunay::joinSmall(const std::vector<std::int32_t>& cells)
{
  // Facet of the edge from the k-th corner of a base to the next: the one opposite to the third.
  constexpr int kFacet[3] = { 3, 1, 2 };
  const std::size_t count = locals_.size();
  edges_.resize(std::max(edges_.size(), count * count));
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    const auto& local = bases_[k].local;
    for (int corner = 0; corner < 3; ++corner)
    {
      edges_[local[corner] * count + local[(corner + 1) % 3]] = 4 * cells[k] + kFacet[corner];
    }
  }
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    const auto& local = bases_[k].local;
    for (int corner = 0; corner < 3; ++corner)
    {
      cells_[cells[k]].beyond[kFacet[corner]] =
        edges_[local[(corner + 1) % 3] * count + local[corner]];
    }
  }
}

void Delaunay::joinLarge(const std::vector<std::int32_t>& cells)
{
  constexpr int kFacet[3] = { 3, 1, 2 };
  std::vector<std::pair<std::uint64_t, std::int32_t>> edges;
  for (std::size_t k = 0; k < cells.size(); ++k)
  {
    const auto& local = bases_[k].local;
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

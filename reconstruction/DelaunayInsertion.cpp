// SPDX-License-Identifier: BSD-3-Clause
// How many points come into a Delaunay tetrahedralization: in which order, and by whom.
#include "reconstruction/Delaunay.h"
#include "reconstruction/DelaunayPredicates.h"
#include "reconstruction/SpatialOrder.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"
#include "core/geometry/Predicates.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <string>
#include <utility>

namespace hybridtree
{
namespace
{

// How many insertions between two looks at whether to go on.
constexpr std::size_t kBreath = 256;
// Tetrahedra about a point of a surface, with the infinite ones, and some to spare.
constexpr std::size_t kCellsPerPoint = 7;
// Fewer points are inserted by one worker.
constexpr std::size_t kMany = 8192;
// Of many points the first, which one worker inserts: tetrahedra must be small against the slabs.
constexpr std::size_t kFirstShare = 64;
// More would leave more points to be inserted after them.
constexpr int kSlabs = 2;

} // namespace

void Delaunay::insert(const std::vector<Vec3>& points, const Progress& progress)
{
  std::size_t first = points_.size();
  points_.insert(points_.end(), points.begin(), points.end());
  cellOf_.resize(points_.size(), -1);
  local_.resize(points_.size(), 0);
  if (!this->spansVolume())
  {
    if (!this->insertFirst())
    {
      return;
    }
    first = 0; // those that had to wait, too
  }
  Order order = insertionOrder(points_.size() - first);
  for (std::int32_t& point : order)
  {
    point += static_cast<std::int32_t>(first);
  }
  cells_.reserve((kCellsPerPoint + 1) * points_.size()); // of pages that may never be touched
  if (order.size() >= kMany)
  {
    order = this->insertMost(order, progress);
  }
  this->insertAll(anywhere_, order, progress);
}

// In parallel. \returns the others, in the same order.
Delaunay::Order Delaunay::insertMost(const Order& order, const Progress& progress)
{
  const auto coarse = order.begin() + static_cast<std::ptrdiff_t>(order.size() / kFirstShare);
  this->insertAll(anywhere_, Order(order.begin(), coarse), progress);
  // Those near the borders of slabs of one kind are mostly far from those of another.
  const Box3 box = std::accumulate(
    points_.begin(), points_.end(), Box3(), [](Box3 all, const Vec3& p) { return all.extend(p); });
  std::array<int, 3> axes{ 0, 1, 2 };
  std::sort(
    axes.begin(), axes.end(), [&](int a, int b) { return box.sizes()[a] > box.sizes()[b]; });
  Order left(coarse, order.end());
  left = this->insertInSlabs(left, axes[0], ProgressPart(progress, 0.0, 0.8));
  return this->insertInSlabs(left, axes[1], ProgressPart(progress, 0.8, 0.9));
}

// Each slab by a worker of its own. \returns those that were not inserted, in the same order.
Delaunay::Order Delaunay::insertInSlabs(const Order& order, int axis, const Progress& progress)
{
  if (order.size() < kMany || cells_.size() + kCellsPerPoint * order.size() > kMostCells)
  {
    return order;
  }
  const std::vector<Order> parts = this->divide(order, axis);
  std::vector<Worker> workers(parts.size());
  std::int32_t nextCell = this->cellCount();
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    workers[k].slab = static_cast<int>(k) + 1;
    workers[k].nextCell = nextCell;
    workers[k].endCell = nextCell += static_cast<std::int32_t>(kCellsPerPoint * parts[k].size());
  }
  this->markSlabs();
  cells_.resize(nextCell);
  for (const Worker& worker : workers)
  {
    marks_.resize(worker.endCell, static_cast<std::uint8_t>(kMarks * worker.slab));
  }
  std::vector<Order> left(parts.size());
  parallelFor(parts.size(), 1,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = begin; k < end; ++k)
      {
        left[k] = this->insertAll(workers[k], parts[k], progress);
      }
    });
  for (Worker& worker : workers)
  {
    this->takeOver(worker);
  }
  progress.report(1.0);
  std::fill(marks_.begin(), marks_.end(), 0);
  Order all;
  std::vector<std::size_t> next(left.size(), 0);
  std::copy_if(order.begin(), order.end(), std::back_inserter(all),
    [&](std::int32_t point)
    {
      const int slab = slabs_[point] - 1;
      const bool is = next[slab] < left[slab].size() && left[slab][next[slab]] == point;
      next[slab] += is;
      return is;
    });
  return all;
}

// Cells that the worker has not used.
void Delaunay::takeOver(const Worker& worker)
{
  std::vector<std::int32_t>& unused = anywhere_.unused;
  unused.insert(unused.end(), worker.unused.begin(), worker.unused.end());
  for (std::int32_t cell = worker.endCell; cell-- > worker.nextCell;)
  {
    cells_[cell].vertices[0] = kUnused;
    unused.push_back(cell);
  }
}

void Delaunay::markSlabs()
{
  parallelFor(cells_.size(), 8192,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t cell = begin; cell < end; ++cell)
      {
        if (!this->used(static_cast<std::int32_t>(cell)))
        {
          continue;
        }
        int slab = 0;
        for (const std::int32_t vertex : cells_[cell].vertices)
        {
          const int other = vertex < 0 ? slab : slabs_[vertex];
          slab = slab == 0 || slab == other ? other : kNoSlab;
        }
        marks_[cell] = static_cast<std::uint8_t>(kMarks * slab);
      }
    });
}

// Into slabs across an axis of as many points each, all in the same order.
std::vector<Delaunay::Order> Delaunay::divide(const Order& order, int axis)
{
  std::vector<double> places(order.size());
  std::transform(order.begin(), order.end(), places.begin(),
    [&](std::int32_t point) { return points_[point][axis]; });
  std::array<double, kSlabs - 1> borders;
  auto begin = places.begin();
  for (int k = 1; k < kSlabs; ++k)
  {
    const auto border = places.begin() + static_cast<std::ptrdiff_t>(k * places.size() / kSlabs);
    std::nth_element(begin, border, places.end());
    borders[k - 1] = *border;
    begin = border;
  }
  slabs_.resize(points_.size());
  for (std::size_t point = 0; point < points_.size(); ++point)
  {
    const double place = points_[point][axis];
    slabs_[point] = static_cast<std::uint8_t>(1 +
      std::count_if(
        borders.begin(), borders.end(), [&](double border) { return border <= place; }));
  }
  std::vector<Order> parts(kSlabs);
  for (const std::int32_t point : order)
  {
    parts[slabs_[point] - 1].push_back(point);
  }
  return parts;
}

// \returns those that were not inserted, in the same order.
Delaunay::Order Delaunay::insertAll(Worker& worker, const Order& order, const Progress& progress)
{
  Order left;
  std::int32_t near = this->startOf(worker);
  if (near < 0 && worker.slab != 0)
  {
    return order;
  }
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    if (k % kBreath == 0)
    {
      progress.check();
      if (worker.slab == 0) // else this may be another thread than the caller's
      {
        progress.report(double(k) / double(order.size()));
      }
    }
    if (!this->insertPoint(worker, order[k], near))
    {
      left.push_back(order[k]);
    }
  }
  return left;
}

// A vertex of the worker's slab.
std::int32_t Delaunay::startOf(const Worker& worker) const
{
  for (std::int32_t point = 0; point < static_cast<std::int32_t>(cellOf_.size()); ++point)
  {
    if ((worker.slab == 0 || slabs_[point] == worker.slab) && cellOf_[point] >= 0)
    {
      return point;
    }
  }
  return -1;
}

bool Delaunay::insertPoint(Worker& worker, std::int32_t point, std::int32_t& near)
{
  if (cellOf_[point] >= 0) // one of the first four
  {
    return true;
  }
  const Vec3& p = points_[point];
  const std::int32_t cell = this->walk(worker, p, this->startOfWalk(near));
  if (cell < 0)
  {
    return false;
  }
  const Place place = this->placeIn(cell, p);
  if (place.vertex >= 0)
  {
    near = place.vertex;
    return true;
  }
  if (!this->findCavity(worker, p, cell, worker.cavity) ||
    !this->fill(worker, point, worker.cavity))
  {
    return false;
  }
  near = point;
  return true;
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
  Cavity& cavity = anywhere_.cavity;
  cavity.cells.clear();
  anywhere_.bases.clear();
  for (std::int32_t facet = 0; facet < 4; ++facet)
  {
    cellOf_[v[facet]] = 0;
    const auto corners = this->facet(facet);
    anywhere_.bases.push_back({ { corners[0], corners[2], corners[1] }, facet, {} });
    cavity.cells.push_back(facet + 1);
  }
  cells_.resize(5);
  cavity.border.resize(4);
  marks_.assign(5, 0);
  this->makeCells(anywhere_, kInfinite, cavity);
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

} // namespace hybridtree

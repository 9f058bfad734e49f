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
// Fewer points are inserted by one worker.
constexpr std::size_t kMany = 8192;
// Of many points the first, which one worker inserts: tetrahedra must be small against the slabs.
constexpr std::size_t kFirstShare = 64;

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
  const std::array<int, 3> axes = this->axesBySize();
  Order left(coarse, order.end());
  left = this->insertInSlabs(left, axes[0], ProgressPart(progress, 0.0, 0.8));
  return this->insertInSlabs(left, axes[1], ProgressPart(progress, 0.8, 0.9));
}

// Of the points' box, the longest first.
std::array<int, 3> Delaunay::axesBySize() const
{
  const Box3 box = std::accumulate(
    points_.begin(), points_.end(), Box3(), [](Box3 all, const Vec3& p) { return all.extend(p); });
  std::array<int, 3> axes{ 0, 1, 2 };
  std::sort(
    axes.begin(), axes.end(), [&](int a, int b) { return box.sizes()[a] > box.sizes()[b]; });
  return axes;
}

// Each slab by a worker of its own. \returns those that were not inserted, in the same order.
Delaunay::Order Delaunay::insertInSlabs(const Order& order, int axis, const Progress& progress)
{
  if (order.size() < kMany || cells_.size() + kCellsPerPoint * order.size() > mostCells_)
  {
    return order;
  }
  std::vector<double> places(order.size());
  std::transform(order.begin(), order.end(), places.begin(),
    [&](std::int32_t point) { return points_[point][axis]; });
  std::vector<Worker> workers = this->makeSlabs(axis, std::move(places), progress);
  std::vector<Order> parts(workers.size());
  for (const std::int32_t point : order)
  {
    parts[slabs_[point] - 1].push_back(point);
  }
  for (std::size_t k = 0; k < parts.size(); ++k)
  {
    this->provideCells(workers[k], parts[k].size());
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
  progress.check();
  progress.report(1.0);
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
  this->join(workers);
  return all;
}

// \returns those that were not inserted, in the same order.
Delaunay::Order Delaunay::insertAll(Worker& worker, const Order& order, const Progress& progress)
{
  Order left;
  std::int32_t near = this->startOf(worker);
  if (near < 0 && worker.slab_ != 0)
  {
    return order;
  }
  for (std::size_t k = 0; k < order.size(); ++k)
  {
    if (k % kBreath == 0)
    {
      progress.check();
      if (worker.slab_ == 0) // else this may be another thread than the caller's
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
    if ((worker.slab_ == 0 || slabs_[point] == worker.slab_) && cellOf_[point] >= 0)
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
  if (!this->findCavity(worker, p, cell, worker.cavity) || !this->hasCells(worker, worker.cavity))
  {
    return false;
  }
  this->fill(worker, point, worker.cavity);
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

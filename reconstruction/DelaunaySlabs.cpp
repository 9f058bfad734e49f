// SPDX-License-Identifier: BSD-3-Clause
// How a Delaunay tetrahedralization is parted into slabs, for several workers at a time.
#include "reconstruction/Delaunay.h"

#include "core/base/Parallel.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace hybridtree
{
namespace
{

// More would leave more points to be inserted after them.
constexpr std::size_t kSlabs = 2;

} // namespace

std::vector<Delaunay::Worker> Delaunay::part(const std::vector<Vec3>& points, int side)
{
  const int axis = this->axesBySize()[side];
  std::vector<double> places(points.size());
  std::transform(
    points.begin(), points.end(), places.begin(), [&](const Vec3& point) { return point[axis]; });
  return this->makeSlabs(axis, std::move(places), Progress::none());
}

// Across an axis, with as many of these places in each.
std::vector<Delaunay::Worker> Delaunay::makeSlabs(
  int axis, std::vector<double> places, const Progress& progress)
{
  slabAxis_ = axis;
  slabBorders_.clear();
  auto begin = places.begin();
  for (std::size_t k = 1; k < kSlabs; ++k)
  {
    const auto border = places.begin() + static_cast<std::ptrdiff_t>(k * places.size() / kSlabs);
    std::nth_element(begin, border, places.end());
    slabBorders_.push_back(*border);
    begin = border;
  }
  slabs_.resize(points_.size());
  std::transform(points_.begin(), points_.end(), slabs_.begin(),
    [&](const Vec3& point) { return static_cast<std::uint8_t>(this->slabOf(point)); });
  parallelFor(cells_.size(), 8192,
    [&](std::size_t first, std::size_t last)
    {
      progress.check();
      for (std::size_t cell = first; cell < last; ++cell)
      {
        this->markSlab(static_cast<std::int32_t>(cell));
      }
    });
  std::vector<Worker> workers(kSlabs);
  for (std::size_t k = 0; k < kSlabs; ++k)
  {
    workers[k].slab_ = static_cast<int>(k) + 1;
  }
  return workers;
}

int Delaunay::slabOf(const Vec3& point) const
{
  return 1 +
    static_cast<int>(std::count_if(slabBorders_.begin(), slabBorders_.end(),
      [&](double border) { return border <= point[slabAxis_]; }));
}

int Delaunay::slabOf(std::int32_t halfFacet) const
{
  int slab = 0;
  for (const std::int32_t vertex : this->facet(halfFacet))
  {
    const int other = vertex < 0 ? slab : slabs_[vertex];
    if (slab != 0 && other != slab)
    {
      return 0;
    }
    slab = other;
  }
  return slab;
}

void Delaunay::markSlab(std::int32_t cell)
{
  if (!this->used(cell))
  {
    return;
  }
  int slab = 0;
  for (const std::int32_t vertex : cells_[cell].vertices)
  {
    const int other = vertex < 0 ? slab : slabs_[vertex];
    slab = slab == 0 || slab == other ? other : kNoSlab;
  }
  marks_[cell] = static_cast<std::uint8_t>(kMarks * slab);
}

std::int32_t Delaunay::provide(Worker& worker, std::size_t vertices)
{
  const auto first = static_cast<std::int32_t>(points_.size());
  points_.resize(points_.size() + vertices, points_.front());
  cellOf_.resize(points_.size(), -1);
  local_.resize(points_.size(), 0);
  slabs_.resize(points_.size(), static_cast<std::uint8_t>(worker.slab_));
  this->reuseCells(worker, vertices);
  this->provideCells(worker, vertices);
  return first;
}

// Cells that were given up, as long as there are any.
void Delaunay::reuseCells(Worker& worker, std::size_t points)
{
  std::vector<std::int32_t>& unused = anywhere_.unused;
  for (; worker.cellsLeft() < kCellsPerPoint * points && !unused.empty(); unused.pop_back())
  {
    const std::int32_t cell = unused.back();
    if (cells_[cell].vertices[0] == kUnused) // it may be listed twice, or used since
    {
      cells_[cell].vertices[0] = kGiven;
      marks_[cell] = static_cast<std::uint8_t>(kMarks * worker.slab_);
      worker.unused.push_back(cell);
    }
  }
}

// So many that points can be inserted, but for places that need uncommonly many.
void Delaunay::provideCells(Worker& worker, std::size_t points)
{
  const std::size_t wanted = kCellsPerPoint * points;
  const std::size_t more = wanted - std::min(wanted, worker.cellsLeft());
  if (more == 0 || cells_.size() + more > mostCells_)
  {
    return;
  }
  this->giveUpRest(worker);
  worker.nextCell = this->cellCount();
  worker.endCell = worker.nextCell + static_cast<std::int32_t>(more);
  cells_.resize(worker.endCell);
  marks_.resize(worker.endCell, static_cast<std::uint8_t>(kMarks * worker.slab_));
}

// Cells that the worker has not used.
void Delaunay::giveUpRest(Worker& worker)
{
  while (worker.endCell > worker.nextCell)
  {
    cells_[--worker.endCell].vertices[0] = kGiven;
    worker.unused.push_back(worker.endCell);
  }
}

void Delaunay::join(std::vector<Worker>& workers)
{
  std::vector<std::int32_t>& unused = anywhere_.unused;
  for (Worker& worker : workers)
  {
    this->giveUpRest(worker);
    for (const std::int32_t cell : worker.unused)
    {
      cells_[cell].vertices[0] = kUnused;
    }
    unused.insert(unused.end(), worker.unused.begin(), worker.unused.end());
  }
  std::fill(marks_.begin(), marks_.end(), std::uint8_t(0));
  slabs_.clear();
}

} // namespace hybridtree

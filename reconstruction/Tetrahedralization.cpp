// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/Tetrahedralization.h"

#include "reconstruction/DelaunayPredicates.h"
#include "reconstruction/SpatialOrder.h"

#include "core/base/Parallel.h"

#include <algorithm>
#include <numeric>

namespace hybridtree
{
namespace
{

constexpr std::size_t kGrain = 16384;

// Looks now and then whether to go on.
class Breath
{
public:
  explicit Breath(const Progress& progress) : progress_(progress) {}
  void operator()()
  {
    if (++steps_ % 65536 == 0)
    {
      progress_.check();
    }
  }

private:
  const Progress& progress_;
  std::size_t steps_ = 0;
};

} // namespace

Tetrahedralization::Tetrahedralization(
  const std::vector<Vec3>& points, const Progress& progress, std::size_t mostCells)
  : points_(&points)
{
  checkFinite(points);
  Delaunay delaunay;
  delaunay.limitCells(mostCells);
  delaunay.insert(points, progress);
  this->copy(delaunay, progress);
}

Tetrahedralization::Tetrahedralization(const Delaunay& delaunay, const Progress& progress)
  : points_(&delaunay.points())
{
  this->copy(delaunay, progress);
}

// By counting. \returns per cell its number in the Delaunay tetrahedralization.
// \param number the other way round.
RawVector<std::int32_t> Tetrahedralization::sort(
  const Delaunay& delaunay, std::vector<std::int32_t>& number, const Progress& progress)
{
  const auto count = static_cast<std::size_t>(delaunay.cellCount());
  const auto pointCount = static_cast<std::int32_t>(points_->size());
  std::vector<std::int32_t>& lowest = number; // vertex; infinite cells after all finite ones
  lowest.resize(count);
  parallelFor(count, kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      for (std::size_t k = begin; k < end; ++k)
      {
        const auto cell = static_cast<std::int32_t>(k);
        const auto& v = delaunay.cell(cell).vertices;
        const bool finite = delaunay.finite(cell);
        lowest[k] = !delaunay.used(cell) ? -1
          : finite                       ? std::min({ v[0], v[1], v[2], v[3] })
                                         : pointCount + std::max({ v[0], v[1], v[2], v[3] });
      }
    });
  Breath breath(progress);
  std::vector<std::int32_t> next(2 * points_->size() + 2, 0);
  for (const std::int32_t vertex : lowest)
  {
    breath();
    ++next[vertex + 2];
  }
  next[1] = 0;
  std::partial_sum(next.begin() + 1, next.end(), next.begin() + 1);
  finiteCells_ = next[pointCount + 1];
  RawVector<std::int32_t> source(next.back());
  for (std::size_t k = 0; k < count; ++k)
  {
    breath();
    if (number[k] >= 0)
    {
      number[k] = next[number[k] + 1]++;
      source[number[k]] = static_cast<std::int32_t>(k);
    }
  }
  return source;
}

void Tetrahedralization::copy(const Delaunay& delaunay, const Progress& progress)
{
  delaunay.checkVolume();
  std::vector<std::int32_t> number;
  const RawVector<std::int32_t> source = this->sort(delaunay, number, progress);
  cells_.resize(source.size());
  parallelFor(source.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      for (std::size_t k = begin; k < end; ++k)
      {
        const Delaunay::Cell& cell = delaunay.cell(source[k]);
        cells_[k].vertices = cell.vertices;
        for (int facet = 0; facet < 4; ++facet)
        {
          const std::int32_t beyond = cell.beyond[facet];
          cells_[k].beyond[facet] = 4 * number[beyond >> 2] + (beyond & 3);
        }
      }
    });
  this->collectStars(progress);
}

void Tetrahedralization::collectStars(const Progress& progress)
{
  Breath breath(progress);
  starOffset_.assign(points_->size() + 1, 0);
  for (const Delaunay::Cell& cell : cells_)
  {
    breath();
    for (const std::int32_t vertex : cell.vertices)
    {
      if (vertex != kInfinite)
      {
        ++starOffset_[vertex + 1];
      }
    }
  }
  std::partial_sum(starOffset_.begin(), starOffset_.end(), starOffset_.begin());
  starCells_.resize(starOffset_.back());
  std::vector<std::int32_t> next(starOffset_.begin(), starOffset_.end() - 1);
  for (std::int32_t c = 0; c < this->cellCount(); ++c)
  {
    breath();
    for (const std::int32_t vertex : this->cell(c))
    {
      if (vertex != kInfinite)
      {
        starCells_[next[vertex]++] = c;
      }
    }
  }
}

Tetrahedralization::Star Tetrahedralization::star(std::int32_t vertex) const
{
  return { starCells_.data() + starOffset_[vertex], starCells_.data() + starOffset_[vertex + 1] };
}

bool Tetrahedralization::isOrientedGabriel(std::int32_t cell, int facet) const
{
  const auto corner = this->facet(cell, facet);
  const std::vector<Vec3>& points = *points_;
  return sideOfLeastBall(points[corner[0]], points[corner[1]], points[corner[2]],
           points[this->cell(cell)[facet]]) <= 0;
}

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#include "reconstruction/PointOctree.h"

#include "reconstruction/ParallelSort.h"
#include "reconstruction/SpreadBits.h"

#include "core/base/Parallel.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hybridtree
{
namespace
{

constexpr int kLevels = 20;
constexpr std::size_t kGrain = 4096;
// A cell of so few points is not split: three lie in one plane.
constexpr std::int32_t kFew = 3;
// All cells are split down to this level, if the points are many enough.
constexpr int kFirstLevels = 4;
// A leaf with less than this share of its parent's points is but grazed by the surface: about four
// of eight children meet a smooth one.
constexpr double kGrazed = 0.04;

using Place = std::array<std::int64_t, 3>; // of a cell among those of its level

std::uint64_t keyOf(const Place& place)
{
  return spreadBits(std::uint64_t(place[0])) | spreadBits(std::uint64_t(place[1])) << 1 |
    spreadBits(std::uint64_t(place[2])) << 2;
}

Place placeOf(std::uint64_t key)
{
  return { std::int64_t(gatherBits(key)), std::int64_t(gatherBits(key >> 1)),
    std::int64_t(gatherBits(key >> 2)) };
}

struct Sortable
{
  std::uint64_t key;
  std::int32_t point;
  bool operator<(const Sortable& other) const
  {
    return key != other.key ? key < other.key : point < other.point;
  }
};

} // namespace

PointOctree::PointOctree(const std::vector<Vec3>& points, const Progress& progress)
  : points_(points)
{
  this->sortPoints(progress);
  this->makeCells(progress);
}

void PointOctree::sortPoints(const Progress& progress)
{
  Box3 box;
  for (const Vec3& p : points_)
  {
    box.extend(p);
  }
  const double edge = points_.empty() ? 0.0 : box.sizes().maxCoeff();
  const double last = std::ldexp(1.0, kLevels) - 1.0;
  const double scale = edge > 0.0 ? std::ldexp(1.0, kLevels) / edge : 0.0;
  std::vector<Sortable> sorted(points_.size());
  parallelFor(points_.size(), kGrain,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      for (std::size_t k = begin; k < end; ++k)
      {
        const Vec3 at = (points_[k] - box.min()) * scale;
        Place place;
        for (int axis = 0; axis < 3; ++axis)
        {
          place[axis] = static_cast<std::int64_t>(std::min(at[axis], last));
        }
        sorted[k] = { keyOf(place), static_cast<std::int32_t>(k) };
      }
    });
  parallelSort(sorted, progress);
  order_.resize(sorted.size());
  keys_.resize(sorted.size());
  for (std::size_t k = 0; k < sorted.size(); ++k)
  {
    order_[k] = sorted[k].point;
    keys_[k] = sorted[k].key;
  }
}

void PointOctree::makeCells(const Progress& progress)
{
  Cell root;
  root.end = static_cast<std::int32_t>(points_.size());
  cells_.assign(1, root);
  std::size_t levelBegin = 0;
  for (int level = 0; levelBegin < cells_.size(); ++level)
  {
    const std::size_t levelEnd = cells_.size();
    parallelFor(levelEnd - levelBegin, 64,
      [&](std::size_t begin, std::size_t end)
      {
        progress.check();
        for (std::size_t k = begin; k < end; ++k)
        {
          this->measure(cells_[levelBegin + k]);
        }
      });
    const int shift = 3 * (kLevels - level - 1);
    for (std::size_t k = levelBegin; level < kLevels && k < levelEnd; ++k)
    {
      const Cell cell = cells_[k];
      if (cell.end - cell.begin <= kFew)
      {
        continue;
      }
      cells_[k].firstChild = static_cast<std::int32_t>(cells_.size());
      for (std::int32_t at = cell.begin; at < cell.end;)
      {
        Cell child;
        child.key = keys_[at] >> shift;
        child.level = level + 1;
        child.parent = static_cast<std::int32_t>(k);
        child.begin = at;
        const auto beyond = std::partition_point(keys_.begin() + at, keys_.begin() + cell.end,
          [&](std::uint64_t key) { return key >> shift == child.key; });
        child.end = at = static_cast<std::int32_t>(beyond - keys_.begin());
        cells_.push_back(child);
        ++cells_[k].childCount;
      }
    }
    levelBegin = levelEnd;
  }
}

void PointOctree::measure(Cell& cell) const
{
  const int count = cell.end - cell.begin;
  if (count <= kFew)
  {
    return;
  }
  const Vec3 origin = points_[order_[cell.begin]];
  Vec3 sum = Vec3::Zero();
  Mat3 squares = Mat3::Zero();
  for (std::int32_t k = cell.begin; k < cell.end; ++k)
  {
    const Vec3 p = points_[order_[k]] - origin;
    sum += p;
    squares += p * p.transpose();
  }
  const Vec3 mean = sum / count;
  Eigen::SelfAdjointEigenSolver<Mat3> solver;
  solver.computeDirect(squares / count - mean * mean.transpose(), Eigen::EigenvaluesOnly);
  cell.roughness = std::sqrt(std::max(0.0, solver.eigenvalues()[0]));
}

void PointOctree::splitFirstLevels(std::size_t most)
{
  std::array<std::size_t, kLevels + 2> atLevel{};
  for (Cell& cell : cells_)
  {
    cell.split = false;
    ++atLevel[cell.level];
  }
  int levels = 0;
  while (levels < kFirstLevels && atLevel[levels + 1] <= most)
  {
    ++levels;
  }
  for (Cell& cell : cells_)
  {
    cell.split = cell.level < levels && cell.childCount > 0;
  }
}

void PointOctree::splitRougher(double roughness)
{
  for (Cell& cell : cells_)
  {
    const bool reached = cell.parent < 0 || cells_[cell.parent].split;
    cell.split = cell.split || (reached && cell.childCount > 0 && cell.roughness > roughness);
  }
  this->balance();
}

void PointOctree::splitToTolerance(double roughness)
{
  this->splitFirstLevels(points_.size() / 8);
  this->splitRougher(roughness);
}

double PointOctree::splitInto(std::size_t cells)
{
  std::vector<double> steps;
  for (const Cell& cell : cells_)
  {
    if (cell.childCount > 0)
    {
      steps.push_back(cell.roughness);
    }
  }
  std::sort(steps.begin(), steps.end());
  steps.insert(steps.begin(), -1.0);
  // More leaves the lower the roughness, about as many more as there are cells between: regula
  // falsi, with the middle in every other step, since that may be far from it.
  constexpr double kAim = 0.99;
  std::size_t fine = 0;
  std::size_t coarse = steps.size() - 1;
  double finest = double(points_.size());
  double coarsest = 1.0;
  double chosen = 0.0;
  bool near = false;
  for (int step = 0; !near; ++step)
  {
    const double share =
      step % 2 == 0 ? (finest - kAim * double(cells)) / std::max(1.0, finest - coarsest) : 0.5;
    const auto at =
      fine + static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * double(coarse - fine));
    const std::size_t next = coarse - fine > 1 ? std::clamp(at, fine + 1, coarse - 1) : fine;
    this->splitFirstLevels(cells / 4);
    this->splitRougher(steps[next]);
    const std::size_t leaves = this->leafCount();
    (leaves > cells ? fine : coarse) = next;
    (leaves > cells ? finest : coarsest) = double(leaves);
    near = coarse - fine <= 1 || (leaves <= cells && 50 * leaves > 49 * cells);
    chosen = steps[next];
  }
  return chosen;
}

// From the finest cells on: where one is split, so are the cells around its parent.
void PointOctree::balance()
{
  for (std::size_t k = cells_.size(); k-- > 0;)
  {
    if (cells_[k].split && cells_[k].level > 1)
    {
      this->splitAround(cells_[k]);
    }
  }
}

void PointOctree::splitAround(const Cell& cell)
{
  const Place place = placeOf(cell.key);
  const std::int64_t count = std::int64_t(1) << (cell.level - 1);
  for (int side = 1; side < 8; ++side)
  {
    Place around;
    bool within = true;
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::int64_t towards = (place[axis] & 1) != 0 ? 1 : -1;
      around[axis] = (place[axis] >> 1) + ((side >> axis & 1) != 0 ? towards : 0);
      within = within && around[axis] >= 0 && around[axis] < count;
    }
    if (within)
    {
      this->splitDownTo(keyOf(around), cell.level - 1);
    }
  }
}

void PointOctree::splitDownTo(std::uint64_t key, std::int32_t level)
{
  std::int32_t at = 0;
  while (at >= 0 && cells_[at].childCount > 0 && cells_[at].level <= level)
  {
    Cell& cell = cells_[at];
    cell.split = true;
    at = -1;
    for (int child = 0; cell.level < level && child < cell.childCount; ++child)
    {
      if (cells_[cell.firstChild + child].key == key >> (3 * (level - cell.level - 1)))
      {
        at = cell.firstChild + child;
      }
    }
  }
}

template <typename Visit>
void PointOctree::forEachLeaf(const Visit& visit) const
{
  std::vector<std::int32_t> stack{ 0 };
  while (!stack.empty())
  {
    const Cell& cell = cells_[stack.back()];
    stack.pop_back();
    if (!cell.split)
    {
      visit(cell);
      continue;
    }
    for (int child = cell.childCount; child-- > 0;)
    {
      stack.push_back(cell.firstChild + child);
    }
  }
}

std::size_t PointOctree::leafCount() const
{
  std::size_t count = 0;
  this->forEachLeaf([&](const Cell&) { ++count; });
  return count;
}

std::vector<std::int32_t> PointOctree::leafOfOrdered() const
{
  std::vector<std::int32_t> leaf(order_.size());
  std::int32_t number = 0;
  this->forEachLeaf([&](const Cell& cell)
    { std::fill(leaf.begin() + cell.begin, leaf.begin() + cell.end, number++); });
  return leaf;
}

std::vector<std::int32_t> PointOctree::representatives() const
{
  std::vector<std::int32_t> chosen;
  this->forEachLeaf(
    [&](const Cell& cell)
    {
      const Cell& above = cells_[std::max(cell.parent, 0)];
      if (cell.end > cell.begin &&
        double(cell.end - cell.begin) >= kGrazed * double(above.end - above.begin))
      {
        chosen.push_back(this->nearestToCentroid(cell));
      }
    });
  return chosen;
}

std::int32_t PointOctree::nearestToCentroid(const Cell& cell) const
{
  const Vec3 origin = points_[order_[cell.begin]];
  Vec3 sum = Vec3::Zero();
  for (std::int32_t k = cell.begin; k < cell.end; ++k)
  {
    sum += points_[order_[k]] - origin;
  }
  const Vec3 centroid = origin + sum / (cell.end - cell.begin);
  std::int32_t best = order_[cell.begin];
  double least = std::numeric_limits<double>::infinity();
  for (std::int32_t k = cell.begin; k < cell.end; ++k)
  {
    const double squared = (points_[order_[k]] - centroid).squaredNorm();
    if (squared < least)
    {
      least = squared;
      best = order_[k];
    }
  }
  return best;
}

} // namespace hybridtree

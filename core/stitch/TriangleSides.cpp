// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/TriangleSides.h"

#include "core/base/Parallel.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr std::size_t kTrianglesPerTask = 4096;

/// Which bricks of the set's bounds hold cells, for a first glance at each triangle.
class BrickMap
{
public:
  BrickMap(const CellSet& cells, const CellGrid& grid) : scale_(1.0 / (kBrickSide * grid.cellSize))
  {
    const Index3 first = brickOf(cells.low());
    const Index3 last = brickOf(cells.high());
    double count = 1.0;
    for (int axis = 0; axis < 3; ++axis)
    {
      size_[axis] = last[axis] - first[axis] + 1;
      count *= static_cast<double>(size_[axis]);
      corner_[axis] = grid.plane(axis, kBrickSide * first[axis]);
    }
    if (count > kMostBricks)
    {
      return;
    }
    has_.assign(static_cast<std::size_t>(count), false);
    for (const CellSet::Brick& brick : cells.bricks())
    {
      has_[this->number({ brick.index[0] - first[0], brick.index[1] - first[1],
        brick.index[2] - first[2] })] = true;
    }
  }

  /// False only where no cell of the set is near the box.
  bool mayReach(const Vec3& low, const Vec3& high) const
  {
    constexpr double kMargin = 1e-6;
    Index3 from{}, to{};
    for (int axis = 0; axis < 3; ++axis)
    {
      const double a = (low[axis] - corner_[axis]) * scale_ - kMargin;
      const double b = (high[axis] - corner_[axis]) * scale_ + kMargin;
      const auto size = static_cast<double>(size_[axis]);
      if (!(b >= 0.0 && a < size))
      {
        return false;
      }
      from[axis] = static_cast<std::int64_t>(std::max(a, 0.0));
      to[axis] = static_cast<std::int64_t>(std::min(b, size - 1.0));
    }
    if (has_.empty())
    {
      return true;
    }
    for (std::int64_t z = from[2]; z <= to[2]; ++z)
    {
      for (std::int64_t y = from[1]; y <= to[1]; ++y)
      {
        for (std::int64_t x = from[0]; x <= to[0]; ++x)
        {
          if (has_[this->number({ x, y, z })])
          {
            return true;
          }
        }
      }
    }
    return false;
  }

private:
  static constexpr double kMostBricks = 1 << 24;

  std::size_t number(const Index3& brick) const
  {
    return static_cast<std::size_t>((brick[2] * size_[1] + brick[1]) * size_[0] + brick[0]);
  }

  double scale_;
  Vec3 corner_;
  Index3 size_{};
  std::vector<char> has_; ///< empty: too many to list
};

} // namespace

std::vector<TriangleSide> triangleSides(
  const TriangleMesh& mesh, const CellSet& cells, const CellGrid& grid, const Progress& progress)
{
  std::vector<TriangleSide> where(mesh.triangles.size(), TriangleSide::Outside);
  if (cells.empty())
  {
    return where;
  }
  const BrickMap map(cells, grid);
  const Index3 first = cells.low();
  const Index3 last = cells.high();
  parallelFor(mesh.triangles.size(), kTrianglesPerTask,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      for (std::size_t t = begin; t < end; ++t)
      {
        const Triangle& c = mesh.triangles[t];
        const Vec3 low = mesh.points[c[0]].cwiseMin(mesh.points[c[1]]).cwiseMin(mesh.points[c[2]]);
        const Vec3 high = mesh.points[c[0]].cwiseMax(mesh.points[c[1]]).cwiseMax(mesh.points[c[2]]);
        if (!map.mayReach(low, high))
        {
          continue;
        }
        Index3 from{}, to{};
        for (int axis = 0; axis < 3; ++axis)
        {
          from[axis] = std::max(grid.slab(axis, low[axis]), first[axis] - 1);
          to[axis] = std::min(grid.slab(axis, high[axis]), last[axis] + 1);
        }
        const CellSet::Share share = cells.shareOf(from, to);
        where[t] = share == CellSet::Share::None ? TriangleSide::Outside
          : share == CellSet::Share::All         ? TriangleSide::Inside
                                                 : TriangleSide::Border;
      }
    });
  return where;
}

} // namespace hybridtree

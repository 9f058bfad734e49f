// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/CutPlanes.h"

#include <algorithm>

namespace hybridtree
{
namespace
{

constexpr double kMargin = 0.01;             // cells, far above rounding
constexpr std::int64_t kMostWithoutLook = 8; // slabs along all axes, where looking does not pay

/// Whether the projections of a cube around the origin and of a triangle onto an axis are apart.
bool areApart(const Vec3& axis, double half, const std::array<Vec3, 3>& corners)
{
  const double reach = half * axis.cwiseAbs().sum();
  const double a = axis.dot(corners[0]), b = axis.dot(corners[1]), c = axis.dot(corners[2]);
  return std::min({ a, b, c }) > reach || std::max({ a, b, c }) < -reach;
}

bool touchesCube(const Vec3& centre, double half, const std::array<Vec3, 3>& triangle)
{
  const std::array<Vec3, 3> corners{ triangle[0] - centre, triangle[1] - centre,
    triangle[2] - centre };
  const Vec3 sides[3] = { corners[1] - corners[0], corners[2] - corners[1],
    corners[0] - corners[2] };
  if (areApart(sides[0].cross(sides[1]), half, corners))
  {
    return false;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const Vec3 unit = Vec3::Unit(axis);
    if (areApart(unit, half, corners) ||
      std::any_of(std::begin(sides), std::end(sides),
        [&](const Vec3& side) { return areApart(unit.cross(side), half, corners); }))
    {
      return false;
    }
  }
  return true;
}

} // namespace

CutPlanes::CutPlanes(const CellSet& cells, const CellGrid& grid) : cells_(cells), grid_(grid)
{
  const Index3 low = cells.low();
  const Index3 high = cells.high();
  for (int axis = 0; axis < 3; ++axis)
  {
    // The Cutter looks a slab beyond the cells on both sides.
    low_[axis] = low[axis] - 1;
    chosen_[axis].resize(static_cast<std::size_t>(high[axis] - low[axis] + 4));
  }
}

void CutPlanes::choose(const Vec3& a, const Vec3& b, const Vec3& c)
{
  const Vec3 sizes = a.cwiseMax(b).cwiseMax(c) - a.cwiseMin(b).cwiseMin(c);
  all_ = sizes.sum() < static_cast<double>(kMostWithoutLook) * grid_.cellSize;
  if (all_)
  {
    return;
  }
  for (std::vector<char>& planes : chosen_)
  {
    std::fill(planes.begin(), planes.end(), 0);
  }
  const double half = (0.5 * kBrickSide + kMargin) * grid_.cellSize;
  for (const CellSet::Brick& brick : cells_.bricks())
  {
    const Index3 first{ kBrickSide * brick.index[0], kBrickSide * brick.index[1],
      kBrickSide * brick.index[2] };
    const Vec3 centre(grid_.plane(0, first[0]), grid_.plane(1, first[1]), grid_.plane(2, first[2]));
    if (touchesCube(centre + Vec3::Constant(0.5 * kBrickSide * grid_.cellSize), half, { a, b, c }))
    {
      this->addSlabs(brick);
    }
  }
}

void CutPlanes::addSlabs(const CellSet::Brick& brick)
{
  std::uint64_t layers = 0;
  for (const std::uint64_t word : brick.bits)
  {
    layers |= word;
  }
  for (int k = 0; k < kBrickSide; ++k)
  {
    const bool isThere[3] = { (layers & (std::uint64_t(0x0101010101010101u) << k)) != 0,
      (layers >> (kBrickSide * k) & 0xffu) != 0, brick.bits[k] != 0 };
    for (int axis = 0; axis < 3; ++axis)
    {
      if (isThere[axis])
      {
        const auto below =
          static_cast<std::size_t>(kBrickSide * brick.index[axis] + k - low_[axis]);
        chosen_[axis][below] = chosen_[axis][below + 1] = 1;
      }
    }
  }
}

} // namespace hybridtree

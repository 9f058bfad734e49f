// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/Lattice.h"

#include "core/base/Error.h"

#include <cmath>
#include <sstream>

namespace hybridtree
{
namespace
{

// A vertex at index + t still has t to 2^-16, below the least distance from a lattice point.
constexpr double kMaxIndex = 68719476736.0; // 2^36

std::int64_t checkedIndex(double value, double cellSize)
{
  if (!(std::abs(value) < kMaxIndex))
  {
    std::ostringstream text;
    text << "A cell size of " << cellSize << " puts the model " << std::abs(value)
         << " cells from the origin; the limit is " << kMaxIndex
         << ". Use a larger edge length or move the model towards the origin.";
    throw TooLarge(text.str());
  }
  return static_cast<std::int64_t>(value);
}

} // namespace

Lattice Lattice::covering(const Box3& bounds, double cellSize, const Vec3& origin)
{
  if (!(cellSize > 0.0) || !std::isfinite(cellSize))
  {
    throw InvalidParameter("The cell size", cellSize, "a finite length > 0");
  }
  if (!bounds.min().allFinite() || !bounds.max().allFinite())
  {
    throw InvalidParameter("The box to polygonize", "not finite", "made of finite numbers");
  }
  Lattice lattice;
  lattice.cellSize = cellSize;
  lattice.origin = origin;
  const Vec3 low = (bounds.min() - origin) / cellSize;
  const Vec3 high = (bounds.max() - origin) / cellSize;
  for (int axis = 0; axis < 3; ++axis)
  {
    lattice.low[axis] = checkedIndex(std::floor(low[axis]), cellSize);
    lattice.high[axis] = checkedIndex(std::ceil(high[axis]), cellSize);
  }
  return lattice;
}

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <array>
#include <cstdint>

namespace hybridtree
{

using Index3 = std::array<std::int64_t, 3>;

/// Part of the lattice of all integer multiples of one cell size, the same for the whole world.
struct Lattice
{
  double cellSize = 1.0;
  Vec3 origin = Vec3::Zero(); ///< of point 0, 0, 0, for lattices that are not the world's
  Index3 low{};               ///< first and
  Index3 high{};              ///< last point, both included, of the region where the field counts

  /// The part that covers `bounds`, rounded outwards.
  /// \throws InvalidParameter, TooLarge as polygonize(). \pre bounds not empty.
  static Lattice covering(const Box3& bounds, double cellSize, const Vec3& origin = Vec3::Zero());

  /// From the origin. Always this product, so that equal indices are equal numbers.
  double coordinate(std::int64_t index) const { return static_cast<double>(index) * cellSize; }
  Vec3 point(const Index3& index) const
  {
    return { origin[0] + this->coordinate(index[0]), origin[1] + this->coordinate(index[1]),
      origin[2] + this->coordinate(index[2]) };
  }
  bool contains(const Index3& index) const
  {
    return low[0] <= index[0] && index[0] <= high[0] && low[1] <= index[1] && index[1] <= high[1] &&
      low[2] <= index[2] && index[2] <= high[2];
  }
};

} // namespace hybridtree

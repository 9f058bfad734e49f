// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace hybridtree
{

/// Coordinate of grid position u of m cells on [-half, half]; the middle where there are no cells.
/// Positions u and m - u are mirror images bit for bit.
inline double gridCoordinate(int u, int m, double half)
{
  return m > 0 ? half * (static_cast<double>(2 * u - m) / m) : 0.0;
}

} // namespace hybridtree

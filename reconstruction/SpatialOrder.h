// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/base/Types.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hybridtree
{

/// All indices of the points along a Hilbert curve: neighbours in the order are neighbours in
/// space, so that arrays about the points are read with few cache misses. The same for the same
/// points, whatever the number of threads. O(n log n), parallel.
/// \throws InvalidGeometry for a coordinate that is not finite (names the point). \throws
/// Cancelled.
std::vector<std::int32_t> spatialOrder(const std::vector<Vec3>& points, const Progress& progress);

/// The order in which to insert 0 .. count-1, points along a curve, into a tetrahedralization:
/// rounds of random choices, each about eight times as many as all before, each along the curve
/// (Amenta, Choi, Rote: Incremental constructions con BRIO, 2003). The same for the same count.
std::vector<std::int32_t> insertionOrder(std::size_t count);

/// \throws InvalidGeometry for a coordinate that is not finite (names the point).
void checkFinite(const std::vector<Vec3>& points);

} // namespace hybridtree

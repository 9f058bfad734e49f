// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// An order of the points of a batch in which neighbours in space are neighbours in the order:
/// along a Morton curve through cells of about one point each. Linear time. order is overwritten.
/// \pre points.size < 2^32.
void orderAlongCurve(PointBatch points, std::vector<std::uint32_t>& order);

} // namespace hybridtree

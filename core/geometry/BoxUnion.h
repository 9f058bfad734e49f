// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <vector>

namespace hybridtree
{

/// Volume of the union of boxes, exact but for rounding, by a sweep: along x from face to face, and
/// between two of them along y. (Inclusion and exclusion, as [HT] 5.2.1 has it, is exponential.)
/// O(n^3) where all boxes overlap, O(n^2) where few do. Empty boxes count as nothing.
double unionVolume(const std::vector<Box3>& boxes);

/// Share of the volume of `box` that lies in any of the others, 0 to 1: the overlap ratio of
/// [HT] 5.2.1. 1 for a box without volume that meets another, else 0.
double overlapRatio(const Box3& box, const std::vector<Box3>& others);

} // namespace hybridtree

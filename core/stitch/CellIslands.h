// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/CellSet.h"

#include <vector>

namespace hybridtree
{

/// The parts of a set of cells that do not touch each other, not even at corners; each sorted, in
/// the order of their first cells. \pre cells is sorted.
std::vector<CellSet> islandsOf(const CellSet& cells);

} // namespace hybridtree

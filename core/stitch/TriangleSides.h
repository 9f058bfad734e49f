// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"
#include "core/stitch/CellGrid.h"
#include "core/stitch/CellSet.h"

#include <vector>

namespace hybridtree
{

/// Where a triangle lies towards a set of cells.
enum class TriangleSide : std::uint8_t
{
  Outside, ///< its box touches no cell of the set
  Inside,  ///< its box touches no other cell
  Border   ///< neither: the border of the set may cut it
};

/// Per triangle, by its box, in parallel. \throws Cancelled.
std::vector<TriangleSide> triangleSides(
  const TriangleMesh& mesh, const CellSet& cells, const CellGrid& grid, const Progress& progress);

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/polygonize/FieldSource.h"
#include "core/stitch/CellSet.h"

#include <vector>

namespace hybridtree
{

/// Of some cells those with corners on both sides of the surface f = T.
CellSet crossedCells(const CellSet& cells, const FieldSource& field, const CellGrid& grid);

/// Adds to the marked cells those from which the surface comes to them without passing through a
/// covered cell: where all pieces end inside of others and none has what lies between them.
void addUncovered(
  const CellSet& covered, const FieldSource& field, const CellGrid& grid, CellSet& marked);

} // namespace hybridtree

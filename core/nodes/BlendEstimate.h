// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/BlendCost.h"
#include "core/nodes/MarkedCells.h"

#include <vector>

namespace hybridtree
{

/// What the terms of a blend tell of its mesh before there is one, for BlendCost. All of it is the
/// same for the same terms.

/// What a value of the field costs: terms count by what they have of the surface, and by what they
/// have in common with others.
BlendCost::Sample sampleCost(const std::vector<MarkTerm>& terms, double edgeLength);

/// Area of the surfaces of the terms that keep their mesh, in squared cells, by how many of some
/// hundred points lie near the surface; right to about a tenth.
double squaresByPoints(const std::vector<MarkTerm>& terms, double cellSize);

/// The same of terms that give up their mesh, as far as they lie outside of the others' boxes. By
/// the sides of boxes, which is two to three times too large for limbs that lie slant in theirs.
double squaresGivenUp(const std::vector<MarkTerm>& terms, double cellSize);

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"

namespace hybridtree
{

/// What a value of the field of a node costs near its surface, in microseconds of one processor, as
/// far as the kinds of the nodes tell: to choose between ways to mesh it. Only ratios matter; they
/// were measured on bricks of a lattice (docs/figures.md). The same for the same tree.
/// \param edgeLength of the lattice: the triangles of a mesh are the closer together for it the
///   longer it is.
double fieldCost(const Node& node, double edgeLength);

} // namespace hybridtree

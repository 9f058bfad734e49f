// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

namespace hybridtree
{

/// Removes the connected components of a mesh that enclose next to nothing: less volume than their
/// area times `thickness`. That is what a lattice finds where a surface runs through its points
/// and nothing is left behind it, as of a solid less itself. The rest keeps its order.
/// \pre thickness >= 0; without vertexOrigin and sourceTriangle, as polygonize() leaves it.
void dropDust(TriangleMesh& mesh, double thickness);

} // namespace hybridtree

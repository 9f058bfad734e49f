// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/MeshBoolean.h"

namespace hybridtree
{

/// Takes away what rounding has left of faces that coincide or touch: edges without length,
/// triangles without height, closed components without thickness, all by a tolerance of 2^-46 of
/// the largest coordinate. Looks only where the cut made triangles; nothing to do costs nothing.
/// Keeps the mesh closed and manifold; what cannot go for that reason stays.
void cleanResult(MeshBooleanResult& result);

} // namespace hybridtree

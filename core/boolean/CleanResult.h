// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/MeshBoolean.h"

namespace hybridtree
{

/// Takes away what rounding has left of faces that coincide or touch: edges without length,
/// triangles without height, closed components without thickness, all by a tolerance of 2^-46 of
/// the largest coordinate; and, where surfaces nearly coincide, what lies back to back. Looks only
/// where the cut made triangles; nothing to do costs nothing. Keeps the mesh closed and manifold;
/// what cannot go for that reason stays. \param nearlyCoincide whether triangles cross that are in
/// one plane but for rounding.
void cleanResult(MeshBooleanResult& result, bool nearlyCoincide);

/// For operands whose triangles need not stay: merges points nearer to the cut than `distance` into
/// it (NearCut.h), so that its own points have room where they have been moved.
/// \param normals per triangle of the result: that of the triangle it is a part of, of any length.
void makeRoomForCut(MeshBooleanResult& result, const std::vector<Vec3>& normals, double distance);

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

namespace hybridtree
{

/// The image of a mesh: points and unit normals, turned around where the map mirrors.
/// \pre the map is invertible.
void applyMap(const Affine3& map, TriangleMesh& mesh);

/// The middle one of the factors by which the map stretches three directions at right angles. A
/// mesh made finer by it comes out about right in two of them, and is split or thinned in the third
/// (remeshStretched).
double middleStretch(const Affine3& map);

} // namespace hybridtree

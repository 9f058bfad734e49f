// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <vector>

namespace hybridtree
{

/// Leaves out the triangles with keep[t] == false and the points that no triangle is left of; the
/// rest keep their order, and every array that the mesh has follows.
/// \pre one flag per triangle.
void keepTriangles(TriangleMesh& mesh, const std::vector<bool>& keep);

} // namespace hybridtree

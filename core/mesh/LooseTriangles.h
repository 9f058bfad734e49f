// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <vector>

namespace hybridtree
{

/// True for the triangles of loose pieces beside closed surfaces, as cutting leaves them in scans:
/// each piece open, joined to the rest by no edge, of a dozen triangles at most. Empty unless they
/// are all that keeps the mesh from having no open edges, and at most one triangle of a hundred.
/// \pre triangles are in range and repeat no corner.
std::vector<bool> looseTriangles(const std::vector<Triangle>& triangles);

} // namespace hybridtree

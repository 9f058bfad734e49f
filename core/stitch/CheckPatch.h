// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

namespace hybridtree
{

/// Points of the triangles from `firstNew` on around which the triangles do not form one closed
/// fan. None: if the triangles before come from closed, oriented 2-manifolds, of which they are
/// all that is not replaced, then the whole mesh is one. In time that goes with the new triangles,
/// but for one glance at each of the others.
std::vector<std::int32_t> faultyPoints(const TriangleMesh& mesh, std::size_t firstNew);

/// Triangles from `firstNew` on that look against the normals of all their points; slivers, whose
/// normals mean nothing, excepted.
std::vector<std::size_t> turnedTriangles(const TriangleMesh& mesh, std::size_t firstNew);

} // namespace hybridtree

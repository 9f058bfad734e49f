// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

namespace hybridtree
{

/// Points of a mesh around which its triangles, with those around it, do not form one closed fan.
/// None: if those around come from closed, oriented 2-manifolds, of which they are what is not
/// replaced at the points of the mesh, then all together is one.
/// \param around triangles with points of the mesh; points it does not have are numbered beyond.
std::vector<std::int32_t> faultyPoints(
  const TriangleMesh& mesh, const std::vector<Triangle>& around);

/// Triangles that look against the normals of all their points; slivers, whose normals mean
/// nothing, excepted.
std::vector<std::size_t> turnedTriangles(const TriangleMesh& mesh);

} // namespace hybridtree

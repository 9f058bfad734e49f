// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

namespace hybridtree
{

/// A triangle as one of its points sees it: the side that leaves the point ends at `from`, the one
/// that comes back begins at `to`.
struct FanSide
{
  std::int32_t point;
  std::int32_t from;
  std::int32_t to;
};

/// Whether these, at one point, are one closed fan: then the mesh is a closed, oriented 2-manifold
/// at that point. They come in another order out of this.
bool isClosedFan(FanSide* begin, FanSide* end);

/// Points of a mesh around which its triangles, with those around it, do not form one closed fan.
/// None: if those around come from closed, oriented 2-manifolds, of which they are what is not
/// replaced at the points of the mesh, then all together is one.
/// \param around triangles with points of the mesh; points it does not have are numbered beyond.
std::vector<std::int32_t> faultyPoints(
  const TriangleMesh& mesh, const std::vector<Triangle>& around);

/// Whether a triangle looks against the normals of all its points; slivers, whose normals mean
/// nothing, excepted. \param corners points of the mesh.
bool isTurned(const TriangleMesh& mesh, const Triangle& corners);

/// Those of the mesh that do.
std::vector<std::size_t> turnedTriangles(const TriangleMesh& mesh);

} // namespace hybridtree

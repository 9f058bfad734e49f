// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"
#include "core/nodes/Node.h"
#include "core/nodes/SpaceWarp.h"

namespace hybridtree
{

/// The image of a mesh under a warp ([HT] 5.4), with triangles of good shape.
///
/// Edges whose image is longer than 4/3 edgeLength, and stretched or bowed, are first split where
/// they are, so that the new points are exact: midpoints on triangles of a mesh leaf stay on them,
/// others are moved onto f = T of the node. Then the points are mapped; where triangles have become
/// much worse, squeezed ones are collapsed and slivers flipped (remeshStretched). Normals are J^-T
/// n, or those of the triangles where the mesh has none.
/// Provenance (sourceLeaf, sourceTriangle, vertexOrigin) follows. Orientation stays outward also
/// when the warp mirrors.
///
/// \param mesh of `node`.
/// \param imagePoints of its points (imageOf()).
/// \throws TooLarge when the area of the image foretells more than 2e7 triangles; Cancelled.
TriangleMesh warpedMesh(const TriangleMesh& mesh, std::vector<Vec3> imagePoints,
  const SpaceWarp& warp, double edgeLength, const Node& node,
  const Progress& progress = Progress::none());

/// Area-weighted unit normals of the points, from the triangles around them.
std::vector<Vec3> pointNormals(const TriangleMesh& mesh);

} // namespace hybridtree

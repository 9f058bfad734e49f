// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"
#include "core/stitch/CellGrid.h"

namespace hybridtree
{

/// Mesh of any node from its field alone: polygonize() with cells of side `edgeLength` over the
/// node's surface bounds, and the leaf of each triangle from Node::sourceLeaf() at its centroid.
///
/// Normals are those of the gradient; in a faceted tree (Node::isFaceted()) they are smoothed over
/// the facets of its mesh leaves, creases kept: a mesh leaf is shaded like the mesh it is.
///
/// The lengths of the edges vary from 0 to sqrt(3) edgeLength, 0.95 edgeLength on average.
/// Empty for a negative node and where the field stays below T.
/// \throws InvalidParameter, TooLarge, Cancelled as polygonize().
TriangleMesh latticeMesh(
  const Node& node, double edgeLength, const Progress& progress = Progress::none());

/// The same on the cells of a grid.
TriangleMesh latticeMesh(
  const Node& node, const CellGrid& grid, const Progress& progress = Progress::none());

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/MergeFacets.h"
#include "core/nodes/BooleanField.h"
#include "core/nodes/CarriedCurves.h"
#include "core/nodes/Node.h"

#include <optional>
#include <string>
#include <vector>

namespace hybridtree
{

/// Which triangles of a mesh that has been cut are triangulated afresh as one (MergeFacets.h).
enum class FacetMerging
{
  None,
  Parts, ///< those that cuts have left of one triangle, so that cuts in turn leave no needles
};

/// What cutting the meshes of two nodes gives.
struct BooleanMesh
{
  /// Empty where the meshes cannot be cut: one crosses itself at the cut.
  std::optional<TriangleMesh> mesh;
  /// Where the surfaces cross, and what is left of such curves of operands that are Booleans.
  PointChains curves;
  Facets facets; ///< which triangles are parts of one
  std::vector<std::string> warnings;
};

/// Union, intersection or difference of two nodes from their meshes at an edge length ([HT] 5.3).
///
/// Triangles away from the cut are the children's own, bit for bit, and so are normals and
/// provenance; the leaves of B are numbered after those of A. Edges of the cut are sharp: its
/// points are moved onto both surfaces where these are not their meshes, as far as no triangle
/// turns over, and have the mean of both normals. What cuts have left of one triangle of a child
/// that is a Boolean too is triangulated as one.
/// \throws TooLarge, Cancelled, as the children's mesh() does.
BooleanMesh booleanMesh(BooleanOperation operation, const Node& a, const Node& b,
  FacetMerging merging, double edgeLength, const Progress& progress);

} // namespace hybridtree

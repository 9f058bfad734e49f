// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/BooleanField.h"
#include "core/nodes/CarriedCurves.h"
#include "core/nodes/Node.h"

#include <optional>
#include <string>
#include <vector>

namespace hybridtree
{

/// What cutting the meshes of two nodes gives.
struct BooleanMesh
{
  /// Empty where the meshes cannot be cut: one crosses itself at the cut.
  std::optional<TriangleMesh> mesh;
  /// Where the surfaces cross, and what is left of such curves of operands that are Booleans.
  PointChains curves;
  std::vector<std::string> warnings;
};

/// Union, intersection or difference of two nodes from their meshes at an edge length ([HT] 5.3).
///
/// Triangles away from the cut are the children's own, bit for bit, and so are normals and
/// provenance; the leaves of B are numbered after those of A. Edges of the cut are sharp: its
/// points are moved onto both surfaces where these are not their meshes, as far as no triangle
/// turns over, and have the mean of both normals.
/// \throws TooLarge, Cancelled, as the children's mesh() does.
BooleanMesh booleanMesh(BooleanOperation operation, const Node& a, const Node& b, double edgeLength,
  const Progress& progress);

} // namespace hybridtree

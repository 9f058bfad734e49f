// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/NodeMaker.h"

namespace hybridtree
{

/// Leaf whose surface is a triangle mesh, with the field of MeshField around it ([HT] 4.2).
///
/// Its mesh is the triangle mesh itself at any edge length, under the map; membership is that of
/// the mesh, exact where it is closed. \param mesh as repairMesh() leaves it; shared, never copied.
/// Nodes over the same object share one distance hierarchy, built at the first query. \param
/// maximumField I, |I| >= T; negative carves. \param influenceRadius R > 0, in lengths of the
/// mesh's own space: the field ends at this distance outside. \param exponent n, 2 to 64.
/// \param map places the mesh; finite and invertible.
/// \throws InvalidParameter, InvalidGeometry (no triangles).
NodePtr makeMeshNode(MeshPtr mesh, double maximumField, double influenceRadius, int exponent,
  const Affine3& map = Affine3::Identity());

/// R of a plain mesh that enters an operator: a tenth of the diagonal of its bounds.
double defaultInfluenceRadius(const TriangleMesh& mesh);

/// NodeMaker of kind "mesh": "mesh" holds contentHashText() of the mesh, which
/// `lookup` turns into the mesh.
/// \throws InvalidText when the lookup has no such mesh, or a parameter is missing.
NodePtr meshFromParameters(
  const Parameters& parameters, const std::vector<NodePtr>& children, const MeshLookup& lookup);

} // namespace hybridtree

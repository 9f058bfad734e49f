// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/MeshBoolean.h"
#include "core/nodes/BooleanField.h"
#include "core/nodes/Node.h"

#include <array>

namespace hybridtree
{

/// Moves the points of a cut onto the surfaces of both nodes, where they lie on their meshes only:
/// Newton's method, the shortest step that brings both fields to T. Where that leads nowhere, as
/// where the surfaces have corners or hardly cross, onto the surface of the Boolean. Points and
/// edges too near for this go (makeRoomForCut()); a point that would still turn a triangle over
/// stays where it is.
/// \param meshes of the nodes, at an edge length, whose Boolean the result is.
void projectCut(BooleanOperation operation, const std::array<const Node*, 2>& nodes,
  const std::array<const TriangleMesh*, 2>& meshes, double edgeLength, MeshBooleanResult& result);

} // namespace hybridtree

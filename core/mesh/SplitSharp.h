// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

namespace hybridtree
{

/// A mesh for views: where triangles meet at more than `angle` (radians), the points of the edge
/// are doubled, so that each side has normals of its own; their normals are the means of the
/// triangles of their side, by angle. All other normals stay, so do points and triangles in their
/// order; the doubles come last, with all else that is told of their points. Looks like the mesh
/// and is open along these edges: welding equal points gives it back.
///
/// The mesh itself where no edge is so sharp, or where it has no normals. \pre mesh is not null.
MeshPtr splitAtSharpEdges(const MeshPtr& mesh, double angle = 0.7);

} // namespace hybridtree

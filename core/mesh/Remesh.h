// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/mesh/TriangleMesh.h"

#include <functional>

namespace hybridtree
{

struct RemeshOptions
{
  /// Target edge length L, world units, finite and > 0. Edges longer than 4/3 L are split.
  double edgeLength = 0.0;
  /// Edges shorter than this share of L are collapsed, but only at badly shaped triangles. [0, 0.7]
  double shortEdge = 0.4;
  /// A triangle is badly shaped when its smallest angle, in degrees, is below this. [0, 30]
  double badAngle = 20.0;
  /// Rounds of splitting, collapsing and flipping; ends earlier once a round changes nothing.
  int maxRounds = 10;
};

/// Brings new vertices onto the surface, in one batch. On entry point[k] lies on the mesh, between
/// old vertices, and normal[k] is interpolated; both may be replaced. Null: new vertices stay on
/// the mesh.
using ProjectToSurface = std::function<void(std::vector<Vec3>& points, std::vector<Vec3>& normals)>;

/// Mends the triangles of a mesh that a deformation has stretched or squeezed, where they are:
/// splits long edges, collapses short ones at badly shaped triangles, flips edges for larger
/// smallest angles (Botsch and Kobbelt 2004, without the smoothing: vertices that stay do not
/// move).
///
/// Keeps the topology: a closed, oriented 2-manifold stays one, of the same genus (link condition);
/// borders and triangles of other leaves keep their outline (edges between different sourceLeaf are
/// only split). No operation turns a triangle's normal by more than 60 degrees or makes an edge
/// longer than 4/3 L. Parts that need nothing keep their points and triangles, bit for bit and in
/// order, before the new ones.
///
/// Follows: normals; sourceLeaf; sourceTriangle, -1 where a triangle is no longer part of one;
/// vertexOrigin, interpolated where both ends of a split edge lie on one source triangle.
/// \throws InvalidParameter, Cancelled.
void remeshStretched(TriangleMesh& mesh, const RemeshOptions& options,
  const ProjectToSurface& project = nullptr, const Progress& progress = Progress::none());

} // namespace hybridtree

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
  /// Edges shorter than this share of L are collapsed, but only at badly shaped triangles. 0 to 0.7
  double shortEdge = 0.4;
  /// A triangle is badly shaped when its smallest angle, in degrees, is below this. 0 to 30
  double badAngle = 20.0;
  /// Rounds of splitting, collapsing and flipping; ends earlier once a round changes nothing.
  int maxRounds = 10;
};

/// Brings new vertices onto the surface, in one batch. On entry points[k] is the middle of an edge
/// and normals[k] interpolated (zero where the mesh has none); both may be replaced. Null: new
/// vertices stay on the mesh. A point whose move would fold the mesh goes back to the middle of its
/// edge.
using ProjectToSurface = std::function<void(std::vector<Vec3>& points, std::vector<Vec3>& normals)>;

/// Mends the triangles of a mesh that a deformation has stretched or squeezed, where they are:
/// splits long edges, collapses short ones at badly shaped triangles, flips edges where that makes
/// the smallest angle larger (Botsch and Kobbelt 2004, without the smoothing: points that stay do
/// not move).
///
/// A closed, oriented 2-manifold stays one, of the same genus (link condition). Points on borders,
/// at faults of the mesh and between triangles of different sourceLeaf stay, and so do the edges
/// that join them there, but for splits. Collapses and flips turn no normal by more than 60
/// degrees, that of slivers excepted, and make no edge longer than 4/3 L that was shorter.
/// Triangles of good shape and size away from the mended ones keep their points, bit for bit, and
/// all keep their order; new points and triangles come last.
///
/// Follows: normals; sourceLeaf; sourceTriangle, -1 for triangles that a collapse or flip has
/// changed; vertexOrigin, interpolated where both ends of a split edge lie on one triangle and no
/// projection is given, else none.
/// \throws InvalidParameter; TooLarge when L asks for more triangles than can be counted;
/// Cancelled.
void remeshStretched(TriangleMesh& mesh, const RemeshOptions& options,
  const ProjectToSurface& project = nullptr, const Progress& progress = Progress::none());

} // namespace hybridtree

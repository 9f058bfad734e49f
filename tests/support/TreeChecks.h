// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hybridtree::test
{

/// How far a mesh is from the solid that it bounds, by random points.
struct SolidCheck
{
  double excess = 0.0;         ///< volume inside of the mesh less volume inside by membership
  double sigma = 0.0;          ///< standard deviation of that
  double chords = 0.0;         ///< most that the flatness of triangles may make of it
  double depth = 0.0;          ///< of the deepest point that is on the wrong side of the mesh
  Vec3 deepest = Vec3::Zero(); ///< that point

  bool volumeOff() const { return !(std::abs(excess) <= 3.0 * sigma + chords); }
};

/// \param edge of the mesh: a triangle of that length on a surface curved as much as it can show
/// stands off by an eighth of it at its middle, and by half of that in the mean.
SolidCheck checkSolid(
  const Node& tree, const MeshPtr& mesh, double edge, std::size_t points, std::uint64_t seed);

/// How far two meshes are apart.
struct Apart
{
  double distance = 0.0;
  Vec3 onA = Vec3::Zero(); ///< the point of A that is farthest from B
  Vec3 onB = Vec3::Zero();
};

/// The largest distance of a vertex or a triangle's centre of one mesh from the other, both ways
/// (Hausdorff). 0 for two empty meshes, infinity where one is.
Apart hausdorff(const MeshPtr& a, const MeshPtr& b);

/// Whether the gradient turns by more than 45 degrees within `reach` of a point: its surface there
/// has a crease, or what is too small to tell from one.
bool isAtCrease(const Node& tree, const Vec3& point, double reach);

/// How many vertices of the mesh of a tree are farther than `allowed` from its surface, not
/// counting those that a blend or a Boolean has taken over from the meshes below it, bit for bit,
/// or that lie on such a mesh, as on the border of a cut. 0 for kinds that do not make a mesh
/// themselves.
std::size_t verticesOffSurface(
  const Node& tree, const TriangleMesh& mesh, double edge, double allowed);

} // namespace hybridtree::test

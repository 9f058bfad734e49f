// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/Node.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hybridtree::test
{

/// Points and how far they are from something, the farthest first.
struct FarPoints
{
  std::vector<Vec3> points;
  std::vector<double> distances;

  /// 0 and the origin if there is none.
  double farthest() const { return distances.empty() ? 0.0 : distances.front(); }
  Vec3 farthestPoint() const { return points.empty() ? Vec3(Vec3::Zero()) : points.front(); }
  /// Of those that are farther than `limit` so many that each other one is near to one of them.
  std::vector<Vec3> beyond(double limit, double near) const;
};

/// How far a mesh is from the solid that it bounds, by random points.
struct SolidCheck
{
  double excess = 0.0; ///< volume inside of the mesh less volume inside by membership
  double sigma = 0.0;  ///< standard deviation of that
  double chords = 0.0; ///< most that the flatness of triangles may make of it
  FarPoints wrong;     ///< points that are on the wrong side of the mesh, by their distance from it

  bool volumeOff() const { return !(std::abs(excess) <= 3.0 * sigma + chords); }
};

/// \param edge of the mesh: a triangle of that length on a surface curved as much as it can show
/// stands off by an eighth of it at its middle, and by half of that in the mean.
SolidCheck checkSolid(
  const Node& tree, const MeshPtr& mesh, double edge, std::size_t points, std::uint64_t seed);

/// How far two meshes are apart: the vertices and centres of triangles of each, from the other.
struct Apart
{
  FarPoints ofA;
  FarPoints ofB;

  /// (Hausdorff.) 0 for two empty meshes, infinity where one is.
  double distance() const { return std::max(ofA.farthest(), ofB.farthest()); }
};

Apart hausdorff(const MeshPtr& a, const MeshPtr& b);

/// Whether the solid of a tree, or what is around it, is too thin beside a point for a lattice of
/// these edges: no ball as wide as the diagonal of a cell that is on one side comes within three
/// quarters of an edge of the point. Smaller balls may have no lattice point in them, and a lattice
/// tells the topology of a solid only if balls of that size fit its surface on both sides
/// (Stelldinger, Latecki and Siqueira 2007). Wedges are thin along their edge if they are sharper
/// than about 60 degrees; right angles and the corners of boxes are not.
bool isThin(const Node& tree, const Vec3& point, double edge);

/// How many vertices of the mesh of a tree are farther than `allowed` from its surface, not
/// counting those that a blend or a Boolean has taken over from the meshes below it, bit for bit,
/// or that lie on such a mesh, as on the border of a cut. 0 for kinds that do not make a mesh
/// themselves.
std::size_t verticesOffSurface(
  const Node& tree, const TriangleMesh& mesh, double edge, double allowed);

} // namespace hybridtree::test

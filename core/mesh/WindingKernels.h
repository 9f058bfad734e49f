// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/MeshBvh.h"
#include "core/mesh/TriangleMesh.h"

#include <vector>

namespace hybridtree
{

/// The children of a node of a mesh's hierarchy as dipoles, laid out for SIMD (Barill et al. 2018).
struct alignas(64) WindingDipoles
{
  double center[3][MeshBvh::kWidth];
  double normal[3][MeshBvh::kWidth]; ///< sum of area normals
  /// Squared distance from the center beyond which a child counts as a dipole.
  double squaredFar[MeshBvh::kWidth];
};

/// Corners of the triangles of a leaf, by corner and axis.
struct alignas(64) LeafCorners
{
  double at[3][3][MeshBvh::kWidth];

  static LeafCorners of(const TriangleMesh& mesh, const MeshBvh::Leaf& leaf);
};

/// What a winding number is summed up from.
struct WindingTree
{
  const TriangleMesh* mesh;
  const MeshBvh* bvh;
  std::vector<WindingDipoles> dipoles; ///< per node
  std::vector<LeafCorners> corners;    ///< per leaf, or empty: gathered each time, for large meshes
};

/// Solid angle of a mesh seen from p, positive where p looks at its back: child clusters far from p
/// count as dipoles, all other triangles one by one (van Oosterom and Strackee 1983, as
/// halfSolidAngle() has it).
double solidAngleOfMesh(const WindingTree& tree, const Vec3& p);

} // namespace hybridtree

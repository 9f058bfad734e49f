// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Types.h"

#include <array>
#include <memory>
#include <vector>

namespace hybridtree
{

using Triangle = std::array<std::int32_t, 3>;

/// Where a vertex of a made mesh lies on the mesh leaf it comes from: inside one triangle of the
/// leaf, at weights (1 - u - v, u, v) of its corners. leaf < 0: it comes from no mesh leaf.
struct VertexOrigin
{
  std::int32_t leaf = -1;
  std::int32_t triangle = -1;
  double u = 0.0;
  double v = 0.0;
};

/// Indexed triangle mesh. Triangles are counter-clockwise seen from outside.
///
/// Plain data: whoever fills it keeps the sizes right. The optional arrays are empty or full.
struct TriangleMesh
{
  std::vector<Vec3> points;
  std::vector<Triangle> triangles;

  /// Per point, unit length, outward. Optional.
  std::vector<Vec3> normals;
  /// Per triangle: index of the leaf it comes from, in the depth-first order of the tree that made
  /// the mesh; -1 where several leaves blend. Optional.
  std::vector<std::int32_t> sourceLeaf;
  /// Per triangle: triangle of that mesh leaf it is (a part of), -1 for none. Optional.
  std::vector<std::int32_t> sourceTriangle;
  /// Per point. Optional.
  std::vector<VertexOrigin> vertexOrigin;

  bool empty() const { return triangles.empty(); }
  Box3 bounds() const;
};

using MeshPtr = std::shared_ptr<const TriangleMesh>;

/// Enclosed volume by the divergence theorem: positive when outward orientation; meaningful for closed meshes.
double signedVolume(const TriangleMesh& mesh);

/// Unnormalised normal of triangle t: twice its area long.
Vec3 areaNormal(const TriangleMesh& mesh, std::size_t t);

} // namespace hybridtree

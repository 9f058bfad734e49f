// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/boolean/BoxTree.h"
#include "core/mesh/TriangleMesh.h"

#include <mutex>
#include <string>
#include <vector>

namespace hybridtree
{

/// A triangle mesh made ready for meshBoolean(). Keep it to cut the same mesh again: the making
/// takes a good part of the time. Immutable; any number of threads may share one.
///
/// Any mesh will do. Open edges are closed by a fan of triangles from the middle of each loop of
/// them, the flat ones of which are where the winding number of the open mesh is 1/2.
class MeshOperand
{
public:
  /// \throws InvalidGeometry: a coordinate above 1e60, or not finite.
  explicit MeshOperand(MeshPtr mesh);

  /// With the fans that close it, which come last.
  const TriangleMesh& mesh() const { return *mesh_; }
  const MeshPtr& original() const { return original_; }
  /// \pre the mesh has triangles.
  const BoxTree& tree() const { return *tree_; }

  /// Triangles of the fans that close the mesh; 0 for a closed one.
  std::size_t addedTriangles() const
  {
    return mesh_->triangles.size() - original_->triangles.size();
  }

  /// How far apart surfaces may be that count as one where rounding is what parts them: 2^-48 of
  /// the largest coordinate.
  double rounding() const { return rounding_; }

  /// The same mesh with each point moved so that the triangles around it lie outward by `distance`,
  /// where the point has not to go farther than twice that; inward below 0.
  MeshOperand swollen(double distance) const;

  /// Outward at a vertex: the mean of the normals of its triangles by angle, as integers below
  /// 2^20.
  Vec3 outward(std::int32_t vertex) const;

private:
  MeshOperand(MeshPtr original, MeshPtr closed);
  void makeTree();
  void makeOutward() const;

  MeshPtr original_;
  MeshPtr mesh_;
  std::unique_ptr<const BoxTree> tree_;
  double rounding_ = 0.0;
  mutable std::once_flag once_;
  mutable std::vector<Vec3> outward_; // made when the first tie asks
};

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/geometry/PointTriangle.h"
#include "core/mesh/HalfEdges.h"
#include "core/mesh/MeshBvh.h"
#include "core/mesh/WindingNumber.h"

#include <memory>
#include <string>
#include <vector>

namespace hybridtree
{

/// On which side of a mesh a point lies: 1 inside, 0 on it, -1 outside.
///
/// Closed meshes: by the angle-weighted pseudonormal of the nearest feature (Baerentzen and Aanaes
/// 2005). Wherever rounding could touch its sign, and in meshes of several shells that may overlap
/// (where a nearest point says nothing of the other shells), by the crossings of a ray, out less
/// in, with exact orientation predicates: inside is where more shells are around than cavities.
/// Others: by the winding number, which is the same for closed meshes.
/// A single shell that crosses itself counts as it is seen from its nearest point, but by the ray
/// beside sharp folds, where it usually does; outside of its bounds is outside.
class MeshSide
{
public:
  /// What the far-field expansion of the winding number may be off by, doubled.
  static constexpr double kWindingError = 0.02;

  /// \pre mesh and bvh outlive this.
  MeshSide(const TriangleMesh& mesh, const MeshBvh& bvh);

  /// \param nearest the point of `triangle` nearest to p, which is the nearest of the mesh.
  /// \param winding the winding number at p where that tells the side; else it stays as it was.
  int side(const Vec3& p, std::int32_t triangle, const NearestOnTriangle& nearest,
    double* winding = nullptr) const;

  /// Without a nearest point at hand: by the crossings of a ray, or by the winding number.
  int side(const Vec3& p, double* winding = nullptr) const;

  /// side() with a nearest point costs as much as without: it seldom tells.
  bool isCostly() const { return overlapping_ || !this->isClosed(); }

  /// Unit normal at a feature of a triangle: of the face, of the edge (mean of both faces), of the
  /// vertex (by angle).
  Vec3 pseudonormal(std::int32_t triangle, int feature) const;

  /// Gradient of the signed distance at p, of length 1: away from the nearest point outside, toward
  /// it inside; the pseudonormal where the two points are too near to tell a direction.
  Vec3 gradient(
    const Vec3& p, int side, std::int32_t triangle, const NearestOnTriangle& nearest) const;

  bool isClosed() const { return edges_.closedAndOriented(); }
  const HalfEdges& edges() const { return edges_; }
  const std::vector<Vec3>& vertexNormals() const { return vertexNormals_; }

  /// How fast the winding number can change along a way that keeps `distance` from the mesh: at
  /// most this, per length. 0 for a closed mesh. By Biot-Savart it is a line integral over the open
  /// edges of at most 1 / (4 pi r^2).
  double windingSlope(double distance) const;
  /// \pre the mesh is not closed.
  double windingNumber(const Vec3& p) const { return winding_->at(p); }

private:
  void makeVertexNormals();
  void doubtFolds();
  bool shellsMayOverlap() const;
  int sideByRay(const Vec3& p) const;
  int sideByWinding(const Vec3& p, double* winding) const;

  const TriangleMesh& mesh_;
  const MeshBvh& bvh_;
  HalfEdges edges_;
  Box3 bounds_;
  std::vector<Vec3> vertexNormals_;
  std::vector<char> doubtful_; // vertices of slivers and folds, whose normals say little
  bool overlapping_ = false;   // boxes of two shells meet
  double borderLength_ = 0.0;
  std::unique_ptr<const WindingNumber> winding_; // null for a closed mesh
};

} // namespace hybridtree

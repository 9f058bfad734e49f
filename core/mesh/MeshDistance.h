// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace hybridtree
{

class KnownSides;
class MeshBvh;
class MeshSide;

/// Part of a mesh: all that can be nearest to points of one box. Made by
/// MeshDistance::restrictedTo(), handed back to its queries to make them start there instead of at
/// the whole mesh.
struct MeshPart
{
  std::vector<std::uint32_t> roots; ///< nodes of the hierarchy
};

/// Euclidean distance to a triangle mesh, nearest triangle and side, in batches.
///
/// Distances are double throughout, whatever the hierarchy inside rounds. Batches may hold any
/// points in any order; points that lie together (a brick of a lattice) cost much less each than
/// scattered ones. Batches of many thousands are spread over the threads, with the same results for
/// any number. Immutable: one object serves any number of threads.
class MeshDistance
{
public:
  /// Builds the hierarchy, O(n log n). \pre mesh is as repairMesh() leaves it.
  /// \throws InvalidGeometry when the mesh has no triangles.
  explicit MeshDistance(MeshPtr mesh);
  ~MeshDistance();
  MeshDistance(const MeshDistance&) = delete;
  MeshDistance& operator=(const MeshDistance&) = delete;

  const MeshPtr& mesh() const { return mesh_; }
  const Box3& bounds() const { return bounds_; }

  /// distance[k] = distance of p_k to the mesh, >= 0; infinity beyond maxDistance.
  /// \param maxDistance > 0, may be infinity. \param part empty, or one whose box holds all points.
  void distance(
    PointBatch points, double maxDistance, double* distance, const MeshPart* part = nullptr) const;

  /// And the triangle that is nearest (-1 beyond maxDistance; the lowest-numbered among those found
  /// equally near is not promised) and its nearest point (NaN beyond).
  void nearest(PointBatch points, double maxDistance, double* distance, std::int32_t* triangle,
    VectorBatch nearestPoint, const MeshPart* part = nullptr) const;

  /// distance[k] negative inside; +-infinity beyond maxDistance, by the side. gradient k is its
  /// gradient: unit length, outward; on the mesh itself the pseudonormal; 0 beyond maxDistance.
  /// gradient.x may be null.
  void signedDistance(PointBatch points, double maxDistance, double* distance, VectorBatch gradient,
    const MeshPart* part = nullptr) const;

  /// 1 inside, 0 on the mesh, -1 outside. For a closed mesh exact, however near to an edge or a
  /// vertex a point is. Otherwise by the winding number, inside above 1/2 (Barill et al. 2018); a
  /// point whose distance is 0 is on the mesh.
  void side(PointBatch points, std::int8_t* side) const;

  /// min <= distance(p) <= max for all p of the box; max - min is at most the box's diagonal.
  Interval range(const Box3& box) const;

  /// As range(), of the signed distance.
  Interval signedRange(const Box3& box) const;

  /// What can be nearest to points of the box, no farther than maxDistance. Empty roots: nothing.
  MeshPart restrictedTo(const Box3& box, double maxDistance) const;
  /// The same where no point of the box is farther than maxDistance from the mesh, or what is
  /// farther does not matter: saves a search.
  MeshPart within(const Box3& box, double maxDistance) const;

  /// Every edge has two triangles that agree: inside is exact. Otherwise the winding number
  /// decides.
  bool isClosed() const;

  /// Angle-weighted unit normals of the vertices (Baerentzen and Aanaes 2005).
  const std::vector<Vec3>& vertexNormals() const;

  /// What the user should know: empty for a closed mesh.
  std::vector<std::string> warnings() const;

private:
  void find(PointBatch points, double maxDistance, const MeshPart* part, double* squared,
    std::int32_t* triangle) const;
  int sideFarAway(const Vec3& p, KnownSides& known) const;

  MeshPtr mesh_;
  Box3 bounds_;
  std::unique_ptr<const MeshBvh> bvh_;
  std::unique_ptr<const MeshSide> side_;
};

/// The MeshDistance of this very mesh object, built at the first call and shared as long as anyone
/// holds it: changing a field's parameters or moving a mesh builds nothing anew. Thread-safe.
std::shared_ptr<const MeshDistance> sharedMeshDistance(const MeshPtr& mesh);

} // namespace hybridtree

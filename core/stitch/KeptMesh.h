// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"
#include "core/stitch/CellGrid.h"
#include "core/stitch/CellSet.h"

#include <memory>
#include <mutex>
#include <vector>

namespace hybridtree
{

/// The triangles of a mesh by the bricks of a grid in which their boxes lie.
class TriangleBricks
{
public:
  TriangleBricks(const TriangleMesh& mesh, const CellGrid& grid);

  const CellGrid& grid() const { return grid_; }

  /// Triangles whose boxes may touch one of the cells' bricks; rising.
  std::vector<std::int32_t> near(const CellSet& cells) const;

  /// Triangles whose boxes may touch the brick of one of these points; rising.
  std::vector<std::int32_t> near(const std::vector<Vec3>& points) const;

private:
  struct Blocks;

  std::vector<Blocks> blocksOf(const TriangleMesh& mesh) const;
  std::vector<std::int32_t> inBlocks(std::vector<Index3> bricks) const;
  std::int64_t number(const Index3& block) const;
  Index3 blockOf(const Index3& brick) const;
  Index3 blockAt(const Vec3& point, double slack) const;

  CellGrid grid_;
  std::int64_t bricksPerBlock_ = 1; ///< along each axis; more than 1 where bricks are too many
  Index3 first_{};                  ///< blocks
  Index3 size_{};
  std::vector<std::int32_t> begin_; ///< per block, and the end: in triangles_
  std::vector<std::int32_t> triangles_;
  std::vector<std::int32_t> large_; ///< in too many blocks to list
};

/// What there is to know of a mesh of which parts are kept. Each is found at the first question.
/// Thread-safe.
class KeptMesh
{
public:
  /// That of this very mesh object, remembered as long as anyone holds the mesh.
  static std::shared_ptr<const KeptMesh> of(const MeshPtr& mesh);

  explicit KeptMesh(const TriangleMesh& mesh) : mesh_(mesh) {}

  /// A closed, oriented 2-manifold with normals: parts of it can be kept in another mesh.
  bool isSound() const;

  double area() const;
  Box3 bounds() const;

  /// Per point: how many triangles it has.
  const std::vector<std::int32_t>& valence() const;

  /// The last one asked for is kept.
  std::shared_ptr<const TriangleBricks> bricks(const CellGrid& grid) const;

private:
  const TriangleMesh& mesh_;
  mutable std::once_flag soundOnce_, areaOnce_, boundsOnce_, valenceOnce_;
  mutable bool sound_ = false;
  mutable double area_ = 0.0;
  mutable Box3 bounds_;
  mutable std::vector<std::int32_t> valence_;
  mutable std::mutex mutex_;
  mutable std::shared_ptr<const TriangleBricks> bricks_;
};

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"
#include "core/stitch/TriangleBlocks.h"

#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace hybridtree
{

/// The triangles at each point of a mesh.
class PointTriangles
{
public:
  /// \pre indices are in range.
  explicit PointTriangles(const TriangleMesh& mesh);

  std::int32_t count(std::int32_t point) const { return begin_[point + 1] - begin_[point]; }

  /// count() numbers, rising.
  const std::int32_t* of(std::int32_t point) const { return &triangles_[begin_[point]]; }

  /// Points without a triangle, rising.
  const std::vector<std::int32_t>& unused() const { return unused_; }

private:
  std::vector<std::int32_t> begin_; ///< per point, and the end: in triangles_
  std::vector<std::int32_t> triangles_;
  std::vector<std::int32_t> unused_;
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

  /// Of the edges at which two triangles meet at more than 30 degrees. \pre isSound()
  double creaseLength() const;

  /// The triangles at each point.
  const PointTriangles& pointTriangles() const;

  const TriangleBlocks& blocks() const;

private:
  const TriangleMesh& mesh_;
  mutable std::once_flag soundOnce_, areaOnce_, boundsOnce_, creasesOnce_, trianglesOnce_,
    blocksOnce_;
  mutable bool sound_ = false;
  mutable double area_ = 0.0;
  mutable double creaseLength_ = 0.0;
  mutable Box3 bounds_;
  mutable std::optional<PointTriangles> triangles_;
  mutable std::optional<TriangleBlocks> blocks_;
};

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <vector>

namespace hybridtree
{

/// The triangles of a mesh by where they are: cubes of a size that fits the mesh, so that one
/// serves every lattice. A triangle is in the block of the low corner of its box; those that are
/// longer than a block are in none, and looked at one by one. Immutable.
class TriangleBlocks
{
public:
  /// \pre points are finite, indices in range.
  explicit TriangleBlocks(const TriangleMesh& mesh);

  /// All triangles whose boxes touch one of these boxes, and some that are only near; rising.
  std::vector<std::int32_t> near(const std::vector<Box3>& boxes) const;

private:
  struct Large
  {
    std::int32_t triangle;
    Box3 box;
  };

  /// Blocks of all triangles, those beyond the last one of large ones. \return how many are large.
  std::size_t findBlocks(const TriangleMesh& mesh, std::vector<std::int32_t>& blockOf) const;
  void fill(const TriangleMesh& mesh, const std::vector<std::int32_t>& blockOf);
  std::int32_t blockAlong(int axis, double coordinate) const;
  std::int32_t blockCount() const { return size_[0] * size_[1] * size_[2]; }

  Vec3 low_ = Vec3::Zero();
  double side_ = 1.0;
  std::array<std::int32_t, 3> size_{ 1, 1, 1 }; ///< blocks
  std::vector<std::int32_t> begin_;             ///< per block, and the end: in triangles_
  std::vector<std::int32_t> triangles_;
  std::vector<Large> large_;
};

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Bounding volume hierarchy over the triangles of a mesh: eight children a node, up to eight
/// triangles a leaf, both laid out for SIMD.
///
/// Boxes are float, rounded outward, in a local space: the mesh centred and scaled into [-1, 1]^3,
/// so that no model is too large, too small or too far from the origin for them.
class MeshBvh
{
public:
  static constexpr std::size_t kWidth = 8;
  static constexpr std::uint32_t kLeafBit = 0x80000000u;
  static constexpr std::uint32_t kNone = 0xffffffffu;

  struct alignas(32) Node
  {
    float lower[3][kWidth];
    float upper[3][kWidth];
    /// A node, or a leaf with kLeafBit set, or kNone (always after the others, with a box so far
    /// away that no test reaches it).
    std::uint32_t child[kWidth];
  };

  /// A triangle in a frame of its own, in local space: the first corner at the origin, the second
  /// on the u axis, the third on the side of positive v. Every direction is made in double and of
  /// unit length, so that distances from it are good to float rounding for slivers too.
  struct Frame
  {
    float origin[3][kWidth];
    float u[3][kWidth];
    float v[3][kWidth];
    float normal[3][kWidth];
    float length[3][kWidth];       ///< of the edges 0-1, 1-2 and 0-2
    float direction[2][2][kWidth]; ///< of the edges 1-2 and 0-2, in (u, v)
  };

  struct alignas(32) Leaf
  {
    Frame frame;
    std::array<std::int32_t, kWidth> triangle; ///< filled up with the last one
    std::uint32_t count;
  };

  /// \pre mesh has triangles.
  explicit MeshBvh(const TriangleMesh& mesh);

  /// The root is node 0.
  const std::vector<Node>& nodes() const { return nodes_; }
  const std::vector<Leaf>& leaves() const { return leaves_; }

  Vec3 toLocal(const Vec3& p) const { return (p - center_) * scale_; }
  double scale() const { return scale_; } ///< local lengths per mesh length
  const Vec3& center() const { return center_; }

private:
  friend class MeshBvhBuilder;

  Vec3 center_;
  double scale_;
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
};

} // namespace hybridtree

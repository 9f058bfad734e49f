// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace hybridtree
{

/// The 256 ways in which a surface can cross a lattice cell, worked out at start-up from one rule
/// instead of copied from a table.
///
/// Corner c of a cell sits at (c & 1, c >> 1 & 1, c >> 2 & 1); bit c of a case is set when it is
/// inside. Edge e runs along axis a = e / 4 from the corner with offset (e & 1) on axis a + 1 and
/// (e >> 1 & 1) on axis a + 2 (axes modulo 3).
///
/// On every face of the cell the crossed edges are joined by segments that part the inside corners
/// from the rest. A face with two inside corners across its diagonal is ambiguous: they are parted
/// from one another, or joined and the other two parted, which is for the field to tell
/// (AmbiguousFaces.h), once for both cells. So both see the same segments. These close to loops,
/// and each loop is filled by triangles whose diagonals never lie in a face of the cell: so no edge
/// can be made twice by different cells.
class MarchingCubesTable
{
public:
  /// Crossed edges of a cell in cyclic order, counter-clockwise seen from the outside of the solid.
  struct Loop
  {
    std::uint8_t size = 0; ///< 3 to 7
    std::array<std::uint8_t, 7> edges{};
    /// 3 (size - 2) positions in `edges`: the triangles. In a loop of four the other diagonal does
    /// as well.
    std::array<std::uint8_t, 15> triangles{};
  };

  struct Case
  {
    std::uint8_t loopCount = 0;
    std::uint8_t triangleCount = 0;
    std::uint16_t edgeMask = 0;  ///< bit e: edge e is crossed
    std::uint8_t ambiguous = 0;  ///< bit 2 a + s: the face at side s of axis a is
    std::array<Loop, 4> loops{}; ///< with the inside corners of ambiguous faces parted
  };

  /// As Loop, of 3 to 12 edges. Without triangles where there are none without a diagonal in a
  /// face: those have to meet in a point in the midst of the loop.
  struct JoinedLoop
  {
    std::vector<std::uint8_t> edges;
    std::vector<std::uint8_t> triangles;

    std::size_t triangleCount() const
    {
      return triangles.empty() ? edges.size() : triangles.size() / 3;
    }
  };

  /// Made once, at the first call.
  static const MarchingCubesTable& instance();

  const Case& operator[](unsigned signs) const { return cases_[signs]; }

  /// The loops of a case where the inside corners of some of its ambiguous faces are joined.
  /// \param faces bits as Case::ambiguous. \pre not 0, and only ambiguous ones.
  const std::vector<JoinedLoop>& joined(unsigned signs, unsigned faces) const
  {
    return joined_.at(signs << 6 | faces);
  }

  /// The two corners of an edge, lower first.
  static constexpr std::array<std::uint8_t, 2> corners(unsigned edge)
  {
    const unsigned axis = edge / 4;
    const unsigned low = (edge & 1u) << (axis + 1) % 3 | (edge >> 1 & 1u) << (axis + 2) % 3;
    return { static_cast<std::uint8_t>(low), static_cast<std::uint8_t>(low | 1u << axis) };
  }

  /// Bit 2 a + s: the edge lies in the face at side s of axis a.
  static unsigned facesOf(unsigned edge);

private:
  MarchingCubesTable();

  std::array<Case, 256> cases_;
  std::unordered_map<unsigned, std::vector<JoinedLoop>> joined_;
};

} // namespace hybridtree

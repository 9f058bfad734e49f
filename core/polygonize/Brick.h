// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/polygonize/BrickTree.h"

#include <array>
#include <vector>

namespace hybridtree
{

inline constexpr int kBrickPoints = kBrickSide * kBrickSide * kBrickSide;

inline unsigned bitCount(std::uint64_t bits)
{
  bits -= bits >> 1 & 0x5555555555555555u;
  bits = (bits & 0x3333333333333333u) + (bits >> 2 & 0x3333333333333333u);
  bits = (bits + (bits >> 4)) & 0x0f0f0f0f0f0f0f0fu;
  return static_cast<unsigned>(bits * 0x0101010101010101u >> 56);
}

/// One bit for each of a brick's 8^3 points: bit 8 y + x of word z.
using BrickBits = std::array<std::uint64_t, kBrickSide>;

/// What polygonize() knows of one crossed brick.
struct Brick
{
  Index3 index{};
  BrickBits inside{};
  std::array<BrickBits, 3> crossed{}; ///< [axis]: the edge from a point along the axis has a vertex
  std::array<std::array<std::uint16_t, kBrickSide>, 3>
    rank{}; ///< vertices before a word of `crossed`
  /// Contents of the bricks at offset (n & 1, n >> 1 & 1, n >> 2 & 1); [0] is this one.
  std::array<BrickTree::Content, 8> neighbours{};
  bool ambiguous = false; ///< some of its cells have an ambiguous face (AmbiguousFaces.h)
  std::uint32_t vertexCount = 0;
  std::uint32_t centreCount = 0; ///< vertices in the midst of loops
  std::uint32_t triangleCount = 0;
  std::uint32_t firstVertex = 0; ///< in the mesh
  std::uint32_t firstCentre = 0;
  std::uint32_t firstTriangle = 0;

  /// Number within the brick of the vertex on a crossed edge.
  std::uint32_t vertexRank(unsigned axis, unsigned x, unsigned y, unsigned z) const
  {
    const std::uint64_t before = (std::uint64_t(1) << (kBrickSide * y + x)) - 1;
    return rank[axis][z] + bitCount(crossed[axis][z] & before);
  }
  /// Fills rank and vertexCount from crossed.
  void countVertices();
};

/// Sides of all corners of a brick's cells: bit x of rows[z][y], x, y, z <= 8.
struct CornerSigns
{
  std::uint16_t rows[kBrickSide + 1][kBrickSide + 1];

  bool uniform() const;
  void findCrossedEdges(std::array<BrickBits, 3>& crossed) const;
  /// Bit c of the case of cell (x, y, z): corner c is inside.
  unsigned cellCase(unsigned x, unsigned y, unsigned z) const
  {
    const auto pair = [x](unsigned row) { return row >> x & 3u; };
    return pair(rows[z][y]) | pair(rows[z][y + 1]) << 2 | pair(rows[z + 1][y]) << 4 |
      pair(rows[z + 1][y + 1]) << 6;
  }
  /// Bit x of row (y, z): the cell has corners on both sides.
  unsigned crossedCells(unsigned y, unsigned z) const
  {
    const unsigned all = rows[z][y] & rows[z][y + 1] & rows[z + 1][y] & rows[z + 1][y + 1];
    const unsigned any = rows[z][y] | rows[z][y + 1] | rows[z + 1][y] | rows[z + 1][y + 1];
    return (any | any >> 1) & ~(all & all >> 1) & 0xffu;
  }
};

/// \param contents as Brick::neighbours; the bits of those >= 0 are in `bricks`.
CornerSigns gatherSigns(
  const std::array<BrickTree::Content, 8>& contents, const std::vector<Brick>& bricks);

} // namespace hybridtree

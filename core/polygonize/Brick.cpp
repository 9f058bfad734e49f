// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/Brick.h"

namespace hybridtree
{
namespace
{

constexpr std::uint64_t kAllBits = ~std::uint64_t(0);

} // namespace

void Brick::countVertices()
{
  vertexCount = 0;
  for (unsigned axis = 0; axis < 3; ++axis)
  {
    for (unsigned z = 0; z < kBrickSide; ++z)
    {
      rank[axis][z] = static_cast<std::uint16_t>(vertexCount);
      vertexCount += bitCount(crossed[axis][z]);
    }
  }
}

bool CornerSigns::uniform() const
{
  const std::uint16_t first = (rows[0][0] & 1u) != 0 ? 0x1ff : 0;
  for (const auto& layer : rows)
  {
    for (const std::uint16_t row : layer)
    {
      if (row != first)
      {
        return false;
      }
    }
  }
  return true;
}

void CornerSigns::findCrossedEdges(std::array<BrickBits, 3>& crossed) const
{
  for (unsigned z = 0; z < kBrickSide; ++z)
  {
    std::array<std::uint64_t, 3> bits{};
    for (unsigned y = 0; y < kBrickSide; ++y)
    {
      const unsigned row = rows[z][y];
      bits[0] |= std::uint64_t((row ^ row >> 1) & 0xffu) << (kBrickSide * y);
      bits[1] |= std::uint64_t((row ^ rows[z][y + 1]) & 0xffu) << (kBrickSide * y);
      bits[2] |= std::uint64_t((row ^ rows[z + 1][y]) & 0xffu) << (kBrickSide * y);
    }
    for (unsigned axis = 0; axis < 3; ++axis)
    {
      crossed[axis][z] = bits[axis];
    }
  }
}

CornerSigns gatherSigns(
  const std::array<BrickTree::Content, 8>& contents, const std::vector<Brick>& bricks)
{
  const auto word = [&](unsigned neighbour, unsigned z)
  {
    const BrickTree::Content content = contents[neighbour];
    return content >= 0               ? bricks[static_cast<std::size_t>(content)].inside[z]
      : content == BrickTree::kInside ? kAllBits
                                      : 0;
  };
  CornerSigns signs;
  for (unsigned z = 0; z <= kBrickSide; ++z)
  {
    const unsigned above = z == kBrickSide ? 4 : 0;
    const unsigned layer = z % kBrickSide;
    const std::uint64_t own = word(above, layer);
    const std::uint64_t nextX = word(above | 1u, layer);
    for (unsigned y = 0; y < kBrickSide; ++y)
    {
      signs.rows[z][y] = static_cast<std::uint16_t>(
        (own >> (kBrickSide * y) & 0xffu) | (nextX >> (kBrickSide * y) & 1u) << kBrickSide);
    }
    signs.rows[z][kBrickSide] = static_cast<std::uint16_t>(
      (word(above | 2u, layer) & 0xffu) | (word(above | 3u, layer) & 1u) << kBrickSide);
  }
  return signs;
}

} // namespace hybridtree

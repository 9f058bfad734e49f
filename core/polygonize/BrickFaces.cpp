// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/BrickFaces.h"

#include "core/base/Parallel.h"
#include "core/polygonize/AmbiguousFaces.h"

#include <algorithm>

namespace hybridtree
{

void BrickFaces::decide(const std::vector<Brick>& bricks, const BrickTree& tree,
  const Lattice& lattice, const Progress& progress)
{
  if (std::none_of(
        bricks.begin(), bricks.end(), [](const Brick& brick) { return brick.ambiguous; }))
  {
    return;
  }
  joined_.resize(bricks.size());
  parallelFor(bricks.size(), 1,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      for (std::size_t k = begin; k < end; ++k)
      {
        if (bricks[k].ambiguous)
        {
          this->decide(bricks[k], gatherSigns(bricks[k].neighbours, bricks),
            *tree.leaves()[k].source, lattice, joined_[k]);
        }
      }
    });
}

void BrickFaces::decide(const Brick& brick, const CornerSigns& signs, const FieldSource& field,
  const Lattice& lattice, std::array<BrickBits, 3>& joined) const
{
  std::vector<AmbiguousFace> faces;
  std::vector<unsigned> bits;
  forEachCrossedCell(signs,
    [&](const CrossedCell& cell)
    {
      for (unsigned axis = 0; axis < 3; ++axis)
      {
        if ((cell.way.ambiguous >> (2 * axis) & 1u) != 0)
        {
          AmbiguousFace face{ {}, axis, (cell.signs & 1u) != 0 };
          for (unsigned k = 0; k < 3; ++k)
          {
            face.low[k] = brick.index[k] * kBrickSide + cell.at[k];
          }
          faces.push_back(face);
          bits.push_back((cell.at[2] * kBrickSide + cell.at[1]) * kBrickSide + cell.at[0]);
        }
      }
    });
  const std::vector<std::uint8_t> answer = joinsInside(field, lattice, faces);
  for (std::size_t n = 0; n < faces.size(); ++n)
  {
    joined[faces[n].axis][bits[n] / 64] |= std::uint64_t(answer[n]) << bits[n] % 64;
  }
}

unsigned BrickFaces::joinedFaces(const Brick& brick, const CrossedCell& cell) const
{
  unsigned faces = 0;
  for (unsigned face = 0; cell.way.ambiguous >> face != 0; ++face)
  {
    const unsigned axis = face / 2;
    std::array<unsigned, 3> low = cell.at;
    low[axis] += face & 1u;
    const BrickTree::Content owner = brick.neighbours[low[axis] / kBrickSide << axis];
    low[axis] %= kBrickSide;
    if ((cell.way.ambiguous >> face & 1u) != 0 && owner >= 0)
    {
      const std::uint64_t bits = joined_[static_cast<std::size_t>(owner)][axis][low[2]];
      faces |= unsigned(bits >> (kBrickSide * low[1] + low[0]) & 1u) << face;
    }
  }
  return faces;
}

void BrickFaces::count(Brick& brick, const CornerSigns& signs) const
{
  forEachCrossedCell(signs,
    [&](const CrossedCell& cell)
    {
      if (const Loops* loops = this->loopsOf(brick, cell))
      {
        brick.triangleCount -= cell.way.triangleCount;
        for (const MarchingCubesTable::JoinedLoop& loop : *loops)
        {
          brick.triangleCount += static_cast<std::uint32_t>(loop.triangleCount());
          brick.centreCount += loop.triangles.empty() ? 1 : 0;
        }
      }
    });
}

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#include "core/stitch/PatchFaces.h"

#include "core/base/Parallel.h"
#include "core/polygonize/AmbiguousFaces.h"
#include "core/polygonize/MarchingCubesTable.h"

namespace hybridtree
{

void PatchFaces::decide(const Lattice& lattice, const Progress& progress)
{
  parallelFor(bricks_.all().size(), 1,
    [&](std::size_t begin, std::size_t end)
    {
      progress.check();
      for (std::size_t k = begin; k < end; ++k)
      {
        if (bricks_.all()[k].source)
        {
          this->decide(bricks_.all()[k], lattice);
        }
      }
    });
}

void PatchFaces::decide(PatchBrick& brick, const Lattice& lattice)
{
  const MarchingCubesTable& table = MarchingCubesTable::instance();
  std::vector<AmbiguousFace> faces;
  std::vector<int> bits;
  PatchBrick::forEachCell(brick.mixed,
    [&](const std::array<int, 3>& cell)
    {
      const unsigned signs = bricks_.caseOf(brick, cell);
      for (unsigned axis = 0; axis < 3 && table[signs].ambiguous != 0; ++axis)
      {
        std::array<int, 3> before = cell;
        --before[axis];
        if ((table[signs].ambiguous >> (2 * axis) & 1u) != 0 && bricks_.isMarked(brick, before))
        {
          AmbiguousFace face{ {}, axis, (signs & 1u) != 0 };
          for (unsigned k = 0; k < 3; ++k)
          {
            face.low[k] = kBrickSide * brick.index[k] + cell[k];
          }
          faces.push_back(face);
          bits.push_back((cell[2] * kBrickSide + cell[1]) * kBrickSide + cell[0]);
        }
      }
    });
  if (faces.empty())
  {
    return;
  }
  const std::vector<std::uint8_t> joined = joinsInside(*brick.source, lattice, faces);
  for (std::size_t n = 0; n < faces.size(); ++n)
  {
    brick.joined[faces[n].axis][bits[n] / 64] |= std::uint64_t(joined[n]) << bits[n] % 64;
  }
}

bool PatchFaces::isJoined(const PatchBrick& brick, std::array<int, 3> cell, unsigned face)
{
  cell[face / 2] += static_cast<int>(face & 1u);
  const auto place = bricks_.locate(brick, cell[0], cell[1], cell[2]);
  return place.brick && PatchBrick::has(place.brick->joined[face / 2], place.x, place.y, place.z);
}

bool PatchFaces::anyJoined(const PatchBrick& brick, const std::array<int, 3>& cell, unsigned signs)
{
  const unsigned ambiguous = MarchingCubesTable::instance()[signs].ambiguous;
  bool any = false;
  for (unsigned face = 0; ambiguous >> face != 0 && !any; ++face)
  {
    any = (ambiguous >> face & 1u) != 0 && this->isJoined(brick, cell, face);
  }
  return any;
}

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/polygonize/BrickTree.h"
#include "core/polygonize/CrossedCells.h"
#include "core/polygonize/Lattice.h"

#include <vector>

namespace hybridtree
{

/// How the ambiguous faces of the lattice go (AmbiguousFaces.h), each decided in the brick of its
/// lowest corner and looked up by the cells on both sides.
class BrickFaces
{
public:
  using Loops = std::vector<MarchingCubesTable::JoinedLoop>;

  /// Asks the field, in parallel.
  /// \param bricks connected; those with Brick::ambiguous are looked at. \param tree their fields.
  void decide(const std::vector<Brick>& bricks, const BrickTree& tree, const Lattice& lattice,
    const Progress& progress);

  /// The loops of a cell if inside corners are joined in some of its faces; null for other cells,
  /// which have those of their case.
  const Loops* loopsOf(const Brick& brick, const CrossedCell& cell) const
  {
    const unsigned faces = cell.way.ambiguous != 0 ? this->joinedFaces(brick, cell) : 0;
    return faces != 0 ? &MarchingCubesTable::instance().joined(cell.signs, faces) : nullptr;
  }

  /// Makes the number of triangles of an ambiguous brick that of these loops, and fills
  /// centreCount.
  void count(Brick& brick, const CornerSigns& signs) const;

private:
  unsigned joinedFaces(const Brick& brick, const CrossedCell& cell) const;
  void decide(const Brick& brick, const CornerSigns& signs, const FieldSource& field,
    const Lattice& lattice, std::array<BrickBits, 3>& joined) const;

  std::vector<std::array<BrickBits, 3>> joined_; ///< per brick, by axis
};

} // namespace hybridtree

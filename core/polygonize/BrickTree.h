// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Progress.h"
#include "core/polygonize/FieldSource.h"
#include "core/polygonize/Lattice.h"
#include "core/polygonize/MemoryBudget.h"

#include <vector>

namespace hybridtree
{

/// Lattice points, and cells, along each axis of a brick.
inline constexpr int kBrickSide = 8;

/// Octree over the bricks of a lattice that tells which bricks the surface may cross.
///
/// Brick b owns the lattice points 8 b .. 8 b + 7 on each axis and the cells that start there, so
/// each point, edge and cell has one owner. Blocks of bricks whose closed box the range of the
/// field puts on one side of the surface are pruned; the rest are halved, each with the field
/// specialised to it.
class BrickTree
{
public:
  /// What the tree knows of a brick: its number >= 0 when it may be crossed, else the side of all
  /// its points.
  using Content = std::int32_t;
  static constexpr Content kOutside = -1;
  static constexpr Content kInside = -2;

  struct Leaf
  {
    Index3 brick;
    FieldSourcePtr source; ///< valid in the closed box of the brick's cells
  };

  /// field and lattice must live as long as the tree.
  /// \throws TooLarge once there are, or evidently will be, more leaves than the budget allows.
  BrickTree(const FieldSource& field, const Lattice& lattice, const MemoryBudget& budget,
    const Progress& progress);

  const std::vector<Leaf>& leaves() const { return leaves_; }
  Content find(const Index3& brick) const;

  /// Makes a pruned brick a leaf after all, unless it lies outside of the tree.
  void open(const Index3& brick);

private:
  struct Block;
  using Blocks = std::vector<Block>;
  using Node = std::array<Content, 8>; ///< of a child: its content, or >= 0 its node or leaf

  Blocks halve(const Blocks& parents, std::int64_t side, const Progress& progress) const;
  Block classify(const Index3& brick, std::int64_t side, const FieldSource& source) const;
  void link(const Blocks& children, bool areLeaves);
  void checkSize(std::size_t blocks, int levelsLeft) const;
  bool reaches(const Index3& brick) const;
  Box3 boxOf(const Index3& brick, std::int64_t side) const;
  unsigned octant(const Index3& brick, int level) const;

  const FieldSource& field_;
  const Lattice& lattice_;
  const MemoryBudget budget_;
  Index3 first_{}; ///< brick at the low corner
  Index3 last_{};
  int levels_ = 0;
  Content root_ = kOutside;
  std::vector<Node> nodes_;
  std::vector<Leaf> leaves_;
  std::vector<FieldSourcePtr> ancestors_; ///< sources that those of the leaves may refer to
};

} // namespace hybridtree

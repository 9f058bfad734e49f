// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/MarkedCells.h"

#include "core/base/Parallel.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

constexpr double kBytesPerBrick = 20000.0;

// A surface is looked for down to blocks of this many cells, and a bit beyond: meshes are off the
// surfaces they stand for.
constexpr int kSurfaceBlock = 2;
constexpr double kSurfaceMargin = 0.5; // cells

// How far off T the field must be to tell that no surface is there.
constexpr double kRangeSlack = 1e-9;

/// A term that may reach a block.
struct Reach
{
  int term = 0;
  bool certain = false;  ///< not 0 anywhere in the block
  FieldSourcePtr source; ///< valid in the block
};

struct Block
{
  Index3 low{};
  std::int64_t side = 1;
  std::vector<Reach> reach;
};

class Marker
{
public:
  Marker(const std::vector<MarkTerm>& terms, const Interaction& interaction, const CellGrid& grid,
    const MemoryBudget& budget, const Progress& progress)
    : terms_(terms), interaction_(interaction), grid_(grid), budget_(budget), progress_(progress)
  {
  }

  CellSet run()
  {
    Block root = this->rootBlock();
    if (root.side > 0)
    {
      this->collectBricks(std::move(root));
    }
    struct Marks
    {
      std::vector<std::pair<Index3, int>> blocks;
    };
    std::vector<Marks> marks(bricks_.size());
    parallelFor(bricks_.size(), 1,
      [&](std::size_t begin, std::size_t end)
      {
        progress_.check();
        for (std::size_t k = begin; k < end; ++k)
        {
          this->markBlock(bricks_[k], marks[k].blocks);
        }
      });
    CellSet cells;
    for (const Marks& part : marks)
    {
      for (const auto& [low, side] : part.blocks)
      {
        cells.insertBlock(low, side);
      }
    }
    cells.sort();
    return cells;
  }

private:
  Block rootBlock() const
  {
    Box3 bounds;
    for (const MarkTerm& term : terms_)
    {
      const Box3 box = term.node->influenceBounds();
      if (!box.isEmpty())
      {
        bounds.extend(box);
      }
    }
    Block root;
    root.side = 0;
    if (bounds.isEmpty())
    {
      return root;
    }
    // Checks that cells can be counted.
    Lattice::covering(bounds, grid_.cellSize);
    const Index3 last = grid_.cellAt(bounds.max());
    const Index3 brick = brickOf(grid_.cellAt(bounds.min()));
    root.side = kBrickSide;
    for (int axis = 0; axis < 3; ++axis)
    {
      root.low[axis] = kBrickSide * brick[axis];
      while (root.low[axis] + root.side <= last[axis])
      {
        root.side *= 2;
      }
    }
    for (std::size_t k = 0; k < terms_.size(); ++k)
    {
      const Node* node = terms_[k].node;
      root.reach.push_back({ static_cast<int>(k), false, FieldSourcePtr(FieldSourcePtr(), node) });
    }
    return root;
  }

  Box3 boxOf(const Block& block, double margin) const
  {
    return grid_.boxOf(block.low, static_cast<double>(block.side), margin);
  }

  enum class Answer
  {
    None, ///< nothing to mark
    Open,
    All
  };

  /// Asks the terms anew for a block, and drops those that do not reach it.
  Answer look(Block& block) const
  {
    const bool forSurface = block.side >= kSurfaceBlock;
    const Box3 box = this->boxOf(block, forSurface ? kSurfaceMargin : 0.0);
    std::vector<int> possible;
    std::vector<int> certain;
    std::vector<Interval> ranges;
    std::vector<Reach> left;
    bool surface = !forSurface;
    for (Reach& reach : block.reach)
    {
      if (!forSurface && reach.certain)
      {
        possible.push_back(reach.term);
        certain.push_back(reach.term);
        left.push_back(reach);
        continue;
      }
      const Interval range = reach.source->range(box);
      if (range.min == 0.0 && range.max == 0.0)
      {
        continue;
      }
      reach.certain = range.min > 0.0 || range.max < 0.0;
      possible.push_back(reach.term);
      const double weight = terms_[reach.term].weight;
      ranges.push_back({ weight * range.min, weight * range.max });
      if (reach.certain)
      {
        certain.push_back(reach.term);
      }
      surface = surface || (terms_[reach.term].kept && Marker::crosses(range));
      left.push_back(reach);
    }
    block.reach = std::move(left);
    if (!interaction_.marks(terms_, possible))
    {
      return Answer::None;
    }
    if (!surface && !Marker::crosses(interaction_.range(possible, ranges)))
    {
      return Answer::None;
    }
    return interaction_.marks(terms_, certain) ? Answer::All : Answer::Open;
  }

  static bool crosses(const Interval& range)
  {
    return range.min <= kThreshold + kRangeSlack && range.max >= kThreshold - kRangeSlack;
  }

  template <typename Body>
  void forEachChild(const Block& block, Body&& body) const
  {
    for (int n = 0; n < 8; ++n)
    {
      Block child;
      child.side = block.side / 2;
      child.low = block.low;
      for (int axis = 0; axis < 3; ++axis)
      {
        child.low[axis] += (n >> axis & 1) != 0 ? child.side : 0;
      }
      child.reach = block.reach;
      body(std::move(child));
    }
  }

  void collectBricks(Block block)
  {
    if (this->look(block) == Answer::None)
    {
      return;
    }
    this->narrow(block);
    if (block.side == kBrickSide)
    {
      bricks_.push_back(std::move(block));
      const auto count = static_cast<double>(bricks_.size());
      budget_.check(count * kBytesPerBrick, count * kBrickPoints);
      return;
    }
    progress_.check();
    this->forEachChild(block, [&](Block child) { this->collectBricks(std::move(child)); });
  }

  /// Specialises the terms to a block.
  void narrow(Block& block)
  {
    const Box3 box = this->boxOf(block, kSurfaceMargin);
    std::vector<Reach> left;
    for (Reach& reach : block.reach)
    {
      FieldSourcePtr source = reach.source->restrictedTo(box);
      if (source)
      {
        if (source != reach.source)
        {
          ancestors_.push_back(std::move(reach.source));
        }
        left.push_back({ reach.term, reach.certain, std::move(source) });
      }
    }
    block.reach = std::move(left);
  }

  void markBlock(Block block, std::vector<std::pair<Index3, int>>& marks) const
  {
    // A brick was looked at when it was found.
    const Answer answer = block.side == kBrickSide ? Answer::Open : this->look(block);
    if (answer == Answer::None)
    {
      return;
    }
    if (block.side == 1 || (answer == Answer::All && block.side <= kSurfaceBlock))
    {
      marks.emplace_back(block.low, static_cast<int>(block.side));
      return;
    }
    this->forEachChild(block, [&](Block child) { this->markBlock(std::move(child), marks); });
  }

  const std::vector<MarkTerm>& terms_;
  const Interaction& interaction_;
  const CellGrid grid_;
  const MemoryBudget& budget_;
  const Progress& progress_;
  std::vector<Block> bricks_;
  std::vector<FieldSourcePtr> ancestors_; ///< sources that those of the bricks may refer to
};

} // namespace

CellSet markedCells(const std::vector<MarkTerm>& terms, const Interaction& interaction,
  const CellGrid& grid, const MemoryBudget& budget, const Progress& progress)
{
  return Marker(terms, interaction, grid, budget, progress).run();
}

} // namespace hybridtree

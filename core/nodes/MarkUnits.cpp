// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/MarkUnits.h"

#include <utility>

namespace hybridtree
{
namespace
{

/// Two units or larger blocks a side cover all; side 0: there is nothing.
MarkBlock rootBlock(const std::vector<MarkTerm>& terms, const CellGrid& grid)
{
  Box3 bounds;
  MarkBlock root;
  root.side = 0;
  for (std::size_t k = 0; k < terms.size(); ++k)
  {
    const Box3 box = terms[k].node->influenceBounds();
    if (!box.isEmpty())
    {
      bounds.extend(box);
      root.reach.push_back({ static_cast<int>(k), false, nullptr });
    }
  }
  if (bounds.isEmpty())
  {
    return root;
  }
  // Checks that cells can be counted.
  Lattice::covering(bounds, grid.cellSize);
  const Index3 first = grid.cellAt(bounds.min());
  const Index3 last = grid.cellAt(bounds.max());
  root.side = kUnit;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto from = [&] { return first[axis] & -root.side; };
    while (from() + 2 * root.side <= last[axis])
    {
      root.side *= 2;
    }
  }
  // Two a side cover the bounds: their block, which need not be at a multiple.
  for (int axis = 0; axis < 3; ++axis)
  {
    root.low[axis] = first[axis] & -root.side;
  }
  root.side *= 2;
  return root;
}

class UnitCollector
{
public:
  UnitCollector(const std::vector<MarkTerm>& terms, const Interaction& interaction,
    const CellGrid& grid, const std::function<void(std::size_t)>& check)
    : terms_(terms), interaction_(interaction), grid_(grid), check_(check)
  {
    for (const MarkTerm& term : terms)
    {
      boxes_.push_back(term.node->influenceBounds());
    }
  }

  void collect(MarkBlock block)
  {
    const Box3 box = grid_.boxOf(block.low, static_cast<double>(block.side), kSurfaceMargin);
    std::vector<int> present;
    std::vector<MarkReach> left;
    for (const MarkReach& reach : block.reach)
    {
      if (box.intersects(boxes_[static_cast<std::size_t>(reach.term)]))
      {
        present.push_back(reach.term);
        left.push_back(reach);
      }
    }
    if (!interaction_.marks(terms_, present))
    {
      return;
    }
    block.reach = std::move(left);
    if (block.side == kUnit)
    {
      units_.push_back(std::move(block));
      check_(units_.size());
      return;
    }
    check_(units_.size());
    for (int n = 0; n < 8; ++n)
    {
      MarkBlock child;
      setChild(block, n, child);
      this->collect(std::move(child));
    }
  }

  std::vector<MarkBlock> units() && { return std::move(units_); }

private:
  const std::vector<MarkTerm>& terms_;
  const Interaction& interaction_;
  const CellGrid& grid_;
  const std::function<void(std::size_t)>& check_;
  std::vector<Box3> boxes_; ///< of influence
  std::vector<MarkBlock> units_;
};

} // namespace

void setChild(const MarkBlock& block, int n, MarkBlock& child)
{
  child.side = block.side / 2;
  child.low = block.low;
  for (int axis = 0; axis < 3; ++axis)
  {
    child.low[axis] += (n >> axis & 1) != 0 ? child.side : 0;
  }
  child.reach = block.reach;
}

std::vector<MarkBlock> markUnits(const std::vector<MarkTerm>& terms, const Interaction& interaction,
  const CellGrid& grid, const std::function<void(std::size_t)>& check)
{
  MarkBlock root = rootBlock(terms, grid);
  UnitCollector collector(terms, interaction, grid, check);
  if (root.side > 0)
  {
    collector.collect(std::move(root));
  }
  return std::move(collector).units();
}

} // namespace hybridtree

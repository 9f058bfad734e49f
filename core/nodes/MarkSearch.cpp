// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/MarkSearch.h"

#include <algorithm>
#include <utility>

namespace hybridtree
{
namespace
{

// Blocks of this many cells are looked at or left out. Each share of them is a lattice with all
// sides alike, so that it is even over planes, too, and it is part of all larger shares.
constexpr std::int64_t kSampledBlock = 4;
constexpr std::int64_t kStepY = 499;
constexpr std::int64_t kStepZ = 425;
constexpr std::size_t kLevelInBricks = 2; // of blocks below the unit

// A surface is looked for down to blocks of this many cells.
constexpr int kSurfaceBlock = 2;

// How far off T the field must be to tell that no surface is there.
constexpr double kRangeSlack = 1e-9;

bool crosses(const Interval& range)
{
  return range.min <= kThreshold + kRangeSlack && range.max >= kThreshold - kRangeSlack;
}

Box3 boxOf(const CellGrid& grid, const MarkBlock& block, double margin)
{
  return grid.boxOf(block.low, static_cast<double>(block.side), margin);
}

} // namespace

void MarkSearch::run(const MarkField& field, std::int64_t share, MarkCount& count)
{
  field_ = &field;
  earlierShare_ = share_;
  share_ = share;
  if (earlierShare_ == 0)
  {
    for (MarkReach& reach : unit_.reach)
    {
      reach.source = field.terms[reach.term].node;
    }
    // Those that are quick to ask first.
    std::stable_partition(unit_.reach.begin(), unit_.reach.end(),
      [&](const MarkReach& reach) { return !field.terms[reach.term].node->isFaceted(); });
    this->markBlock(unit_, 0, count);
    return;
  }
  for (const MarkBlock& brick : bricks_)
  {
    this->markChildren(brick, kLevelInBricks, count);
  }
}

/// Whether it is in the share that is looked at, and was not before.
bool MarkSearch::isDue(const MarkBlock& block) const
{
  const std::int64_t place =
    (block.low[0] + kStepY * block.low[1] + kStepZ * block.low[2]) / kSampledBlock;
  const auto isIn = [&](std::int64_t share) { return (place & (share - 1)) == 0; };
  return isIn(share_) && (earlierShare_ == 0 || !isIn(earlierShare_));
}

/// Asks the terms anew for a block, and drops those that do not reach it. Those that do are
/// narrowed to large blocks.
MarkSearch::Answer MarkSearch::look(MarkBlock& block)
{
  const auto& [terms, interaction, grid] = *field_;
  const Box3 box = boxOf(grid, block, kSurfaceMargin);
  possible_.clear();
  certain_.clear();
  ranges_.clear();
  std::size_t left = 0;
  bool surface = false;
  bool dropped = false;
  for (std::size_t k = 0; k < block.reach.size(); ++k)
  {
    MarkReach reach = block.reach[k];
    const MarkTerm& term = terms[reach.term];
    if (dropped && !this->mayMark(block, k))
    {
      return Answer::None; // whatever the others say
    }
    if (block.side >= kBrickSide && !this->narrow(reach, box))
    {
      dropped = true;
      continue;
    }
    const Interval range = reach.source->range(box);
    if (range.min == 0.0 && range.max == 0.0)
    {
      dropped = true;
      continue;
    }
    reach.certain = range.min > 0.0 || range.max < 0.0;
    ranges_.push_back({ term.weight * range.min, term.weight * range.max });
    surface = surface || (term.kept && crosses(range));
    possible_.push_back(reach.term);
    if (reach.certain)
    {
      certain_.push_back(reach.term);
    }
    block.reach[left++] = reach;
  }
  block.reach.resize(left);
  if (!interaction.marks(terms, possible_))
  {
    return Answer::None;
  }
  if (!surface && !crosses(interaction.range(possible_, ranges_)))
  {
    return Answer::None;
  }
  return interaction.marks(terms, certain_) ? Answer::All : Answer::Open;
}

/// \return whether the term is there at all.
bool MarkSearch::narrow(MarkReach& reach, const Box3& box)
{
  FieldSourcePtr source = reach.source->restrictedTo(box);
  reach.source = source.get();
  sources_.push_back(std::move(source));
  return reach.source != nullptr;
}

/// Whether a cell is marked, as far as the ranges of the terms tell. A surface is near.
bool MarkSearch::marksCell(const MarkBlock& cell)
{
  const auto& [terms, interaction, grid] = *field_;
  const auto mayBeThere = [](const MarkReach& reach, const Box3& box)
  {
    const Interval range = reach.source->range(box);
    return range.min != 0.0 || range.max != 0.0;
  };
  possible_.clear();
  for (const MarkReach& reach : cell.reach)
  {
    if (reach.certain)
    {
      possible_.push_back(reach.term);
    }
  }
  const Box3 box = boxOf(grid, cell, 0.0);
  bool marks = interaction.marks(terms, possible_);
  for (std::size_t k = 0; k < cell.reach.size() && !marks; ++k)
  {
    const MarkReach& reach = cell.reach[k];
    if (!reach.certain && mayBeThere(reach, box))
    {
      possible_.push_back(reach.term);
      marks = interaction.marks(terms, possible_);
    }
  }
  return marks;
}

/// With the terms found so far, and all from number `next` on.
bool MarkSearch::mayMark(const MarkBlock& block, std::size_t next)
{
  const std::size_t found = possible_.size();
  for (std::size_t k = next; k < block.reach.size(); ++k)
  {
    possible_.push_back(block.reach[k].term);
  }
  const bool may = field_->interaction.marks(field_->terms, possible_);
  possible_.resize(found);
  return may;
}

/// \param level of its children.
void MarkSearch::markBlock(MarkBlock& block, std::size_t level, MarkCount& count)
{
  if (count.areTooMany())
  {
    return;
  }
  Answer answer = Answer::All;
  if (block.side >= kSurfaceBlock)
  {
    answer = this->look(block);
  }
  else if (!this->marksCell(block))
  {
    answer = Answer::None;
  }
  if (answer == Answer::None)
  {
    return;
  }
  if (answer == Answer::All && block.side <= kSurfaceBlock)
  {
    cells_.insertBlock(block.low, static_cast<int>(block.side));
    count.found += static_cast<std::size_t>(block.side * block.side * block.side);
    return;
  }
  if (block.side == kBrickSide && share_ > 1)
  {
    bricks_.push_back(block);
  }
  this->markChildren(block, level, count);
}

void MarkSearch::markChildren(const MarkBlock& block, std::size_t level, MarkCount& count)
{
  MarkBlock& child = blocks_[level];
  for (int n = 0; n < 8; ++n)
  {
    setChild(block, n, child);
    if (child.side != kSampledBlock || this->isDue(child))
    {
      this->markBlock(child, level + 1, count);
    }
  }
}

} // namespace hybridtree

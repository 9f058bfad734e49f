// SPDX-License-Identifier: BSD-3-Clause
#include "core/polygonize/BrickTree.h"

#include "core/base/Error.h"
#include "core/base/Parallel.h"

#include <algorithm>
#include <cmath>

namespace hybridtree
{
namespace
{

// Ranges are trusted to this much: two neighbouring blocks whose fields are T up to rounding on
// their common face cannot be pruned to different sides.
constexpr double kRangeSlack = 1e-9;

// Below this many blocks a level says little about how many bricks there will be in the end.
constexpr std::size_t kTellingBlocks = 4096;

constexpr std::size_t kBlocksPerTask = 4;

// Samples, a specialised source, and the part of the mesh that a crossed brick makes on average.
constexpr double kBytesPerBrick = 12000.0;

std::int64_t brickOf(std::int64_t point)
{
  return point >= 0 ? point / kBrickSide : -((-point + kBrickSide - 1) / kBrickSide);
}

} // namespace

struct BrickTree::Block
{
  Index3 brick{};
  Content content = kOutside; ///< >= 0: may be crossed
  FieldSourcePtr source;      ///< of crossed blocks
};

BrickTree::BrickTree(const FieldSource& field, const Lattice& lattice, const MemoryBudget& budget,
  const Progress& progress)
  : field_(field), lattice_(lattice), budget_(budget)
{
  std::int64_t bricks = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    // One point more at the low end, so that the edges that leave the region have an owner.
    first_[axis] = brickOf(lattice.low[axis] - 1);
    last_[axis] = brickOf(lattice.high[axis]);
    bricks = std::max(bricks, last_[axis] - first_[axis] + 1);
  }
  while ((std::int64_t(1) << levels_) < bricks)
  {
    ++levels_;
  }
  std::int64_t side = std::int64_t(1) << levels_;
  Blocks blocks{ this->classify(first_, side, field) };
  root_ = blocks.front().content;
  for (int level = 0;; ++level)
  {
    blocks.erase(std::remove_if(blocks.begin(), blocks.end(),
                   [](const Block& block) { return block.content < 0; }),
      blocks.end());
    this->checkSize(blocks.size(), levels_ - level);
    progress.report(static_cast<double>(level) / (levels_ + 1));
    if (side == 1 || blocks.empty())
    {
      break;
    }
    side /= 2;
    Blocks children = this->halve(blocks, side, progress);
    this->link(children, side == 1);
    for (Block& block : blocks)
    {
      ancestors_.push_back(std::move(block.source));
    }
    blocks = std::move(children);
  }
  leaves_.reserve(blocks.size());
  for (Block& block : blocks)
  {
    leaves_.push_back({ block.brick, std::move(block.source) });
  }
}

BrickTree::Block BrickTree::classify(
  const Index3& brick, std::int64_t side, const FieldSource& source) const
{
  Block block;
  block.brick = brick;
  bool covered = true; // the region covers the block's closed box
  for (int axis = 0; axis < 3; ++axis)
  {
    if (brick[axis] > last_[axis])
    {
      return block;
    }
    covered = covered && brick[axis] * kBrickSide > lattice_.low[axis] &&
      (brick[axis] + side) * kBrickSide <= lattice_.high[axis];
  }
  const Box3 box = this->boxOf(brick, side);
  const Interval range = source.range(box);
  if (range.max < kThreshold - kRangeSlack)
  {
    return block;
  }
  if (range.min > kThreshold + kRangeSlack && covered)
  {
    block.content = kInside;
    return block;
  }
  block.source = source.restrictedTo(box);
  block.content = block.source ? 0 : kOutside;
  return block;
}

BrickTree::Blocks BrickTree::halve(
  const Blocks& parents, std::int64_t side, const Progress& progress) const
{
  Blocks children(8 * parents.size());
  parallelFor(parents.size(), kBlocksPerTask,
    [&](std::size_t begin, std::size_t end)
    {
      for (std::size_t k = 8 * begin; k < 8 * end; ++k)
      {
        progress.check(); // a block may take long where thousands of leaves overlap
        Index3 brick = parents[k / 8].brick;
        for (int axis = 0; axis < 3; ++axis)
        {
          brick[axis] += (k >> axis & 1) != 0 ? side : 0;
        }
        children[k] = this->classify(brick, side, *parents[k / 8].source);
      }
    });
  return children;
}

/// The k-th crossed block of a level gets the k-th of its nodes, or the k-th leaf.
void BrickTree::link(const Blocks& children, bool areLeaves)
{
  const std::size_t parent = nodes_.size();
  nodes_.resize(parent + children.size() / 8);
  auto next = static_cast<Content>(areLeaves ? 0 : nodes_.size());
  for (std::size_t k = 0; k < children.size(); ++k)
  {
    const Content content = children[k].content;
    nodes_[parent + k / 8][k % 8] = content < 0 ? content : next++;
  }
}

void BrickTree::checkSize(std::size_t blocks, int levelsLeft) const
{
  // A surface has four times the blocks on the next level; divided by 8 for thin and loose cases.
  const double foreseen = blocks < kTellingBlocks
    ? static_cast<double>(blocks)
    : std::max(
        static_cast<double>(blocks), std::ldexp(static_cast<double>(blocks), 2 * levelsLeft - 3));
  budget_.check(foreseen * kBytesPerBrick, foreseen * kBrickSide * kBrickSide * kBrickSide);
}

bool BrickTree::reaches(const Index3& brick) const
{
  bool inside = true;
  for (int axis = 0; axis < 3; ++axis)
  {
    inside = inside && first_[axis] <= brick[axis] && brick[axis] <= last_[axis];
  }
  return inside;
}

Box3 BrickTree::boxOf(const Index3& brick, std::int64_t side) const
{
  Box3 box;
  for (int axis = 0; axis < 3; ++axis)
  {
    box.min()[axis] = lattice_.origin[axis] + lattice_.coordinate(brick[axis] * kBrickSide);
    box.max()[axis] =
      lattice_.origin[axis] + lattice_.coordinate((brick[axis] + side) * kBrickSide);
  }
  return box;
}

unsigned BrickTree::octant(const Index3& brick, int level) const
{
  unsigned child = 0;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::int64_t offset = brick[axis] - first_[axis];
    child |= static_cast<unsigned>(offset >> (levels_ - 1 - level) & 1) << axis;
  }
  return child;
}

BrickTree::Content BrickTree::find(const Index3& brick) const
{
  if (!this->reaches(brick))
  {
    return kOutside;
  }
  Content content = root_;
  for (int level = 0; level < levels_ && content >= 0; ++level)
  {
    content = nodes_[static_cast<std::size_t>(content)][this->octant(brick, level)];
  }
  return content;
}

void BrickTree::open(const Index3& brick)
{
  if (!this->reaches(brick))
  {
    return;
  }
  // Position of the entry rather than its address: making nodes moves them.
  const auto entry = [this](std::ptrdiff_t node, unsigned child) -> Content&
  { return node < 0 ? root_ : nodes_[static_cast<std::size_t>(node)][child]; };
  std::ptrdiff_t node = -1;
  unsigned child = 0;
  for (int level = 0; level < levels_; ++level)
  {
    const Content content = entry(node, child);
    if (content < 0)
    {
      nodes_.emplace_back().fill(content);
      entry(node, child) = static_cast<Content>(nodes_.size() - 1);
    }
    node = entry(node, child);
    child = this->octant(brick, level);
  }
  if (entry(node, child) < 0)
  {
    entry(node, child) = static_cast<Content>(leaves_.size());
    // Not restricted: what pruned the brick is in doubt.
    leaves_.push_back({ brick, FieldSourcePtr(FieldSourcePtr(), &field_) });
  }
}

} // namespace hybridtree

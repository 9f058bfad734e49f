// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/MarkedCells.h"

#include "core/base/Parallel.h"
#include "core/nodes/MarkBlock.h"
#include "core/nodes/MarkMemory.h"
#include "core/nodes/NearDependencies.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr double kBytesPerBrick = 20000.0;

// Cells along the side of what is marked, and remembered, as one.
constexpr std::int64_t kUnit = 4 * kBrickSide;
static_assert(kUnit >> MarkSearch::kLevels == 1, "a unit is halved down to cells");

// Where the search may end early, some blocks of this many cells are looked at first, one in eight
// or less: the count is the more certain the more cells are counted, and where so many are that
// there are too many in all, not even as many as allowed are looked for.
constexpr std::int64_t kSampledBlock = 4;
constexpr std::int64_t kLargestShare = 8; // one in so many
constexpr std::int64_t kLeastShare = 512;
constexpr double kTellingCells = 200.0;
constexpr double kFarTooMany = 1.2; // times as many

// A surface is looked for down to blocks of this many cells, and a bit beyond: meshes are off the
// surfaces they stand for.
constexpr int kSurfaceBlock = 2;
constexpr double kSurfaceMargin = 0.5; // cells

// All that is asked in a unit lies in it or less than this beyond.
constexpr double kMargin = 1.0; // cells
static_assert(kMargin > kSurfaceMargin);

// How far off T the field must be to tell that no surface is there.
constexpr double kRangeSlack = 1e-9;

class Marker
{
public:
  Marker(const std::vector<MarkTerm>& terms, const Interaction& interaction, const CellGrid& grid,
    const MemoryBudget& budget, std::size_t mostCells, const Progress& progress)
    : terms_(terms)
    , interaction_(interaction)
    , grid_(grid)
    , budget_(budget)
    , mostCells_(mostCells)
    , progress_(progress)
  {
  }

  std::optional<CellSet> run()
  {
    this->findUnits();
    std::vector<std::shared_ptr<const UnitMarks>> marks(units_.size());
    this->forEachUnit([&](std::size_t k) { marks[k] = this->marksOf(std::move(units_[k])); });
    if (this->areTooMany())
    {
      return std::nullopt;
    }
    CellSet cells;
    for (const auto& unit : marks)
    {
      for (const CellSet::Brick& brick : *unit)
      {
        cells.insertBrick(brick);
      }
    }
    cells.sort();
    return cells;
  }

  /// That it ends as soon as what was found suffices does not change the answer.
  bool seemFarTooMany()
  {
    const double farTooMany = kFarTooMany * static_cast<double>(mostCells_);
    share_ = kLargestShare;
    while (share_ < kLeastShare && farTooMany > 2.0 * kTellingCells * static_cast<double>(share_))
    {
      share_ *= 2;
    }
    mostCells_ = static_cast<std::size_t>(farTooMany / static_cast<double>(share_));
    this->findUnits();
    this->forEachUnit([&](std::size_t k) { this->sample(std::move(units_[k])); });
    return this->areTooMany();
  }

private:
  void findUnits()
  {
    MarkBlock root = this->rootBlock();
    if (root.side > 0)
    {
      this->collectUnits(std::move(root));
    }
  }

  /// Blocks are at multiples of their side: a unit is the same wherever the terms begin and end.
  MarkBlock rootBlock() const
  {
    Box3 bounds;
    MarkBlock root;
    root.side = 0;
    for (std::size_t k = 0; k < terms_.size(); ++k)
    {
      const Box3 box = terms_[k].node->influenceBounds();
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
    Lattice::covering(bounds, grid_.cellSize);
    const Index3 first = grid_.cellAt(bounds.min());
    const Index3 last = grid_.cellAt(bounds.max());
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

  /// By influence boxes alone.
  void collectUnits(MarkBlock block)
  {
    const Box3 box = this->boxOf(block, kSurfaceMargin);
    std::vector<int> present;
    std::vector<MarkReach> left;
    for (const MarkReach& reach : block.reach)
    {
      if (box.intersects(terms_[reach.term].node->influenceBounds()))
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
      this->checkBudget(units_.size());
      return;
    }
    progress_.check();
    for (int n = 0; n < 8; ++n)
    {
      MarkBlock child;
      Marker::setChild(block, n, child);
      this->collectUnits(std::move(child));
    }
  }

  template <typename Body>
  void forEachUnit(Body&& body)
  {
    parallelFor(units_.size(), 1,
      [&](std::size_t begin, std::size_t end)
      {
        for (std::size_t k = begin; k < end; ++k)
        {
          progress_.check();
          body(k);
        }
      });
  }

  void sample(MarkBlock unit)
  {
    if (this->areTooMany())
    {
      return;
    }
    const UnitKey key = this->keyOf(unit);
    if (const std::shared_ptr<const std::size_t> known = sampledCounts().find(key))
    {
      count_ += *known;
      return;
    }
    MarkSearch search;
    this->markUnit(unit, search);
    if (!this->areTooMany())
    {
      sampledCounts().keep(key, std::make_shared<const std::size_t>(search.cells.size()),
        sizeof key + key.terms.size() * sizeof(Dependency));
    }
  }

  /// Evenly over planes, too: the blocks of a share are a lattice with all sides alike.
  bool isSampled(const MarkBlock& block) const
  {
    const std::int64_t second = 1 + 2 * (share_ * 39 / 200);
    const std::int64_t third = 1 + 2 * (share_ * 8 / 25);
    const std::int64_t place = block.low[0] + second * block.low[1] + third * block.low[2];
    return place / kSampledBlock % share_ == 0;
  }

  void checkBudget(std::size_t bricks) const
  {
    const auto count = static_cast<double>(bricks);
    budget_.check(count * kBytesPerBrick, count * kBrickPoints);
  }

  UnitKey keyOf(const MarkBlock& unit) const
  {
    NearDependencies near({ this->boxOf(unit, kMargin) }, NearDependencies::Leaves::Nameless);
    for (const MarkReach& reach : unit.reach)
    {
      const MarkTerm& term = terms_[reach.term];
      const int flags =
        (term.kept ? 1 : 0) + (term.node->isNegative() ? 2 : 0) + (term.node->isFaceted() ? 4 : 0);
      near.addNumber(term.weight, flags);
      near.add(*term.node, 0);
    }
    return { grid_, unit.low, interaction_.kind(), share_, near.take() };
  }

  std::shared_ptr<const UnitMarks> marksOf(MarkBlock unit)
  {
    const UnitKey key = this->keyOf(unit);
    std::shared_ptr<const UnitMarks> marks = unitMarks().find(key);
    if (!marks)
    {
      MarkSearch search;
      this->markUnit(unit, search);
      if (this->areTooMany())
      {
        return nullptr;
      }
      marks = std::make_shared<const UnitMarks>(search.cells.bricks());
      unitMarks().keep(key, marks,
        sizeof key + key.terms.size() * sizeof(Dependency) +
          marks->size() * sizeof(CellSet::Brick));
    }
    else
    {
      for (const CellSet::Brick& brick : *marks)
      {
        count_ += brick.size();
      }
    }
    this->checkBudget(bricks_ += marks->size());
    return marks;
  }

  Box3 boxOf(const MarkBlock& block, double margin) const
  {
    return grid_.boxOf(block.low, static_cast<double>(block.side), margin);
  }

  enum class Answer
  {
    None, ///< nothing to mark
    Open,
    All
  };

  /// Asks the terms anew for a block, and drops those that do not reach it. Those that do are
  /// narrowed to large blocks.
  Answer look(MarkBlock& block, MarkSearch& search) const
  {
    const Box3 box = this->boxOf(block, kSurfaceMargin);
    search.possible.clear();
    search.certain.clear();
    search.ranges.clear();
    std::size_t left = 0;
    bool surface = false;
    bool dropped = false;
    for (std::size_t k = 0; k < block.reach.size(); ++k)
    {
      MarkReach reach = block.reach[k];
      const MarkTerm& term = terms_[reach.term];
      if (dropped && term.node->isFaceted() && !this->mayMark(search.possible, block, k))
      {
        return Answer::None; // whatever the meshes say, which takes long
      }
      if (block.side >= kBrickSide && !Marker::narrow(reach, box, search))
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
      search.ranges.push_back({ term.weight * range.min, term.weight * range.max });
      surface = surface || (term.kept && Marker::crosses(range));
      search.possible.push_back(reach.term);
      if (reach.certain)
      {
        search.certain.push_back(reach.term);
      }
      block.reach[left++] = reach;
    }
    block.reach.resize(left);
    if (!interaction_.marks(terms_, search.possible))
    {
      return Answer::None;
    }
    if (!surface && !Marker::crosses(interaction_.range(search.possible, search.ranges)))
    {
      return Answer::None;
    }
    return interaction_.marks(terms_, search.certain) ? Answer::All : Answer::Open;
  }

  /// \return whether the term is there at all.
  static bool narrow(MarkReach& reach, const Box3& box, MarkSearch& search)
  {
    FieldSourcePtr source = reach.source->restrictedTo(box);
    reach.source = source.get();
    search.sources.push_back(std::move(source));
    return reach.source != nullptr;
  }

  /// Whether a cell is marked, as far as the ranges of the terms tell. A surface is near.
  bool marksCell(const MarkBlock& cell, MarkSearch& search) const
  {
    search.possible.clear();
    for (const MarkReach& reach : cell.reach)
    {
      if (reach.certain)
      {
        search.possible.push_back(reach.term);
      }
    }
    const Box3 box = this->boxOf(cell, 0.0);
    bool marks = interaction_.marks(terms_, search.possible);
    for (std::size_t k = 0; k < cell.reach.size() && !marks; ++k)
    {
      const MarkReach& reach = cell.reach[k];
      if (!reach.certain && this->mayBeThere(reach, box))
      {
        search.possible.push_back(reach.term);
        marks = interaction_.marks(terms_, search.possible);
      }
    }
    return marks;
  }

  static bool mayBeThere(const MarkReach& reach, const Box3& box)
  {
    const Interval range = reach.source->range(box);
    return range.min != 0.0 || range.max != 0.0;
  }

  /// With all terms from number `next` on.
  bool mayMark(std::vector<int> present, const MarkBlock& block, std::size_t next) const
  {
    for (std::size_t k = next; k < block.reach.size(); ++k)
    {
      present.push_back(block.reach[k].term);
    }
    return interaction_.marks(terms_, present);
  }

  static bool crosses(const Interval& range)
  {
    return range.min <= kThreshold + kRangeSlack && range.max >= kThreshold - kRangeSlack;
  }

  static void setChild(const MarkBlock& block, int n, MarkBlock& child)
  {
    child.side = block.side / 2;
    child.low = block.low;
    for (int axis = 0; axis < 3; ++axis)
    {
      child.low[axis] += (n >> axis & 1) != 0 ? child.side : 0;
    }
    child.reach = block.reach;
  }

  bool areTooMany() const { return count_ > mostCells_; }

  /// Those that are quick to ask first.
  void markUnit(MarkBlock& unit, MarkSearch& search)
  {
    for (MarkReach& reach : unit.reach)
    {
      reach.source = terms_[reach.term].node;
    }
    std::stable_partition(unit.reach.begin(), unit.reach.end(),
      [&](const MarkReach& reach) { return !terms_[reach.term].node->isFaceted(); });
    this->markBlock(unit, search, 0);
  }

  /// \param level of its children.
  void markBlock(MarkBlock& block, MarkSearch& search, std::size_t level)
  {
    if (this->areTooMany() ||
      (share_ > 1 && block.side == kSampledBlock && !this->isSampled(block)))
    {
      return;
    }
    Answer answer = Answer::All;
    if (block.side >= kSurfaceBlock)
    {
      answer = this->look(block, search);
    }
    else if (!this->marksCell(block, search))
    {
      answer = Answer::None;
    }
    if (answer == Answer::None)
    {
      return;
    }
    if (answer == Answer::All && block.side <= kSurfaceBlock)
    {
      search.cells.insertBlock(block.low, static_cast<int>(block.side));
      count_ += static_cast<std::size_t>(block.side * block.side * block.side);
      return;
    }
    MarkBlock& child = search.blocks[level];
    for (int n = 0; n < 8; ++n)
    {
      Marker::setChild(block, n, child);
      this->markBlock(child, search, level + 1);
    }
  }

  const std::vector<MarkTerm>& terms_;
  const Interaction& interaction_;
  const CellGrid grid_;
  const MemoryBudget& budget_;
  std::size_t mostCells_;
  std::int64_t share_ = 1; ///< of the blocks, one in so many is looked at
  const Progress& progress_;
  std::vector<MarkBlock> units_;
  std::atomic<std::size_t> count_{ 0 }; ///< of cells
  std::atomic<std::size_t> bricks_{ 0 };
};

} // namespace

std::optional<CellSet> markedCells(const std::vector<MarkTerm>& terms,
  const Interaction& interaction, const CellGrid& grid, const MemoryBudget& budget,
  std::size_t mostCells, const Progress& progress)
{
  return Marker(terms, interaction, grid, budget, mostCells, progress).run();
}

bool seemFarMoreMarked(const std::vector<MarkTerm>& terms, const Interaction& interaction,
  const CellGrid& grid, const MemoryBudget& budget, std::size_t mostCells, const Progress& progress)
{
  return Marker(terms, interaction, grid, budget, mostCells, progress).seemFarTooMany();
}

void forgetMarks()
{
  unitMarks().clear();
  sampledCounts().clear();
}

} // namespace hybridtree

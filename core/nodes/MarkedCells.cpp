// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/MarkedCells.h"

#include "core/base/Parallel.h"
#include "core/nodes/MarkMemory.h"
#include "core/nodes/MarkSearch.h"
#include "core/nodes/NearDependencies.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace hybridtree
{
namespace
{

constexpr double kBytesPerBrick = 20000.0;

// A sample begins with one block in so many, or fewer where that many cells tell.
constexpr std::int64_t kLargestShare = 8;
constexpr double kTellingCells = 200.0;

// The number of marked cells is the more certain the more are found. They come a block at a time:
// the relative error is about the square root of this over what was found.
constexpr double kCellsTogether = 12.0;
constexpr double kCertain = 0.2;

// All that is asked in a unit lies in it or less than this beyond.
constexpr double kMargin = 1.0; // cells
static_assert(kMargin > kSurfaceMargin);

double uncertainty(double found)
{
  return std::sqrt(kCellsTogether / (found + 1.0));
}

/// So many found cells surely stand for more than those expected.
double surelyMoreThan(double expected)
{
  double found = expected;
  for (int step = 0; step < 4; ++step)
  {
    found = expected * (1.0 + uncertainty(found));
  }
  return found;
}

} // namespace

class CellMarker::Units
{
public:
  Units(const std::vector<MarkTerm>& terms, const Interaction& interaction, const CellGrid& grid,
    const MemoryBudget& budget, const Progress& progress)
    : terms_(terms), interaction_(interaction), grid_(grid), budget_(budget), progress_(progress)
  {
  }

  std::optional<CellSet> mark(std::size_t most)
  {
    this->begin(most);
    std::vector<std::shared_ptr<const UnitMarks>> marks(units_.size());
    std::atomic<std::size_t> bricks{ 0 };
    this->forEachUnit(
      [&](Unit& unit, std::size_t k)
      {
        marks[k] = this->marksOf(unit);
        if (marks[k])
        {
          this->checkBudget(bricks += marks[k]->size());
        }
      });
    if (count_.areTooMany())
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

  bool seemMoreThan(std::size_t count)
  {
    const auto expected = static_cast<double>(count);
    std::int64_t share = kLargestShare;
    while (share < MarkSearch::kLeastShare &&
      expected > 2.0 * kTellingCells * static_cast<double>(share))
    {
      share *= 2;
    }
    for (; share > 1; share /= 2)
    {
      const double inShare = expected / static_cast<double>(share);
      this->begin(static_cast<std::size_t>(surelyMoreThan(inShare)));
      this->forEachUnit([&](Unit& unit, std::size_t) { this->sample(unit, share); });
      if (count_.areTooMany())
      {
        return true;
      }
      const auto found = static_cast<double>(count_.found);
      const double doubt = uncertainty(found);
      if (doubt < kCertain || found * (1.0 + doubt) < inShare)
      {
        return found > inShare;
      }
    }
    return false;
  }

private:
  struct Unit
  {
    MarkBlock block;
    std::unique_ptr<MarkSearch> search;
    std::int64_t share = 0; ///< of its blocks that the search has looked at
    std::vector<Dependency> dependencies;
  };

  /// That a search ends as soon as there are too many does not change that there are.
  void begin(std::size_t most)
  {
    if (!areFound_)
    {
      const auto check = [this](std::size_t units)
      {
        progress_.check();
        this->checkBudget(units);
      };
      for (MarkBlock& block : markUnits(terms_, interaction_, grid_, check))
      {
        units_.push_back({ std::move(block), nullptr, 0, {} });
      }
      areFound_ = true;
    }
    count_.found = 0;
    count_.most = most;
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
          body(units_[k], k);
        }
      });
  }

  void sample(Unit& unit, std::int64_t share)
  {
    if (count_.areTooMany())
    {
      return;
    }
    const UnitKey key = this->keyOf(unit, share);
    if (const std::shared_ptr<const std::size_t> known = sampledCounts().find(key))
    {
      count_.found += *known;
    }
    else if (this->search(unit, share))
    {
      sampledCounts().keep(key, std::make_shared<const std::size_t>(unit.search->cells().size()),
        sizeof key + key.terms.size() * sizeof(Dependency));
    }
  }

  /// \return nothing where there are too many.
  std::shared_ptr<const UnitMarks> marksOf(Unit& unit)
  {
    if (count_.areTooMany())
    {
      return nullptr;
    }
    const UnitKey key = this->keyOf(unit, 1);
    std::shared_ptr<const UnitMarks> marks = unitMarks().find(key);
    if (marks)
    {
      for (const CellSet::Brick& brick : *marks)
      {
        count_.found += brick.size();
      }
    }
    else if (this->search(unit, 1))
    {
      marks = std::make_shared<const UnitMarks>(unit.search->cells().bricks());
      unitMarks().keep(key, marks,
        sizeof key + key.terms.size() * sizeof(Dependency) +
          marks->size() * sizeof(CellSet::Brick));
    }
    unit.search.reset();
    unit.share = 0;
    return marks;
  }

  /// Brings the search in a unit to a share of its blocks.
  /// \return false where there are too many: then all that was found is dropped.
  bool search(Unit& unit, std::int64_t share)
  {
    if (!unit.search || unit.share < share)
    {
      unit.search = std::make_unique<MarkSearch>(unit.block);
      unit.share = 0;
    }
    count_.found += unit.search->cells().size();
    if (unit.share != share)
    {
      unit.search->run({ terms_, interaction_, grid_ }, share, count_);
      unit.share = share;
    }
    if (count_.areTooMany())
    {
      unit.search.reset();
      unit.share = 0;
      return false;
    }
    return true;
  }

  void checkBudget(std::size_t bricks) const
  {
    const auto count = static_cast<double>(bricks);
    budget_.check(count * kBytesPerBrick, count * kBrickPoints);
  }

  UnitKey keyOf(Unit& unit, std::int64_t share) const
  {
    if (unit.dependencies.empty())
    {
      const Box3 box = grid_.boxOf(unit.block.low, static_cast<double>(unit.block.side), kMargin);
      NearDependencies near({ box }, NearDependencies::Leaves::Nameless);
      for (const MarkReach& reach : unit.block.reach)
      {
        const MarkTerm& term = terms_[reach.term];
        const int flags = (term.kept ? 1 : 0) + (term.node->isNegative() ? 2 : 0) +
          (term.node->isFaceted() ? 4 : 0);
        near.addNumber(term.weight, flags);
        near.add(*term.node, 0);
      }
      unit.dependencies = near.take();
    }
    return { grid_, unit.block.low, interaction_.kind(), share, unit.dependencies };
  }

  const std::vector<MarkTerm>& terms_;
  const Interaction& interaction_;
  const CellGrid grid_;
  const MemoryBudget budget_;
  const Progress& progress_;
  std::vector<Unit> units_;
  bool areFound_ = false;
  MarkCount count_;
};

CellMarker::CellMarker(const std::vector<MarkTerm>& terms, const Interaction& interaction,
  const CellGrid& grid, const MemoryBudget& budget, const Progress& progress)
  : units_(std::make_unique<Units>(terms, interaction, grid, budget, progress))
{
}

CellMarker::~CellMarker() = default;

bool CellMarker::seemMoreThan(std::size_t count)
{
  return units_->seemMoreThan(count);
}

std::optional<CellSet> CellMarker::mark(std::size_t most)
{
  return units_->mark(most);
}

void forgetMarks()
{
  unitMarks().clear();
  sampledCounts().clear();
}

} // namespace hybridtree

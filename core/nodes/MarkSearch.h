// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/nodes/MarkUnits.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hybridtree
{

/// What is searched for marked cells.
struct MarkField
{
  const std::vector<MarkTerm>& terms;
  const Interaction& interaction;
  const CellGrid& grid;
};

/// How many cells have been found, by all threads, and how many may be.
struct MarkCount
{
  std::atomic<std::size_t> found{ 0 };
  std::size_t most = 0;

  bool areTooMany() const { return found > most; }
};

/// The marked cells of one unit: of all of it, or of a sample of its blocks, which may grow. Not
/// for several threads.
class MarkSearch
{
public:
  explicit MarkSearch(MarkBlock unit) : unit_(std::move(unit)) {}

  /// Looks at one block in `share`, those that were looked at before included. Ends early where
  /// there are too many: then what was found is worth nothing but to tell that.
  /// \param share a power of two, at most kLeastShare; not larger than in an earlier call.
  /// \param count grows by the cells found. Those found in earlier calls have to be in it.
  void run(const MarkField& field, std::int64_t share, MarkCount& count);

  /// In the order they were found.
  const CellSet& cells() const { return cells_; }

  /// One in so many blocks, at the least.
  static constexpr std::int64_t kLeastShare = 512;

private:
  enum class Answer
  {
    None, ///< nothing to mark
    Open,
    All
  };

  void markBlock(MarkBlock& block, std::size_t level, MarkCount& count);
  void markChildren(const MarkBlock& block, std::size_t level, MarkCount& count);
  bool isDue(const MarkBlock& block) const;
  Answer look(MarkBlock& block);
  bool narrow(MarkReach& reach, const Box3& box);
  bool marksCell(const MarkBlock& cell);
  bool mayMark(const MarkBlock& block, std::size_t next);

  static constexpr std::size_t kLevels = 5; ///< of halving a unit down to cells
  static_assert(kUnit >> kLevels == 1, "a unit is halved down to cells");

  const MarkField* field_ = nullptr; ///< of the call at hand
  MarkBlock unit_;
  std::int64_t share_ = 0;        ///< that is looked at; 0: nothing yet
  std::int64_t earlierShare_ = 0; ///< that was looked at before
  std::vector<MarkBlock> bricks_; ///< in which blocks may be left
  CellSet cells_;

  // So that nothing is allocated for a block:
  std::vector<FieldSourcePtr> sources_;   ///< that blocks refer to
  std::array<MarkBlock, kLevels> blocks_; ///< the one at hand on each level below the unit
  std::vector<int> possible_;             ///< terms that may not be 0
  std::vector<int> certain_;
  std::vector<Interval> ranges_;
};

} // namespace hybridtree

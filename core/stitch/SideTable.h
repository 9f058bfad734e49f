// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Triangles by their sides, from one point to another: a hash table in one array, since each step
/// through a triangulation asks it several times.
class SideTable
{
public:
  static constexpr std::int32_t kNone = -1;

  /// \param sides it grows beyond.
  explicit SideTable(std::size_t sides)
  {
    std::size_t slots = 16;
    while (slots < 2 * sides)
    {
      slots *= 2;
    }
    entries_.resize(slots);
  }

  /// kNone where there is none.
  std::int32_t find(std::int32_t from, std::int32_t to) const
  {
    return entries_[this->slotOf(keyOf(from, to))].triangle;
  }

  /// Replaces what was there.
  void put(std::int32_t from, std::int32_t to, std::int32_t triangle)
  {
    if (2 * (count_ + 1) > entries_.size())
    {
      this->grow();
    }
    const std::uint64_t key = keyOf(from, to);
    Entry& entry = entries_[this->slotOf(key)];
    count_ += entry.triangle == kNone ? 1 : 0;
    entry = { key, triangle };
  }

  void erase(std::int32_t from, std::int32_t to)
  {
    std::size_t hole = this->slotOf(keyOf(from, to));
    if (entries_[hole].triangle == kNone)
    {
      return;
    }
    --count_;
    // What follows moves up, where it may, so that no search ends too early.
    for (std::size_t k = this->next(hole); entries_[k].triangle != kNone; k = this->next(k))
    {
      const std::size_t mask = entries_.size() - 1;
      const std::size_t home = this->homeOf(entries_[k].key);
      if (((k - home) & mask) >= ((k - hole) & mask))
      {
        entries_[hole] = entries_[k];
        hole = k;
      }
    }
    entries_[hole] = {};
  }

private:
  struct Entry
  {
    std::uint64_t key = 0;
    std::int32_t triangle = kNone;
  };

  static std::uint64_t keyOf(std::int32_t from, std::int32_t to)
  {
    return static_cast<std::uint64_t>(static_cast<std::uint32_t>(from)) << 32 |
      static_cast<std::uint32_t>(to);
  }

  std::size_t homeOf(std::uint64_t key) const
  {
    return (key * 0x9e3779b97f4a7c15u >> 32) & (entries_.size() - 1);
  }
  std::size_t next(std::size_t slot) const { return (slot + 1) & (entries_.size() - 1); }

  /// Where a key is, or would be.
  std::size_t slotOf(std::uint64_t key) const
  {
    std::size_t slot = this->homeOf(key);
    while (entries_[slot].triangle != kNone && entries_[slot].key != key)
    {
      slot = this->next(slot);
    }
    return slot;
  }

  void grow()
  {
    std::vector<Entry> old(2 * entries_.size());
    old.swap(entries_);
    for (const Entry& entry : old)
    {
      if (entry.triangle != kNone)
      {
        entries_[this->slotOf(entry.key)] = entry;
      }
    }
  }

  std::vector<Entry> entries_; ///< a power of two, at most half of them taken
  std::size_t count_ = 0;
};

} // namespace hybridtree

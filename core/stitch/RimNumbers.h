// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/stitch/Island.h"

#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Places of points of parts in the rim of an island: a hash table with open addressing, since
/// every corner around a cut asks.
class RimNumbers
{
public:
  /// \param rim each point once; kept by reference.
  explicit RimNumbers(const std::vector<PartPoint>& rim) : rim_(rim)
  {
    while (mask_ < 2 * rim.size())
    {
      mask_ = 2 * mask_ + 1;
    }
    slots_.assign(mask_ + 1, -1);
    for (std::size_t k = 0; k < rim.size(); ++k)
    {
      slots_[this->slotOf(rim[k])] = static_cast<std::int32_t>(k);
    }
  }

  /// -1 where it is not in the rim.
  std::int32_t find(const PartPoint& at) const { return slots_[this->slotOf(at)]; }

private:
  /// Where it is, or would be.
  std::size_t slotOf(const PartPoint& at) const
  {
    const std::uint64_t key =
      static_cast<std::uint64_t>(at.part) << 32 | static_cast<std::uint32_t>(at.point);
    std::size_t slot = (key * 0x9e3779b97f4a7c15u >> 32) & mask_;
    while (slots_[slot] >= 0 && !(rim_[static_cast<std::size_t>(slots_[slot])] == at))
    {
      slot = (slot + 1) & mask_;
    }
    return slot;
  }

  const std::vector<PartPoint>& rim_;
  std::size_t mask_ = 1; ///< one less than the number of slots, a power of two
  std::vector<std::int32_t> slots_;
};

} // namespace hybridtree

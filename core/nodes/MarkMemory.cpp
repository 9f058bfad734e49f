// SPDX-License-Identifier: BSD-3-Clause
#include "core/nodes/MarkMemory.h"

namespace hybridtree
{

// Both outlive all statics.

RecentStore<UnitKey, UnitMarks>& unitMarks()
{
  constexpr std::size_t kMostBytes = std::size_t(32) << 20;
  static auto* const instance = new RecentStore<UnitKey, UnitMarks>(kMostBytes);
  return *instance;
}

RecentStore<UnitKey, std::size_t>& sampledCounts()
{
  constexpr std::size_t kMostBytes = std::size_t(4) << 20;
  static auto* const instance = new RecentStore<UnitKey, std::size_t>(kMostBytes);
  return *instance;
}

} // namespace hybridtree

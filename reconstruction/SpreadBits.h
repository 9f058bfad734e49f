// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace hybridtree
{

/// The lowest 21 bits, two zeros between each two: one axis of a key along a curve through space.
inline std::uint64_t spreadBits(std::uint64_t bits)
{
  bits = (bits | bits << 32) & 0x1f00000000ffffull;
  bits = (bits | bits << 16) & 0x1f0000ff0000ffull;
  bits = (bits | bits << 8) & 0x100f00f00f00f00full;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3ull;
  return (bits | bits << 2) & 0x1249249249249249ull;
}

/// The way back: bits 0, 3, 6 ... of a key.
inline std::uint64_t gatherBits(std::uint64_t bits)
{
  bits &= 0x1249249249249249ull;
  bits = (bits | bits >> 2) & 0x10c30c30c30c30c3ull;
  bits = (bits | bits >> 4) & 0x100f00f00f00f00full;
  bits = (bits | bits >> 8) & 0x1f0000ff0000ffull;
  bits = (bits | bits >> 16) & 0x1f00000000ffffull;
  return (bits | bits >> 32) & 0x1fffffull;
}

} // namespace hybridtree

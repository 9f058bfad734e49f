// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace hybridtree
{

/// Numbers waiting in the order of sizes: largest first, but sizes within a sixteenth of an octave
/// count as equal, and of those the last to come goes first. Every step takes constant time.
class SizeQueue
{
public:
  bool empty() const { return summary_ == 0; }

  /// \param size >= 0, not NaN.
  void push(float size, std::int32_t item)
  {
    const std::size_t bucket = bucketOf(size);
    buckets_[bucket].push_back(item);
    filled_[bucket / 64] |= std::uint64_t(1) << bucket % 64;
    summary_ |= std::uint64_t(1) << bucket / 64;
  }

  /// \pre not empty.
  std::int32_t pop()
  {
    const std::size_t word = highest(summary_);
    const std::size_t bit = highest(filled_[word]);
    std::vector<std::int32_t>& bucket = buckets_[64 * word + bit];
    const std::int32_t item = bucket.back();
    bucket.pop_back();
    if (bucket.empty())
    {
      filled_[word] ^= std::uint64_t(1) << bit;
      summary_ ^= filled_[word] == 0 ? std::uint64_t(1) << word : 0;
    }
    return item;
  }

  /// What will come so many pops from now, 0 the next, if nothing is pushed until then and it is of
  /// the same size; else -1. For prefetching. \pre not empty.
  std::int32_t ahead(std::size_t pops) const
  {
    const std::size_t word = highest(summary_);
    const std::vector<std::int32_t>& bucket = buckets_[64 * word + highest(filled_[word])];
    return pops < bucket.size() ? bucket[bucket.size() - 1 - pops] : -1;
  }

private:
  // The exponent and four bits of the fraction: order by these is order by size.
  static std::size_t bucketOf(float size)
  {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &size, sizeof bits);
    return bits >> 19;
  }
  static std::size_t highest(std::uint64_t bits)
  {
#if defined(__GNUC__)
    return 63 - static_cast<std::size_t>(__builtin_clzll(bits));
#else
    std::size_t bit = 0;
    for (int step = 32; step > 0; step /= 2)
    {
      if (bits >> step != 0)
      {
        bits >>= step;
        bit += static_cast<std::size_t>(step);
      }
    }
    return bit;
#endif
  }

  std::array<std::vector<std::int32_t>, 4096> buckets_;
  std::array<std::uint64_t, 64> filled_{}; // bit per bucket: not empty
  std::uint64_t summary_ = 0;              // bit per word of filled_
};

} // namespace hybridtree

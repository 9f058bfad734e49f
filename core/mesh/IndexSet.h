// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hybridtree
{

/// Some of the numbers 0 .. size() - 1, one bit each, visited in ascending order.
///
/// Threads may change numbers of disjoint words, kPerWord each, at the same time.
class IndexSet
{
public:
  static constexpr std::size_t kPerWord = 64;

  /// New numbers are not in the set.
  void resize(std::size_t size)
  {
    size_ = size;
    words_.resize((size + kPerWord - 1) / kPerWord, 0);
  }
  std::size_t size() const { return size_; }

  ///@{
  /// \pre k < size().
  void insert(std::size_t k) { words_[k / kPerWord] |= bit(k); }
  void erase(std::size_t k) { words_[k / kPerWord] &= ~bit(k); }
  bool contains(std::size_t k) const { return (words_[k / kPerWord] & bit(k)) != 0; }
  void set(std::size_t k, bool in) { in ? this->insert(k) : this->erase(k); }
  ///@}

  /// The first number in the set from k on; size() when there is none.
  std::size_t next(std::size_t k) const
  {
    std::size_t w = k / kPerWord;
    if (k >= size_)
    {
      return size_;
    }
    std::uint64_t word = words_[w] >> (k % kPerWord);
    while (word == 0)
    {
      if (++w == words_.size())
      {
        return size_;
      }
      k = w * kPerWord;
      word = words_[w];
    }
    for (; (word & 1) == 0; word >>= 1)
    {
      ++k;
    }
    return k;
  }

private:
  static std::uint64_t bit(std::size_t k) { return std::uint64_t(1) << (k % kPerWord); }

  std::vector<std::uint64_t> words_;
  std::size_t size_ = 0;
};

} // namespace hybridtree

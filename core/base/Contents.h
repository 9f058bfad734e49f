// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/RecentStore.h"

#include <cstring>
#include <memory>
#include <utility>
#include <vector>

namespace hybridtree
{

/// Numbers that something depends on, one after the other, bit by bit.
class Contents
{
public:
  void add(std::uint64_t word) { words_.push_back(word); }
  void add(std::int32_t number) { words_.push_back(static_cast<std::uint32_t>(number)); }
  void add(double value)
  {
    std::uint64_t word;
    std::memcpy(&word, &value, sizeof word);
    words_.push_back(word);
  }

  std::size_t bytes() const { return words_.capacity() * sizeof(std::uint64_t); }
  std::uint64_t hash() const
  {
    HashSum sum;
    for (const std::uint64_t word : words_)
    {
      sum.add(word);
    }
    return sum.value();
  }
  bool operator==(const Contents& other) const { return words_ == other.words_; }

private:
  std::vector<std::uint64_t> words_;
};

/// One object for equal contents, so that results can depend on what things are made of as they do
/// on objects (Dependency.h). Past a number of bytes those go that were not asked for the longest,
/// and with them what depends on them. Thread-safe.
class ContentsStore
{
public:
  using ContentsPtr = std::shared_ptr<const Contents>;

  explicit ContentsStore(std::size_t mostBytes) : known_(mostBytes) {}

  ContentsPtr of(Contents contents)
  {
    const Key key{ std::make_shared<const Contents>(std::move(contents)) };
    if (ContentsPtr known = known_.find(key))
    {
      return known;
    }
    known_.keep(key, key.contents, key.contents->bytes() + sizeof(Contents));
    const ContentsPtr kept = known_.find(key); // that of a thread that was faster
    return kept ? kept : key.contents;
  }

  std::size_t bytes() const { return known_.bytes(); }

private:
  struct Key
  {
    explicit Key(ContentsPtr of) : contents(std::move(of)), sum(contents->hash()) {}

    ContentsPtr contents;
    std::uint64_t sum;

    std::uint64_t hash() const { return sum; }
    bool operator==(const Key& other) const { return *contents == *other.contents; }
    bool isExpired() const { return false; }
  };

  RecentStore<Key, Contents> known_;
};

} // namespace hybridtree

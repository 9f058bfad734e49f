// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>
#include <utility>

namespace hybridtree
{

/// Results that may be needed again, by what they were made from. Past a number of bytes those go
/// that were not asked for the longest; those whose key is expired, made from objects that are
/// gone, go once new ones are a quarter of all. Thread-safe.
///
/// \tparam Key has hash(), operator== and isExpired(). A key that is expired equals none.
template <class Key, class Value>
class RecentStore
{
public:
  using ValuePtr = std::shared_ptr<const Value>;

  explicit RecentStore(std::size_t mostBytes) : mostBytes_(mostBytes) {}

  /// Null when it is not there.
  ValuePtr find(const Key& key)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = this->locate(key);
    if (found == entries_.end())
    {
      return nullptr;
    }
    entries_.splice(entries_.begin(), entries_, found);
    return found->value;
  }

  /// \param bytes that key and value take. What would take most of the store is not kept.
  void keep(Key key, ValuePtr value, std::size_t bytes)
  {
    if (bytes > mostBytes_ / 2)
    {
      return;
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    if (this->locate(key) != entries_.end())
    {
      return; // another thread was faster
    }
    const std::uint64_t hash = key.hash();
    entries_.push_front({ std::move(key), std::move(value), bytes, hash });
    index_.emplace(hash, entries_.begin());
    bytes_ += bytes;
    if (++sinceSweep_ > entries_.size() / 4)
    {
      this->sweep();
    }
    while (bytes_ > mostBytes_)
    {
      this->erase(std::prev(entries_.end()));
    }
  }

  void clear()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    entries_.clear();
    index_.clear();
    bytes_ = 0;
  }

  std::size_t bytes() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return bytes_;
  }

private:
  struct Entry
  {
    Key key;
    ValuePtr value;
    std::size_t bytes;
    std::uint64_t hash;
  };
  using Entries = std::list<Entry>; ///< what was asked for last comes first
  using Place = typename Entries::iterator;

  Place locate(const Key& key)
  {
    const auto [begin, end] = index_.equal_range(key.hash());
    for (auto at = begin; at != end; ++at)
    {
      if (at->second->key == key)
      {
        return at->second;
      }
    }
    return entries_.end();
  }

  Place erase(Place place)
  {
    const auto [begin, end] = index_.equal_range(place->hash);
    for (auto at = begin; at != end; ++at)
    {
      if (at->second == place)
      {
        index_.erase(at);
        break;
      }
    }
    bytes_ -= place->bytes;
    return entries_.erase(place);
  }

  void sweep()
  {
    sinceSweep_ = 0;
    for (Place place = entries_.begin(); place != entries_.end();)
    {
      place = place->key.isExpired() ? this->erase(place) : std::next(place);
    }
  }

  mutable std::mutex mutex_;
  const std::size_t mostBytes_;
  std::size_t bytes_ = 0;
  std::size_t sinceSweep_ = 0;
  Entries entries_;
  std::unordered_multimap<std::uint64_t, Place> index_;
};

/// A hash of several numbers, one after the other.
class HashSum
{
public:
  void add(std::uint64_t word)
  {
    sum_ = (sum_ ^ word) * 0x9e3779b97f4a7c15u;
    sum_ ^= sum_ >> 29;
  }
  std::uint64_t value() const { return sum_; }

private:
  std::uint64_t sum_ = 0x243f6a8885a308d3u;
};

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/Dependency.h"
#include "core/nodes/Node.h"

#include <functional>
#include <mutex>
#include <vector>

namespace hybridtree
{

/// Nodes that are made from others, such as images under a map. What is made again from the same
/// objects is the same object for as long as anyone holds it, so that all that hangs on it is found
/// again: its mesh, and the parts of blends that depend on it. Thread-safe.
class DerivedNodes
{
public:
  NodePtr of(
    std::vector<Dependency> from, const Affine3& map, const std::function<NodePtr()>& make);

private:
  struct Key
  {
    std::vector<Dependency> from;
    Affine3 map;

    bool operator==(const Key& other) const
    {
      return from == other.from && map.matrix() == other.map.matrix();
    }
    bool isExpired() const { return anyExpired(from); }
    std::uint64_t hash() const;
  };

  struct Slot
  {
    mutable std::mutex mutex; ///< held while the node is made
    mutable std::weak_ptr<const Node> node;
  };

  static constexpr std::size_t kMostBytes = std::size_t(1) << 20;

  RecentStore<Key, Slot> slots_{ kMostBytes };
};

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/mesh/TriangleMesh.h"

#include <iterator>
#include <memory>
#include <mutex>
#include <unordered_map>

namespace hybridtree
{

/// Something about meshes, found once for each mesh object and remembered as long as anyone holds
/// it. Thread-safe.
template <typename Value>
class PerMesh
{
public:
  using ValuePtr = std::shared_ptr<const Value>;

  /// \param make(*mesh) returns a ValuePtr. Called while others wait: it must be quick, or put off
  /// the work.
  template <typename Make>
  ValuePtr of(const MeshPtr& mesh, Make&& make)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto found = known_.find(mesh.get());
    if (found != known_.end() && found->second.mesh.lock() == mesh)
    {
      return found->second.value;
    }
    for (auto entry = known_.begin(); entry != known_.end();)
    {
      entry = entry->second.mesh.expired() ? known_.erase(entry) : std::next(entry);
    }
    ValuePtr value = make(*mesh);
    known_[mesh.get()] = { mesh, value };
    return value;
  }

private:
  struct Known
  {
    std::weak_ptr<const TriangleMesh> mesh; ///< no other mesh at the same address
    ValuePtr value;
  };

  std::mutex mutex_;
  std::unordered_map<const TriangleMesh*, Known> known_;
};

} // namespace hybridtree

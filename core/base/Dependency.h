// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/base/RecentStore.h"

#include <cstring>
#include <memory>
#include <vector>

namespace hybridtree
{

/// An immutable object that a result depends on, and a way to use it. Two are equal when they are
/// the same object, which is still there, used in the same way: no object that came to lie at the
/// same address later is taken for it.
class Dependency
{
public:
  /// \param number, index whatever else the result depends on.
  Dependency(const std::shared_ptr<const void>& object, double number, std::int64_t index)
    : object_(object), address_(object.get()), number_(number), index_(index)
  {
  }

  bool isExpired() const { return object_.expired(); }

  bool operator==(const Dependency& other) const
  {
    return address_ == other.address_ && number_ == other.number_ && index_ == other.index_ &&
      !object_.owner_before(other.object_) && !other.object_.owner_before(object_);
  }

  void addTo(HashSum& hash) const
  {
    std::uint64_t bits;
    std::memcpy(&bits, &number_, sizeof bits);
    hash.add(reinterpret_cast<std::uintptr_t>(address_));
    hash.add(bits);
    hash.add(static_cast<std::uint64_t>(index_));
  }

private:
  std::weak_ptr<const void> object_;
  const void* address_;
  double number_;
  std::int64_t index_;
};

inline bool anyExpired(const std::vector<Dependency>& dependencies)
{
  for (const Dependency& dependency : dependencies)
  {
    if (dependency.isExpired())
    {
      return true;
    }
  }
  return false;
}

} // namespace hybridtree

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace hybridtree
{

/// Leaves new elements undefined where no value is given, so that threads that fill a large array
/// are the first to touch it, and nobody writes it twice.
template <typename Item>
struct RawAllocator : std::allocator<Item>
{
  template <typename Other>
  struct rebind
  {
    using other = RawAllocator<Other>;
  };
  template <typename Other>
  void construct(Other* item) noexcept
  {
    ::new (static_cast<void*>(item)) Other;
  }
  template <typename Other, typename... Values>
  void construct(Other* item, Values&&... values)
  {
    ::new (static_cast<void*>(item)) Other{ std::forward<Values>(values)... };
  }
};

/// A vector whose resize() leaves what it adds undefined.
template <typename Item>
using RawVector = std::vector<Item, RawAllocator<Item>>;

} // namespace hybridtree

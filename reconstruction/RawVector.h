// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace hybridtree
{

/// Leaves new elements undefined where no value is given, so that threads that fill a large array
/// are the first to touch it, and nobody writes it twice. Items start on lines of the cache, and
/// large arrays on huge pages where the system has them to give: walks over tetrahedra look at a
/// few bytes here and there, and would else wait for the addresses of pages.
template <typename Item>
struct RawAllocator
{
  using value_type = Item;

  RawAllocator() = default;
  template <typename Other>
  RawAllocator(const RawAllocator<Other>&) noexcept
  {
  }
  Item* allocate(std::size_t count)
  {
    if (count > std::numeric_limits<std::size_t>::max() / sizeof(Item))
    {
      throw std::bad_alloc();
    }
    void* items = ::operator new(count * sizeof(Item), alignment(count));
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (alignment(count) == kHugePage)
    {
      madvise(items, count * sizeof(Item), MADV_HUGEPAGE); // no harm if it fails
    }
#endif
    return static_cast<Item*>(items);
  }
  void deallocate(Item* items, std::size_t count) noexcept
  {
    ::operator delete(items, alignment(count));
  }
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
  template <typename Other>
  friend bool operator==(const RawAllocator&, const RawAllocator<Other>&) noexcept
  {
    return true;
  }
  template <typename Other>
  friend bool operator!=(const RawAllocator&, const RawAllocator<Other>&) noexcept
  {
    return false;
  }

private:
  static constexpr std::align_val_t kLine{ 64 };
  static constexpr std::align_val_t kHugePage{ std::size_t(1) << 21 };
  static constexpr std::size_t kLarge = std::size_t(1) << 22; // bytes
  static std::align_val_t alignment(std::size_t count)
  {
    return count * sizeof(Item) >= kLarge ? kHugePage : kLine;
  }
};

/// A vector whose resize() leaves what it adds undefined.
template <typename Item>
using RawVector = std::vector<Item, RawAllocator<Item>>;

} // namespace hybridtree

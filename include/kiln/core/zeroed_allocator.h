// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

namespace kiln {

/// Memory whose every byte is 0. Large blocks come from the system page by page as they are first
/// written, so the threads that fill an image also pay for its memory; 2 MiB pages are asked for.
/// Throws std::bad_alloc.
void* zeroed_memory(std::size_t bytes, std::size_t alignment);
void free_zeroed_memory(void* memory, std::size_t bytes, std::size_t alignment) noexcept;

/// For vectors of numbers that are made at their full size and start at 0: nothing is written then.
template <class T>
struct ZeroedAllocator {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
  using value_type = T;

  ZeroedAllocator() = default;
  template <class U>
  ZeroedAllocator(const ZeroedAllocator<U>&) {}

  T* allocate(std::size_t count) {
    return static_cast<T*>(zeroed_memory(count * sizeof(T), alignof(T)));
  }
  void deallocate(T* memory, std::size_t count) noexcept {
    free_zeroed_memory(memory, count * sizeof(T), alignof(T));
  }
  template <class U, class... Args>
  void construct(U* at, Args&&... args) {
    if constexpr (sizeof...(Args) > 0)
      ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
  }
  friend bool operator==(ZeroedAllocator, ZeroedAllocator) { return true; }
};

}  // namespace kiln

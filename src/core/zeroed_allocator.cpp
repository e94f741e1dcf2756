// SPDX-License-Identifier: Apache-2.0
#include "kiln/core/zeroed_allocator.h"

#include <sys/mman.h>

#include <cstring>
#include <new>

namespace kiln {
namespace {

constexpr std::size_t large_page = std::size_t{2} << 20;

// Smaller blocks are cheaper from the heap, which gives out again what it was given back.
bool comes_from_system(std::size_t bytes) { return bytes >= 6 * large_page; }

}  // namespace

void* zeroed_memory(std::size_t bytes, std::size_t alignment) {
  if (!comes_from_system(bytes)) {
    void* memory = ::operator new (bytes, std::align_val_t{alignment});
    return std::memset(memory, 0, bytes);
  }
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  madvise(memory, bytes, MADV_HUGEPAGE);  // a wish: without it all works, slower
  return memory;
}

void free_zeroed_memory(void* memory, std::size_t bytes, std::size_t alignment) noexcept {
  if (comes_from_system(bytes)) {
    munmap(memory, bytes);
  } else {
    ::operator delete (memory, std::align_val_t{alignment});
  }
}

}  // namespace kiln

// SPDX-License-Identifier: MIT
// Replaces the allocation functions of the whole program.
#include "faults/failing_allocator.hpp"

#include <atomic>
#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

std::atomic<std::int64_t> num_made{0}, first_failing{0}, num_failing{0};

void* allocate(std::size_t size, std::size_t alignment) {
  const std::int64_t number = ++num_made;
  const std::int64_t first = first_failing;
  if (first > 0 && number >= first && number - first < num_failing) throw std::bad_alloc();
  void* const block =
      alignment <= alignof(std::max_align_t)
          ? std::malloc(size == 0 ? 1 : size)
          : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}

}  // namespace

namespace quadrille::support {

void fail_allocations(std::int64_t n, std::int64_t length) {
  num_failing = length;
  num_made = 0;
  first_failing = n;
}

std::int64_t stop_failing() {
  first_failing = 0;
  return num_made.exchange(0);
}

}  // namespace quadrille::support

void* operator new(std::size_t size) { return allocate(size, 0); }
void* operator new[](std::size_t size) { return allocate(size, 0); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocate(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete[](void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
void operator delete[](void* block, std::size_t) noexcept { std::free(block); }
void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete[](void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }
void operator delete[](void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }

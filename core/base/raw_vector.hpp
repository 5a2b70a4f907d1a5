// SPDX-License-Identifier: BSD-3-Clause
// A std::vector whose resize() leaves numbers uninitialised and whose large blocks ask for huge pages: a stage that
// writes every element anyway saves one pass over memory and, on a fresh machine, most of the page faults.
#pragma once

#include <algorithm>
#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace warren {

/// Blocks of 512 KiB and more are aligned to 2 MiB, advised to use huge pages, and made of the pages of earlier ones
/// where the thread keeps them. Both functions stand in core/base/page_pool.cpp. Throws std::bad_alloc.
void* allocate_raw(std::size_t bytes);
/// Gives back what allocate_raw() gave for so many bytes.
void release_raw(void* block, std::size_t bytes) noexcept;

/// Allocates by allocate_raw(), and leaves numbers as the memory has them.
template <class T>
class RawAllocator {
 public:
  using value_type = T;  ///< of the elements
  RawAllocator() = default;
  /// All of them are alike.
  template <class U>
  RawAllocator(const RawAllocator<U>&) noexcept {}  // NOLINT(google-explicit-constructor): allocators convert

  /// Room for n elements. Throws std::bad_alloc.
  T* allocate(std::size_t n) {
    if (n > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_alloc();
    return static_cast<T*>(allocate_raw(n * sizeof(T)));
  }
  /// Gives it back.
  void deallocate(T* block, std::size_t n) noexcept { release_raw(block, n * sizeof(T)); }

  /// An element without a value.
  template <class U>
  void construct(U* at) noexcept(std::is_nothrow_default_constructible_v<U>) {
    ::new (static_cast<void*>(at)) U;  // default-initialised: numbers keep what was in memory
  }
  /// An element of these values.
  template <class U, class... Args>
  void construct(U* at, Args&&... args) {
    ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
  }
  friend bool operator==(const RawAllocator&, const RawAllocator&) { return true; }
};

/// Elements of plain aggregates with default member initialisers are still initialised: use it for numbers and for
/// structs without them.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

/// Asks nothing.
struct NoPoll {
  void operator()() const {}  ///< does nothing
};

/// Makes `block` n times `value`, and calls poll() between pieces of it: the first touch of memory can take seconds.
template <class T, class Poll>
void assign_polled(RawVector<T>& block, std::size_t n, T value, const Poll& poll) {
  constexpr std::size_t piece = std::size_t{1} << 16;
  block.clear();
  block.resize(n);
  for (std::size_t first = 0; first < n; first += piece) {
    poll();
    std::fill_n(block.begin() + static_cast<std::ptrdiff_t>(first), std::min(piece, n - first), value);
  }
}

/// Memory given back before its owner ends. `held = {}` does not do that for a std::vector: it assigns an empty list,
/// which keeps the room for the elements that were there. Leaves containers empty and without room.
template <class... Containers>
void let_go(Containers&... held) noexcept {
  (Containers().swap(held), ...);
}

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// Which memory is a mapped file, for handlers of SIGBUS: a file that becomes shorter while it is mapped leaves pages
// that nobody can read, in whatever thread. At most 16 at once are known; more are mapped like all others, but not
// known.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>

#include "core/base/types.hpp"

namespace warren {

namespace detail {
/// Free where `end` is 0. `taken` is set first and cleared last; a handler reads `begin` and `name` only where `end`
/// says that they are there.
struct RangeSlot {
  std::atomic<bool> taken{false};
  std::atomic<std::uintptr_t> begin{0};
  std::atomic<std::uintptr_t> end{0};
  std::atomic<const char*> name{nullptr};
};
static_assert(std::atomic<std::uintptr_t>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

inline constinit std::array<RangeSlot, 16> range_slots;
}  // namespace detail

/// Known while it lives. `name` must outlive it.
class MappedRange : NotCopied {
 public:
  MappedRange(const void* begin, std::size_t bytes, const char* name) noexcept {
    std::size_t i = 0;
    while (i < detail::range_slots.size() && detail::range_slots[i].taken.exchange(true)) ++i;
    if (i == detail::range_slots.size()) return;
    slot_ = &detail::range_slots[i];
    const auto first = reinterpret_cast<std::uintptr_t>(begin);
    slot_->begin = first;
    slot_->name = name;
    slot_->end = first + bytes;
  }
  ~MappedRange() {
    if (slot_ == nullptr) return;
    slot_->end = 0;
    slot_->taken = false;
  }

 private:
  detail::RangeSlot* slot_ = nullptr;
};

/// The name of the range that holds an address, or nullptr. May be called from a signal handler.
inline const char* name_of_mapped(const void* address) noexcept {
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  for (const detail::RangeSlot& slot : detail::range_slots) {
    if (at < slot.end && at >= slot.begin) return slot.name;
  }
  return nullptr;
}

}  // namespace warren

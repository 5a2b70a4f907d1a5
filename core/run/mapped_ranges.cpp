// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/mapped_ranges.hpp"

#include <array>
#include <atomic>
#include <cstdint>

namespace warren {
namespace {

/// Free where `end` is 0. `taken` is set first and cleared last; a handler reads `begin` and `name` only where `end`
/// says that they are there.
struct RangeSlot {
  std::atomic<bool> taken{false};
  std::atomic<std::uintptr_t> begin{0};
  std::atomic<std::uintptr_t> end{0};
  std::atomic<const char*> name{nullptr};
};

constinit std::array<RangeSlot, 16> slots;
static_assert(std::atomic<std::uintptr_t>::is_always_lock_free, "a signal handler may only touch lock-free atomics");

}  // namespace

MappedRange::MappedRange(const void* begin, std::size_t bytes, const char* name) noexcept : slot_(0) {
  while (slot_ < slots.size() && slots[slot_].taken.exchange(true)) ++slot_;
  if (slot_ == slots.size()) return;
  const auto first = reinterpret_cast<std::uintptr_t>(begin);
  slots[slot_].begin = first;
  slots[slot_].name = name;
  slots[slot_].end = first + bytes;
}

MappedRange::~MappedRange() {
  if (slot_ == slots.size()) return;
  slots[slot_].end = 0;
  slots[slot_].taken = false;
}

const char* name_of_mapped(const void* address) noexcept {
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  for (const RangeSlot& slot : slots) {
    if (at < slot.end && at >= slot.begin) return slot.name;
  }
  return nullptr;
}

}  // namespace warren

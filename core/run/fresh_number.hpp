// SPDX-License-Identifier: BSD-3-Clause
// Names for values that are remembered: an address may be another value's later, a number is not.
#pragma once

#include <atomic>
#include <cstdint>

namespace warren {

/// A number, from 1, that this process has given nobody before. Any thread.
inline std::uint64_t fresh_number() noexcept {
  static std::atomic<std::uint64_t> latest{0};
  return latest.fetch_add(1, std::memory_order_relaxed) + 1;
}

}  // namespace warren

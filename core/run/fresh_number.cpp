// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/fresh_number.hpp"

#include <atomic>

namespace warren {

std::uint64_t fresh_number() noexcept {
  static std::atomic<std::uint64_t> latest{0};
  return latest.fetch_add(1, std::memory_order_relaxed) + 1;
}

}  // namespace warren

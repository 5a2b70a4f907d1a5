// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "core/base/enum_names.hpp"

namespace warren {

/// Why a computation was stopped before its end.
enum class StopReason : std::uint8_t { time, memory, interrupt, terminate, hang_up };
/// As answers say it.
constexpr auto enum_names(StopReason) {
  return std::array<std::string_view, 5>{"budget", "memory", "SIGINT", "SIGTERM", "SIGHUP"};
}

/// As people are told it.
constexpr std::string_view text_of(StopReason reason) {
  constexpr std::array<std::string_view, 5> texts{"the time budget ended", "it needs more memory than it may hold",
                                                  "interrupted", "terminated", "the terminal was closed"};
  return texts[static_cast<std::size_t>(reason)];
}

/// Was it a signal?
constexpr bool is_signal(StopReason reason) { return reason >= StopReason::interrupt; }

}  // namespace warren

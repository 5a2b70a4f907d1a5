// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

namespace warren {

/// Why a computation was stopped before its end.
enum class StopReason : std::uint8_t { time, memory, interrupt, terminate, hang_up };

constexpr bool is_signal(StopReason reason) { return reason >= StopReason::interrupt; }

}  // namespace warren

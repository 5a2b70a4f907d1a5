// SPDX-License-Identifier: BSD-3-Clause
// Names for values that are remembered: an address may be another value's later, a number is not.
#pragma once

#include <cstdint>

namespace warren {

/// A number, from 1, that this process has given nobody before. Any thread.
std::uint64_t fresh_number() noexcept;

}  // namespace warren

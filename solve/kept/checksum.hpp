// SPDX-License-Identifier: BSD-3-Clause
// The checksum of .roadmap files: XXH3 of 64 bits with seed 0, as libxxhash defines it since 0.8.0, the same on every
// processor. It finds damage, of which one in 2^64 would go unseen, and no malice: whoever forges a file can make its
// checksums right as well. Memory speed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace warren {

std::uint64_t checksum(std::span<const std::byte> bytes) noexcept;

}  // namespace warren

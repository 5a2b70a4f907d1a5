// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kept/checksum.hpp"

#ifdef WARREN_PLAIN
#define XXH_VECTOR 0  // the library's plain code, which every processor runs
#endif
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace warren {

std::uint64_t checksum(std::span<const std::byte> bytes) noexcept { return XXH3_64bits(bytes.data(), bytes.size()); }

}  // namespace warren

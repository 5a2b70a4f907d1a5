// SPDX-License-Identifier: BSD-3-Clause
// CRC-32 as zlib, PNG and Python's zlib.crc32 have it (reflected, polynomial 0xEDB88320), eight bytes at a time by
// tables (Kounavis, Berry 2005).
#pragma once

#include <cstdint>
#include <string_view>

namespace warren {

std::uint32_t crc32(std::string_view bytes) noexcept;

}  // namespace warren

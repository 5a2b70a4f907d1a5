// SPDX-License-Identifier: BSD-3-Clause
// What stands before the numbers of a NumPy array: a Python literal, padded so that the numbers begin on a multiple of
// 64 bytes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace warren {

/// The header, format version 1, of an array in C order. `type` as NumPy spells it: "<f8", "<i4", "|S3". A shape
/// without numbers is that of a single value.
std::string npy_header(std::string_view type, std::span<const std::uint64_t> shape);

}  // namespace warren

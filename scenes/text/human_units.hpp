// SPDX-License-Identifier: BSD-3-Clause
// Numbers as people read them: "12.3 M", "4.1 ms", "8.6 MiB", "1 683".
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace warren {

std::string human_count(double count);        ///< 950, 12.3 k, 4.5 M, 1.2 G
std::string human_seconds(double seconds);    ///< 3.2 ms, 0.41 s, 12.3 s, 2 min 05 s
std::string precise_seconds(double seconds);  ///< three digits from nanoseconds on: 512 ns, 3.70 us, 519 us, 1.40 ms
std::string human_bytes(double bytes);        ///< 8.6 MiB
std::string grouped(std::uint64_t count);     ///< 1 683 000, by groups of three with a space between
/// "1 wall", "1 683 walls"
std::string counted(std::uint64_t count, std::string_view one, std::string_view many);
std::string human_number(double value);  ///< six significant digits, and all before the point up to 1e15

}  // namespace warren

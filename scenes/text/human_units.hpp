// SPDX-License-Identifier: BSD-3-Clause
// Numbers as people read them: "12.3 M", "4.1 ms", "8.6 MiB", "1 683".
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/base/solution.hpp"

namespace warren {

std::string human_count(double count);        ///< 950, 12.3 k, 4.5 M, 1.2 G
std::string human_seconds(double seconds);    ///< 3.2 ms, 0.41 s, 12.3 s, 2 min 05 s
std::string precise_seconds(double seconds);  ///< three digits from nanoseconds on: 512 ns, 3.70 us, 519 us, 1.40 ms
std::string human_bytes(double bytes);        ///< 8.6 MiB
std::string grouped(std::uint64_t count);     ///< 1 683 000, by groups of three with a space between
/// "1 wall", "1 683 walls"
std::string counted(std::uint64_t count, std::string_view one, std::string_view many);
std::string human_number(double value);  ///< six significant digits, and all before the point up to 1e15

/// Why it was stopped, with the memory that was wanted where that is known (> 0).
std::string stop_text(StopReason reason, std::size_t wanted_bytes);

/// CSV as RFC 4180 has it: fields between commas, quoted where they must be. A text as a field, made printable (so it
/// has no ends of lines): in quotes where it holds a comma or a quote.
std::string csv_field(std::string_view text);

/// Wraps text in colour where it is on.
class Palette {
 public:
  explicit Palette(bool on) : on_(on) {}
  std::string good(std::string_view text) const { return painted("1;32", text); }
  std::string bad(std::string_view text) const { return painted("1;31", text); }
  std::string doubtful(std::string_view text) const { return painted("1;33", text); }
  std::string strong(std::string_view text) const { return painted("1", text); }
  std::string faint(std::string_view text) const { return painted("2", text); }

 private:
  std::string painted(std::string_view code, std::string_view text) const;
  bool on_;
};

}  // namespace warren

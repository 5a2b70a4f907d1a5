// SPDX-License-Identifier: BSD-3-Clause
// What the terminal can show: colour by the rules of no-color.org and CLICOLOR, width, and whether a bar makes sense.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace warren {

enum class ColorMode : std::uint8_t { automatic, always, never };
enum class ProgressMode : std::uint8_t { automatic, bar, plain, none };

/// May this descriptor be written in colour? --color wins over the environment; NO_COLOR (set and not empty) and
/// TERM=dumb refuse; CLICOLOR_FORCE or FORCE_COLOR (set, not 0) force; else only a terminal.
bool wants_color(int descriptor, ColorMode mode);

/// automatic becomes bar on a terminal that can erase a line, none elsewhere.
ProgressMode resolved(ProgressMode mode);

/// Columns of the terminal behind standard error: COLUMNS, else what the terminal says, else 80.
std::size_t terminal_width();

/// Appends to standard output; main tells at the end whether it was all written.
void print_text(std::string_view text);

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

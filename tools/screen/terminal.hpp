// SPDX-License-Identifier: BSD-3-Clause
// What the terminal can show: colour by the rules of no-color.org and CLICOLOR, width, and whether a bar makes sense.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "scenes/text/human_units.hpp"  // IWYU pragma: export

namespace warren::tools {

enum class ColorMode : std::uint8_t { automatic, always, never };
constexpr auto enum_names(ColorMode) { return std::array<std::string_view, 3>{"auto", "always", "never"}; }
enum class ProgressMode : std::uint8_t { automatic, bar, plain, none };
constexpr auto enum_names(ProgressMode) { return std::array<std::string_view, 4>{"auto", "bar", "plain", "none"}; }

/// May this descriptor be written in colour? --color wins over the environment; NO_COLOR (set and not empty) and
/// TERM=dumb refuse; CLICOLOR_FORCE or FORCE_COLOR (set, not 0) force; else only a terminal.
bool wants_color(int descriptor, ColorMode mode);

/// automatic becomes bar on a terminal that can erase a line, none elsewhere.
ProgressMode resolved(ProgressMode mode);

/// Columns of the terminal behind standard error: COLUMNS, else what the terminal says, else 80.
std::size_t terminal_width();

/// Appends to standard output. Throws WriteError where it takes no more; main tells of what was still on its way.
void print_text(std::string_view text);

}  // namespace warren::tools

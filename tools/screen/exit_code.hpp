// SPDX-License-Identifier: BSD-3-Clause
// How the program ends: its exit code, the table of docs/file_formats.md, and the one line on standard error that says
// what went wrong, here and nowhere else; also where nothing else works any more. The signals that end it. And what it
// writes on until then: what the terminal can show, colour by the rules of no-color.org and CLICOLOR, width, and
// whether a bar makes sense.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string_view>

#include "core/run/execution.hpp"

namespace warren::tools {
namespace exit_code {

inline constexpr int success = 0;
inline constexpr int no_path = 1;  ///< or `verify` refutes the answer
inline constexpr int usage = 2;
inline constexpr int bad_data = 65;
inline constexpr int unreadable = 66;
inline constexpr int internal = 70;
inline constexpr int unwritable = 73;
inline constexpr int budget = 124;
inline constexpr int hung_up = 129;
inline constexpr int interrupted = 130;
inline constexpr int terminated = 143;

}  // namespace exit_code

/// Runs the program of that name and gives its exit code; what it has printed is on its way then. hint: follows what is
/// said of a command line that can't be.
int run_with_errors_told(std::string_view program, std::string_view hint, const std::function<int()>& run);

/// "NAME: text" on standard error; gives the code back.
int complain(std::string_view program, int code, std::string_view text);

/// Where the caller has closed standard input, output or error, what is opened first would take its number, and results
/// and messages would end up in it. Such a descriptor fails from now on when it is used.
void hold_standard_descriptors();

/// Writes to standard error, come what may. Allocates nothing.
void say_on_standard_error(std::string_view text) noexcept;

/// Says that memory is out; returns the exit code for it. Allocates nothing.
int say_memory_is_out() noexcept;

/// Memory that runs out in a destructor, or while an error is told, ends the program by say_memory_is_out(), too, where
/// it would have been aborted.
void install_last_words();

// SIGINT, SIGTERM and SIGHUP (unless nohup has it ignored) set a flag that every stage polls: the program ends in
// order, and a second one within a second changes nothing about that, for a key pressed twice must leave no
// half-written file; after a second it kills at once. A file that grows past its limit (SIGXFSZ) is an output that
// can't be written. SIGPIPE ends the program quietly, SIGQUIT at once, with a core where the system keeps one.

void install_signal_handlers();

/// 0, or the number of the signal that came.
const SignalFlag& signal_flag();
/// The signal that came has done what it could: the next one stops what runs then.
void forget_signal();

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

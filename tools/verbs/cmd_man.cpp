// SPDX-License-Identifier: BSD-3-Clause
// warren man: the manual page warren.1, made from the table of commands. SOURCE_DATE_EPOCH sets its date.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <span>
#include <utility>

#include "tools/screen/exit_code.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/words/command.hpp"
#include "tools/words/help.hpp"

namespace warren {
namespace {

/// For troff: hyphens as typed, no leading dot or quote.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '\\') {
      out += "\\e";
    } else if (c == '-') {
      out += "\\-";
    } else {
      out += c;
    }
  }
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

std::string page_date() {
  std::time_t when = std::time(nullptr);
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing here sets variables
  if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH")) when = std::strtoll(epoch, nullptr, 10);
  return fmt::format("{:%Y-%m-%d}", fmt::gmtime(when));
}

std::string command_section(const Command& command) {
  return fmt::format(".SS warren {} {}\n{}.\n", command.name, escaped(command.operands), escaped(command.summary));
}

std::string option_section(const Command&, const OptionSpec& option) {
  const std::string_view name = option.short_name;
  return fmt::format(
      ".TP\n{}\\fB{}\\fR{}\n{}.\n{}", name.empty() ? "" : fmt::format("\\fB{}\\fR, ", escaped(name)),
      escaped(option.name), option.value.empty() ? "" : fmt::format(" \\fI{}\\fR", escaped(option.value)),
      escaped(option.help), option.choices.empty() ? "" : fmt::format("One of: {}.\n", escaped(option.choices)));
}

constexpr std::string_view description = R"(.SH DESCRIPTION
\fBwarren\fR plans motions by roadmaps: it finds a path for a point or a disc through mazes and other worlds of walls,
verifies the path by code of its own that the search does not use, and says what the work took.
Results are the same for any number of threads.
.PP
\fIWORLD\fR is a file (scene text or a NumPy array of walls; its content decides), \fB\-\fR for standard input, or
\fBmaze:\fIROWS\fBx\fICOLS\fR[\fB,seed=\fIN\fR][\fB,algorithm=\fINAME\fR][\fB,loops=\fIF\fR].
)";

/// What a paragraph tells, and its text.
constexpr std::pair<std::string_view, std::string_view> exit_codes[] = {
    {"0", "success; for solve, a path that was verified."},
    {"1", "no path (the status says which kind), or verify refutes the answer."},
    {"2", "usage."},
    {"65", "bad data in an input file."},
    {"66", "an input can't be read."},
    {"70", "internal error: please report it."},
    {"73", "an output can't be written."},
    {"124", "the time or memory budget ran out."},
    {"129, 130, 143", "SIGHUP, SIGINT, SIGTERM."}};
constexpr std::pair<std::string_view, std::string_view> variables[] = {
    {"NO_COLOR\\fR, \\fBCLICOLOR_FORCE\\fR, \\fBFORCE_COLOR\\fR, \\fBTERM",
     "Whether output is coloured; \\fB\\-\\-color\\fR wins."},
    {"COLUMNS", "Width of the progress bar's line."},
    {"SOURCE_DATE_EPOCH", "Date of the manual page that \\fBwarren man\\fR prints."}};

std::string paragraphs(std::span<const std::pair<std::string_view, std::string_view>> all) {
  std::string text;
  for (const auto& [head, body] : all) text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", head, body);
  return text;
}

constexpr std::string_view tail = R"(.SH FILES
Scenes are text, one item a line: \fIX1 Y1 X2 Y2\fR is a wall, further lines start with a word such as \fBstart\fR,
\fBgoal\fR, \fBclearance\fR, \fBmaze\fR, \fBbounds\fR or \fBrobot\fR. See file_formats.md in the documentation.
.SH EXAMPLES
.nf
warren solve maze:41x41 \-\-svg maze.svg \-\-json maze.json
warren generate maze 100x200 \-\-seed 7 \-o maze.npy
warren solve maze.npy \-\-sampler uniform \-\-budget 20s
warren verify maze:41x41 maze.json
.fi
.SH SEE ALSO
.BR rsvg\-convert (1)
)";

int man(const Arguments&) {
  std::string page = fmt::format(".TH WARREN 1 {} \"warren {}\" \"User Commands\"\n", page_date(), WARREN_VERSION);
  page += ".SH NAME\nwarren \\- motion planning by roadmaps\n.SH SYNOPSIS\n";
  page += text_of_commands([](const Command& c) {
    return fmt::format(".B warren {}\n.I {}\n[options]\n.br\n", c.name, escaped(c.operands));
  });
  page.append(description).append(".SH OPTIONS\n").append(text_of_commands(command_section, option_section));
  page.append(".SH EXIT STATUS\n").append(paragraphs(exit_codes));
  page.append(".SH ENVIRONMENT\n").append(paragraphs(variables)).append(tail);
  print_text(page);
  return exit_code::success;
}

}  // namespace

Command man_command() { return {"man", "", "print the manual page", {}, man}; }

}  // namespace warren

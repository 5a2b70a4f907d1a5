// SPDX-License-Identifier: BSD-3-Clause
// warren man: the manual page warren.1, made from the table of commands. SOURCE_DATE_EPOCH sets its date.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <optional>

#include "core/base/error.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/words/command.hpp"

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

void add_command(std::string& page, const Command& command) {
  page += fmt::format(".SS warren {} {}\n{}.\n", command.name, escaped(command.operands), escaped(command.summary));
  for (const OptionSpec& option : command.options) {
    const std::string short_name =
        option.short_name.empty() ? "" : fmt::format("\\fB{}\\fR, ", escaped(option.short_name));
    page += fmt::format(".TP\n{}\\fB{}\\fR{}\n{}", short_name, escaped(option.name),
                        option.value.empty() ? "" : fmt::format(" \\fI{}\\fR", escaped(option.value)),
                        escaped(option.help));
    page += option.choices.empty() ? ".\n" : fmt::format(".\nOne of: {}.\n", escaped(option.choices));
  }
}

constexpr std::string_view description = R"(.SH DESCRIPTION
\fBwarren\fR plans motions by roadmaps: it finds a path for a point or a disc through mazes and other worlds of walls,
verifies the path by code of its own that the search does not use, and says what the work took.
Results are the same for any number of threads.
.PP
\fIWORLD\fR is a file (scene text or a NumPy array of walls; its content decides), \fB\-\fR for standard input, or
\fBmaze:\fIROWS\fBx\fICOLS\fR[\fB,seed=\fIN\fR][\fB,algorithm=\fINAME\fR][\fB,loops=\fIF\fR].
)";

constexpr std::string_view tail = R"(.SH EXIT STATUS
.TP
\fB0\fR
success; for solve, a path that was verified.
.TP
\fB1\fR
no path (the status says which kind), or verify refutes the answer.
.TP
\fB2\fR
usage.
.TP
\fB65\fR
bad data in an input file.
.TP
\fB66\fR
an input can't be read.
.TP
\fB70\fR
internal error: please report it.
.TP
\fB73\fR
an output can't be written.
.TP
\fB124\fR
the time or memory budget ran out.
.TP
\fB129, 130, 143\fR
SIGHUP, SIGINT, SIGTERM.
.SH ENVIRONMENT
.TP
\fBNO_COLOR\fR, \fBCLICOLOR_FORCE\fR, \fBFORCE_COLOR\fR, \fBTERM\fR
Whether output is coloured; \fB\-\-color\fR wins.
.TP
\fBCOLUMNS\fR
Width of the progress bar's line.
.TP
\fBSOURCE_DATE_EPOCH\fR
Date of the manual page that \fBwarren man\fR prints.
.SH FILES
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
  for (const Command& command : command_table()) {
    page += fmt::format(".B warren {}\n.I {}\n[options]\n.br\n", command.name, escaped(command.operands));
  }
  page += description;
  page += ".SH OPTIONS\n";
  for (const Command& command : command_table()) add_command(page, command);
  page += tail;
  print_text(page);
  return exit_code::success;
}

}  // namespace

Command man_command() { return {"man", "", "print the manual page", {}, man}; }

}  // namespace warren

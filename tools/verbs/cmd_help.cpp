// SPDX-License-Identifier: BSD-3-Clause
// warren help: the verbs; one verb's options, as its --help; all options of all; or what an option or a word of the
// field is here. warren man: the manual pages, warren.1 and one a command (warren-solve.1), made from the table of
// commands. SOURCE_DATE_EPOCH sets their date.
#include <fmt/chrono.h>
#include <fmt/format.h>

#include <cstdlib>
#include <ctime>

#include "core/base/error.hpp"
#include "scenes/text/output_file_io.hpp"
#include "tools/screen/run_of_verb.hpp"
#include "tools/words/help.hpp"

namespace warren::tools {
namespace {

std::string help_text(const Arguments& arguments) {
  if (arguments.operand_count() == 0) return program_help();
  const std::string& word = arguments.operand(0);
  const bool is_more = arguments.operand_count() > 1;
  if (!is_more && (word == "all" || word == "--all")) {
    std::string text = program_help();
    for (const Command& command : command_table()) text += "\n\n" + command_help(command, terminal_width(), true);
    return text;
  }
  const bool is_all = is_more && (arguments.operand(1) == "all" || arguments.operand(1) == "--all");
  if (is_more && !is_all && find_command(word) == nullptr) {  // a word of two, such as potential field
    return word_help(word + ' ' + arguments.operand(1), command_table(), terminal_width());
  }
  if (is_more && !is_all) return word_help(arguments.operand(1), {&command_named(word), 1}, terminal_width());
  if (const Command* command = find_command(word)) return command_help(*command, terminal_width(), is_all);
  return word_help(word, command_table(), terminal_width());
}

int help(const Arguments& arguments) {
  print_text(help_text(arguments));
  return exit_code::success;
}

/// For troff: hyphens as typed, no leading dot or quote.
std::string escaped(std::string_view text) {
  std::string out;
  for (const char& c : text) out += c == '\\' ? "\\e" : c == '-' ? "\\-" : std::string_view(&c, 1);
  return out.starts_with('.') || out.starts_with('\'') ? "\\&" + out : out;
}

constexpr OptionSpec man_specs[] = {{"--folder", "FOLDER", "write all pages there instead, as files"}};

std::string head_of(std::string_view name, std::string_view summary) {
  std::string capitals{name};
  for (char& c : capitals) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  std::time_t when = std::time(nullptr);
  // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing here sets variables
  if (const char* epoch = std::getenv("SOURCE_DATE_EPOCH")) {
    constexpr long long last = 253'402'300'799;  // of year 9999
    when = std::clamp(std::strtoll(epoch, nullptr, 10), 0LL, last);
  }
  return fmt::format(".TH {} 1 {:%Y-%m-%d} \"warren {}\" \"User Commands\"\n.SH NAME\n{} \\- {}\n", escaped(capitals),
                     fmt::gmtime(when), WARREN_VERSION, escaped(name), escaped(summary));
}

std::string option_section(const OptionSpec& option) {
  const std::string_view name = option.short_name;
  const std::string value = option_usage(option).substr(option_usage(option).find(option.name) + option.name.size());
  return fmt::format(".TP\n{}\\fB{}\\fR{}\n{}.\n{}", name.empty() ? "" : fmt::format("\\fB{}\\fR, ", escaped(name)),
                     escaped(option.name), value.empty() ? "" : fmt::format(" \\fI{}\\fR", escaped(value.substr(1))),
                     escaped(option.help),
                     option.choices.empty() ? "" : fmt::format("One of: {}.\n", escaped(option.choices)));
}

std::string command_page(const Command& command) {
  std::string page = head_of(fmt::format("warren-{}", command.name), command.summary);
  page +=
      fmt::format(".SH SYNOPSIS\n.B warren {}\n.I {}\n[options]\n", escaped(command.name), escaped(command.operands));
  std::string operands;
  for (const std::string& operand : words_of(command.operands)) {
    if (const auto meaning = meaning_of(operand); !meaning.empty()) {
      operands += fmt::format(".TP\n\\fI{}\\fR\n{}.\n", escaped(operand), escaped(meaning));
    }
  }
  if (!operands.empty()) page += ".SH OPERANDS\n" + operands;
  if (!command.options.empty()) page += ".SH OPTIONS\n";
  for (const auto& [title, options] : grouped_options(command)) {
    page += fmt::format(".SS {}\n", escaped(title));
    for (const OptionSpec* option : options) page += option_section(*option);
  }
  page += ".SH EXAMPLES\n";
  for (const HelpExample& example : help_examples(command.name)) {
    page += fmt::format(".TP\n\\fB{}\\fR\n{}.\n", escaped(example.command), escaped(example.does));
  }
  return page + ".SH SEE ALSO\n.BR warren (1)\n";
}

constexpr std::string_view description = R"(.SH DESCRIPTION
\fBwarren\fR plans motions by roadmaps: it finds a path for a point, a disc, a polygon that turns, a car or an arm through
mazes, walls, polygons, occupancy maps or solids, verifies the path by code of its own that the search does not use, and
says what the work took.
Results are the same for any number of threads and on any processor.
.PP
\fIWORLD\fR is a file (scene text, NumPy array, GeoJSON, WKT, rings, Moving AI map, map_server YAML, image of a maze; its
content decides), \fB\-\fR for standard input, or
\fBmaze:\fIROWS\fBx\fICOLS\fR[\fB,seed=\fIN\fR][\fB,algorithm=\fINAME\fR][\fB,loops=\fIF\fR].
\fBwarren example\fR writes worlds to try things on.
)";

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
Scenes are text, one item a line: \fIX1 Y1 X2 Y2\fR is a wall, further lines start with a word such as \fBpolygon\fR,
\fBsphere\fR, \fBbox\fR, \fBbounds\fR, \fBrobot\fR, \fBstart\fR, \fBgoal\fR, \fBclearance\fR or \fBmaze\fR. See
file_formats.md in the documentation.
.SH EXAMPLES
.nf
warren solve maze:41x41 \-\-picture maze.svg \-\-json maze.json
warren verify maze:41x41 maze.json
warren generate polygons 50 \-\-seed 7 \-o town.scene
warren solve town.scene \-\-picture town.svg \-\-budget 20s
warren example parking\-lot
warren solve parking\-lot.scene \-\-optimise \-\-path drive.yaml \-\-speed 1.5
.fi
)";

std::string program_page() {
  std::string page = head_of("warren", "motion planning by roadmaps");
  page +=
      ".SH SYNOPSIS\n.B warren\n.I COMMAND\n[operands] [options]\n.br\n.B warren "
      "help\n[\\fICOMMAND\\fR|\\fIWORD\\fR]\n";
  page.append(description).append(".SH COMMANDS\n");
  std::string others;
  for (const auto& [title, commands] : grouped_commands()) {
    page += fmt::format(".SS {}\n", escaped(title));
    for (const Command* command : commands) {
      page += fmt::format(".TP\n\\fBwarren {}\\fR \\fI{}\\fR\n{}.\n", escaped(command->name),
                          escaped(command->operands), escaped(command->summary));
      others += fmt::format(".BR warren\\-{} (1),\n", escaped(command->name));
    }
  }
  page.append(".SH EXIT STATUS\n").append(paragraphs(exit_codes));
  page.append(".SH ENVIRONMENT\n").append(paragraphs(variables)).append(tail);
  return page + ".SH SEE ALSO\n" + others + ".BR rsvg\\-convert (1)\n";
}

int man(const Arguments& arguments) {
  const bool one = arguments.operand_count() > 0;
  const auto folder = arguments.value("--folder");
  if (one && folder) throw UsageError("--folder: takes all pages; leave out " + arguments.operand(0));
  if (!folder) {
    print_text(one ? command_page(command_named(arguments.operand(0))) : program_page());
    return exit_code::success;
  }
  write_file(*folder + "/warren.1", program_page(), {});
  for (const Command& command : command_table()) {
    write_file(fmt::format("{}/warren-{}.1", *folder, command.name), command_page(command), {});
  }
  return exit_code::success;
}

}  // namespace

Command help_command() {
  Command command{"help", "[COMMAND|WORD] [all|OPTION]", "explain a command, an option or a word", {}, help};
  command.takes_any_word = true;
  return command;
}

Command man_command() {
  return {"man", "[COMMAND]", "print the manual page of warren, or of a command", joined_options({man_specs}), man};
}

}  // namespace warren::tools

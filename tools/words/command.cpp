// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/command.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/printable.hpp"
#include "tools/words/help.hpp"

namespace warren::tools {

const OptionSpec* option_named(const Command& command, std::string_view name) {
  name = own_spelling(name);
  const auto found = std::find_if(command.options.begin(), command.options.end(), [&](const OptionSpec& option) {
    return name == option.name || (!option.short_name.empty() && name == option.short_name);
  });
  return found == command.options.end() ? nullptr : &*found;
}

std::vector<std::string> words_of(std::string_view text) {
  const std::vector<std::string_view> pieces = split(text, " ");
  std::vector<std::string> words(pieces.begin(), pieces.end());
  if (words.back().empty()) words.pop_back();
  return words;
}

bool is_among(std::string_view word, std::string_view words) { return std::ranges::count(words_of(words), word) > 0; }

Arguments::Arguments(const Command& command, std::span<const std::string> words) : verb_(command.name) {
  command_line_ = "warren " + std::string{command.name};
  for (const std::string& word : words) command_line_ += ' ' + word;
  bool options_ended = false;
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    const bool is_help = word == "--help" || word == "-h";
    if (options_ended || word.size() < 2 || word[0] != '-' || (command.takes_any_word && !is_help)) {
      operands_.push_back(word);
    } else if (word == "--") {
      options_ended = true;
    } else {
      take_option(command, words, i);
    }
  }
  if (!wants_help_) check_operands(command);
}

void Arguments::take_option(const Command& command, std::span<const std::string> words, std::size_t& i) {
  const std::string& word = words[i];
  const std::size_t equals = word.starts_with("--") ? word.find('=') : std::string::npos;
  const std::string name = word.substr(0, equals);
  if (name == "--help" || name == "-h") {
    wants_help_ = true;
    wants_all_help_ = word == "--help=all" || (i + 1 < words.size() && words[i + 1] == "all");
    return;
  }
  const OptionSpec* option = option_named(command, name);
  if (option == nullptr) {
    for (const auto& [foreign, why] : command.foreign) {
      if (own_spelling(name) == foreign) throw UsageError(fmt::format("{}: {}", name, why));
    }
    std::vector<std::string_view> known{"--help"};
    for (const OptionSpec& each : command.options) known.push_back(each.name);
    throw UsageError("unknown option " + name + suggestion(name, known));
  }
  if (has(option->name) && !option->may_repeat && !option->goes_on)
    throw UsageError(std::string{option->name} + ": given twice");
  if (option->value.empty() || option->value_optional) {
    if (option->value.empty() && equals != std::string::npos) {
      throw UsageError(std::string{option->name} + ": takes no value");
    }
    std::string value = equals != std::string::npos ? word.substr(equals + 1) : "";
    const bool is_gone = option->name == "--lazy" && i + 1 < words.size() && words[i + 1] == "path";  // refused by name
    const bool is_next = i + 1 < words.size() && (is_gone || is_among(words[i + 1], option->choices));
    if (equals == std::string::npos && is_next) value = words[++i];
    options_.emplace_back(option->name, std::move(value));
    return;
  }
  const std::vector<std::string> expected = words_of(option->value);
  for (std::size_t k = 0; k < expected.size(); ++k) {
    const bool is_inside = k == 0 && equals != std::string::npos;
    if (!is_inside && i + 1 == words.size()) {
      throw UsageError(std::string{option->name} + ": " + expected[k] + " is missing");
    }
    std::string value = is_inside ? word.substr(equals + 1) : words[++i];
    const auto before = std::find_if(options_.begin(), options_.end(),
                                     [&](const auto& given) { return option->goes_on && given.first == option->name; });
    if (before != options_.end()) {
      before->second += "; " + value;
    } else {
      options_.emplace_back(option->name, std::move(value));
    }
  }
}

void Arguments::check_operands(const Command& command) const {
  const std::vector<std::string> needed = words_of(command.operands);
  const bool complete = operands_.size() >= needed.size() || needed[operands_.size()].starts_with('[');
  if (!complete) throw UsageError(needed[operands_.size()] + " is missing");
  if (operands_.size() <= needed.size()) return;
  const std::string extra = "unexpected argument '" + operands_[needed.size()] + "'";
  if (operands_[0] == "maze") {
    const bool is_world = !needed.empty() && needed[0].find("WORLD") != std::string::npos;
    throw UsageError(extra + (is_world ? "; a maze is called maze:41x41" : "; its size is one word, 41x41"));
  }
  throw UsageError(extra + (options_.empty() ? "" : "; a value of several words is quoted: --robot \"disc 0.2\""));
}

std::optional<std::string> Arguments::value(std::string_view option) const {
  const std::vector<std::string> all = values(option);
  return all.empty() ? std::nullopt : std::optional(all.front());
}

std::vector<std::string> Arguments::values(std::string_view option) const {
  std::vector<std::string> all;
  for (const auto& [name, text] : options_) {
    if (name == option) all.push_back(text);
  }
  return all;
}

void Arguments::refuse(std::initializer_list<std::string_view> options, std::string_view why) const {
  for (const std::string_view option : options) {
    if (has(option)) throw UsageError(fmt::format("{}: {}", option, why));
  }
}

void Arguments::refuse(std::span<const OptionSpec> options, std::string_view why) const {
  for (const OptionSpec& option : options) refuse({option.name}, why);
}

Arguments Arguments::of(std::string_view option, std::string value) {
  Arguments one;
  one.options_.emplace_back(option, std::move(value));
  return one;
}

Arguments Arguments::without(std::span<const std::string_view> options) const {
  Arguments others = *this;
  std::erase_if(others.options_, [&](const auto& given) { return std::ranges::count(options, given.first) > 0; });
  return others;
}

const std::vector<Command>& command_table() {
  static const std::vector<Command> table{
      solve_command(),    verify_command(),     render_command(),  compare_command(), build_command(),
      query_command(),    update_command(),     export_command(),  serve_command(),   example_command(),
      generate_command(), info_command(),       convert_command(), largest_command(), scale_command(),
      profile_command(),  bench_scen_command(), help_command(),    man_command(),     completion_command()};
  return table;
}

const Command* find_command(std::string_view name) {
  const auto found = std::ranges::find(command_table(), name, &Command::name);
  return found == command_table().end() ? nullptr : &*found;
}

const Command& command_named(std::string_view name) {
  if (const Command* command = find_command(name)) return *command;
  std::vector<std::string_view> names{"--help", "--version"};
  for (const Command& command : command_table()) names.push_back(command.name);
  const bool is_world = name.starts_with("maze:") || name.find('.') != std::string_view::npos;
  if (is_world) throw UsageError(fmt::format("unknown command {0}; to find a path in a world: warren solve {0}", name));
  const std::string_view what = name.starts_with('-') ? "unknown option " : "unknown command ";
  throw UsageError(std::string{what} + std::string{name} + suggestion(name, names));
}

}  // namespace warren::tools

// SPDX-License-Identifier: BSD-3-Clause
// warren completion bash|zsh|fish: what a shell needs to complete our words, made from the table of commands.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "tools/screen/exit_code.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/verbs/example_files.hpp"
#include "tools/words/command.hpp"
#include "tools/words/help.hpp"
#include "tools/words/option_values.hpp"

namespace warren {
namespace {

std::string for_shell(std::string_view text) {  // inside single quotes of a shell
  std::string out;
  for (const char c : text) out += c == '\'' ? std::string{"'\\''"} : std::string(1, c);
  return out;
}

/// The words that a verb takes where others take files; none.
std::string operand_words(const Command& command) {
  if (command.name == "completion") return "bash zsh fish";
  if (command.name != "example") return {};
  std::set<std::string_view> names;  // of worlds, which may have several files
  for (const EmbeddedFile& file : example_files()) {
    if (file.name != "README.md") names.insert(file.name.substr(0, file.name.find('.')));
  }
  return fmt::format("{}", fmt::join(names, " "));
}

std::string bash_completion() {
  const auto choices = [](const Command& c, const OptionSpec& o) {
    return o.choices.empty() ? "" : fmt::format("      '{} {}') words='{}' ;;\n", c.name, o.name, o.choices);
  };
  const auto operands = [](const Command& c) {
    const std::string words = operand_words(c);
    return words.empty() ? "" : fmt::format("      '{0} {0}') words='{1}' ;;\n", c.name, words);
  };
  return "# bash completion for warren; install as /usr/share/bash-completion/completions/warren\n"
         "_warren() {\n"
         "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words=\n"
         "  if (( COMP_CWORD == 1 )); then\n"
         "    words=\"" +
         text_of_commands([](const Command& c) { return fmt::format("{} ", c.name); }) +
         "--help --version\"\n"
         "  else\n"
         "    case \"${COMP_WORDS[1]} $before\" in\n" +
         text_of_commands([](const Command&) { return ""; }, choices) + text_of_commands(operands) +
         "    esac\n"
         "    if [[ -z $words && $word == -* ]]; then\n"
         "      case ${COMP_WORDS[1]} in\n" +
         text_of_commands([](const Command& c) { return fmt::format("        {}) words='--help", c.name); },
                          [](const Command&, const OptionSpec& o) { return fmt::format(" {}", o.name); }, "' ;;\n") +
         "      esac\n    fi\n  fi\n"
         "  if [[ -n $words ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
         "  else\n"
         "    mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n"
         "  fi\n"
         "}\n"
         "complete -o filenames -F _warren warren\n";
}

std::string zsh_option(const Command&, const OptionSpec& option) {
  std::string help;  // brackets and colons mean something to _arguments
  for (const char c : option.help) help += c == '[' || c == ']' || c == ':' ? std::string{"\\"} + c : std::string(1, c);
  const std::string values = option.choices.empty() ? "_files" : fmt::format("({})", option.choices);
  std::string taken;
  for (const std::string& word : words_of(option.value)) taken += fmt::format(":{}:{}", for_shell(word), values);
  return fmt::format("        '{}{}[{}]{}' \\\n", option.name, taken.empty() ? "" : "=", for_shell(help), taken);
}

std::string zsh_completion() {
  const auto verb = [](const Command& c) { return fmt::format("      '{}:{}'\n", c.name, for_shell(c.summary)); };
  const auto head = [](const Command& c) {
    const std::string words = operand_words(c);
    return fmt::format("    {})\n      shift words; (( CURRENT-- ))\n      _arguments \\\n", c.name) +
           (words.empty() ? "" : fmt::format("        '1:word:({})' \\\n", words));
  };
  return "#compdef warren\n"
         "# zsh completion for warren; install as _warren in a folder of $fpath\n"
         "_warren() {\n"
         "  if (( CURRENT == 2 )); then\n"
         "    local -a verbs=(\n" +
         text_of_commands(verb) + "    )\n    _describe command verbs\n    return\n  fi\n  case ${words[2]} in\n" +
         text_of_commands(head, zsh_option, "        '*:file:_files'\n      ;;\n") + "  esac\n}\n_warren \"$@\"\n";
}

std::string fish_completion() {
  const auto verb = [](const Command& c) {
    const std::string words = operand_words(c);
    return fmt::format("complete -c warren -n __fish_use_subcommand -a {} -d '{}'\n", c.name, for_shell(c.summary)) +
           (words.empty()
                ? ""
                : fmt::format("complete -c warren -n '__fish_seen_subcommand_from {}' -f -a '{}'\n", c.name, words));
  };
  const auto option = [](const Command& c, const OptionSpec& o) {
    return fmt::format("complete -c warren -n '__fish_seen_subcommand_from {}' -l {}{}{}{} -d '{}'\n", c.name,
                       o.name.substr(2), o.short_name.empty() ? "" : fmt::format(" -s {}", o.short_name.substr(1)),
                       o.value.empty() ? "" : " -r", o.choices.empty() ? "" : fmt::format(" -f -a '{}'", o.choices),
                       for_shell(o.help));
  };
  return "# fish completion for warren; install in vendor_completions.d/warren.fish\n" + text_of_commands(verb) +
         text_of_commands([](const Command&) { return ""; }, option);
}

int completion(const Arguments& arguments) {
  constexpr std::string_view shells[] = {"bash", "zsh", "fish"};
  const std::size_t shell = choice_value("SHELL", arguments.operand(0), shells);
  print_text(shell == 0 ? bash_completion() : shell == 1 ? zsh_completion() : fish_completion());
  return exit_code::success;
}

}  // namespace

Command completion_command() {
  return {"completion", "SHELL", "print completions for bash, zsh or fish", {}, completion};
}

}  // namespace warren

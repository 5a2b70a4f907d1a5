// SPDX-License-Identifier: BSD-3-Clause
// warren completion bash|zsh|fish: what a shell needs to complete our words, made from the table of commands.
#include <fmt/format.h>

#include "core/base/error.hpp"
#include "tools/screen/exit_code.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/words/command.hpp"
#include "tools/words/option_values.hpp"

namespace warren {
namespace {

std::string names_of_commands() {
  std::string names;
  for (const Command& command : command_table()) names.append(names.empty() ? "" : " ").append(command.name);
  return names;
}

std::string names_of_options(const Command& command) {
  std::string names = "--help";
  for (const OptionSpec& option : command.options) names.append(" ").append(option.name);
  return names;
}

std::string for_shell(std::string_view text) {  // inside single quotes of a shell
  std::string out;
  for (const char c : text) out += c == '\'' ? std::string{"'\\''"} : std::string(1, c);
  return out;
}

std::string bash_completion() {
  std::string text =
      "# bash completion for warren; install as /usr/share/bash-completion/completions/warren\n"
      "_warren() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words=\n"
      "  if (( COMP_CWORD == 1 )); then\n"
      "    words=\"" +
      names_of_commands() +
      " --help --version\"\n"
      "  else\n"
      "    case \"${COMP_WORDS[1]} $before\" in\n";
  for (const Command& command : command_table()) {
    for (const OptionSpec& option : command.options) {
      if (option.choices.empty()) continue;
      text += fmt::format("      '{} {}') words='{}' ;;\n", command.name, option.name, option.choices);
    }
  }
  text +=
      "      'completion completion') words='bash zsh fish' ;;\n    esac\n    if [[ -z $words && $word == -* ]]; then\n"
      "      case ${COMP_WORDS[1]} in\n";
  for (const Command& command : command_table()) {
    text += fmt::format("        {}) words='{}' ;;\n", command.name, names_of_options(command));
  }
  return text +
         "      esac\n    fi\n  fi\n"
         "  if [[ -n $words ]]; then\n"
         "    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$word\")\n"
         "  else\n"
         "    mapfile -t COMPREPLY < <(compgen -f -- \"$word\")\n"
         "  fi\n"
         "}\n"
         "complete -o filenames -F _warren warren\n";
}

std::string zsh_completion() {
  std::string text =
      "#compdef warren\n"
      "# zsh completion for warren; install as _warren in a folder of $fpath\n"
      "_warren() {\n"
      "  if (( CURRENT == 2 )); then\n"
      "    local -a verbs=(\n";
  for (const Command& command : command_table()) {
    text += fmt::format("      '{}:{}'\n", command.name, for_shell(command.summary));
  }
  text += "    )\n    _describe command verbs\n    return\n  fi\n  case ${words[2]} in\n";
  for (const Command& command : command_table()) {
    text += fmt::format("    {})\n      shift words; (( CURRENT-- ))\n      _arguments \\\n", command.name);
    for (const OptionSpec& option : command.options) {
      std::string help;  // brackets and colons mean something to _arguments
      for (const char c : option.help)
        help += c == '[' || c == ']' || c == ':' ? std::string{"\\"} + c : std::string(1, c);
      const bool takes = !option.value.empty();
      const std::string values = option.choices.empty() ? "_files" : fmt::format("({})", option.choices);
      text += fmt::format("        '{}{}[{}]{}' \\\n", option.name, takes ? "=" : "", for_shell(help),
                          takes ? fmt::format(":{}:{}", for_shell(option.value), values) : "");
    }
    text += "        '*:file:_files'\n      ;;\n";
  }
  return text + "  esac\n}\n_warren \"$@\"\n";
}

std::string fish_completion() {
  std::string text = "# fish completion for warren; install in vendor_completions.d/warren.fish\n";
  for (const Command& command : command_table()) {
    text += fmt::format("complete -c warren -n __fish_use_subcommand -a {} -d '{}'\n", command.name,
                        for_shell(command.summary));
  }
  for (const Command& command : command_table()) {
    for (const OptionSpec& option : command.options) {
      text += fmt::format(
          "complete -c warren -n '__fish_seen_subcommand_from {}' -l {}{}{}{} -d '{}'\n", command.name,
          option.name.substr(2), option.short_name.empty() ? "" : fmt::format(" -s {}", option.short_name.substr(1)),
          option.value.empty() ? "" : " -r", option.choices.empty() ? "" : fmt::format(" -f -a '{}'", option.choices),
          for_shell(option.help));
    }
  }
  return text;
}

int completion(const Arguments& arguments) {
  constexpr std::string_view shells[] = {"bash", "zsh", "fish"};
  switch (choice_value("SHELL", arguments.operand(0), shells)) {
    case 0:
      print_text(bash_completion());
      break;
    case 1:
      print_text(zsh_completion());
      break;
    default:
      print_text(fish_completion());
  }
  return exit_code::success;
}

}  // namespace

Command completion_command() {
  return {"completion", "SHELL", "print completions for bash, zsh or fish", {}, completion};
}

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// warren completion bash|zsh|fish: what a shell needs to complete our words. The scripts ask the program itself, by
// `warren complete WORDS` (tools/verbs/completions.hpp), and add the names of files, which shells know better.
#include "tools/screen/exit_code.hpp"
#include "tools/screen/terminal.hpp"
#include "tools/words/command.hpp"
#include "tools/words/option_values.hpp"

namespace warren::tools {
namespace {

// Bash splits words at "=" and ":" where COMP_WORDBREAKS has them, and replaces only what stands behind the last of
// these: words are joined again as they stand in the line, and what bash keeps is cut off the answers.
constexpr std::string_view bash_script =
    R"(# bash completion for warren; install as share/bash-completion/completions/warren
_warren() {
  local line=${COMP_LINE:0:${COMP_POINT:-0}} i word before=' ' lines=() words=() IFS=$' \t\n'
  for (( i = 0; i <= COMP_CWORD; i++ )); do
    word=${COMP_WORDS[i]}
    if [[ $before == *[=:] || $word == [=:]* ]] && (( i > 1 )) && [[ -z $line || $line != [[:space:]]* ]]; then
      words[${#words[@]}-1]+=$word
    else
      words+=("$word")
    fi
    line=${line#"${line%%[![:space:]]*}"}
    line=${line#"$word"}
    before=$word
  done
  local typed=${words[${#words[@]}-1]} kept= answer file found=() told
  mapfile -t lines < <("${words[0]}" complete "${words[@]:1}" 2>/dev/null)
  (( ${#lines[@]} )) || return 0
  told=${lines[${#lines[@]}-1]}
  unset "lines[${#lines[@]}-1]"
  [[ $typed == *[=:]* && $COMP_WORDBREAKS == *[=:]* ]] && kept=${typed%"${typed##*[=:]}"}
  COMPREPLY=()
  for answer in "${lines[@]}"; do
    answer=${answer%%$'\t'*}
    COMPREPLY+=("${answer#"$kept"}")
  done
  local prefix=${told#* }
  told=${told%% *}
  case $told in
    *f*) mapfile -t found < <(compgen -f -- "${typed#"$prefix"}") ;;
    *d*) mapfile -t found < <(compgen -d -- "${typed#"$prefix"}") ;;
  esac
  for file in "${found[@]}"; do
    file=$prefix$file
    COMPREPLY+=("${file#"$kept"}")
  done
  (( ${#found[@]} )) && compopt -o filenames 2>/dev/null
  [[ $told == *n* ]] && compopt -o nospace 2>/dev/null
  return 0
}
complete -F _warren warren
)";

constexpr std::string_view zsh_script = R"(#compdef warren
# zsh completion for warren; install as _warren in a folder of $fpath
_warren() {
  local -a lines told described
  local line prefix
  lines=("${(@f)$(${words[1]} complete "${(@)words[2,CURRENT]}" 2>/dev/null)}")
  (( ${#lines} )) || return 1
  told=${lines[-1]%% *}
  prefix=${lines[-1]#* }
  for line in "${(@)lines[1,-2]}"; do
    described+=("${${line%%$'\t'*}//:/\\:}${${(M)line:#*$'\t'*}:+:${line#*$'\t'}}")
  done
  if (( ${#described} )); then
    if [[ $told == *n* ]]; then
      _describe -V warren described -S ''
    else
      _describe -V warren described
    fi
  fi
  [[ -n $prefix ]] && compset -P "${(b)prefix}"
  if [[ $told == *f* ]]; then
    _files
  elif [[ $told == *d* ]]; then
    _files -/
  fi
}
_warren "$@"
)";

constexpr std::string_view fish_script = R"(# fish completion for warren; install in vendor_completions.d/warren.fish
function __warren_complete
  set -l words (commandline -opc)
  set -l typed (commandline -ct)
  set -l lines ($words[1] complete $words[2..-1] "$typed" 2>/dev/null)
  test (count $lines) -gt 0; or return
  for line in $lines[1..-2]
    echo $line
  end
  set -l told (string split -m 1 ' ' -- $lines[-1])
  set -l rest (string sub -s (math 1 + (string length -- "$told[2]")) -- "$typed")
  if string match -q '*f*' -- $told[1]
    for file in (__fish_complete_path "$rest")
      echo $told[2]$file
    end
  else if string match -q '*d*' -- $told[1]
    for file in (__fish_complete_directories "$rest" '')
      echo $told[2]$file
    end
  end
end
complete -c warren -f -a '(__warren_complete)'
)";

int completion(const Arguments& arguments) {
  constexpr std::string_view shells[] = {"bash", "zsh", "fish"};
  constexpr std::string_view scripts[] = {bash_script, zsh_script, fish_script};
  print_text(scripts[choice_value("SHELL", arguments.operand(0), shells)]);
  return exit_code::success;
}

}  // namespace

Command completion_command() {
  return {"completion", "SHELL", "print completions for bash, zsh or fish", {}, completion};
}

}  // namespace warren::tools

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/screen/terminal.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <system_error>

#include "core/base/error.hpp"

namespace warren::tools {
namespace {

std::string_view environment(const char* name) {
  const char* value = std::getenv(name);  // NOLINT(concurrency-mt-unsafe): nothing here sets variables
  return value == nullptr ? std::string_view{} : std::string_view{value};
}

bool forces(std::string_view value) { return !value.empty() && value != "0"; }

}  // namespace

bool wants_color(int descriptor, ColorMode mode) {
  if (mode != ColorMode::automatic) return mode == ColorMode::always;
  if (!environment("NO_COLOR").empty()) return false;
  if (forces(environment("CLICOLOR_FORCE")) || forces(environment("FORCE_COLOR"))) return true;
  return environment("TERM") != "dumb" && ::isatty(descriptor) == 1;
}

ProgressMode resolved(ProgressMode mode) {
  if (mode != ProgressMode::automatic) return mode;
  const bool can_erase = ::isatty(STDERR_FILENO) == 1 && environment("TERM") != "dumb";
  return can_erase ? ProgressMode::bar : ProgressMode::none;
}

std::size_t terminal_width() {
  constexpr std::size_t usual = 80;
  const int columns = std::atoi(std::string{environment("COLUMNS")}.c_str());
  if (columns > 0) return static_cast<std::size_t>(columns);
  winsize size{};
  if (::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0) return size.ws_col;
  return usual;
}

void print_text(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size()) return;
  throw WriteError("standard output", std::generic_category().message(errno));
}

}  // namespace warren::tools

// SPDX-License-Identifier: BSD-3-Clause
// Runs the program as a user does and keeps what it says.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <memory>
#include <string>

#include "tests/paths.hpp"

namespace warren {

struct ProgramRun {
  int exit_code = -1;
  std::string out;
};

/// `words` go through the shell; standard error is joined to the output only where they say "2>&1".
inline ProgramRun run_program(const std::string& words) {
  const std::string command = test::program() + " " + words;
  std::FILE* pipe = ::popen(command.c_str(), "r");
  ProgramRun run;
  if (pipe == nullptr) return run;
  std::array<char, 4096> buffer{};
  for (std::size_t n = 0; (n = std::fread(buffer.data(), 1, buffer.size(), pipe)) > 0;)
    run.out.append(buffer.data(), n);
  const int status = ::pclose(pipe);
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return run;
}

}  // namespace warren

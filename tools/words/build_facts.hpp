// SPDX-License-Identifier: BSD-3-Clause
// Which build this is: what `warren --version` says beyond the version.
#pragma once

#include <string>
#include <string_view>

namespace warren::tools {

/// The commit that the sources are of, with "-dirty" where they differ from it; "unknown" where they came without git.
/// Made anew by each build (cmake/commit.cmake) and linked into the program alone.
std::string_view build_commit();

/// "g++ 12.2.0, Release".
std::string build_compiler();

/// "x86-64; used here: avx2": what the code needs, and what it takes beside that where the processor has it.
std::string build_instruction_sets();

}  // namespace warren::tools

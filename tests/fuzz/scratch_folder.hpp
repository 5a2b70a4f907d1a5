// SPDX-License-Identifier: BSD-3-Clause
// Where a fuzzed reader's files go: a folder of this process below TMPDIR, in memory where nothing else is said.
#pragma once

#include <string>
#include <string_view>

namespace warren::fuzz {

/// The path of a file there; the folder is made by the first call and goes when the program ends well.
std::string scratch_file(std::string_view name);

/// Writes a file there and returns its path.
std::string write_scratch(std::string_view name, std::string_view bytes);

}  // namespace warren::fuzz

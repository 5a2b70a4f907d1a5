// SPDX-License-Identifier: BSD-3-Clause
// Names of output files: what their endings say, and whether they can be written, asked before a long computation.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "tools/arguments.hpp"

namespace warren {

/// Throws WriteError if `path` can't be written as things stand. Creates and changes nothing.
void check_writable(const std::string& path);

/// The file that an option names, if it is given; check_writable has been asked.
std::optional<std::string> output_file(const Arguments& arguments, std::string_view option);

/// ".svg" of "a.SVG", in lower case; "" where there is none.
std::string ending_of(const std::string& path);

}  // namespace warren

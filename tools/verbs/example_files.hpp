// SPDX-License-Identifier: BSD-3-Clause
// The files of examples/worlds, whose bytes the build puts into the program.
#pragma once

#include <span>

#include "core/base/embedded_file.hpp"

namespace warren::tools {

/// By name; README.md, whose table says what to see, is one of them.
std::span<const EmbeddedFile> example_files();

}  // namespace warren::tools

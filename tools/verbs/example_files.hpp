// SPDX-License-Identifier: BSD-3-Clause
// The files of examples/worlds, whose bytes the build puts into the program (cmake/embed_files.cmake).
#pragma once

#include <span>
#include <string_view>

namespace warren {

struct ExampleFile {
  std::string_view name;  ///< "flat.pgm"
  std::string_view bytes;
};

/// By name; README.md, whose table says what to see, is one of them.
std::span<const ExampleFile> example_files();

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// A file whose bytes the build has put into the program (cmake/WarrenEmbed.cmake).
#pragma once

#include <string_view>

namespace warren {

struct EmbeddedFile {
  std::string_view name;  ///< "flat.pgm"
  std::string_view bytes;
  std::string_view sha256;  ///< of the bytes, as 64 hex digits
};

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
#include "tests/paths.hpp"

#include <cstdlib>

namespace warren::test {

std::string source_dir() { return WARREN_SOURCE_DIR; }
std::string program() {
  const char* const other = std::getenv("WARREN_PROGRAM");
  return other != nullptr ? other : WARREN_PROGRAM;
}

}  // namespace warren::test

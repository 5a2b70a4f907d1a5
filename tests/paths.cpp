// SPDX-License-Identifier: BSD-3-Clause
#include "tests/paths.hpp"

namespace warren::test {

std::string source_dir() { return WARREN_SOURCE_DIR; }
std::string program() { return WARREN_PROGRAM; }

}  // namespace warren::test

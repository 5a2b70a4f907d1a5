// SPDX-License-Identifier: BSD-3-Clause
// Where this build and its tree lie. Only paths.cpp knows the names, so that all other objects are the same for every
// checkout and a compiler cache serves them all.
#pragma once

#include <string>

namespace warren::test {

std::string source_dir();  ///< the root of the tree
std::string program();  ///< the program `warren` of this build, or the one that the environment's WARREN_PROGRAM names

}  // namespace warren::test

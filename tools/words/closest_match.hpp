// SPDX-License-Identifier: BSD-3-Clause
// What is said of a word that nobody knows: what it is here, where it is one of the field's (other_names.hpp), else
// "did you mean" the known word with the smallest edit distance.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace warren::tools {

/// "; WHAT IT IS HERE", or "; did you mean KNOWN?" for the earliest of the closest known words, or for one that begins
/// so. Capitals and dashes before it count nothing; "" if more than a third of the letters would have to change.
std::string suggestion(std::string_view word, std::span<const std::string_view> known);

}  // namespace warren::tools

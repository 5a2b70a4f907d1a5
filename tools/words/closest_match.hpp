// SPDX-License-Identifier: BSD-3-Clause
// "did you mean": the known word with the smallest edit distance (insert, delete, replace, swap of neighbours).
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace warren::tools {

/// Optimal string alignment distance. O(length a × length b).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// "; did you mean KNOWN?" for the closest of the known words, which is the earliest of equals; "" if all are farther
/// than `farthest`.
std::string suggestion(std::string_view word, std::span<const std::string_view> known,
                       std::size_t farthest = std::string_view::npos);

}  // namespace warren::tools

// SPDX-License-Identifier: BSD-3-Clause
// How deep JSON is nested, before anybody parses it: a parser's stack is not for strangers to choose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace warren::serve {

inline constexpr std::size_t deepest_json = 8;

/// Is each line a text of its own, or is it the whole?
enum class NestedIn : std::uint8_t { lines, whole };

/// How deep brackets and braces lie in each other, in the deepest line or in the whole.
std::size_t nesting_of(std::string_view text, NestedIn what = NestedIn::lines);

}  // namespace warren::serve

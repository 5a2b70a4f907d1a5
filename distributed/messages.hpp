// SPDX-License-Identifier: BSD-3-Clause
// What rank 0 asks of the others, and how they answer. Rank 0 leads: it sends the same request to all, does its own
// share, and takes the others' answers; nobody else ever speaks first. So no two ranks wait for each other, and a
// message that comes to a rank at work can only be the end.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace warren::distributed {

/// The stages of a run, as messages name them.
enum class Request : std::uint32_t { make, turn, reduce, hand_over, rounds, steps, judge, read, end };
inline constexpr std::size_t request_count = 9;
constexpr auto enum_names(Request) {
  return std::array<std::string_view, request_count>{"generate", "join",   "connect", "gather", "rounds",
                                                     "expand",   "verify", "search",  "end"};
}

/// How an answer begins: what follows is what was asked for, a StopReason, or the line of an error. Alone stand the
/// answer to Request::end, and what a rank says last of all.
enum class Reply : std::uint32_t { done, stopped, refused, ended, gone };

}  // namespace warren::distributed

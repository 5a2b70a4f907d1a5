// SPDX-License-Identifier: BSD-3-Clause
// What is known of each edge of a roadmap, two bits an edge end: the states of an edge's two ends are the same, so that
// a search looks its edge up where it finds it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace warren {

/// unchecked: a candidate that nobody has asked about. free, blocked: the world has answered.
enum class EdgeState : std::uint8_t { unchecked, free, blocked };
constexpr auto enum_names(EdgeState) { return std::array<std::string_view, 3>{"unchecked", "free", "blocked"}; }

/// Edge ends in one word of states: end i has bits 2 (i mod 32) and the next of word i / 32; the bits after the last
/// are zero.
inline constexpr std::size_t edge_states_in_word = 32;

constexpr std::size_t edge_state_words(std::size_t ends) {
  return (ends + edge_states_in_word - 1) / edge_states_in_word;
}

constexpr EdgeState edge_state(std::span<const std::uint64_t> words, std::size_t end) {
  return static_cast<EdgeState>(words[end / edge_states_in_word] >> (2 * (end % edge_states_in_word)) & 3U);
}

constexpr void set_edge_state(std::span<std::uint64_t> words, std::size_t end, EdgeState state) {
  const std::size_t shift = 2 * (end % edge_states_in_word);
  std::uint64_t& word = words[end / edge_states_in_word];
  word = (word & ~(std::uint64_t{3} << shift)) | static_cast<std::uint64_t>(state) << shift;
}

}  // namespace warren

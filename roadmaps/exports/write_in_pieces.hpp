// SPDX-License-Identifier: BSD-3-Clause
// Long texts, made piece by piece on all cores and written in their order: a file of any size goes through 16 pieces of
// memory, and its bytes are the same for any number of threads.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <string>

#include "parallel/chunks.hpp"

namespace warren {

/// Vertices in a piece: at most half a megabyte of text.
inline constexpr std::size_t vertices_a_piece = 2048;

/// Calls make(Range, std::string&), which appends, for each piece of `grain` indices of 0 .. n - 1, and sink.write()
/// with what it made, one after the other. Throws Stopped, and as make and the sink do.
template <class Sink, class Make>
void write_in_pieces(Sink& sink, std::size_t n, std::size_t grain, const Execution& execution, const Make& make) {
  constexpr std::size_t pieces_at_once = 16;
  std::array<std::string, pieces_at_once> texts;
  std::array<std::exception_ptr, pieces_at_once> errors;  // the first by number, not by time
  for (std::size_t begin = 0; begin < n; begin += pieces_at_once * grain) {
    const std::size_t count = std::min(pieces_at_once * grain, n - begin);
    for_chunks(count, grain, execution, [&](Range range) {
      std::string& text = texts[range.first / grain];
      text.clear();
      try {
        make(Range{begin + range.first, begin + range.last}, text);
      } catch (...) {
        errors[range.first / grain] = std::current_exception();
      }
    });
    for (std::size_t piece = 0; piece < chunk_count(count, grain); ++piece) {
      if (errors[piece]) std::rethrow_exception(errors[piece]);
      sink.write(texts[piece]);
    }
  }
}

}  // namespace warren

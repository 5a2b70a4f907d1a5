// SPDX-License-Identifier: BSD-3-Clause
#include "planners/lengths/cell_marks.hpp"

#include "parallel/chunks.hpp"
#include "planners/lengths/core_graph.hpp"

namespace warren {

RawVector<std::uint64_t> mark_words(const RawVector<std::uint8_t>& peeled, const LatticePlaces& places,
                                    const Execution& execution) {
  const std::size_t rows = places.place_count() / 64;
  execution.reserve(rows * mark_word::count * sizeof(std::uint64_t));
  RawVector<std::uint64_t> words(rows * mark_word::count);
  constexpr std::size_t grain = 1024;
  for_chunks(rows, grain, execution, [&](Range r) {
    for (std::size_t row = r.first; row < r.last; ++row) {
      const std::uint8_t* const bytes = peeled.data() + row * 64;
      std::uint64_t low = 0;
      std::uint64_t high = 0;
      std::uint64_t off = 0;
      for (unsigned i = 0; i < 64; ++i) {
        low |= std::uint64_t{bytes[i] >> 4 & 1U} << i;
        high |= std::uint64_t{bytes[i] >> 5 & 1U} << i;
        off |= std::uint64_t{bytes[i] >> 6 & 1U} << i;
      }
      std::uint64_t* const out = words.data() + row * mark_word::count;
      out[mark_word::low] = low;
      out[mark_word::high] = high;
      out[mark_word::core] = ~off;
    }
  });
  return words;
}

}  // namespace warren

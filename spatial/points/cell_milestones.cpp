// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/points/cell_milestones.hpp"

#include <bit>
#include <vector>

#include "core/base/whole.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

/// The free cells of a row as words, with a blocked word before and after; rows outside of the map are blocked.
class FreeRow {
 public:
  FreeRow(const Bitmap& blocked, std::int64_t y) : words_((blocked.width() + 63) / 64 + 2, 0) {
    if (y < 0 || y >= blocked.height()) return;
    const auto row = blocked.row(as_whole<std::uint32_t>(y));
    for (std::size_t w = 0; w < row.size(); ++w) words_[w + 1] = ~row[w];
    if (blocked.width() % 64 != 0) words_[row.size()] &= (std::uint64_t{1} << blocked.width() % 64) - 1;
  }
  std::uint64_t here(std::size_t w) const { return words_[w + 1]; }
  /// Is the cell left, or right, of each free?
  std::uint64_t left(std::size_t w) const { return words_[w + 1] << 1 | words_[w] >> 63; }
  std::uint64_t right(std::size_t w) const { return words_[w + 1] >> 1 | words_[w + 2] << 63; }

 private:
  std::vector<std::uint64_t> words_;
};

constexpr std::size_t rows_a_chunk = 64;

}  // namespace

Bitmap cell_milestones(const Bitmap& blocked, const Execution& execution) {
  Bitmap kept(blocked.width(), blocked.height());
  execution.reserve(kept.bytes());
  constexpr std::uint64_t odd_columns = 0xAAAAAAAAAAAAAAAAU;
  for_chunks(blocked.height(), rows_a_chunk, execution, [&](Range r) {
    for (std::size_t y = r.first; y < r.last; ++y) {
      const auto number = as_whole<std::int64_t>(y);
      const FreeRow below(blocked, number - 1);
      const FreeRow row(blocked, number);
      const FreeRow above(blocked, number + 1);
      const auto out = kept.row(as_whole<std::uint32_t>(y));
      for (std::size_t w = 0; w < out.size(); ++w) {
        const std::uint64_t sides = row.left(w) & row.right(w);
        const std::uint64_t ends = below.here(w) & above.here(w);
        const std::uint64_t level = sides & ~(below.here(w) | above.here(w));
        const std::uint64_t upright = ends & ~(row.left(w) | row.right(w));
        const std::uint64_t left_out = (level | upright) & (y % 2 == 0 ? odd_columns : ~odd_columns);
        out[w] = row.here(w) & ~left_out;
      }
    }
  });
  return kept;
}

bool is_narrow(const Bitmap& blocked) {
  if (blocked.empty()) return false;
  std::uint64_t free = 0;
  std::uint64_t wide = 0;
  FreeRow below(blocked, -1);
  FreeRow row(blocked, 0);
  for (std::int64_t y = 0; y < blocked.height(); ++y) {
    FreeRow above(blocked, y + 1);
    for (std::size_t w = 0; w < blocked.row(0).size(); ++w) {
      const auto square = [&](const FreeRow& other) {
        return (row.left(w) & other.here(w) & other.left(w)) | (row.right(w) & other.here(w) & other.right(w));
      };
      free += as_whole<std::uint64_t>(std::popcount(row.here(w)));
      wide += as_whole<std::uint64_t>(std::popcount(row.here(w) & (square(below) | square(above))));
    }
    below = std::move(row);
    row = std::move(above);
  }
  return 2 * wide < free;
}

}  // namespace warren

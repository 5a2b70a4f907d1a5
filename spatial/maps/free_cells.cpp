// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/maps/free_cells.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

constexpr std::array<std::uint8_t, 512> steps_of(StepRule rule) {
  std::array<std::uint8_t, 512> table{};
  for (unsigned around = 0; around < table.size(); ++around) {
    const auto is_free = [&](int dx, int dy) { return (around >> (3 * (dy + 1) + dx + 1) & 1U) != 0; };
    unsigned allowed = 0;
    for (unsigned s = 0; s < cell_steps.size(); ++s) {
      const auto [dx, dy] = cell_steps[s];
      bool may = is_free(dx, dy);
      if (is_diagonal(s) && rule == StepRule::four) may = false;
      if (is_diagonal(s) && rule == StepRule::eight) may = may && is_free(dx, 0) && is_free(0, dy);
      allowed |= may ? 1U << s : 0U;
    }
    table[around] = as_whole<std::uint8_t>(allowed);
  }
  return table;
}

constexpr std::uint32_t tile = 64;
constexpr double least_drop = 0.6;

bool is_ridge(const DistanceField& field, double least, std::uint32_t x, std::uint32_t y) {
  const double here = field.distance(x, y);
  if (!(here > 0.0 && here >= least)) return false;
  const auto drop_to = [&](std::int64_t col, std::int64_t row) {  // what lies outside of the map is blocked
    if (col < 0 || row < 0 || col >= field.width() || row >= field.height()) return here;
    return here - field.distance(as_whole<std::uint32_t>(col), as_whole<std::uint32_t>(row));
  };
  constexpr std::array<std::array<int, 2>, 4> axes{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
  return std::any_of(axes.begin(), axes.end(), [&](const std::array<int, 2>& axis) {
    const double way = axis[1] == 0 || axis[0] == 0 ? 1.0 : std::sqrt(2.0);
    const double before = drop_to(std::int64_t{x} - axis[0], std::int64_t{y} - axis[1]);
    const double after = drop_to(std::int64_t{x} + axis[0], std::int64_t{y} + axis[1]);
    return before >= 0.0 && after >= 0.0 && before + after >= least_drop * way;
  });
}

/// The ridge cells of a band of rows, tile by tile.
std::vector<std::uint32_t> places_of(const DistanceField& field, double least, std::uint32_t first_row,
                                     const Execution& execution) {
  std::vector<std::uint32_t> places;
  const std::uint32_t last_row = std::min(first_row + tile, field.height());
  for (std::uint32_t first = 0; first < field.width(); first += tile) {
    execution.check();
    const std::uint32_t last = std::min(first + tile, field.width());
    for (std::uint32_t y = first_row; y < last_row; ++y) {
      for (std::uint32_t x = first; x < last; ++x) {
        if (is_ridge(field, least, x, y)) push_asked(places, y * field.width() + x, execution);
      }
    }
  }
  return places;
}

}  // namespace

FreeCells::FreeCells(const Bitmap& blocked, const Execution& execution)
    : width_(blocked.width()), height_(blocked.height()), stride_((blocked.width() / 64 + 1) * 64) {
  per_stride_ = 1.0 / stride_;
  const std::uint64_t end = (std::uint64_t{height_} + 2) * stride_ + std::uint64_t{2} * margin;
  if (end >= std::numeric_limits<VertexId>::max()) {
    throw InputError("map", "has too many cells for a grid search: 2^32 with the margin");
  }
  number_end_ = end;
  execution.reserve((end / 64 + 2) * sizeof(std::uint64_t));
  assign_polled(words_, end / 64 + 2, std::uint64_t{0}, [&] { execution.check(); });
  const std::size_t row_words = stride_ / 64;
  for (std::uint32_t y = 0; y < height_; ++y) {
    execution.poll(y);
    const auto from = blocked.row(y);
    std::uint64_t* to = words_.data() + (y + 1) * row_words + margin / 64;
    for (std::size_t w = 0; w < from.size(); ++w) to[w] = ~from[w];
    if (width_ % 64 != 0) to[from.size() - 1] &= (std::uint64_t{1} << width_ % 64) - 1;
  }
}

Bitmap transposed(const Bitmap& bitmap, const Execution& execution) {
  execution.reserve(Bitmap::bytes_for(bitmap.height(), bitmap.width()));
  Bitmap result(bitmap.height(), bitmap.width(), false, [&] { execution.check(); });
  for (std::uint32_t y = 0; y < bitmap.height(); ++y) {
    if (y % 16 == 0) execution.check();
    bitmap.for_each_in_row(y, [&](std::uint32_t x) { result.set(y, x); });
  }
  return result;
}

const std::array<std::uint8_t, 512>& allowed_steps(StepRule rule) {
  static constexpr std::array<std::uint8_t, 512> tables[] = {steps_of(StepRule::four), steps_of(StepRule::eight),
                                                             steps_of(StepRule::eight_squeezing)};
  return tables[as_whole<std::size_t>(rule)];
}

CorridorCells::CorridorCells(const DistanceField& field, double least, const Execution& execution)
    : width_(field.width()) {
  execution.reserve(Bitmap::bytes_for(field.width(), field.height()));
  ridge_ = Bitmap(field.width(), field.height(), false, [&] { execution.check(); });
  const auto bands = parts_of_chunks((field.height() + tile - 1) / tile, 1, execution, [&](Range r) {
    return places_of(field, least, as_whole<std::uint32_t>(r.first) * tile, execution);
  });
  std::size_t count = 0;
  for (const auto& band : bands) count += band.size();
  execution.reserve(count * (sizeof(std::uint32_t) + sizeof(double)));
  places_.reserve(count);
  weight_sums_.reserve(count);
  double sum = 0.0;
  for (const auto& band : bands) {
    execution.check();
    for (const std::uint32_t place : band) {
      sum += 1.0 / field.distance(place % width_, place / width_);
      places_.push_back(place);
      ridge_.set(place % width_, place / width_);
      weight_sums_.push_back(sum);
    }
  }
}

CorridorCells::Place CorridorCells::at(double share) const {
  const auto found = std::upper_bound(weight_sums_.begin(), weight_sums_.end(), share * weight_sums_.back());
  const auto i = std::min<std::size_t>(as_whole<std::size_t>(found - weight_sums_.begin()), places_.size() - 1);
  const double weight = i == 0 ? weight_sums_[0] : weight_sums_[i] - weight_sums_[i - 1];
  return {{places_[i] % width_, places_[i] / width_}, 1.0 / weight};
}

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
  execution.reserve(blocked.bytes());
  Bitmap kept(blocked.width(), blocked.height(), false, [&] { execution.check(); });
  constexpr std::uint64_t odd_columns = 0xAAAAAAAAAAAAAAAAU;
  for_each_index(blocked.height(), rows_a_chunk, execution, [&](std::size_t y) {
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
  });
  return kept;
}

bool is_narrow(const Bitmap& blocked, const Execution& execution) {
  if (blocked.empty()) return false;
  std::uint64_t free = 0;
  std::uint64_t wide = 0;
  FreeRow below(blocked, -1);
  FreeRow row(blocked, 0);
  for (std::int64_t y = 0; y < blocked.height(); ++y) {
    execution.check();
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

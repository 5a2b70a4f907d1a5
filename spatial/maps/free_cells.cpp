// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/maps/free_cells.hpp"

#include <bit>
#include <limits>

#include "core/base/error.hpp"

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

}  // namespace

FreeCells::FreeCells(const Bitmap& blocked)
    : width_(blocked.width()), height_(blocked.height()), stride_((blocked.width() / 64 + 1) * 64) {
  per_stride_ = 1.0 / stride_;
  const std::uint64_t end = (std::uint64_t{height_} + 2) * stride_ + std::uint64_t{2} * margin;
  if (end >= std::numeric_limits<VertexId>::max()) {
    throw InputError("map", "has too many cells for a grid search: 2^32 with the margin");
  }
  number_end_ = end;
  words_.assign(end / 64 + 2, 0);
  const std::size_t row_words = stride_ / 64;
  for (std::uint32_t y = 0; y < height_; ++y) {
    const auto from = blocked.row(y);
    std::uint64_t* to = words_.data() + (y + 1) * row_words + margin / 64;
    for (std::size_t w = 0; w < from.size(); ++w) to[w] = ~from[w];
    if (width_ % 64 != 0) to[from.size() - 1] &= (std::uint64_t{1} << width_ % 64) - 1;
  }
}

Bitmap transposed(const Bitmap& bitmap, const Execution& execution) {
  Bitmap result(bitmap.height(), bitmap.width());
  for (std::uint32_t y = 0; y < bitmap.height(); ++y) {
    if (y % 16 == 0) execution.check();
    const auto words = bitmap.row(y);
    for (std::uint32_t w = 0; w < words.size(); ++w) {
      for (std::uint64_t rest = words[w]; rest != 0; rest &= rest - 1) {
        result.set(y, 64 * w + as_whole<std::uint32_t>(std::countr_zero(rest)));
      }
    }
  }
  return result;
}

const std::array<std::uint8_t, 512>& allowed_steps(StepRule rule) {
  static constexpr std::array<std::uint8_t, 512> tables[] = {steps_of(StepRule::four), steps_of(StepRule::eight),
                                                             steps_of(StepRule::eight_squeezing)};
  return tables[as_whole<std::size_t>(rule)];
}

}  // namespace warren

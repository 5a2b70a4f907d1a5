// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/known_part.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace warren {
namespace {

/// Cells from first to last of both.
struct CellRange {
  std::uint32_t first = 0xffffffff;
  std::uint32_t last = 0;
  void include(std::uint32_t cell) {
    first = std::min(first, cell);
    last = std::max(last, cell);
  }
  bool empty() const { return first > last; }
  double count() const { return static_cast<double>(last) - first + 1.0; }
};

struct KnownCells {
  CellRange columns;
  CellRange rows;
};

KnownCells known_cells(const Bitmap& unknown, const Execution& execution) {
  KnownCells known;
  const std::uint32_t tail = unknown.width() % Bitmap::word_bits;
  for (std::uint32_t y = 0; y < unknown.height(); ++y) {
    if (y % 64 == 0) execution.check();
    const auto words = unknown.row(y);
    for (std::size_t w = 0; w < words.size(); ++w) {
      const bool is_cut = tail != 0 && w + 1 == words.size();
      const std::uint64_t bits = ~words[w] & (is_cut ? (std::uint64_t{1} << tail) - 1 : ~std::uint64_t{0});
      if (bits == 0) continue;
      const auto first = static_cast<std::uint32_t>(w * Bitmap::word_bits);
      known.columns.include(first + static_cast<std::uint32_t>(std::countr_zero(bits)));
      known.columns.include(first + static_cast<std::uint32_t>(std::bit_width(bits)) - 1);
      known.rows.include(y);
    }
  }
  return known;
}

}  // namespace

std::optional<Box> known_part(const OccupancyMap& map, const Execution& execution) {
  if (map.unknown.empty()) return std::nullopt;
  const auto [columns, rows] = known_cells(map.unknown, execution);
  if (rows.empty()) return std::nullopt;
  constexpr double share = 1.0 / 40.0;
  const double margin = std::max(2.0, share * std::max(columns.count(), rows.count()));
  const Vec2 low{std::max(columns.first - margin, 0.0), std::max(rows.first - margin, 0.0)};
  const Vec2 high{std::min(columns.last + 1.0 + margin, static_cast<double>(map.width())),
                  std::min(rows.last + 1.0 + margin, static_cast<double>(map.height()))};
  constexpr double most = 0.9;
  if (high.x - low.x > most * map.width() && high.y - low.y > most * map.height()) return std::nullopt;
  Box box;
  for (const Vec2 corner : {low, Vec2{high.x, low.y}, high, Vec2{low.x, high.y}}) box.include(world_point(map, corner));
  return box;
}

std::vector<Vec2> part_in_box(std::span<const Vec2> outline, const Box& box) {
  std::vector<Vec2> part(outline.begin(), outline.end());
  const auto cut = [&part](const auto& depth) {  // >= 0 inside
    std::vector<Vec2> kept;
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Vec2 a = part[i];
      const Vec2 b = part[(i + 1) % part.size()];
      if (depth(a) >= 0.0) kept.push_back(a);
      if ((depth(a) < 0.0) != (depth(b) < 0.0)) kept.push_back(a + depth(a) / (depth(a) - depth(b)) * (b - a));
    }
    part = std::move(kept);
  };
  cut([&](Vec2 p) { return p.x - box.min.x; });
  cut([&](Vec2 p) { return box.max.x - p.x; });
  cut([&](Vec2 p) { return p.y - box.min.y; });
  cut([&](Vec2 p) { return box.max.y - p.y; });
  return part;
}

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiles/wall_counts.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "planners/tiles/growing_box.hpp"

namespace warren {
namespace {

/// At least 16384 walls, at most 512 chunks: so that their counts stay small beside the walls.
std::size_t grain_of(std::size_t walls) { return std::max<std::size_t>(16384, (walls + 511) / 512); }

}  // namespace

void ChunkCounts::add_up() {
  std::fill_n(before_.begin(), tiles_, 0U);
  for (std::size_t i = tiles_; i < before_.size(); ++i) before_[i] += before_[i - tiles_];
}

WallCounts::WallCounts(const WallSet& walls, const WallFiler& filer, std::size_t tiles, const Execution& execution)
    : walls_(walls.size()), grain_(grain_of(walls.size())), tiles_(tiles) {
  execution.reserve(2 * (chunks() + 1) * tiles * sizeof(std::uint32_t));
  narrow_ = ChunkCounts(chunks(), tiles);
  wide_ = ChunkCounts(chunks(), tiles);
  walls.visit([&](auto given) { count(given, filer, execution); });
  narrow_.add_up();
  any_wide_ ? wide_.add_up() : void(wide_ = {});
}

Range WallCounts::chunk(std::size_t number) const { return {number * grain_, std::min(walls_, (number + 1) * grain_)}; }

template <class Wall>
void WallCounts::count(std::span<const Wall> walls, const WallFiler& filer, const Execution& execution) {
  std::vector<Box> boxes(chunks());
  std::vector<std::uint8_t> wide_found(chunks());
  for_chunks(walls.size(), grain_, execution, [&](Range r) {
    const std::size_t chunk = r.first / grain_;
    std::uint32_t* const narrow = narrow_.counts(chunk);
    std::uint32_t* const wide = wide_.counts(chunk);
    std::fill_n(narrow, tiles_, 0U);
    std::fill_n(wide, tiles_, 0U);
    const WallFiler own = filer;
    GrowingBox box;
    bool any_wide = false;
    const auto count_narrow = [=](std::size_t tile, const detail::WallSteps&) { ++narrow[tile]; };
    const auto count_wide = [&](std::size_t tile) {
      ++wide[tile];
      any_wide = true;
    };
    for (const Wall& wall : walls.subspan(r.first, r.size())) {
      box.include(wall);
      own.file(wall, count_narrow, count_wide);
    }
    boxes[chunk] = box.box();
    wide_found[chunk] = any_wide ? 1 : 0;
  });
  for (const Box& box : boxes) box_.include(box);
  any_wide_ = std::find(wide_found.begin(), wide_found.end(), 1) != wide_found.end();
}

}  // namespace warren

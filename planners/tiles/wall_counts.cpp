// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiles/wall_counts.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

namespace warren {
namespace {

/// The box of the walls that it has been shown.
class GrowingBox {
 public:
  void include(const PackedWall& w) { include(detail::WallSteps(w).numbers() * (1.0F / narrow_unit)); }
  void include(const FloatWall& w) {
    detail::Four ends;
    std::memcpy(&ends, &w, sizeof ends);
    include(ends);
  }
  void include(const DoubleWall& w) { doubles_.include(box_of(w.segment())); }
  Box box() const {
    Box box = doubles_;
    box.include({{std::min(low_[0], low_[2]), std::min(low_[1], low_[3])},
                 {std::max(high_[0], high_[2]), std::max(high_[1], high_[3])}});
    return box;
  }

 private:
  void include(detail::Four ends) {
    low_ = low_ < ends ? low_ : ends;
    high_ = high_ > ends ? high_ : ends;
  }

  detail::Four low_ = detail::Four{} + std::numeric_limits<float>::infinity();
  detail::Four high_ = detail::Four{} - std::numeric_limits<float>::infinity();
  Box doubles_;
};

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

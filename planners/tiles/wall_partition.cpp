// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiles/wall_partition.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "parallel/first_touch.hpp"
#include "planners/tiles/wall_in_band.hpp"
#include "planners/tiles/wall_steps.hpp"

namespace warren {
namespace {

using detail::TileCorner;
using detail::WallSteps;

/// The box of the walls that it has been shown.
class GrowingBox {
 public:
  void include(const FloatWall& w) {
    Four ends;
    std::memcpy(&ends, &w, sizeof ends);
    low_ = low_ < ends ? low_ : ends;
    high_ = high_ > ends ? high_ : ends;
  }
  void include(const DoubleWall& w) { doubles_.include(box_of(w.segment())); }
  Box box() const {
    Box box = doubles_;
    box.include({{std::min(low_[0], low_[2]), std::min(low_[1], low_[3])},
                 {std::max(high_[0], high_[2]), std::max(high_[1], high_[3])}});
    return box;
  }

 private:
  using Four = float __attribute__((vector_size(16)));
  Four low_ = Four{} + std::numeric_limits<float>::infinity();
  Four high_ = Four{} - std::numeric_limits<float>::infinity();
  Box doubles_;
};

/// Into which tiles a wall goes, and in which form.
class Filer {
 public:
  Filer(const TileGrid& grid, double halo)
      : grid_(grid),
        halo_(halo),
        tile_log2_(static_cast<int>(narrow_bits + grid.side_log2)),
        halo_steps_(static_cast<std::int32_t>(std::ceil(halo * narrow_unit))),
        narrow_fits_(std::max(grid.cols, grid.rows) <= (1U << 22)) {}

  /// Calls narrow(tile, steps) or wide(tile) for each tile that w goes to, ascending.
  template <class T, class Narrow, class Wide>
  void file(const WallOf<T>& w, const Narrow& narrow, const Wide& wide) const {
    const WallSteps steps(w);
    if (!steps.exact() || !steps.is_short(64 * narrow_unit) || !narrow_fits_) return file_wide(w.segment(), wide);
    constexpr std::int32_t origin = narrow_unit / 2;
    const TileCorner first = steps.first(origin + halo_steps_, tile_log2_);
    const TileCorner last = steps.last(halo_steps_ - origin, tile_log2_);
    if (first.col == last.col && first.row == last.row) {
      if (inside(first.col, grid_.tile_cols) && inside(first.row, grid_.tile_rows)) {
        narrow(tile(first.col, first.row), steps);
      }
      return;
    }
    const std::int32_t end_col = std::min(last.col + 1, static_cast<std::int32_t>(grid_.tile_cols));
    const std::int32_t end_row = std::min(last.row + 1, static_cast<std::int32_t>(grid_.tile_rows));
    for (std::int32_t row = std::max(first.row, 0); row < end_row; ++row) {
      for (std::int32_t col = std::max(first.col, 0); col < end_col; ++col) narrow(tile(col, row), steps);
    }
  }

 private:
  static bool inside(std::int32_t i, std::uint32_t count) { return static_cast<std::uint32_t>(i) < count; }
  std::size_t tile(std::int32_t col, std::int32_t row) const {
    return static_cast<std::size_t>(row) * grid_.tile_cols + static_cast<std::size_t>(col);
  }

  template <class Wide>
  void file_wide(const Segment& w, const Wide& wide) const {
    const Box box = box_of(w).grown(halo_);
    if (!box.meets(grid_.area())) return;
    const auto index = [&](double x, std::uint32_t count) {
      const double place = std::floor((x - 0.5) / grid_.side());
      return static_cast<std::size_t>(std::clamp(place, 0.0, static_cast<double>(count - 1)));
    };
    const std::size_t last_row = index(box.max.y, grid_.tile_rows);
    for (std::size_t row = index(box.min.y, grid_.tile_rows); row <= last_row; ++row) {
      const double low = 0.5 + static_cast<double>(row * grid_.side());
      const BandInterval x = x_range_in_band(w, low - halo_, low + grid_.side() + halo_);
      if (x.high + halo_ < 0.5 || x.low - halo_ > grid_.area().max.x) continue;
      const std::size_t last_col = index(x.high + halo_, grid_.tile_cols);
      for (std::size_t col = index(x.low - halo_, grid_.tile_cols); col <= last_col; ++col) {
        wide(row * grid_.tile_cols + col);
      }
    }
  }

  const TileGrid& grid_;
  const double halo_;
  const int tile_log2_;  // in steps
  const std::int32_t halo_steps_;
  const bool narrow_fits_;
};

/// What one chunk of walls puts where: entry t of the narrow (or wide) half is first a count, then the next place.
class Places {
 public:
  Places(std::size_t chunks, std::size_t tiles) : tiles_(tiles), entries_(chunks * 2 * tiles) {}
  std::uint32_t* narrow(std::size_t chunk) { return entries_.data() + chunk * 2 * tiles_; }
  std::uint32_t* wide(std::size_t chunk) { return narrow(chunk) + tiles_; }

  /// Turns counts into places: by tile, in a tile by chunk. Returns where each tile begins, and the end.
  RawVector<std::uint32_t> narrow_places() { return places(0); }
  /// The same, where there is none: empty.
  RawVector<std::uint32_t> wide_places(bool any) { return any ? places(tiles_) : RawVector<std::uint32_t>{0}; }

 private:
  RawVector<std::uint32_t> places(std::size_t half) {
    const std::size_t chunks = entries_.size() / (2 * tiles_);
    std::vector<std::uint64_t> next(tiles_ + 1, 0);
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
      const std::uint32_t* counts = narrow(chunk) + half;
      for (std::size_t t = 0; t < tiles_; ++t) next[t + 1] += counts[t];
    }
    for (std::size_t t = 0; t < tiles_; ++t) next[t + 1] += next[t];
    if (next.back() > 0xffffffffU)
      throw InputError("walls", "make more than 2^32 - 1 entries in the tiles that they pass");
    RawVector<std::uint32_t> first(tiles_ + 1);
    std::copy(next.begin(), next.end(), first.begin());
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) {
      std::uint32_t* counts = narrow(chunk) + half;
      for (std::size_t t = 0; t < tiles_; ++t) {
        const std::uint32_t count = counts[t];
        counts[t] = static_cast<std::uint32_t>(next[t]);
        next[t] += count;
      }
    }
    return first;
  }

  std::size_t tiles_;
  RawVector<std::uint32_t> entries_;
};

/// Chunks of at least 16384 walls, at most 256 of them: so that their counts stay small beside the walls.
std::size_t grain_of(std::size_t walls) { return std::max<std::size_t>(16384, (walls + 255) / 256); }

struct Counted {
  Box box;  ///< of the walls
  bool any_wide = false;
};

template <class T>
Counted count(std::span<const WallOf<T>> walls, const Filer& filer, std::size_t tiles, Places& places,
              const Execution& execution) {
  const std::size_t grain = grain_of(walls.size());
  std::vector<Counted> parts(chunk_count(walls.size(), grain));
  for_chunks(walls.size(), grain, execution, [&](Range r) {
    std::uint32_t* narrow = places.narrow(r.first / grain);
    std::uint32_t* wide = places.wide(r.first / grain);
    std::fill(narrow, narrow + 2 * tiles, 0U);
    GrowingBox box;
    bool any_wide = false;
    for (std::size_t i = r.first; i < r.last; ++i) {
      box.include(walls[i]);
      filer.file(
          walls[i], [&](std::size_t tile, const WallSteps&) { ++narrow[tile]; },
          [&](std::size_t tile) {
            ++wide[tile];
            any_wide = true;
          });
    }
    parts[r.first / grain] = {box.box(), any_wide};
  });
  Counted all;
  for (const Counted& part : parts) {
    all.box.include(part.box);
    all.any_wide |= part.any_wide;
  }
  return all;
}

/// Middle of each column (or row) of tiles, in steps.
std::int32_t middle_steps(std::uint32_t first, const TileGrid& grid) {
  return static_cast<std::int32_t>((first + grid.side() / 2 + 1) * narrow_unit);
}

template <class T>
void scatter(std::span<const WallOf<T>> walls, const Filer& filer, const TileGrid& grid, Places& places,
             NarrowWall* narrow_walls, WallOf<T>* wide_walls, const Execution& execution) {
  const std::size_t grain = grain_of(walls.size());
  std::vector<std::uint64_t> middle(grid.count());
  for (std::size_t t = 0; t < middle.size(); ++t) {
    const auto x = static_cast<std::uint32_t>(middle_steps(grid.first_col(t), grid));
    const auto y = static_cast<std::uint32_t>(middle_steps(grid.first_row(t), grid));
    middle[t] = x | (std::uint64_t{y} << 32);
  }
  for_chunks(walls.size(), grain, execution, [&](Range r) {
    std::uint32_t* narrow = places.narrow(r.first / grain);
    std::uint32_t* wide = places.wide(r.first / grain);
    for (std::size_t i = r.first; i < r.last; ++i) {
      filer.file(
          walls[i],
          [&](std::size_t tile, const WallSteps& steps) { narrow_walls[narrow[tile]++] = steps.from(middle[tile]); },
          [&](std::size_t tile) { wide_walls[wide[tile]++] = walls[i]; });
    }
  });
}

}  // namespace

WallPartition::WallPartition(const WallSet& walls, std::span<const Segment> more, const TileGrid& grid, double halo,
                             const Execution& execution)
    : more_(more) {
  const Filer filer(grid, halo);
  walls.visit([&]<class T>(std::span<const WallOf<T>> given) {
    const std::size_t chunks = chunk_count(given.size(), grain_of(given.size()));
    execution.reserve(2 * chunks * grid.count() * sizeof(std::uint32_t));
    Places places(chunks, grid.count());
    const Counted counted = count(given, filer, grid.count(), places, execution);
    box_ = counted.box;
    first_narrow_ = places.narrow_places();
    first_wide_ = places.wide_places(counted.any_wide);
    execution.reserve(first_narrow_.back() * sizeof(NarrowWall) + first_wide_.back() * sizeof(WallOf<T>));
    narrow_.resize(first_narrow_.back());
    touch_first(narrow_, execution);
    RawVector<WallOf<T>> wide(first_wide_.back());
    touch_first(wide, execution);
    scatter(given, filer, grid, places, narrow_.data(), wide.data(), execution);
    if constexpr (std::is_same_v<T, float>) {
      floats_ = std::move(wide);
    } else {
      doubles_ = std::move(wide);
    }
  });
}

TileWalls WallPartition::of(std::size_t tile) const {
  const auto part = [tile](const auto& walls, const auto& first) {
    using Wall = typename std::decay_t<decltype(walls)>::value_type;
    if (walls.empty()) return std::span<const Wall>();
    return std::span<const Wall>(walls.data() + first[tile], walls.data() + first[tile + 1]);
  };
  return {part(narrow_, first_narrow_), part(floats_, first_wide_), part(doubles_, first_wide_), more_};
}

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// Where a tile's walls come from, whether they are held or made when they are asked for. Each tile is given every wall
// that can block an edge of one of its lattice points.
//
// Walls that are held are filed by tile: each tile holds every wall whose box, grown by the halo, meets the tile, so
// that a tile can be worked on without looking elsewhere.
//
// Two streaming passes over the walls: count, then scatter, all tiles at once or band by band; chunk borders depend on
// the number of walls alone and each chunk has its own places, so there are no atomics and the order is the walls'
// order. A wall that is a multiple of 1/128 in every coordinate and at most 64 long along each axis is filed in 8 bytes
// (NarrowWall), whatever it came as; any other as doubles (wide). A long wall is filed in the tiles that it passes, row
// of tiles by row of tiles, not in all that its box meets: memory is at most 8 bytes a short wall (32 where it is
// wide), a few per cent for walls near borders, and one copy a tile passed for long ones; asked of the memory limit
// before it is taken. Cost: 2 to 3 ns a wall to count, 4 to 6 to scatter (bench/tiled_phases.cpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/plane/cell_walls.hpp"
#include "core/plane/wall_set.hpp"
#include "core/run/execution.hpp"
#include "parallel/chunks.hpp"
#include "planners/mazes/tile_grid.hpp"

namespace warren {

/// Where a wall passes a horizontal band: what keeps the cost of a long slanted wall at the cells that it passes
/// instead of all cells of its box.
struct BandInterval {
  double low;
  double high;
};

/// Contains the x of every point of the wall with low <= y <= high (there must be one); widened by the rounding error,
/// never beyond the wall's box.
inline BandInterval x_range_in_band(const Segment& wall, double low, double high) noexcept {
  const Box box = box_of(wall);
  if (box.min.y >= low && box.max.y <= high) return {box.min.x, box.max.x};
  const Vec2 along = wall.b - wall.a;
  const auto x_at = [&](double y) { return wall.a.x + std::clamp((y - wall.a.y) / along.y, 0.0, 1.0) * along.x; };
  const double x1 = x_at(low);
  const double x2 = x_at(high);
  const double reach_y = std::abs(wall.a.y) + std::abs(wall.b.y) + std::abs(low) + std::abs(high);
  const double error =
      16 * std::numeric_limits<double>::epsilon() *
      (std::abs(wall.a.x) + std::abs(wall.b.x) + std::abs(along.x) * (1 + reach_y / std::abs(along.y)));
  if (!(error < box.width())) return {box.min.x, box.max.x};
  return {std::max(box.min.x, std::min(x1, x2) - error), std::min(box.max.x, std::max(x1, x2) + error)};
}

/// Into which tiles a wall goes, and in which form: every tile that its box, grown by the halo, meets; where it is long
/// or no multiple of 1/128, row of tiles by row of tiles those that it passes. Refers to the grid.
class WallFiler {
 public:
  WallFiler(const TileGrid& grid, double halo)
      : grid_(grid),
        halo_(halo),
        tile_log2_(static_cast<int>(narrow_bits + grid.side_log2)),
        halo_steps_(static_cast<std::int32_t>(std::ceil(halo * narrow_unit))),
        narrow_fits_(std::max(grid.cols, grid.rows) <= (1U << 22)) {}

  /// Calls narrow(tile, steps) or wide(tile) for each tile that w goes to, ascending.
  template <class Wall, class Narrow, class Wide>
  void file(const Wall& w, const Narrow& narrow, const Wide& wide) const {
    const detail::WallSteps steps(w);
    if (!steps.exact() || !steps.is_short(64 * narrow_unit) || !narrow_fits_) return file_wide(w.segment(), wide);
    constexpr std::int32_t origin = narrow_unit / 2;
    const detail::TileCorner first = steps.first(origin + halo_steps_, tile_log2_);
    const detail::TileCorner last = steps.last(halo_steps_ - origin, tile_log2_);
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

/// How many walls of each chunk of the list go to each tile: with that, any tiles can be filed by themselves, each wall
/// where it would stand if all were, and chunks that have nothing for them are passed over. One pass over the walls.
/// Borders of chunks depend on the number of walls alone. Memory: 4 bytes a chunk and tile. Of the narrow or of the
/// wide walls. Immutable after its construction.
class ChunkCounts {
 public:
  ChunkCounts(std::size_t chunks, std::size_t tiles) : chunks_(chunks), tiles_(tiles), before_((chunks + 1) * tiles) {}

  /// A chunk's counts, to be filled in.
  std::uint32_t* counts(std::size_t chunk) { return before_.data() + (chunk + 1) * tiles_; }
  /// When all are filled in.
  void add_up() {
    std::fill_n(before_.begin(), tiles_, 0U);
    for (std::size_t i = tiles_; i < before_.size(); ++i) before_[i] += before_[i - tiles_];
  }

  /// Walls of the tile in the chunks before this one.
  std::uint32_t before(std::size_t chunk, std::size_t tile) const { return before_[chunk * tiles_ + tile]; }
  std::uint32_t of(std::size_t chunk, std::size_t tile) const { return before(chunk + 1, tile) - before(chunk, tile); }
  std::uint32_t of_tile(std::size_t tile) const { return before(chunks_, tile); }

 private:
  std::size_t chunks_;
  std::size_t tiles_;
  RawVector<std::uint32_t> before_;  // first row: nothing; then counts, at last what they sum up to
};

class WallCounts {
 public:
  /// Throws Stopped.
  WallCounts(const WallSet& walls, const WallFiler& filer, std::size_t tiles, const Execution& execution);

  std::size_t chunks() const { return chunk_count(walls_, grain_); }
  /// Its walls.
  Range chunk(std::size_t number) const { return {number * grain_, std::min(walls_, (number + 1) * grain_)}; }
  const ChunkCounts& narrow() const { return narrow_; }
  const ChunkCounts& wide() const { return wide_; }
  bool has(std::size_t chunk, std::size_t tile) const {
    return narrow_.of(chunk, tile) > 0 || wide_.of(chunk, tile) > 0;
  }
  /// Of all walls.
  const Box& box() const { return box_; }

 private:
  template <class Wall>
  void count(std::span<const Wall> walls, const WallFiler& filer, const Execution& execution);

  std::size_t walls_;
  std::size_t grain_;  // at most 512 chunks, so that their counts stay small beside the walls
  std::size_t tiles_;
  ChunkCounts narrow_;
  ChunkCounts wide_;
  Box box_;
};

/// Which tiles are filed together: all, or bands of tiles one after the other, so that not all walls are held twice.
/// Where the walls come in some order, a band takes but a part of the list, and many bands cost no more than one: the
/// copies then are a 16th of the walls. Where they come in no order, each band is a pass over all walls, and there are
/// as few as the memory allows. What is made of the tiles is the same for any bands. `count` bands of whole columns (or
/// rows) of tiles.
struct TileBands {
  std::uint32_t count = 1;
  bool by_rows = false;

  /// In which a tile is.
  std::uint32_t of(const TileGrid& grid, std::size_t tile) const {
    const std::size_t at = by_rows ? tile / grid.tile_cols : tile % grid.tile_cols;
    return static_cast<std::uint32_t>(at * count / (by_rows ? grid.tile_rows : grid.tile_cols));
  }
  /// Ascending.
  std::vector<std::size_t> tiles(const TileGrid& grid, std::uint32_t band) const {
    std::vector<std::size_t> tiles;
    for (std::size_t tile = 0; tile < grid.count(); ++tile) {
      if (of(grid, tile) == band) tiles.push_back(tile);
    }
    return tiles;
  }
};

/// Asks the memory limit how much is left.
TileBands choose_bands(const WallCounts& counts, const TileGrid& grid, const Execution& execution);

/// All that a tile needs to know of the walls: each list holds walls of its own.
struct TileWalls {
  std::span<const NarrowWall> narrow;
  std::span<const DoubleWall> wide;
  std::span<const Segment> more;  ///< the same for every tile: may lie anywhere

  /// Calls visit(const Segment&) for each wall, as the exact segment that it is in the world.
  template <class Visit>
  void for_each(const TileGrid& grid, std::size_t tile, const Visit& visit) const {
    for (const NarrowWall& w : narrow) visit(grid.segment(tile, w));
    for_each_wide(visit);
  }
  /// The same for those whose box meets this one, and perhaps some that nearly do.
  template <class Visit>
  void for_each_around(const TileGrid& grid, std::size_t tile, const Box& around, const Visit& visit) const {
    constexpr std::int32_t rounding = 2;  // steps, more than what is cut off
    const auto steps = [](double x) {
      constexpr double most = 1 << 20;  // beyond what narrow walls have
      return static_cast<std::int32_t>(std::clamp(x * narrow_unit, -most, most));
    };
    const Vec2 low = around.min - grid.middle_of(tile);
    const Vec2 high = around.max - grid.middle_of(tile);
    const std::int32_t left = steps(low.x) - rounding;
    const std::int32_t right = steps(high.x) + rounding;
    const std::int32_t bottom = steps(low.y) - rounding;
    const std::int32_t top = steps(high.y) + rounding;
    for (const NarrowWall& w : narrow) {
      if (std::max(w.x1, w.x2) < left || std::min(w.x1, w.x2) > right) continue;
      if (std::max(w.y1, w.y2) < bottom || std::min(w.y1, w.y2) > top) continue;
      visit(grid.segment(tile, w));
    }
    for_each_wide(visit);
  }
  template <class Visit>
  void for_each_wide(const Visit& visit) const {
    for (const DoubleWall& w : wide) visit(w.segment());
    for (const Segment& w : more) visit(w);
  }
};

/// The lists of a tile that is read by itself.
struct LooseTile {
  RawVector<NarrowWall> narrow;
  RawVector<DoubleWall> wide;
};

/// Gives tiles; belongs to one thread.
class TileReader : NotCopied {
 public:
  virtual ~TileReader() = default;
  /// Good until the next one is read.
  virtual TileWalls read(std::size_t tile) = 0;
};

/// Immutable; any number of readers may be at work.
class TileSource : NotCopied {
 public:
  virtual ~TileSource() = default;
  /// Tiles are read fastest band by band, each after it was begun.
  virtual std::uint32_t band_count() const { return 1; }
  /// Returns the band's tiles, ascending. No reader may be at work. Throws as WallPartition.
  virtual std::vector<std::size_t> begin_band(std::uint32_t band, const Execution& execution) = 0;
  virtual std::unique_ptr<TileReader> reader() const = 0;
  /// Of all walls.
  virtual Box box() const = 0;
  /// Calls visit with every wall whose box meets `around`, and perhaps others.
  virtual void for_each_near(const Box& around, const std::function<void(const Segment&)>& visit) const = 0;
};

/// Walls that are held, filed by tile. Any number of threads may read, but while a band is filed.
class WallPartition : public TileSource {
 public:
  /// `more` are a few walls beside the set (bounds), kept by reference, as are the walls, which begin_band() and
  /// look_up() read. halo >= 0, in the world's unit. bands; none: as choose_bands() says. Where there is one it is
  /// filed; else none is, yet. Throws Stopped at the deadline or before memory would pass its limit, InputError where
  /// walls and tiles make 2^32 entries or more.
  WallPartition(const WallSet& walls, std::span<const Segment> more, const TileGrid& grid, double halo,
                const Execution& execution, std::optional<TileBands> bands = TileBands());

  std::uint32_t band_count() const override { return bands_.count; }
  /// Files the walls of a band's tiles in the place of those before, and returns the tiles, ascending. Throws as above.
  std::vector<std::size_t> begin_band(std::uint32_t band, const Execution& execution) override;
  std::unique_ptr<TileReader> reader() const override;
  Box box() const override { return counts_.box(); }
  void for_each_near(const Box& around, const std::function<void(const Segment&)>& visit) const override;
  bool is_filed(std::size_t tile) const { return bands_.of(grid_, tile) == filed_; }
  /// Of a tile that is filed.
  TileWalls of(std::size_t tile) const;
  /// Of any tile: looks through the chunks that have walls of it.
  TileWalls look_up(std::size_t tile, LooseTile& into) const;

 private:
  static constexpr std::uint32_t nothing = ~std::uint32_t{0};

  template <class Wall>
  void scatter(std::span<const Wall> walls, std::span<const std::size_t> chunks, const Execution& execution);

  const WallSet& walls_;
  std::span<const Segment> more_;
  const Execution execution_;
  const TileGrid grid_;
  const WallFiler filer_;
  const WallCounts counts_;
  TileBands bands_;
  std::uint32_t filed_ = nothing;
  RawVector<std::uint32_t> first_narrow_;  // where the tile's walls begin; `nothing`: it is not filed
  RawVector<std::uint32_t> first_wide_;
  RawVector<NarrowWall> narrow_;
  RawVector<DoubleWall> wide_;
};

/// Walls on the sides of unit cells, made tile by tile; the grid's tiles are the source's. A tile is given its own
/// sides alone, which is enough for clearances below most_cell_clearance: whatever else stands half a step off its
/// edges.
std::unique_ptr<TileSource> cell_tiles(const CellWallSource& cells, const TileGrid& grid);
inline constexpr double most_cell_clearance = 0.5;

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
#include "planners/mazes/tile_source.hpp"

#include "core/base/error.hpp"
#include "parallel/asked_memory.hpp"

namespace warren {
namespace {

constexpr std::size_t band_bytes = std::size_t{64} << 20;  // smaller bands are not worth their count
constexpr std::uint32_t most_bands_in_order = 16;
constexpr std::uint32_t most_bands = 64;

/// Chunks looked at for all bands together, over the number of chunks.
double passes(const WallCounts& counts, const TileGrid& grid, const TileBands& bands) {
  std::size_t looks = 0;
  std::vector<std::uint8_t> met(bands.count);
  for (std::size_t chunk = 0; chunk < counts.chunks(); ++chunk) {
    std::fill(met.begin(), met.end(), std::uint8_t{0});
    for (std::size_t tile = 0; tile < grid.count(); ++tile) {
      if (counts.has(chunk, tile)) met[bands.of(grid, tile)] = 1;
    }
    looks += static_cast<std::size_t>(std::count(met.begin(), met.end(), 1));
  }
  return static_cast<double>(looks) / static_cast<double>(counts.chunks());
}

/// So many that a band takes half of what is left.
std::uint32_t bands_by_memory(std::size_t bytes, const Execution& execution) {
  if (execution.deadline == nullptr) return 1;
  const std::size_t limit = execution.deadline->memory_bytes();
  const std::size_t held = resident_bytes();
  const std::size_t left = limit > held ? (limit - held) / 2 : 0;
  if (bytes <= left) return 1;
  return static_cast<std::uint32_t>(std::min<std::size_t>(most_bands, bytes / std::max(left, band_bytes) + 1));
}

using detail::middle_of, detail::WallSteps;

/// Where the walls of each of these tiles begin; returns how many there are.
std::size_t add_up(const ChunkCounts& counts, std::span<const std::size_t> tiles, RawVector<std::uint32_t>& first) {
  std::uint64_t sum = 0;
  for (const std::size_t tile : tiles) {
    first[tile] = static_cast<std::uint32_t>(sum);
    sum += counts.of_tile(tile);
  }
  if (sum >= 0xffffffffU) throw InputError("walls", "make more than 2^32 - 1 entries in the tiles that they pass");
  return sum;
}

template <class Wall>
DoubleWall widened(const Wall& wall) {
  const Segment s = wall.segment();
  return {s.a.x, s.a.y, s.b.x, s.b.y};
}

/// What it held is gone.
template <class Wall>
void resize_touched(RawVector<Wall>& walls, std::size_t count, const Execution& execution) {
  const std::size_t room = walls.capacity();
  if (count > room) {
    let_go(walls);
    execution.reserve(count * sizeof(Wall));
  }
  walls.resize(count);
  if (count > room) touch_first(walls, execution);
}

class PartitionReader : public TileReader {
 public:
  explicit PartitionReader(const WallPartition& partition) : partition_(partition) {}
  TileWalls read(std::size_t tile) override {
    return partition_.is_filed(tile) ? partition_.of(tile) : partition_.look_up(tile, loose_);
  }

 private:
  const WallPartition& partition_;
  LooseTile loose_;
};

class CellTiles : public TileSource {
 public:
  CellTiles(const CellWallSource& cells, const TileGrid& grid) : cells_(cells), grid_(grid) {}

  std::vector<std::size_t> begin_band(std::uint32_t band, const Execution&) override {
    return TileBands().tiles(grid_, band);
  }
  std::unique_ptr<TileReader> reader() const override { return std::make_unique<Reader>(cells_, grid_); }
  Box box() const override { return cells_.box(); }
  void for_each_near(const Box& around, const std::function<void(const Segment&)>& visit) const override {
    const std::size_t low = grid_.tile_near(around.min);
    const std::size_t high = grid_.tile_near(around.max);
    Reader reader(cells_, grid_);
    for (std::size_t row = low / grid_.tile_cols; row <= high / grid_.tile_cols; ++row) {
      for (std::size_t col = low % grid_.tile_cols; col <= high % grid_.tile_cols; ++col) {
        const std::size_t tile = row * grid_.tile_cols + col;
        reader.read(tile).for_each(grid_, tile, visit);
      }
    }
  }

 private:
  class Reader : public TileReader {
   public:
    Reader(const CellWallSource& cells, const TileGrid& grid) : grid_(grid), cells_(cells.reader()) {}
    /// Written without branches: every second wall stands, and nobody can guess which.
    TileWalls read(std::size_t tile) override {
      cells_->read(tile, tile_);
      walls_.resize(2 * tile_.walls.size());
      NarrowWall* out = walls_.data();
      constexpr int half = narrow_unit / 2;
      const int middle = static_cast<int>(grid_.side() / 2) * narrow_unit;
      const auto number = [](int x) { return static_cast<std::int16_t>(x); };
      for (std::ptrdiff_t row = -1; row < std::ptrdiff_t{tile_.height}; ++row) {
        const std::uint8_t* const line = tile_.walls.data() + tile_.index(0, row);
        const std::int16_t low = number(static_cast<int>(row) * narrow_unit - half - middle);
        const std::int16_t high = number(low + narrow_unit);
        for (std::ptrdiff_t col = -1; col < std::ptrdiff_t{tile_.width}; ++col) {
          const std::int16_t left = number(static_cast<int>(col) * narrow_unit - half - middle);
          const std::int16_t right = number(left + narrow_unit);
          *out = {right, low, right, high};
          out += row >= 0 ? line[col] & CellTile::right_wall : 0;
          *out = {left, high, right, high};
          out += col >= 0 ? (line[col] & CellTile::upper_wall) >> 1 : 0;
        }
      }
      return {.narrow = {walls_.data(), static_cast<std::size_t>(out - walls_.data())}, .wide = {}, .more = {}};
    }

   private:
    const TileGrid& grid_;
    std::unique_ptr<CellWallReader> cells_;
    CellTile tile_;
    std::vector<NarrowWall> walls_;
  };

  const CellWallSource& cells_;
  const TileGrid grid_;
};

}  // namespace

WallCounts::WallCounts(const WallSet& walls, const WallFiler& filer, std::size_t tiles, const Execution& execution)
    : walls_(walls.size()),
      grain_(std::max<std::size_t>(16384, (walls.size() + 511) / 512)),
      tiles_((execution.reserve(2 * (chunks() + 1) * tiles * sizeof(std::uint32_t)), tiles)),
      narrow_(chunks(), tiles),
      wide_(chunks(), tiles) {
  walls.visit([&](auto given) { count(given, filer, execution); });
  narrow_.add_up();
  wide_.add_up();
}

template <class Wall>
void WallCounts::count(std::span<const Wall> walls, const WallFiler& filer, const Execution& execution) {
  std::vector<Box> boxes(chunks());
  for_chunks(walls.size(), grain_, execution, [&](Range r) {
    const std::size_t chunk = r.first / grain_;
    std::uint32_t* const narrow = narrow_.counts(chunk);
    std::uint32_t* const wide = wide_.counts(chunk);
    std::fill_n(narrow, tiles_, 0U);
    std::fill_n(wide, tiles_, 0U);
    const WallFiler own = filer;
    GrowingBox box;
    const auto count_narrow = [=](std::size_t tile, const WallSteps&) { ++narrow[tile]; };
    const auto count_wide = [=](std::size_t tile) { ++wide[tile]; };
    for (const Wall& wall : walls.subspan(r.first, r.size())) {
      box.include(wall);
      own.file(wall, count_narrow, count_wide);
    }
    boxes[chunk] = box.box();
  });
  for (const Box& box : boxes) box_.include(box);
}

TileBands choose_bands(const WallCounts& counts, const TileGrid& grid, const Execution& execution) {
  std::size_t bytes = 0;
  for (std::size_t tile = 0; tile < grid.count(); ++tile) {
    bytes += counts.narrow().of_tile(tile) * sizeof(NarrowWall) + counts.wide().of_tile(tile) * sizeof(DoubleWall);
  }
  if (bytes <= band_bytes) return {};
  const auto bands = [&](bool by_rows, std::size_t count) {
    return TileBands{
        static_cast<std::uint32_t>(std::min<std::size_t>(by_rows ? grid.tile_rows : grid.tile_cols, count)), by_rows};
  };
  constexpr double about_one_pass = 1.5;
  const std::size_t in_order = std::min<std::size_t>(most_bands_in_order, bytes / band_bytes + 1);
  for (const bool by_rows : {false, true}) {
    const TileBands some = bands(by_rows, in_order);
    if (passes(counts, grid, some) < about_one_pass) return some;
  }
  return bands(grid.tile_rows > grid.tile_cols, bands_by_memory(bytes, execution));
}

WallPartition::WallPartition(const WallSet& walls, std::span<const Segment> more, const TileGrid& grid, double halo,
                             const Execution& execution, std::optional<TileBands> bands)
    : walls_(walls),
      more_(more),
      execution_(execution),
      grid_(grid),
      filer_(grid_, halo),
      counts_(walls, filer_, grid.count(), execution),
      bands_(bands ? *bands : choose_bands(counts_, grid, execution)),
      first_narrow_(grid.count()),
      first_wide_(grid.count()) {
  if (bands_.count == 1) {
    WallPartition::begin_band(0, execution);
    return;
  }
  std::vector<std::uint64_t> narrow(bands_.count);
  std::vector<std::uint64_t> wide(bands_.count);
  for (std::size_t tile = 0; tile < grid_.count(); ++tile) {
    narrow[bands_.of(grid_, tile)] += counts_.narrow().of_tile(tile);
    wide[bands_.of(grid_, tile)] += counts_.wide().of_tile(tile);
  }
  resize_touched(narrow_, std::ranges::max(narrow), execution);
  resize_touched(wide_, std::ranges::max(wide), execution);
}

std::vector<std::size_t> WallPartition::begin_band(std::uint32_t band, const Execution& execution) {
  std::vector<std::size_t> tiles = bands_.tiles(grid_, band);
  if (filed_ == band) return tiles;
  filed_ = nothing;
  std::fill(first_narrow_.begin(), first_narrow_.end(), nothing);
  std::fill(first_wide_.begin(), first_wide_.end(), nothing);
  const std::size_t narrow = add_up(counts_.narrow(), tiles, first_narrow_);
  const std::size_t wide = add_up(counts_.wide(), tiles, first_wide_);
  std::vector<std::size_t> chunks;
  for (std::size_t chunk = 0; chunk < counts_.chunks(); ++chunk) {
    const auto has = [&](std::size_t tile) { return counts_.has(chunk, tile); };
    if (std::any_of(tiles.begin(), tiles.end(), has)) chunks.push_back(chunk);
  }
  resize_touched(narrow_, narrow, execution);
  resize_touched(wide_, wide, execution);
  walls_.visit([&](auto walls) { scatter(walls, chunks, execution); });
  filed_ = band;
  return tiles;
}

/// All that the loop reads is its own: what it writes might be any of the members.
template <class Wall>
void WallPartition::scatter(std::span<const Wall> walls, std::span<const std::size_t> chunks,
                            const Execution& execution) {
  std::vector<std::uint64_t> middles(grid_.count());
  for (std::size_t tile = 0; tile < middles.size(); ++tile) middles[tile] = middle_of(grid_, tile);
  for_chunks(chunks.size(), 1, execution, [&](Range r) {
    // Where the chunk's walls go, tile by tile; `nothing` where the tile is not of the band.
    const auto places = [&](const ChunkCounts& counts, const RawVector<std::uint32_t>& first) {
      std::vector<std::uint32_t> next(first.begin(), first.end());
      for (std::size_t tile = 0; tile < next.size(); ++tile) {
        if (next[tile] != nothing) next[tile] += counts.before(chunks[r.first], tile);
      }
      return next;
    };
    std::vector<std::uint32_t> narrow_places = places(counts_.narrow(), first_narrow_);
    std::vector<std::uint32_t> wide_places = places(counts_.wide(), first_wide_);
    std::uint32_t* const narrow = narrow_places.data();
    std::uint32_t* const wide = wide_places.data();
    NarrowWall* const narrow_walls = narrow_.data();
    DoubleWall* const wide_walls = wide_.data();
    const std::uint64_t* const middle = middles.data();
    const WallFiler filer = filer_;
    const Range range = counts_.chunk(chunks[r.first]);
    for (const Wall& wall : walls.subspan(range.first, range.size())) {
      filer.file(
          wall,
          [=](std::size_t tile, const WallSteps& steps) {
            const std::uint32_t place = narrow[tile];
            if (place == nothing) return;
            narrow[tile] = place + 1;
            narrow_walls[place] = steps.from(middle[tile]);
          },
          [&](std::size_t tile) {
            if (wide[tile] != nothing) wide_walls[wide[tile]++] = widened(wall);
          });
    }
  });
}

TileWalls WallPartition::of(std::size_t tile) const {
  return {std::span(narrow_).subspan(first_narrow_[tile], counts_.narrow().of_tile(tile)),
          std::span(wide_).subspan(first_wide_[tile], counts_.wide().of_tile(tile)), more_};
}

TileWalls WallPartition::look_up(std::size_t tile, LooseTile& into) const {
  const std::uint64_t middle = middle_of(grid_, tile);
  into = {};
  walls_.visit([&](auto walls) {
    for (std::size_t chunk = 0; chunk < counts_.chunks(); ++chunk) {
      if (!counts_.has(chunk, tile)) continue;
      execution_.check();
      for (std::size_t i = counts_.chunk(chunk).first; i < counts_.chunk(chunk).last; ++i) {
        filer_.file(
            walls[i],
            [&](std::size_t to, const WallSteps& steps) {
              if (to == tile) into.narrow.push_back(steps.from(middle));
            },
            [&](std::size_t to) {
              if (to == tile) into.wide.push_back(widened(walls[i]));
            });
      }
    }
  });
  return {into.narrow, into.wide, more_};
}

std::unique_ptr<TileReader> WallPartition::reader() const { return std::make_unique<PartitionReader>(*this); }

void WallPartition::for_each_near(const Box&, const std::function<void(const Segment&)>& visit) const {
  walls_.visit([&](auto held) {
    for (const auto& wall : held) visit(wall.segment());
  });
  for (const Segment& wall : more_) visit(wall);
}

std::unique_ptr<TileSource> cell_tiles(const CellWallSource& cells, const TileGrid& grid) {
  return std::make_unique<CellTiles>(cells, grid);
}

}  // namespace warren

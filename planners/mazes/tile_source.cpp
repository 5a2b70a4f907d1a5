// SPDX-License-Identifier: BSD-3-Clause
#include "planners/mazes/tile_source.hpp"

#include <algorithm>

#include "core/base/raw_vector.hpp"
#include "planners/mazes/wall_steps.hpp"

namespace warren {
namespace {

void for_each_held(const WallSet& walls, std::span<const Segment> more,
                   const std::function<void(const Segment&)>& visit) {
  walls.visit([&](auto held) {
    for (const auto& wall : held) visit(wall.segment());
  });
  for (const Segment& wall : more) visit(wall);
}

class HeldTiles : public TileSource {
 public:
  HeldTiles(const WallSet& walls, std::span<const Segment> more, const TileGrid& grid, double halo, std::uint32_t bands,
            const Execution& execution)
      : walls_(walls),
        more_(more),
        execution_(execution),
        partition_(
            walls, more, grid, halo, [&](const WallCounts& counts) { return bands_for(bands, counts, grid); },
            execution) {}

  std::uint32_t band_count() const override { return partition_.band_count(); }
  std::vector<std::size_t> begin_band(std::uint32_t band, const Execution& execution) override {
    return partition_.file(band, execution);
  }
  std::unique_ptr<TileReader> reader() const override { return std::make_unique<Reader>(partition_, execution_); }
  Box box() const override { return partition_.box(); }
  void for_each_near(const Box&, const std::function<void(const Segment&)>& visit) const override {
    for_each_held(walls_, more_, visit);
  }

 private:
  class Reader : public TileReader {
   public:
    Reader(const WallPartition& partition, const Execution& execution) : partition_(partition), execution_(execution) {}
    TileWalls read(std::size_t tile) override {
      return partition_.is_filed(tile) ? partition_.of(tile) : partition_.look_up(tile, loose_, execution_);
    }

   private:
    const WallPartition& partition_;
    const Execution& execution_;
    LooseTile loose_;
  };
  TileBands bands_for(std::uint32_t asked, const WallCounts& counts, const TileGrid& grid) const {
    if (asked > 0) return {std::min(asked, grid.tile_cols)};
    return choose_bands(counts, grid, walls_.holds_doubles() ? sizeof(DoubleWall) : sizeof(FloatWall), execution_);
  }

  const WallSet& walls_;
  std::span<const Segment> more_;
  const Execution& execution_;
  WallPartition partition_;
};

/// A few walls among the milestones of one tile: one pass, and nothing is counted.
class OneTile : public TileSource {
 public:
  static bool takes(const WallSet& walls, const TileGrid& grid) {
    return grid.count() == 1 && walls.size() <= most_walls;
  }
  OneTile(const WallSet& walls, std::span<const Segment> more, const TileGrid& grid, double halo)
      : walls_(walls), more_(more), grid_(grid), narrow_(walls.size()) {
    walls.visit([&](auto given) { file(given, WallFiler(grid_, halo)); });
  }

  std::vector<std::size_t> begin_band(std::uint32_t, const Execution&) override { return {0}; }
  std::unique_ptr<TileReader> reader() const override { return std::make_unique<Reader>(*this); }
  Box box() const override { return box_; }
  void for_each_near(const Box&, const std::function<void(const Segment&)>& visit) const override {
    for_each_held(walls_, more_, visit);
  }

 private:
  static constexpr std::size_t most_walls = std::size_t{1} << 14;

  class Reader : public TileReader {
   public:
    explicit Reader(const OneTile& tile) : tile_(tile) {}
    TileWalls read(std::size_t) override { return {tile_.narrow_, tile_.floats_, tile_.doubles_, tile_.more_}; }

   private:
    const OneTile& tile_;
  };

  template <class Wall>
  void file(std::span<const Wall> walls, const WallFiler& filer) {
    const std::uint64_t middle = detail::middle_of(grid_, 0);
    NarrowWall* end = narrow_.data();
    GrowingBox box;
    for (const Wall& wall : walls) {
      box.include(wall);
      filer.file(
          wall, [&](std::size_t, const detail::WallSteps& steps) { *end++ = steps.from(middle); },
          [&](std::size_t) { keep_wide(unpacked(wall)); });
    }
    narrow_.resize(static_cast<std::size_t>(end - narrow_.data()));
    box_ = box.box();
  }
  void keep_wide(const FloatWall& wall) { floats_.push_back(wall); }
  void keep_wide(const DoubleWall& wall) { doubles_.push_back(wall); }

  const WallSet& walls_;
  std::span<const Segment> more_;
  const TileGrid grid_;
  RawVector<NarrowWall> narrow_;
  RawVector<FloatWall> floats_;
  RawVector<DoubleWall> doubles_;
  Box box_;
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
    TileWalls read(std::size_t tile) override;

   private:
    const TileGrid& grid_;
    std::unique_ptr<CellWallReader> cells_;
    CellTile tile_;
    std::vector<NarrowWall> walls_;
  };

  const CellWallSource& cells_;
  const TileGrid grid_;
};

/// Written without branches: every second wall stands, and nobody can guess which.
TileWalls CellTiles::Reader::read(std::size_t tile) {
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
  return {.narrow = {walls_.data(), static_cast<std::size_t>(out - walls_.data())},
          .floats = {},
          .doubles = {},
          .more = {}};
}

}  // namespace

std::unique_ptr<TileSource> held_tiles(const WallSet& walls, std::span<const Segment> more, const TileGrid& grid,
                                       double halo, std::uint32_t bands, const Execution& execution) {
  if (OneTile::takes(walls, grid)) return std::make_unique<OneTile>(walls, more, grid, halo);
  return std::make_unique<HeldTiles>(walls, more, grid, halo, bands, execution);
}

std::unique_ptr<TileSource> cell_tiles(const CellWallSource& cells, const TileGrid& grid) {
  return std::make_unique<CellTiles>(cells, grid);
}

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiles/tile_source.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace warren {
namespace {

class HeldTiles : public TileSource {
 public:
  HeldTiles(const WallSet& walls, std::span<const Segment> more, const TileGrid& grid, double halo,
            const Execution& execution)
      : walls_(walls), more_(more), partition_(walls, more, grid, halo, execution) {}

  std::unique_ptr<TileReader> reader() const override { return std::make_unique<Reader>(partition_); }
  Box box() const override { return partition_.box(); }
  void for_each_near(const Box&, const std::function<void(const Segment&)>& visit) const override {
    walls_.visit([&](auto walls) {
      for (const auto& wall : walls) visit(wall.segment());
    });
    for (const Segment& wall : more_) visit(wall);
  }

 private:
  class Reader : public TileReader {
   public:
    explicit Reader(const WallPartition& partition) : partition_(partition) {}
    TileWalls read(std::size_t tile) override { return partition_.of(tile); }

   private:
    const WallPartition& partition_;
  };

  const WallSet& walls_;
  std::span<const Segment> more_;
  WallPartition partition_;
};

class CellTiles : public TileSource {
 public:
  CellTiles(const CellWallSource& cells, const TileGrid& grid) : cells_(cells), grid_(grid) {}

  std::unique_ptr<TileReader> reader() const override { return std::make_unique<Reader>(cells_, grid_); }
  Box box() const override { return cells_.box(); }
  void for_each_near(const Box& around, const std::function<void(const Segment&)>& visit) const override {
    const auto cell = [](double x, std::uint32_t count) {
      return static_cast<std::uint32_t>(std::clamp(std::floor(x - 0.5), 0.0, count - 1.0));
    };
    const std::size_t low = grid_.tile_at(cell(around.min.x, grid_.cols), cell(around.min.y, grid_.rows));
    const std::size_t high = grid_.tile_at(cell(around.max.x, grid_.cols), cell(around.max.y, grid_.rows));
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
                                       double halo, const Execution& execution) {
  return std::make_unique<HeldTiles>(walls, more, grid, halo, execution);
}

std::unique_ptr<TileSource> cell_tiles(const CellWallSource& cells, const TileGrid& grid) {
  return std::make_unique<CellTiles>(cells, grid);
}

}  // namespace warren

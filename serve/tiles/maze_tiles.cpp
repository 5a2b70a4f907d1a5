// SPDX-License-Identifier: BSD-3-Clause
// Tiles of mazes. Where a cell has two pixels or more its walls are drawn as lines, else the share of its walls is a
// shade: of each cell where it is a pixel, of squares of cells from the pyramid beyond. Wall by wall the same numbers
// decide, so a tile costs 512 x 512 looks at bits or bytes at most, whatever the maze's size.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/plane/geometry.hpp"
#include "serve/tiles/shade_png.hpp"
#include "serve/tiles/shade_pyramid.hpp"
#include "serve/tiles/world_tiles.hpp"

namespace warren::serve {
namespace {

constexpr std::int64_t side = TileGrid::pixels;

class MazeTiles : public WorldTiles {
 public:
  MazeTiles(LatticePassages passages, MazeOutline outline, const TileGrid& grid, CellsOnTiles cells,
            const Execution& execution)
      : WorldTiles(grid),
        passages_(std::move(passages)),
        outline_(std::move(outline)),
        cells_(cells),
        far_(
            passages_.size().cols, passages_.size().rows,
            [this](std::uint32_t col, std::uint32_t row) { return shade_of(col, row); }, execution) {}

  std::string draw(const TilePlace& place, const Execution& execution) const override {
    ShadeTile tile;
    const int level = cells_.level - static_cast<int>(place.zoom);
    if (level >= 0) {
      draw_far(tile, place, static_cast<unsigned>(level), execution);
    } else {
      draw_near(tile, place, std::int64_t{1} << -level, execution);
    }
    return png_of(tile, colors::wall, execution);
  }

  std::unique_ptr<PlaceDistances> distances(const Execution& execution) const override;
  double largest_pixel_of_distances() const override { return 1.0 / 8.0; }

  LatticeSize size() const { return passages_.size(); }
  /// Column and row from 0; -1: the outline's left and lower side.
  bool has_right_wall(std::int64_t col, std::int64_t row) const {
    if (col < 0) return outline_.left[static_cast<std::size_t>(row)];
    if (col + 1 == passages_.size().cols) return outline_.right[static_cast<std::size_t>(row)];
    return (open_at(col, row) & 1U) == 0;
  }
  bool has_upper_wall(std::int64_t col, std::int64_t row) const {
    if (row < 0) return outline_.lower[static_cast<std::size_t>(col)];
    if (row + 1 == passages_.size().rows) return outline_.upper[static_cast<std::size_t>(col)];
    return (open_at(col, row) & 2U) == 0;
  }

 private:
  unsigned open_at(std::int64_t col, std::int64_t row) const {
    return passages_.open_at(static_cast<std::uint32_t>(col), static_cast<std::uint32_t>(row));
  }
  std::uint8_t shade_of(std::uint32_t col, std::uint32_t row) const {
    constexpr unsigned of_a_wall = 127;
    const unsigned open = passages_.open_at(col, row);
    return static_cast<std::uint8_t>(of_a_wall * (2U - (open & 1U) - (open >> 1U & 1U)));
  }
  /// Lighter than lines, for the path to be seen.
  void draw_far(ShadeTile& tile, const TilePlace& place, unsigned level, const Execution& execution) const {
    const LatticeSize size = passages_.size();
    const std::int64_t margin = cells_.margin >> level;
    const std::int64_t squares = (std::int64_t{size.rows} + (std::int64_t{1} << level) - 1) >> level;
    // Rows of pixels are counted from the maze's upper side, squares from its lower one: those may lie askew.
    const std::int64_t top_row = std::int64_t{size.rows} - 1;
    for (std::int64_t y = 0; y < side; ++y) {
      if (y % 64 == 0) execution.check();
      const std::int64_t from_top = (std::int64_t{place.y} * side + y - margin) << level;
      const std::int64_t row = (top_row - from_top) >> level;
      if (from_top < 0 || row < 0 || row >= squares) continue;
      for (std::int64_t x = 0; x < side; ++x) {
        const std::int64_t col = std::int64_t{place.x} * side + x - margin;
        if (col < 0 || col << level >= size.cols) continue;
        const unsigned shade = level == 0 ? shade_of(static_cast<std::uint32_t>(col), static_cast<std::uint32_t>(row))
                                          : far_.at(level, col, row);
        tile.at(static_cast<std::size_t>(x), static_cast<std::size_t>(y)) = static_cast<std::uint8_t>(shade / 2);
      }
    }
  }
  void draw_near(ShadeTile& tile, const TilePlace& place, std::int64_t cell, const Execution& execution) const {
    const LatticeSize size = passages_.size();
    const std::int64_t left = std::int64_t{place.x} * side;
    const std::int64_t top = std::int64_t{place.y} * side;
    const std::int64_t thick = std::max<std::int64_t>(1, cell / 8);
    const std::uint8_t shade = cell >= 8 ? 255 : cell >= 4 ? 208 : 160;
    const auto fill = [&](std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height) {
      const std::int64_t right = std::min(side, x - left + width);
      const std::int64_t bottom = std::min(side, y - top + height);
      for (std::int64_t v = std::max<std::int64_t>(0, y - top); v < bottom; ++v) {
        for (std::int64_t u = std::max<std::int64_t>(0, x - left); u < right; ++u) {
          tile.at(static_cast<std::size_t>(u), static_cast<std::size_t>(v)) = shade;
        }
      }
    };
    const std::int64_t before = (thick + 1) / 2;
    const auto clamped = [](std::int64_t number, std::int64_t end) {
      return std::clamp<std::int64_t>(number, -1, end - 1);
    };
    const std::int64_t first_col = clamped(left / cell - cells_.margin - 1, size.cols);
    const std::int64_t last_col = clamped((left + side) / cell - cells_.margin + 1, size.cols);
    const std::int64_t highest = clamped(size.rows - 1 - (top / cell - cells_.margin - 1), size.rows);
    const std::int64_t lowest = clamped(size.rows - 1 - ((top + side) / cell - cells_.margin + 1), size.rows);
    for (std::int64_t row = lowest; row <= highest; ++row) {
      execution.check();
      const std::int64_t upper = (size.rows - 1 - row + cells_.margin) * cell;  // the pixel of the cell's upper side
      for (std::int64_t col = first_col; col <= last_col; ++col) {
        const std::int64_t leftmost = (col + cells_.margin) * cell;
        if (row >= 0 && has_right_wall(col, row)) {
          fill(leftmost + cell - before, upper - before, thick, cell + thick);
        }
        if (col >= 0 && has_upper_wall(col, row)) fill(leftmost - before, upper - before, cell + thick, thick);
      }
    }
  }

  LatticePassages passages_;
  MazeOutline outline_;
  CellsOnTiles cells_;
  ShadePyramid far_;
};

/// By the walls of the cells around the place's own, ring by ring, until those farther out can't be nearer.
class MazeDistances : public PlaceDistances {
 public:
  explicit MazeDistances(const MazeTiles& tiles) : tiles_(tiles) {}

  double at(Vec2 place) const override {
    const double cols = tiles_.size().cols;
    const double rows = tiles_.size().rows;
    const bool is_inside = place.x >= 0.5 && place.y >= 0.5 && place.x <= cols + 0.5 && place.y <= rows + 0.5;
    if (!is_inside) return std::numeric_limits<double>::quiet_NaN();
    const auto col = static_cast<std::int64_t>(std::min(place.x - 0.5, cols - 1.0));
    const auto row = static_cast<std::int64_t>(std::min(place.y - 0.5, rows - 1.0));
    double least = farthest;
    for (std::int64_t ring = 0; ring == 0 || least > static_cast<double>(ring - 1); ++ring) {
      for (std::int64_t y = row - ring; y <= row + ring; ++y) {
        const bool is_whole = y == row - ring || y == row + ring;
        const std::int64_t step = is_whole || ring == 0 ? 1 : 2 * ring;
        for (std::int64_t x = col - ring; x <= col + ring; x += step) least = std::min(least, to_walls(place, x, y));
      }
    }
    return least;
  }

 private:
  static constexpr double farthest = 4.0;  // cells; what is farther is as far

  /// To the right and the upper wall of a cell; any column and row.
  double to_walls(Vec2 place, std::int64_t col, std::int64_t row) const {
    const LatticeSize size = tiles_.size();
    if (col < -1 || row < -1 || col >= size.cols || row >= size.rows) return farthest;
    const Vec2 corner{static_cast<double>(col) + 1.5, static_cast<double>(row) + 1.5};  // upper right
    double least = farthest;
    if (row >= 0 && tiles_.has_right_wall(col, row)) least = distance(place, {{corner.x, corner.y - 1.0}, corner});
    if (col < 0 || !tiles_.has_upper_wall(col, row)) return least;
    return std::min(least, distance(place, {{corner.x - 1.0, corner.y}, corner}));
  }

  const MazeTiles& tiles_;
};

std::unique_ptr<PlaceDistances> MazeTiles::distances(const Execution&) const {
  return std::make_unique<MazeDistances>(*this);
}

}  // namespace

MazeOutline MazeOutline::of_course(LatticeSize size) {
  MazeOutline outline{std::vector<bool>(size.rows, true), std::vector<bool>(size.rows, true),
                      std::vector<bool>(size.cols, true), std::vector<bool>(size.cols, true)};
  outline.left.front() = false;
  outline.right.back() = false;
  return outline;
}

MazeOutline MazeOutline::of_walls(const WallSet& walls, LatticeSize size, const Execution& execution) {
  MazeOutline outline{std::vector<bool>(size.rows), std::vector<bool>(size.rows), std::vector<bool>(size.cols),
                      std::vector<bool>(size.cols)};
  constexpr std::size_t walls_a_poll = std::size_t{1} << 20U;
  const Box around{{0.5, 0.5}, {size.cols + 0.5, size.rows + 0.5}};
  const auto mark = [](std::vector<bool>& side, double from, double to) {
    for (double at = from + 0.5; at < to; at += 1.0) {
      const auto cell = static_cast<std::size_t>(at - 0.5);
      if (at > 0.5 && cell < side.size()) side[cell] = true;
    }
  };
  walls.visit([&](auto all) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (i % walls_a_poll == 0) execution.check();
      const Segment s = all[i].segment();
      const BoxSide side = side_under(s, around);
      const Box box = box_of(s);
      if (side == BoxSide::left) mark(outline.left, box.min.y, box.max.y);
      if (side == BoxSide::right) mark(outline.right, box.min.y, box.max.y);
      if (side == BoxSide::bottom) mark(outline.lower, box.min.x, box.max.x);
      if (side == BoxSide::top) mark(outline.upper, box.min.x, box.max.x);
    }
  });
  return outline;
}

std::unique_ptr<WorldTiles> maze_tiles(LatticePassages passages, MazeOutline outline, const Execution& execution) {
  CellsOnTiles cells;
  const LatticeSize size = passages.size();
  const TileGrid grid = grid_for_cells(size.cols, size.rows, 1.0, {0.5, size.rows + 0.5}, cells);
  return std::make_unique<MazeTiles>(std::move(passages), std::move(outline), grid, cells, execution);
}

}  // namespace warren::serve

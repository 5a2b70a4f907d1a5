// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/tiles/world_tiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"
#include "parallel/sort.hpp"
#include "pictures/formats/raster.hpp"
#include "solve/kept/lattice_roadmap.hpp"
#include "spatial/maps/distance_field.hpp"
#include "spatial/obstacles/box_tree.hpp"

namespace warren::serve {

// Tiles of mazes. Where a cell has two pixels or more its walls are drawn as lines, else the share of its walls is a
// shade: of each cell where it is a pixel, of squares of cells from the pyramid beyond. Wall by wall the same numbers
// decide, so a tile costs 512 x 512 looks at bits or bytes at most, whatever the maze's size.

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
    PixelTile tile;
    const int level = cells_.level - static_cast<int>(place.zoom);
    if (level >= 0) {
      draw_far(tile, place, static_cast<unsigned>(level), execution);
    } else {
      draw_near(tile, place, std::int64_t{1} << -level, execution);
    }
    return png_of_shades(std::move(tile), colors::wall, execution);
  }

  PlaceDistances distances(const Execution&) const override {
    return {[this](Vec2 place) { return distance_at(place); }};
  }
  double largest_pixel_of_distances() const override { return 1.0 / 8.0; }

 private:
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
  unsigned open_at(std::int64_t col, std::int64_t row) const {
    return passages_.open_at(static_cast<std::uint32_t>(col), static_cast<std::uint32_t>(row));
  }
  std::uint8_t shade_of(std::uint32_t col, std::uint32_t row) const {
    constexpr unsigned of_a_wall = 127;
    const unsigned open = passages_.open_at(col, row);
    return static_cast<std::uint8_t>(of_a_wall * (2U - (open & 1U) - (open >> 1U & 1U)));
  }
  /// Lighter than lines, for the path to be seen.
  void draw_far(PixelTile& tile, const TilePlace& place, unsigned level, const Execution& execution) const {
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
  void draw_near(PixelTile& tile, const TilePlace& place, std::int64_t cell, const Execution& execution) const {
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
        if (row >= 0 && has_right_wall(col, row)) fill(leftmost + cell - before, upper - before, thick, cell + thick);
        if (col >= 0 && has_upper_wall(col, row)) fill(leftmost - before, upper - before, cell + thick, thick);
      }
    }
  }

  static constexpr double farthest = 4.0;  // cells; what is farther is as far

  /// By the walls of the cells around the place's own, ring by ring, until those farther out can't be nearer.
  double distance_at(Vec2 place) const {
    const double cols = passages_.size().cols;
    const double rows = passages_.size().rows;
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
  /// To the right and the upper wall of a cell; any column and row.
  double to_walls(Vec2 place, std::int64_t col, std::int64_t row) const {
    const LatticeSize size = passages_.size();
    if (col < -1 || row < -1 || col >= size.cols || row >= size.rows) return farthest;
    const Vec2 corner{static_cast<double>(col) + 1.5, static_cast<double>(row) + 1.5};  // upper right
    double least = farthest;
    if (row >= 0 && has_right_wall(col, row)) least = distance(place, {{corner.x, corner.y - 1.0}, corner});
    if (col < 0 || !has_upper_wall(col, row)) return least;
    return std::min(least, distance(place, {{corner.x - 1.0, corner.y}, corner}));
  }

  LatticePassages passages_;
  MazeOutline outline_;
  CellsOnTiles cells_;
  ShadePyramid far_;
};

// Tiles of maps: a pixel takes the shade of the cell in its middle, from afar that of the pyramid's square there. Maps
// may be turned, so each row of pixels is a line through the cells.

constexpr std::uint8_t blocked_shade = 255;
constexpr std::uint8_t unknown_shade = 80;

class MapTiles : public WorldTiles {
 public:
  MapTiles(const OccupancyMap& map, const Execution& execution)
      : WorldTiles(grid_around(world_box(map))),
        map_(map),
        far_(
            map.width(), map.height(), [this](std::uint32_t x, std::uint32_t y) { return shade_of(x, y); }, execution) {
  }

  std::string draw(const TilePlace& place, const Execution& execution) const override {
    PixelTile tile;
    const OnTile on_tile = grid().on(place);
    const Vec2 first = map_point(map_, on_tile.middle_of(0));
    const Vec2 right = map_point(map_, on_tile.middle_of(1)) - first;
    const Vec2 down = map_point(map_, on_tile.middle_of(TileGrid::pixels)) - first;
    unsigned level = 0;  // the last one whose squares are no larger than a pixel
    while (level + 1 < far_.levels() && static_cast<double>(2U << level) <= on_tile.pixel / map_.cell) ++level;
    for (unsigned y = 0; y < TileGrid::pixels; ++y) {
      if (y % 64 == 0) execution.check();
      for (unsigned x = 0; x < TileGrid::pixels; ++x) {
        tile.at(x, y) = shade_at(first + static_cast<double>(x) * right + static_cast<double>(y) * down, level);
      }
    }
    return png_of_shades(std::move(tile), colors::wall, execution);
  }

  /// Of a cell's middle, from the squares of blocked cells and of those around the map; four bytes a cell.
  PlaceDistances distances(const Execution& execution) const override {
    return {[this, field = DistanceField(map_.blocked, CellDistance::squares, true, execution)](Vec2 place) {
      const std::optional<Cell> cell = cell_at(map_, place);
      if (!cell || map_.blocked.test(cell->x, cell->y)) return std::numeric_limits<double>::quiet_NaN();
      return map_.cell * field.distance(cell->x, cell->y);
    }};
  }

 private:
  std::uint8_t shade_of(std::uint32_t x, std::uint32_t y) const {
    if (!map_.blocked.test(x, y)) return 0;
    return !map_.unknown.empty() && map_.unknown.test(x, y) ? unknown_shade : blocked_shade;
  }
  std::uint8_t shade_at(Vec2 in_cells, unsigned level) const {
    if (!(in_cells.x >= 0.0 && in_cells.y >= 0.0 && in_cells.x < map_.width() && in_cells.y < map_.height())) return 0;
    const auto x = static_cast<std::uint32_t>(in_cells.x);
    const auto y = static_cast<std::uint32_t>(in_cells.y);
    return level == 0 ? shade_of(x, y) : far_.at(level, x >> level, y >> level);
  }

  const OccupancyMap& map_;
  ShadePyramid far_;
};

// Tiles of walls, polygons and bounds: the shapes whose boxes meet a tile, by a tree of boxes, drawn as they are. From
// afar that is all of them: a tile of zoom 0 costs a fifth of a microsecond a wall.

constexpr double wall_pixels = 2.0;
constexpr double outline_pixels = 1.0;

std::size_t shape_count(const Scene& scene) { return scene.walls.size() + scene.polygons.size(); }

BoxOf<2> as_item(const Box& box) { return {{box.min.x, box.min.y}, {box.max.x, box.max.y}}; }

/// Of so many items: box(i) is that of the i-th.
template <class BoxOfItem>
std::vector<BoxOf<2>> boxes_of(std::size_t count, const BoxOfItem& box, const Execution& execution) {
  std::vector<BoxOf<2>> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    execution.poll(i);
    boxes.push_back(as_item(box(i)));
  }
  return boxes;
}

std::vector<BoxOf<2>> boxes_of(const Scene& scene, const Execution& execution) {
  if (shape_count(scene) > most_shapes) {
    throw UsageError(fmt::format("a world of {} walls and polygons is too large to be shown; at most {} are",
                                 shape_count(scene), most_shapes));
  }
  execution.reserve(2 * shape_count(scene) * sizeof(BoxOf<2>) + shape_count(scene) * 64);
  const std::size_t walls = scene.walls.size();
  const auto box = [&](std::size_t i) {
    return i < walls ? box_of(scene.walls.segment(i)) : box_around(scene.polygons[i - walls].corners);
  };
  return boxes_of(shape_count(scene), box, execution);
}

Box box_of_world(const Scene& scene, const Execution& execution) {
  Box box = obstacle_box(scene, execution);
  if (scene.bounds) box.include(*scene.bounds);
  return box.empty() ? Box{{0, 0}, {1, 1}} : box;
}

/// Sides along which parts of one polygon are joined.
class SeamSides {
 public:
  SeamSides(const Scene& scene, const Execution& execution) {
    for (const Segment& seam : scene.seams) sides_.push_back(ordered_ends(seam.a, seam.b));
    polled_sort(sides_.begin(), sides_.end(), execution);
  }
  /// Calls visit(a, b) for all other sides of a polygon.
  template <class Visit>
  void for_each_other_side(const ScenePolygon& polygon, const Visit& visit) const {
    Vec2 a = polygon.corners.back();
    for (const Vec2 b : polygon.corners) {
      if (!std::binary_search(sides_.begin(), sides_.end(), ordered_ends(a, b))) visit(a, b);
      a = b;
    }
  }

 private:
  std::vector<std::array<double, 4>> sides_;
};

/// Walls, sides of polygons but seams, and bounds.
std::vector<Segment> sides_of(const Scene& scene, const SeamSides& seams, const Execution& execution) {
  std::size_t count = scene.walls.size();
  for (const ScenePolygon& polygon : scene.polygons) count += polygon.corners.size();
  execution.reserve(count * (sizeof(Segment) + 3 * sizeof(BoxOf<2>)));
  std::vector<Segment> sides = bounds_walls(scene);
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    execution.poll(i);
    sides.push_back(scene.walls.segment(i));
  }
  for (const ScenePolygon& polygon : scene.polygons) {
    execution.check();
    seams.for_each_other_side(polygon, [&](Vec2 a, Vec2 b) { sides.push_back({a, b}); });
  }
  return sides;
}

PolygonSet outline_on(const OnTile& tile, const ScenePolygon& polygon) {
  std::vector<Vec2> corners;
  for (const Vec2 p : polygon.corners) corners.push_back(tile(p));
  PolygonSet one;
  one.add(corners);
  return one;
}

class ShapeTiles : public WorldTiles {
 public:
  ShapeTiles(const Scene& scene, const Execution& execution)
      : WorldTiles(grid_around(box_of_world(scene, execution))),
        scene_(scene),
        tree_(boxes_of(scene, execution), execution),
        seams_(scene, execution) {}

  std::string draw(const TilePlace& place, const Execution& execution) const override {
    Image image(TileGrid::pixels, TileGrid::pixels, execution);
    const OnTile on_tile = grid().on(place);
    const auto draw_side = [&](Vec2 a, Vec2 b) {
      image.draw_line(on_tile(a), on_tile(b), outline_pixels, colors::outline);
    };
    const auto draw_wall = [&](const Segment& s) {
      image.draw_line(on_tile(s.a), on_tile(s.b), wall_pixels, colors::wall);
    };
    const std::vector<std::uint32_t> shapes =
        shapes_in(on_tile.box.grown(2.0 * wall_pixels * on_tile.pixel), execution);
    const auto walls = static_cast<std::uint32_t>(scene_.walls.size());
    const auto polygons = std::lower_bound(shapes.begin(), shapes.end(), walls);
    std::for_each(polygons, shapes.end(), [&](std::uint32_t i) {
      image.fill(outline_on(on_tile, scene_.polygons[i - walls]), colors::polygon, 1.0, execution);
    });
    std::for_each(polygons, shapes.end(), [&](std::uint32_t i) {
      execution.check();
      seams_.for_each_other_side(scene_.polygons[i - walls], draw_side);
    });
    std::for_each(shapes.begin(), polygons, [&](std::uint32_t i) {
      if (i % 256 == 0) execution.check();
      draw_wall(scene_.walls.segment(i));
    });
    for (const Segment& s : bounds_walls(scene_)) draw_wall(s);
    std::string bytes;
    write_png_file(image, 0.0, execution, [&](std::string_view piece) { bytes += piece; });
    return bytes;
  }
  /// By a tree of sides; 132 bytes a side.
  PlaceDistances distances(const Execution& execution) const override {
    std::vector<Segment> lines = sides_of(scene_, seams_, execution);
    const auto box_of_line = [&](std::size_t i) { return box_of(lines[i]); };
    BoxTree<2> boxes(boxes_of(lines.size(), box_of_line, execution), execution);
    const Box room = scene_.bounds ? *scene_.bounds : box_of_world(scene_, execution);
    auto at = [sides = std::move(lines), tree = std::move(boxes)](Vec2 place) {
      double least = std::numeric_limits<double>::infinity();
      tree.search({{place.x, place.y}, {place.x, place.y}}, least,
                  [&](std::uint32_t i) { return least = std::min(least, distance(place, sides[tree.order()[i]])); });
      return least;
    };
    auto leave_out = [this, room](PixelTile& tile, const OnTile& on_tile, const Execution& asked) {
      Mask inside(TileGrid::pixels, TileGrid::pixels, asked);  // how much of each pixel polygons cover
      for (const std::uint32_t i : shapes_in(on_tile.box, asked)) {
        if (i < scene_.walls.size()) continue;
        inside.fill(outline_on(on_tile, scene_.polygons[i - scene_.walls.size()]), 1.0, asked);
      }
      for (std::size_t i = 0; i < tile.bytes.size(); ++i) {
        if (!room.contains(on_tile.middle_of(i)) || inside.pixels()[i] >= 128) tile.bytes[i] = 0;
      }
    };
    return {std::move(at), std::move(leave_out)};
  }

 private:
  /// Walls and then polygons, each in the order of the world.
  std::vector<std::uint32_t> shapes_in(const Box& box, const Execution& execution) const {
    std::vector<std::uint32_t> shapes;
    tree_.search(as_item(box), 0.0, [&](std::uint32_t place) {
      execution.poll(shapes.size());
      shapes.push_back(tree_.order()[place]);
      return 0.0;
    });
    polled_sort(shapes.begin(), shapes.end(), execution);
    return shapes;
  }

  const Scene& scene_;
  BoxTree<2> tree_;
  SeamSides seams_;
};

constexpr std::size_t row_pixels = TileGrid::pixels;
constexpr std::size_t stride = 4;  // pixels, of places between which a distance is told by theirs
constexpr std::size_t rows_a_chunk = 16;

/// For the distances at the middles of squares into which the box is cut, but those that are no number.
Steps steps_of(const PlaceDistances& distances, const Box& box, const Execution& execution) {
  constexpr std::size_t squares = 61;  // of a side: no divisor of what worlds are made of
  std::vector<double> found(squares * squares);
  for_each_index(found.size(), squares, execution, [&](std::size_t i) {
    const double x = (static_cast<double>(i % squares) + 0.5) / squares;
    const double y = (static_cast<double>(i / squares) + 0.5) / squares;
    found[i] = distances.at({box.min.x + x * box.width(), box.min.y + y * box.height()});
  });
  std::erase_if(found, [](double d) { return !std::isfinite(d); });
  if (found.empty()) return {};
  std::sort(found.begin(), found.end());
  return Steps::up_to(found[found.size() - 1 - found.size() / 20], found.back());
}

}  // namespace

ClearanceLayer::ClearanceLayer(const WorldTiles& tiles, const Box& box, double needed, const Execution& execution)
    : tiles_(tiles),
      distances_(tiles.distances(execution)),
      needed_(needed),
      steps_(steps_of(distances_, box, execution)) {}

/// 0 for what is no number.
std::uint8_t ClearanceLayer::ink_of(double distance) const {
  if (!(distance >= 0.0)) return 0;
  if (distance < needed_) return static_cast<std::uint8_t>(step_inks.size() + 1);
  return static_cast<std::uint8_t>(steps_.of(distance) + 1);
}

std::string ClearanceLayer::draw(const TilePlace& place, const Execution& execution) const {
  PixelTile tile;
  const OnTile on_tile = tiles_.grid().on(place);
  if (on_tile.pixel <= tiles_.largest_pixel_of_distances()) {
    if (distances_.leave_out) {
      draw_between(tile, on_tile, execution);
      distances_.leave_out(tile, on_tile, execution);
    } else {
      for_each_index(tile.bytes.size(), rows_a_chunk * row_pixels, execution,
                     [&](std::size_t i) { tile.bytes[i] = ink_of(distances_.at(on_tile.middle_of(i))); });
    }
  }
  return png_of_inks(tile, step_inks_and(too_near_ink), std::array{step_opacity}, execution);
}

/// Distances change by no more than the way, so between places they are off by less than that between these.
void ClearanceLayer::draw_between(PixelTile& tile, const OnTile& on_tile, const Execution& execution) const {
  constexpr std::size_t places = row_pixels / stride + 1;  // of a row, both ends included
  std::vector<double> found(places * places);
  const double way = static_cast<double>(stride) * on_tile.pixel;
  for_each_index(found.size(), places, execution, [&](std::size_t i) {
    const Vec2 off{static_cast<double>(i % places) * way, static_cast<double>(i / places) * way};
    found[i] = distances_.at({on_tile.box.min.x + off.x, on_tile.box.max.y - off.y});
  });
  const auto mixed = [](double a, double b, double share) { return a + share * (b - a); };
  for (std::size_t y = 0; y < row_pixels; ++y) {
    const double down = (static_cast<double>(y % stride) + 0.5) / stride;
    for (std::size_t x = 0; x < row_pixels; ++x) {
      const double right = (static_cast<double>(x % stride) + 0.5) / stride;
      const double* at = &found[y / stride * places + x / stride];
      tile.at(x, y) = ink_of(mixed(mixed(at[0], at[1], right), mixed(at[places], at[places + 1], right), down));
    }
  }
}

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
  const Box around{{0.5, 0.5}, {size.cols + 0.5, size.rows + 0.5}};
  const auto mark = [](std::vector<bool>& side, double from, double to) {
    for (double at = from + 0.5; at < to; at += 1.0) {
      const auto cell = static_cast<std::size_t>(at - 0.5);
      if (at > 0.5 && cell < side.size()) side[cell] = true;
    }
  };
  walls.visit([&](auto all) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      execution.poll(i);
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

std::unique_ptr<WorldTiles> tiles_of(const Scene& scene, const Execution& execution) {
  if (scene.map) return std::make_unique<MapTiles>(*scene.map, execution);
  if (scene.maze) {
    constexpr double no_reach = 0.0;
    if (auto passages = passages_of_maze(scene, no_reach, execution)) {
      MazeOutline outline = MazeOutline::of_walls(scene.walls, passages->size(), execution);
      return maze_tiles(std::move(*passages), std::move(outline), execution);
    }
  }
  return std::make_unique<ShapeTiles>(scene, execution);
}

}  // namespace warren::serve

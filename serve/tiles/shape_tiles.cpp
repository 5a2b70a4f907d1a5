// SPDX-License-Identifier: BSD-3-Clause
// Tiles of walls, polygons and bounds: the shapes whose boxes meet a tile, by a tree of boxes, drawn as they are. From
// afar that is all of them: a tile of zoom 0 costs a fifth of a microsecond a wall.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"
#include "parallel/polled_sort.hpp"
#include "pictures/formats/png_file.hpp"
#include "pictures/formats/raster.hpp"
#include "serve/tiles/world_tiles.hpp"
#include "spatial/obstacles/box_tree.hpp"

namespace warren::serve {
namespace {

constexpr double wall_pixels = 2.0;
constexpr double outline_pixels = 1.0;
constexpr std::size_t shapes_a_poll = std::size_t{1} << 12U;

std::size_t shape_count(const Scene& scene) { return scene.walls.size() + scene.polygons.size(); }

BoxOf<2> as_item(const Box& box) { return {{box.min.x, box.min.y}, {box.max.x, box.max.y}}; }

Box box_of_corners(const ScenePolygon& polygon) {
  Box box;
  for (const Vec2 p : polygon.corners) box.include(p);
  return box;
}

std::vector<BoxOf<2>> boxes_of(const Scene& scene, const Execution& execution) {
  if (shape_count(scene) > most_shapes) {
    throw UsageError(fmt::format("a world of {} walls and polygons is too large to be shown; at most {} are",
                                 shape_count(scene), most_shapes));
  }
  execution.reserve(2 * shape_count(scene) * sizeof(BoxOf<2>) + shape_count(scene) * 64);
  std::vector<BoxOf<2>> boxes;
  const auto add = [&](const Box& box) {
    if (boxes.size() % shapes_a_poll == 0) execution.check();
    boxes.push_back(as_item(box));
  };
  for (std::size_t i = 0; i < scene.walls.size(); ++i) add(box_of(scene.walls.segment(i)));
  for (const ScenePolygon& polygon : scene.polygons) add(box_of_corners(polygon));
  return boxes;
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
    for (const Segment& seam : scene.seams) sides_.push_back(ordered(seam.a, seam.b));
    polled_sort(sides_.begin(), sides_.end(), execution);
  }
  bool holds(Vec2 a, Vec2 b) const { return std::binary_search(sides_.begin(), sides_.end(), ordered(a, b)); }

 private:
  /// With the lower end first, as sides and seams are compared.
  static std::array<double, 4> ordered(Vec2 a, Vec2 b) {
    if (b.x < a.x || (b.x == a.x && b.y < a.y)) std::swap(a, b);
    return {a.x, a.y, b.x, b.y};
  }
  std::vector<std::array<double, 4>> sides_;
};

/// Walls, sides of polygons but seams, and bounds.
std::vector<Segment> sides_of(const Scene& scene, const SeamSides& seams, const Execution& execution) {
  std::size_t count = scene.walls.size();
  for (const ScenePolygon& polygon : scene.polygons) count += polygon.corners.size();
  execution.reserve(count * (sizeof(Segment) + 3 * sizeof(BoxOf<2>)));
  std::vector<Segment> sides = bounds_walls(scene);
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    if (i % shapes_a_poll == 0) execution.check();
    sides.push_back(scene.walls.segment(i));
  }
  for (const ScenePolygon& polygon : scene.polygons) {
    execution.check();
    Vec2 a = polygon.corners.back();
    for (const Vec2 b : polygon.corners) {
      if (!seams.holds(a, b)) sides.push_back({a, b});
      a = b;
    }
  }
  return sides;
}

std::vector<BoxOf<2>> boxes_of(const std::vector<Segment>& sides, const Execution& execution) {
  std::vector<BoxOf<2>> boxes;
  for (const Segment& side : sides) {
    if (boxes.size() % shapes_a_poll == 0) execution.check();
    boxes.push_back(as_item(box_of(side)));
  }
  return boxes;
}

class ShapeTiles : public WorldTiles {
 public:
  ShapeTiles(const Scene& scene, const Execution& execution)
      : WorldTiles(grid_around(box_of_world(scene, execution))),
        scene_(scene),
        tree_(boxes_of(scene, execution), execution),
        seams_(scene, execution) {}

  std::string draw(const TilePlace& place, const Execution& execution) const override {
    Image image(TileGrid::pixels, TileGrid::pixels, colors::paper, execution);
    const Brush brush{image, grid().box_of(place), grid().pixel(place.zoom), execution};
    const std::vector<std::uint32_t> shapes = shapes_in(brush.box.grown(2.0 * wall_pixels * brush.pixel), execution);
    const auto walls = static_cast<std::uint32_t>(scene_.walls.size());
    const auto polygons = std::lower_bound(shapes.begin(), shapes.end(), walls);
    std::for_each(polygons, shapes.end(), [&](std::uint32_t i) { fill(brush, scene_.polygons[i - walls]); });
    std::for_each(polygons, shapes.end(), [&](std::uint32_t i) { outline(brush, scene_.polygons[i - walls]); });
    std::for_each(shapes.begin(), polygons, [&](std::uint32_t i) {
      if (i % 256 == 0) execution.check();
      brush.line(scene_.walls.segment(i), wall_pixels);
    });
    for (const Segment& s : bounds_walls(scene_)) brush.line(s, wall_pixels);
    std::string bytes;
    write_png_file(image, 0.0, execution, [&](std::string_view piece) { bytes += piece; });
    return bytes;
  }
  std::unique_ptr<PlaceDistances> distances(const Execution& execution) const override;

  const Scene& scene() const { return scene_; }
  const SeamSides& seams() const { return seams_; }
  /// How much of each pixel lies inside of polygons. Throws Stopped.
  Mask insides(const Box& box, double pixel, const Execution& execution) const {
    Mask mask(TileGrid::pixels, TileGrid::pixels, execution);
    for (const std::uint32_t i : shapes_in(box, execution)) {
      if (i < scene_.walls.size()) continue;
      PolygonSet one;
      std::vector<Vec2> corners;
      for (const Vec2 p : scene_.polygons[i - scene_.walls.size()].corners) {
        corners.push_back({(p.x - box.min.x) / pixel, (box.max.y - p.y) / pixel});
      }
      one.add(corners);
      mask.fill(one, 1.0, execution);
    }
    return mask;
  }

 private:
  struct Brush {
    Image& image;
    Box box;
    double pixel;
    const Execution& execution;

    Vec2 at(Vec2 p) const { return {(p.x - box.min.x) / pixel, (box.max.y - p.y) / pixel}; }
    void line(const Segment& s, double width) const {
      image.draw_line(at(s.a), at(s.b), width, width == wall_pixels ? colors::wall : colors::outline);
    }
  };

  /// Walls and then polygons, each in the order of the world.
  std::vector<std::uint32_t> shapes_in(const Box& box, const Execution& execution) const {
    std::vector<std::uint32_t> shapes;
    tree_.search(as_item(box), 0.0, [&](std::uint32_t place) {
      if (shapes.size() % shapes_a_poll == 0) execution.check();
      shapes.push_back(tree_.order()[place]);
      return 0.0;
    });
    polled_sort(shapes.begin(), shapes.end(), execution);
    return shapes;
  }
  static void fill(const Brush& brush, const ScenePolygon& polygon) {
    std::vector<Vec2> corners;
    for (const Vec2 p : polygon.corners) corners.push_back(brush.at(p));
    PolygonSet one;
    one.add(corners);
    brush.image.fill(one, colors::polygon, 1.0, brush.execution);
  }
  void outline(const Brush& brush, const ScenePolygon& polygon) const {
    brush.execution.check();
    Vec2 a = polygon.corners.back();
    for (const Vec2 b : polygon.corners) {
      if (!seams_.holds(a, b)) brush.line({a, b}, outline_pixels);
      a = b;
    }
  }

  const Scene& scene_;
  BoxTree<2> tree_;
  SeamSides seams_;
};

/// By a tree of sides; 132 bytes a side.
class ShapeDistances : public PlaceDistances {
 public:
  ShapeDistances(const ShapeTiles& tiles, const Execution& execution)
      : tiles_(tiles),
        sides_(sides_of(tiles.scene(), tiles.seams(), execution)),
        tree_(boxes_of(sides_, execution), execution),
        room_(tiles.scene().bounds ? *tiles.scene().bounds : box_of_world(tiles.scene(), execution)) {}

  double at(Vec2 place) const override {
    double least = std::numeric_limits<double>::infinity();
    tree_.search({{place.x, place.y}, {place.x, place.y}}, least,
                 [&](std::uint32_t i) { return least = std::min(least, distance(place, sides_[tree_.order()[i]])); });
    return least;
  }
  bool are_dear() const override { return true; }
  void leave_out(StepTile& tile, const Box& box, double pixel, const Execution& execution) const override {
    const Mask inside = tiles_.insides(box, pixel, execution);
    for (std::size_t i = 0; i < tile.steps.size(); ++i) {
      const Vec2 middle{static_cast<double>(i % TileGrid::pixels) + 0.5,
                        static_cast<double>(i / TileGrid::pixels) + 0.5};
      const bool is_outside = !room_.contains({box.min.x + middle.x * pixel, box.max.y - middle.y * pixel});
      if (is_outside || inside.pixels()[i] >= 128) tile.steps[i] = 0;
    }
  }

 private:
  const ShapeTiles& tiles_;
  std::vector<Segment> sides_;
  BoxTree<2> tree_;
  Box room_;
};

std::unique_ptr<PlaceDistances> ShapeTiles::distances(const Execution& execution) const {
  return std::make_unique<ShapeDistances>(*this, execution);
}

}  // namespace

std::unique_ptr<WorldTiles> shape_tiles(const Scene& scene, const Execution& execution) {
  return std::make_unique<ShapeTiles>(scene, execution);
}

}  // namespace warren::serve

// SPDX-License-Identifier: BSD-3-Clause
// A world as tiles of any zoom, each drawn when it is asked for: mazes, maps, and what has walls and shapes.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "apps/serve/tiles/web_tile.hpp"
#include "planners/lengths/core_graph.hpp"
#include "scenes/scene/scene.hpp"

namespace warren::serve {

/// How far places of a world are from the nearest obstacle. Any number of threads may ask.
struct PlaceDistances {
  /// No number inside of cells that are blocked and outside of mazes and maps.
  std::function<double(Vec2)> at;
  /// Where one a pixel would be too many: takes out what lies inside of shapes or outside of the world. None: at() is
  /// cheap and does that. Throws Stopped.
  std::function<void(PixelTile&, const OnTile&, const Execution&)> leave_out = {};
};

/// Immutable; any number of threads may draw.
class WorldTiles : NotCopied {
 public:
  explicit WorldTiles(const TileGrid& grid) : grid_(grid) {}
  virtual ~WorldTiles() = default;

  const TileGrid& grid() const { return grid_; }
  /// A PNG. The tile is one of the grid. Throws Stopped.
  virtual std::string draw(const TilePlace& tile, const Execution& execution) const = 0;
  /// Refers to what the tiles refer to, and to them. Throws Stopped.
  virtual PlaceDistances distances(const Execution& execution) const = 0;
  /// Tiles whose pixels are larger don't show them.
  virtual double largest_pixel_of_distances() const { return std::numeric_limits<double>::infinity(); }

 private:
  TileGrid grid_;
};

/// Where the body does not fit.
inline constexpr Rgb too_near_ink{200, 16, 46};

/// How far the places of a world are from the nearest obstacle, as tiles above it: a scale of round steps that fits the
/// world, and one ink more where a body of a radius does not fit. Immutable; any number of threads may draw.
class ClearanceLayer {
 public:
  /// Refers to the tiles. box: of the world, by some thousand places of which the scale is made. needed: distance that
  /// a body's middle must have, 0 for none. Throws Stopped.
  ClearanceLayer(const WorldTiles& tiles, const Box& box, double needed, const Execution& execution);

  /// A PNG. Throws Stopped.
  std::string draw(const TilePlace& place, const Execution& execution) const;
  const Steps& steps() const { return steps_; }
  double needed() const { return needed_; }

 private:
  std::uint8_t ink_of(double distance) const;
  void draw_between(PixelTile& tile, const OnTile& on_tile, const Execution& execution) const;

  const WorldTiles& tiles_;
  PlaceDistances distances_;
  double needed_;
  Steps steps_;
};

/// The walls around a maze, unit by unit: of each row the left and the right one, of each column the lower and the
/// upper.
struct MazeOutline {
  std::vector<bool> left, right;
  std::vector<bool> lower, upper;

  /// As the course's mazes have it: open left of the first cell and right of the last.
  static MazeOutline of_course(LatticeSize size);
  /// Of walls on the maze's grid. Throws Stopped.
  static MazeOutline of_walls(const WallSet& walls, LatticeSize size, const Execution& execution);
};

/// Of a maze in which a wall stands wherever the lattice has no passage.
std::unique_ptr<WorldTiles> maze_tiles(LatticePassages passages, MazeOutline outline, const Execution& execution);
/// Of a maze, a map, or walls, polygons and bounds; refers to the scene but for a maze's. Throws UsageError for more
/// than most_shapes walls and polygons.
std::unique_ptr<WorldTiles> tiles_of(const Scene& scene, const Execution& execution);

/// The index of shapes is made on one thread, and can't be stopped: two seconds for so many.
inline constexpr std::size_t most_shapes = std::size_t{1} << 21U;

}  // namespace warren::serve

// SPDX-License-Identifier: BSD-3-Clause
// A world as tiles of any zoom, each drawn when it is asked for: mazes, maps, and what has walls and shapes.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "apps/serve/tiles/web_tile.hpp"
#include "core/run/execution.hpp"
#include "planners/lengths/lattice_passages.hpp"
#include "scenes/scene/scene.hpp"

namespace warren::serve {

/// How far places of a world are from the nearest obstacle. Immutable; any number of threads may ask.
class PlaceDistances {
 public:
  virtual ~PlaceDistances() = default;

  /// No number inside of cells that are blocked and outside of mazes and maps.
  virtual double at(Vec2 place) const = 0;
  /// Is one a pixel too many?
  virtual bool are_dear() const { return false; }
  /// Takes out what lies inside of shapes or outside of the world, where at() doesn't. Throws Stopped.
  virtual void leave_out(PixelTile&, const Box&, double /*pixel*/, const Execution&) const {}
};

/// Immutable; any number of threads may draw.
class WorldTiles {
 public:
  explicit WorldTiles(const TileGrid& grid) : grid_(grid) {}
  virtual ~WorldTiles() = default;
  WorldTiles(const WorldTiles&) = delete;
  WorldTiles& operator=(const WorldTiles&) = delete;

  const TileGrid& grid() const { return grid_; }
  /// A PNG. The tile is one of the grid. Throws Stopped.
  virtual std::string draw(const TilePlace& tile, const Execution& execution) const = 0;
  /// Refers to what the tiles refer to, and to them. Throws Stopped.
  virtual std::unique_ptr<PlaceDistances> distances(const Execution& execution) const = 0;
  /// Tiles whose pixels are larger don't show them.
  virtual double largest_pixel_of_distances() const { return std::numeric_limits<double>::infinity(); }

 private:
  TileGrid grid_;
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

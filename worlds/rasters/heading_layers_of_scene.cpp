// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/rasters/heading_layers_of_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "core/plane/se2.hpp"
#include "parallel/chunks.hpp"
#include "spatial/maps/distance_field.hpp"
#include "worlds/rasters/convex_pieces.hpp"
#include "worlds/rasters/heading_footprints.hpp"
#include "worlds/rasters/polygons_on_lattice.hpp"

namespace warren {
namespace {

/// Where positions lie, without any layer.
HeadingLayers empty_lattice(const Scene& scene, const RobotSpec& robot, const LayerOptions& options,
                            const Execution& execution) {
  const GridSpec& grid = options.grid;
  const Box box = options.region ? *options.region : scene.bounds ? *scene.bounds : obstacle_box(scene, execution);
  if (box.empty()) throw InputError("world", "has neither walls nor bounds: nothing confines the grid");
  constexpr double rounding = 1e-9;
  const double width = std::floor(box.width() / grid.cell + rounding);
  const double height = std::floor(box.height() / grid.cell + rounding);
  const std::uint32_t angles = robot.kind == RobotKind::polygon ? grid.angles : 1;
  constexpr auto most_states = static_cast<double>(HeadingLayers::most_states);
  if (width < 1.0 || height < 1.0) {
    throw InputError(scene.source.empty() ? "world" : scene.source,
                     fmt::format("a grid needs bounds, or obstacles, that span a cell of {} each way", grid.cell),
                     fmt::format("{} x {}", box.width(), box.height()));
  }
  if (!(width * height * angles <= most_states)) {
    throw InputError("grid", "must have from 1 to 2^32 - 4 states: cells across the bounds, times headings",
                     fmt::format("{} x {} x {}", width, height, angles));
  }
  HeadingLayers layers;
  layers.origin = box.min;
  layers.cell = grid.cell;
  layers.width = bounded_whole<std::uint32_t>(width);
  layers.height = bounded_whole<std::uint32_t>(height);
  layers.angles = angles;
  return layers;
}

/// The exact layers: a list of jobs, then all of them at once.
class ExactLayers {
 public:
  ExactLayers(const Scene& scene, const RobotSpec& robot, const LayerOptions& options, const Execution& execution)
      : scene_(scene),
        execution_(execution),
        outline_(robot.kind == RobotKind::polygon ? robot.outline : std::vector<Vec2>{{0.0, 0.0}}),
        radius_((robot.kind == RobotKind::disc ? robot.radius : 0.0) + options.clearance),
        layers_(empty_lattice(scene, robot, options, execution)) {
    for (const ScenePolygon& polygon : scene.polygons) {
      for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
        sides_.push_back({polygon.corners[i], polygon.corners[(i + 1) % polygon.corners.size()]});
      }
    }
  }

  HeadingLayers make() {
    const std::vector<LayerJob> jobs = list_layer_jobs(outline_, layers_);
    execution_.reserve(jobs.size() * (layers_.width / 8 + 8) * std::size_t{layers_.height});
    layers_.bitmaps.resize(jobs.size());
    for_chunks(jobs.size(), 1, execution_, [&](Range r) { layers_.bitmaps[r.first] = made(jobs[r.first]); });
    return std::move(layers_);
  }

 private:
  Bitmap made(const LayerJob& job) const {
    constexpr std::size_t walls_per_poll = 64;  // each may meet all rows
    LatticeMarking marking(layers_.origin, layers_.cell, layers_.width, layers_.height);
    for (const ConvexPiece& piece : job.pieces) {
      if (scene_.bounds) marking.mark_outside(piece, radius_, *scene_.bounds);
      for (std::size_t i = 0; i < scene_.walls.size(); ++i) {
        if (i % walls_per_poll == 0) execution_.check();
        mark(piece, scene_.walls.segment(i), marking);
      }
      for (std::size_t i = 0; i < sides_.size(); ++i) {
        if (i % walls_per_poll == 0) execution_.check();
        mark(piece, sides_[i], marking);
      }
    }
    if (job.is_standing) {
      for (std::size_t i = 0; i < scene_.polygons.size(); ++i) {
        if (i % walls_per_poll == 0) execution_.check();
        marking.mark_inside(scene_.polygons[i].corners, job.pieces.front().front(), execution_);
      }
    }
    return marking.take();
  }
  void mark(const ConvexPiece& piece, const Segment& wall, LatticeMarking& marking) const {
    marking.mark_near(touching_positions(piece, wall), radius_);
  }

  const Scene& scene_;
  const Execution& execution_;
  std::vector<Vec2> outline_;
  double radius_;
  std::vector<Segment> sides_;  // of polygons
  HeadingLayers layers_;
};

// ---- as in report 004 -----------------------------------------------------------------------------------------------

/// The report's drawing, found from its figures: a wall covers the cells on both sides of it, a level one also the cell
/// before its first; an upright one begins and ends with the cells of its ends.
void draw_two_cells_thick(const Segment& wall, const HeadingLayers& lattice, Bitmap& drawn) {
  const auto set = [&](double i, double j) {
    if (i >= 0.0 && j >= 0.0 && i < lattice.width && j < lattice.height) {
      drawn.set(bounded_whole<std::uint32_t>(i), bounded_whole<std::uint32_t>(j));
    }
  };
  const Vec2 a = (1.0 / lattice.cell) * (wall.a - lattice.origin);
  const Vec2 b = (1.0 / lattice.cell) * (wall.b - lattice.origin);
  const bool steep = std::abs(b.y - a.y) > std::abs(b.x - a.x);
  const double from = std::floor(steep ? a.y : a.x);
  const double to = std::floor(steep ? b.y : b.x);
  const double length = std::abs(to - from);
  for (double step = 0.0; step <= length; ++step) {
    const double t = length == 0.0 ? 0.0 : step / length;
    const double along = from + std::copysign(step, to - from);
    const double across = std::floor(steep ? a.x + t * (b.x - a.x) : a.y + t * (b.y - a.y));
    const double i = steep ? across : along;
    const double j = steep ? along : across;
    for (const double left : {i - 1.0, i}) {
      set(left, j);
      if (!steep) set(left, j - 1.0);
    }
  }
}

/// Half of the body's projection on the axes at one heading, in cells, rounded up.
std::uint32_t disc_cells(const RobotSpec& robot, const HeadingLayers& lattice, std::uint32_t k) {
  double reach = robot.radius;
  for (const Vec2 p : turned(robot.outline, k, lattice.angles)) {
    reach = std::max({reach, std::abs(p.x), std::abs(p.y)});
  }
  constexpr double rounding = 1e-9;
  return bounded_whole<std::uint32_t>(std::ceil(reach / lattice.cell - rounding));
}

Bitmap drawn_walls(const Scene& scene, const HeadingLayers& lattice, const Execution& execution) {
  Bitmap drawn(lattice.width, lattice.height);
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    if (i % 64 == 0) execution.check();
    draw_two_cells_thick(scene.walls.segment(i), lattice, drawn);
  }
  for (const ScenePolygon& polygon : scene.polygons) {
    execution.check();
    for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
      draw_two_cells_thick({polygon.corners[i], polygon.corners[(i + 1) % polygon.corners.size()]}, lattice, drawn);
    }
  }
  drawn.set_run(0, 0, lattice.width);
  drawn.set_run(lattice.height - 1, 0, lattice.width);
  for (std::uint32_t j = 0; j < lattice.height; ++j) {
    drawn.set(0, j);
    drawn.set(lattice.width - 1, j);
  }
  return drawn;
}

HeadingLayers report_layers(const Scene& scene, const RobotSpec& robot, const LayerOptions& options,
                            const Execution& execution) {
  HeadingLayers layers = empty_lattice(scene, robot, options, execution);
  const DistanceField field(drawn_walls(scene, layers, execution), CellDistance::centres, false, execution);
  std::map<std::uint32_t, std::uint32_t> bitmap_of;  // by the disc's radius
  for (std::uint32_t k = 0; k < layers.angles; ++k) {
    const std::uint32_t radius = disc_cells(robot, layers, k);
    const auto [at, is_new] = bitmap_of.emplace(radius, as_whole<std::uint32_t>(layers.bitmaps.size()));
    layers.standing.push_back(at->second);
    if (!is_new) continue;
    Bitmap blocked(layers.width, layers.height);
    for (std::uint32_t j = 0; j < layers.height; ++j) {
      if (j % 64 == 0) execution.check();
      for (std::uint32_t i = 0; i < layers.width; ++i) {
        if (field.squared(i, j) <= std::uint64_t{radius} * radius) blocked.set(i, j);
      }
    }
    layers.bitmaps.push_back(std::move(blocked));
  }
  return layers;
}

}  // namespace

HeadingLayers orientation_layers(const Scene& scene, const RobotSpec& robot, const LayerOptions& options,
                                 const Execution& execution) {
  if (robot.kind != RobotKind::point && robot.kind != RobotKind::disc && robot.kind != RobotKind::polygon) {
    throw InputError("robot", "must be a point, a disc or a polygon for a grid");
  }
  if (!(options.grid.cell > 0.0) || options.grid.angles < 1) {
    throw InputError("grid", "needs a cell above 0 and at least one heading");
  }
  if (options.kind == LayerKind::report004) return report_layers(scene, robot, options, execution);
  return ExactLayers(scene, robot, options, execution).make();
}

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/rasters/heading_layers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "core/plane/convex_polygons.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"
#include "core/plane/se2.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "spatial/maps/distance_field.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren {
namespace {

/// One bitmap to be made: positions at which the union of the pieces touches something.
struct LayerJob {
  std::vector<ConvexPiece> pieces;
  bool is_standing = false;  ///< a body may also stand inside an obstacle without touching its outline
};

/// Corners in order from the least: the same for every heading that covers the same set.
ConvexPiece key_of(ConvexPiece corners) {
  std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end(), is_before), corners.end());
  return corners;
}

/// The turn to the next heading, larger ones in parts, so that arcs stay near their tangents.
LayerJob turn_job(const std::vector<ConvexPiece>& pieces, std::uint32_t angles) {
  LayerJob job;
  const double angle_rad = 2.0 * std::numbers::pi / angles;
  constexpr double widest = std::numbers::pi / 24;
  const int parts = bounded_whole<int>(std::ceil(angle_rad / widest));
  for (const ConvexPiece& piece : pieces) {
    for (int part = 0; part < parts; ++part) {
      ConvexPiece from;
      for (const Vec2 p : piece) from.push_back(Rotation(part * angle_rad / parts)(p));
      for (ConvexPiece& swept : swept_by_turn(from, angle_rad / parts)) job.pieces.push_back(std::move(swept));
    }
  }
  return job;
}

/// Which bitmaps the layers of a turning body need, whatever it turns among: for each heading what the body covers
/// where it stands, on each of the four steps and on the turn to the next heading, as convex pieces around the
/// reference point. Headings at which the body covers the same set share their jobs. O(headings squared) comparisons.
/// Job i makes bitmap i; fills in standing, moving and turning. outline: a polygon around the reference point, or that
/// alone.
std::vector<LayerJob> list_layer_jobs(std::span<const Vec2> outline, HeadingLayers& layers,
                                      const Execution& execution) {
  execution.reserve(layers.angles * 6 * (sizeof(LayerJob) + 4 * outline.size() * sizeof(Vec2)));
  std::vector<LayerJob> jobs;
  const auto add = [&](LayerJob job) {
    jobs.push_back(std::move(job));
    return as_whole<std::uint32_t>(jobs.size() - 1);
  };
  std::vector<ConvexPiece> keys;
  for (std::uint32_t k = 0; k < layers.angles; ++k) {
    execution.check();
    keys.push_back(key_of(turned(outline, k, layers.angles)));
    const auto same = as_whole<std::size_t>(std::find(keys.begin(), keys.end(), keys.back()) - keys.begin());
    if (same < k) {
      layers.standing.push_back(layers.standing[same]);
      layers.moving.push_back(layers.moving[same]);
      if (layers.angles > 1) layers.turning.push_back(layers.turning[same]);
      continue;
    }
    const std::vector<ConvexPiece> pieces = outline_pieces(turned(outline, k, layers.angles));
    layers.standing.push_back(add({pieces, true}));
    std::array<std::uint32_t, 4>& moving = layers.moving.emplace_back();
    for (std::size_t s = 0; s < moving.size(); ++s) {
      const auto [dx, dy] = HeadingLayers::steps[s];
      LayerJob job;
      for (const ConvexPiece& piece : pieces) {
        job.pieces.push_back(swept_by_step(piece, {dx * layers.cell, dy * layers.cell}));
      }
      moving[s] = add(std::move(job));
    }
    if (layers.angles > 1) layers.turning.push_back(add(turn_job(pieces, layers.angles)));
  }
  return jobs;
}

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
  const auto whole = [](double x) { return bounded_whole<std::uint32_t>(x); };
  return {box.min, grid.cell, whole(width), whole(height), angles, {}, {}, {}, {}};
}

/// Where a piece of the job, widened by the radius, touches a wall or a side, or leaves the bounds.
Bitmap touching_bitmap(const LayerJob& job, const Scene& scene, std::span<const Segment> sides, double radius,
                       const HeadingLayers& lattice, const Execution& execution) {
  const std::size_t walls_per_poll = std::max(1U, (1U << 15U) / lattice.height);  // each may meet all rows
  const std::size_t walls = scene.walls.size();
  LatticeMarking marking(lattice.origin, lattice.cell, lattice.width, lattice.height);
  for (const ConvexPiece& piece : job.pieces) {
    if (scene.bounds) marking.mark_outside(piece, radius, *scene.bounds);
    for (std::size_t i = 0; i < walls + sides.size(); ++i) {
      if (i % walls_per_poll == 0) execution.check();
      const Segment wall = i < walls ? scene.walls.segment(i) : sides[i - walls];
      marking.mark_near(touching_positions(piece, wall), radius);
    }
  }
  if (!job.is_standing) return marking.take();
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    if (i % walls_per_poll == 0) execution.check();
    marking.mark_inside(scene.polygons[i].corners, job.pieces.front().front(), execution);
  }
  return marking.take();
}

/// A list of jobs, then all of them at once.
HeadingLayers exact_layers(const Scene& scene, const RobotSpec& robot, const LayerOptions& options,
                           const Execution& execution) {
  HeadingLayers layers = empty_lattice(scene, robot, options, execution);
  const double radius = (robot.kind == RobotKind::disc ? robot.radius : 0.0) + options.clearance;
  std::vector<Segment> sides;  // of polygons
  for (const ScenePolygon& polygon : scene.polygons) {
    for_each_side(polygon.corners, [&](Vec2 a, Vec2 b) { push_asked(sides, {a, b}, execution); });
  }
  const std::vector<Vec2> middle{{0.0, 0.0}};
  const auto jobs = list_layer_jobs(robot.kind == RobotKind::polygon ? robot.outline : middle, layers, execution);
  execution.reserve(jobs.size() * (layers.width / 8 + 8) * std::size_t{layers.height});
  layers.bitmaps = parts_of_chunks(jobs.size(), 1, execution, [&](Range r) {
    return touching_bitmap(jobs[r.first], scene, sides, radius, layers, execution);
  });
  return layers;
}

/// The drawing of the course's report 004, found from its figures: a wall covers the cells on both sides of it, a level
/// one also the cell before its first; an upright one begins and ends with the cells of its ends. Throws Stopped.
void draw_two_cells_thick(const Segment& wall, const HeadingLayers& lattice, Bitmap& drawn,
                          const Execution& execution) {
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
  const double last = steep ? lattice.height : lattice.width;  // a wall may go on far beyond the lattice
  const double first = std::clamp(to < from ? from - last : -from, 0.0, length);
  const double end = std::min(length, to < from ? from : last - from);
  for (std::uint64_t k = 0; static_cast<double>(k) <= end - first; ++k) {
    execution.poll(k);
    const double step = first + static_cast<double>(k);
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
  execution.reserve(Bitmap::bytes_for(lattice.width, lattice.height));
  Bitmap drawn(lattice.width, lattice.height);
  const auto draw = [&](Vec2 a, Vec2 b) { draw_two_cells_thick({a, b}, lattice, drawn, execution); };
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    const Segment wall = scene.walls.segment(i);
    draw(wall.a, wall.b);
  }
  for (const ScenePolygon& polygon : scene.polygons) for_each_side(polygon.corners, draw);
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
    execution.reserve(Bitmap::bytes_for(layers.width, layers.height));
    Bitmap blocked(layers.width, layers.height);
    for (std::uint32_t j = 0; j < layers.height; ++j) {
      execution.check();
      for (std::uint32_t i = 0; i < layers.width; ++i) {
        if (field.squared(i, j) <= std::uint64_t{radius} * radius) blocked.set(i, j);
      }
    }
    layers.bitmaps.push_back(std::move(blocked));
  }
  return layers;
}

/// Cells at row dy and columns first .. last from a position.
struct StampRun {
  int dy;
  int first;
  int last;
};

/// Which cells, as offsets from the position, a body touches.
struct Stamp {
  std::vector<StampRun> runs;
  int least_x = 0;  // of all cells
  int most_x = 0;
  int least_y = 0;
  int most_y = 0;
  int widest = 0;  // cells of a run

  void add(const StampRun& run) {
    runs.push_back(run);
    least_x = std::min(least_x, run.first);
    most_x = std::max(most_x, run.last);
    least_y = std::min(least_y, run.dy);
    most_y = std::max(most_y, run.dy);
    widest = std::max(widest, run.last - run.first + 1);
  }
};

/// to[w] |= the bits of `from` beginning at `first`, for all words of `to`.
void or_from(std::span<const std::uint64_t> from, std::size_t first, std::span<std::uint64_t> to) {
  const std::uint64_t* words = from.data() + first / 64;
  const unsigned shift = first % 64;
  if (shift == 0) {
    for (std::size_t w = 0; w < to.size(); ++w) to[w] |= words[w];
    return;
  }
  for (std::size_t w = 0; w < to.size(); ++w) to[w] |= words[w] >> shift | words[w + 1] << (64 - shift);
}

/// doubled[n] bit t: is any of the row's bits t .. t + 2^n - 1 set? The row begins at bit 64 * margin.
void double_row(std::span<const std::uint64_t> row, std::size_t margin,
                std::vector<std::vector<std::uint64_t>>& doubled) {
  std::copy(row.begin(), row.end(), doubled[0].begin() + as_whole<std::ptrdiff_t>(margin));
  for (std::size_t n = 1; n < doubled.size(); ++n) {
    std::vector<std::uint64_t>& wide = doubled[n];
    wide = doubled[n - 1];
    const std::size_t by = std::size_t{1} << (n - 1);
    const std::size_t words = wide.size() - by / 64 - 1;
    or_from(doubled[n - 1], by, std::span(wide).first(words));
  }
}

/// The bitmap widened by the stamp, and the positions from which that reaches beyond the map.
Bitmap widened(const Bitmap& blocked, const Stamp& stamp, const Execution& execution) {
  const int reach = std::max({-stamp.least_x, stamp.most_x, stamp.widest});
  const std::size_t margin = as_whole<std::size_t>(reach) / 64 + 1;  // words before a row's first
  const std::size_t words = blocked.row(0).size() + 2 * margin + 2;
  const auto lengths = as_whole<std::size_t>(std::bit_width(as_whole<unsigned>(stamp.widest)));
  std::vector doubled(lengths, std::vector<std::uint64_t>(words, 0));
  const std::int64_t width = blocked.width();
  const std::int64_t height = blocked.height();
  Bitmap result(blocked.width(), blocked.height());
  for (std::uint32_t y = 0; y < blocked.height(); ++y) {
    execution.check();
    const auto row = blocked.row(y);
    if (std::all_of(row.begin(), row.end(), [](std::uint64_t word) { return word == 0; })) continue;
    double_row(row, margin, doubled);
    for (const StampRun& run : stamp.runs) {
      const std::int64_t to = std::int64_t{y} - run.dy;
      if (to < 0 || to >= height) continue;
      const auto length = as_whole<unsigned>(run.last - run.first + 1);
      const auto n = as_whole<std::size_t>(std::bit_width(length) - 1);
      const auto out = result.row(as_whole<std::uint32_t>(to));
      const auto at = [&](int dx) { return as_whole<std::size_t>(as_whole<std::int64_t>(64 * margin) + dx); };
      or_from(doubled[n], at(run.first), out);
      or_from(doubled[n], at(run.last + 1 - (1 << n)), out);
    }
  }
  result.clear_beyond_width();
  const auto column = [&](std::int64_t x) { return as_whole<std::uint32_t>(std::clamp<std::int64_t>(x, 0, width)); };
  for (std::int64_t y = 0; y < height; ++y) {
    const auto row = as_whole<std::uint32_t>(y);
    const bool is_beyond = (y + stamp.least_y < 0 || y + stamp.most_y >= height);
    result.set_run(row, 0, column(is_beyond ? width : -stamp.least_x));
    result.set_run(row, column(width - stamp.most_x), column(width));
  }
  return result;
}

/// The stamp of a job on a map whose cells are so wide, with some room around the body. A position touches the square
/// around a point exactly if the point is in the sum of body and square.
Stamp stamp_of(const LayerJob& job, double cell, double room, const Execution& execution) {
  constexpr double most_reach = 1 << 29;  // cells: wider than all that memory holds
  const double half = cell / 2;
  const std::vector<Vec2> square{{-half, -half}, {half, -half}, {half, half}, {-half, half}};
  double reach = 0.0;
  for (const ConvexPiece& piece : job.pieces) {
    for (const Vec2 p : piece) reach = std::max({reach, std::abs(p.x), std::abs(p.y)});
  }
  const auto most = bounded_whole<int>(std::ceil((reach + room + half) / cell), 0.0, most_reach) + 1;
  const double corner = -most * cell;
  const int side = 2 * most + 1;
  const auto points = as_whole<std::uint32_t>(side);
  execution.reserve(Bitmap::bytes_for(points, points));
  LatticeMarking marking({corner, corner}, cell, points, points);
  for (const ConvexPiece& piece : job.pieces) marking.mark_near(minkowski_sum(piece, square), room);
  const Bitmap marked = marking.take();
  Stamp stamp;
  for (int j = 0; j < side; ++j) {
    execution.check();
    for (int i = 0; i < side; ++i) {
      if (!marked.holds(i, j)) continue;
      const int first = i;
      while (marked.holds(i + 1, j)) ++i;
      stamp.add({j - most, first - most, i - most});
    }
  }
  return stamp;
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
  return exact_layers(scene, robot, options, execution);
}

HeadingLayers map_layers(const OccupancyMap& map, std::span<const Vec2> outline, std::uint32_t angles, double clearance,
                         const Execution& execution) {
  if (outline.size() < 3) throw InputError("robot", "a polygon needs three corners or more");
  if (!(clearance >= 0.0)) throw InputError("clearance", "must be a number from 0", std::to_string(clearance));
  if (angles < 1 || map.blocked.size() > HeadingLayers::most_states / angles) {
    throw InputError("grid", "must have from 1 to 2^32 - 4 states: the map's cells times headings",
                     fmt::format("{} x {} x {}", map.width(), map.height(), angles));
  }
  constexpr double widest = 4096.0;  // cells: half a stamp, which has 8 MB then
  const double reach = clearance + outline_reach(outline);
  if (!(reach / map.cell < widest)) {
    throw InputError("robot", "reaches over more than 4096 cells of the map", std::to_string(reach));
  }
  // The world's coordinates are rounded: what is free here shall be free there.
  constexpr double rounding = 1e-13;
  const double size = map.cell * (double{1} * map.width() + map.height());
  const double room = clearance + rounding * (std::abs(map.origin.x) + std::abs(map.origin.y) + size);
  HeadingLayers layers{{0.5 * map.cell, 0.5 * map.cell}, map.cell, map.width(), map.height(), angles, {}, {}, {}, {}};
  const std::vector<LayerJob> jobs = list_layer_jobs(outline, layers, execution);
  execution.reserve(jobs.size() * map.blocked.bytes());
  layers.bitmaps = parts_of_chunks(jobs.size(), 1, execution, [&](Range r) {
    const Stamp stamp = stamp_of(jobs[r.first], map.cell, room, execution);
    return widened(map.blocked, stamp, execution);
  });
  return layers;
}

}  // namespace warren

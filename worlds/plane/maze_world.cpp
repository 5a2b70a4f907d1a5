// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/plane/maze_world.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "core/plane/geometry.hpp"
#include "parallel/chunks.hpp"
#include "spatial/obstacles/polygon_index.hpp"

namespace warren {
namespace {

static_assert(bunch_size <= WallIndex::most_motions);

constexpr double least_clearance = 1e-3;
constexpr double largest_place = 1e9;
// Of the clearance: so near, all tests say so, and a free point beside a closed side is a millionth of a cell away from
// it at least, which is more than cell_of() may round at the largest place.
constexpr double surely_near = 0.999;

/// Cells that are looked at together. The index gives a wall for each of its pieces near them, so that they bound what
/// a long wall costs, too.
struct Block {
  static constexpr std::size_t side = 32;
  Range rows;
  Range cols;
};

/// What a wall closes in a block. Axis 0: sides that stand, between columns, left of the block's columns; 1: sides that
/// lie, between rows, of the block's cells alone.
class ClosedBy {
 public:
  ClosedBy(CellSides& cells, const Block& block, double r) : cells_(cells), block_(block), r_(r * surely_near) {}

  /// The sides of one axis.
  void close(const Segment& wall, int axis) const {
    // On the axis on which the sides lie apart, and on the other one.
    const auto across_of = [axis](Vec2 p) { return axis == 0 ? p.x : p.y; };
    const auto along_of = [axis](Vec2 p) { return axis == 0 ? p.y : p.x; };
    if (!(std::abs(across_of(wall.a) - across_of(wall.b)) < 2.0 * r_)) return;
    const double start = along_of(cells_.corner);
    const double line = std::round(0.5 * (across_of(wall.a) + across_of(wall.b)) - across_of(cells_.corner));
    const double lines = axis == 0 ? cells_.cols : cells_.rows;
    const Range& across = axis == 0 ? block_.cols : block_.rows;
    const Range& along = axis == 0 ? block_.rows : block_.cols;
    if (line < 1.0 || line > lines - 1.0) return;
    if (line < static_cast<double>(across.first) || line > static_cast<double>(across.last)) return;
    const double from =
        std::max(std::min(along_of(wall.a), along_of(wall.b)) - r_ - start, static_cast<double>(along.first));
    const double to =
        std::min(std::max(along_of(wall.a), along_of(wall.b)) + r_ - start, static_cast<double>(along.last));
    bool was_near = false;
    for (double place = std::ceil(from); place <= to; place += 1.0) {
      const Vec2 end = axis == 0 ? cells_.corner + Vec2{line, place} : cells_.corner + Vec2{place, line};
      const bool is_near = distance_sq(end, wall) < r_ * r_;
      if (is_near && was_near)
        close_side(axis, bounded_whole<std::size_t>(line), bounded_whole<std::size_t>(place) - 1);
      was_near = is_near;
    }
  }

 private:
  /// The side on line `line`, >= 1, at place `place` of it.
  void close_side(int axis, std::size_t line, std::size_t place) const {
    const std::size_t col = axis == 0 ? line : place;
    const std::size_t row = axis == 0 ? place : line;
    const std::size_t cell = row * cells_.cols + col;
    if (axis == 0) {
      clear(cell, CellSides::left);
      clear(cell - 1, CellSides::right);
      return;
    }
    const auto is_ours = [&](std::size_t r) { return r >= block_.rows.first && r < block_.rows.last; };
    if (is_ours(row)) clear(cell, CellSides::down);
    if (is_ours(row - 1)) clear(cell - cells_.cols, CellSides::up);
  }
  void clear(std::size_t cell, std::uint8_t side) const {
    cells_.open[cell] &= as_whole<std::uint8_t>(CellSides::all - side);
  }

  CellSides& cells_;
  Block block_;
  double r_;
};

/// All sides but those of the rim.
void open_all(CellSides& cells, Range rows) {
  for (std::size_t row = rows.first; row < rows.last; ++row) {
    std::uint8_t sides = CellSides::all;
    if (row == 0) sides &= CellSides::all - CellSides::down;
    if (row + 1 == cells.rows) sides &= CellSides::all - CellSides::up;
    std::uint8_t* const its = cells.open.data() + row * cells.cols;
    std::fill_n(its, cells.cols, sides);
    its[0] &= CellSides::all - CellSides::left;
    its[cells.cols - 1] &= CellSides::all - CellSides::right;
  }
}

void close_sides(const WallIndex& walls, const Block& block, double clearance, CellSides& cells) {
  const ClosedBy closed(cells, block, clearance);
  const auto corner = [&](std::size_t col, std::size_t row) {
    return cells.corner + Vec2{static_cast<double>(col), static_cast<double>(row)};
  };
  const Box box{corner(block.cols.first, block.rows.first), corner(block.cols.last, block.rows.last)};
  walls.for_each_near(box.grown(clearance), [&](const Segment& wall) {
    for (const int axis : {0, 1}) closed.close(wall, axis);
    return true;
  });
}

/// From `from`, a step off the wall, along the unit vector `normal`.
double look(const WallIndex& index, const Box& box, Vec2 from, Vec2 normal, double step, const Execution& execution) {
  const double farthest = box.width() + box.height();
  const auto blocked = [&](double t) {
    execution.check();
    return index.blocks(from + step * normal, from + t * normal);
  };
  double far = 2.0 * step;
  while (far < farthest && !blocked(far)) far *= 2.0;
  if (far >= farthest) return 0.0;
  double near = 0.5 * far;
  while (far - near > 0.01 * far) {
    const double t = 0.5 * (near + far);
    (blocked(t) ? far : near) = t;
  }
  return far;
}

/// How far one sees from the middle of a wall (or beside it, where another wall ends there), square to it (side = 1: to
/// its left, -1: right), before the next wall, to a percent; 0 where nothing is in the way within the box.
double free_width(const WallIndex& index, const Box& box, const Segment& wall, double side,
                  const Execution& execution) {
  const Vec2 along = wall.b - wall.a;
  const double length = norm(along);
  if (length == 0.0) return 0.0;
  const Vec2 normal = (side / length) * Vec2{-along.y, along.x};
  const double breadth = std::min(box.width(), box.height());
  const double step = 1e-3 * std::min(length, breadth > 0.0 ? breadth : box.width() + box.height());
  const double width = look(index, box, 0.5 * (wall.a + wall.b), normal, step, execution);
  if (width == 0.0 || width > 2.0 * step) return width;
  constexpr double aside = 0.381966;  // a wall that ends in the middle of this one is not across the way
  return look(index, box, wall.a + aside * along, normal, step, execution);
}

}  // namespace

double samples_for_width(double width, double area, double clearance) {
  constexpr double samples_a_square = 4.5;
  const double free = std::max(width - 2.0 * clearance, 0.1 * width);
  return samples_a_square * area / (free * free);
}

double typical_width(const WallIndex& index, const Box& box, const PolygonIndex* polygons, const Execution& execution) {
  constexpr std::size_t probes = 64;
  std::vector<double> widths;
  for (const Segment& wall : index.some_walls(probes)) {
    const Vec2 along = wall.b - wall.a;
    for (const double side : {-1.0, 1.0}) {
      const Vec2 beside = 0.5 * (wall.a + wall.b) + (side * 1e-3) * Vec2{-along.y, along.x};
      if (polygons != nullptr && polygons->polygon_around(beside)) continue;
      const double width = free_width(index, box, wall, side, execution);
      if (width > 0.0) widths.push_back(width);
    }
  }
  const double whole = std::sqrt(box.width() * box.height());
  if (widths.empty()) return whole;
  const auto quartile = widths.begin() + as_whole<std::ptrdiff_t>(widths.size() / 4);
  std::nth_element(widths.begin(), quartile, widths.end());
  return std::min(whole, *quartile);
}

MazeWorld::MazeWorld(const Scene& scene, double clearance, const Execution& execution)
    : clearance_(checked_clearance(clearance)),
      planning_clearance_(clearance * (1 + 1e-9)),
      index_(scene.walls, bounds_walls(scene), execution) {
  box_ = scene.bounds ? *scene.bounds : index_.box();
  if (box_.empty()) throw InputError("world", "has neither walls nor bounds: nothing confines the robot");
}

bool MazeWorld::is_free(const State& a, Query&) const noexcept {
  return box_.contains(a) && index_.keeps_clearance(a, a, planning_clearance_);
}

std::uint32_t MazeWorld::free_motions(std::span<const Motion<State>> motions, Query& query) const noexcept {
  std::transform(motions.begin(), motions.end(), query.motions.begin(), [](const Motion<State>& motion) {
    return Segment{motion.from, motion.to};
  });
  return index_.keep_clearance({query.motions.data(), motions.size()}, planning_clearance_);
}

std::uint32_t MazeWorld::free_states(std::span<const State> states, Query& query) const noexcept {
  std::uint32_t in_box = 0;
  for (std::size_t i = 0; i < states.size(); ++i) {
    query.motions[i] = {states[i], states[i]};
    in_box |= std::uint32_t{box_.contains(states[i])} << i;
  }
  return in_box & index_.keep_clearance({query.motions.data(), states.size()}, planning_clearance_);
}

double MazeWorld::suggested_samples(const Execution& execution) const {
  constexpr double least = 500.0;
  constexpr double samples_a_wall = 16.0;
  const double width = typical_width(index_, box_, nullptr, execution);
  // What so many walls in such a box are worth, however long the box is: what a square as broad as the box would need,
  // since a long world of few walls is no harder than the same one pushed together, or some samples for each wall,
  // since a long corridor may have a cell for each.
  const double breadth = std::min(box_.width(), box_.height());
  const double most = std::max(samples_for_width(width, breadth * breadth, clearance_),
                               least + samples_a_wall * static_cast<double>(index_.wall_count()));
  return std::min(samples_for_width(width, sampled_area(), clearance_), most);
}

CellSides MazeWorld::cell_sides(std::size_t most_cells, const Execution& execution) const {
  const double largest = std::max(std::max(-box_.min.x, -box_.min.y), std::max(box_.max.x, box_.max.y));
  if (box_.empty() || !(clearance_ >= least_clearance) || !(largest <= largest_place)) return {};
  const Vec2 first{std::floor(box_.min.x + 0.5), std::floor(box_.min.y + 0.5)};
  const double cols = std::max(std::ceil(box_.max.x - 0.5) - first.x, 0.0) + 1.0;
  const double rows = std::max(std::ceil(box_.max.y - 0.5) - first.y, 0.0) + 1.0;
  if (cols * rows > static_cast<double>(most_cells)) return {};
  CellSides cells{first - Vec2{0.5, 0.5}, bounded_whole<std::uint32_t>(cols), bounded_whole<std::uint32_t>(rows), {}};
  execution.reserve(std::size_t{cells.cols} * cells.rows);
  cells.open.resize(std::size_t{cells.cols} * cells.rows);
  const std::size_t grain = (std::size_t{1} << 16) / cells.cols + 16;
  for_chunks(cells.rows, grain, execution, [&](Range range) {
    open_all(cells, range);
    for (std::size_t row = range.first; row < range.last; row += Block::side) {
      for (std::size_t col = 0; col < cells.cols; col += Block::side) {
        execution.check();
        const Block block{{row, std::min(row + Block::side, range.last)},
                          {col, std::min<std::size_t>(col + Block::side, cells.cols)}};
        close_sides(index_, block, clearance_, cells);
      }
    }
  });
  return cells;
}

}  // namespace warren

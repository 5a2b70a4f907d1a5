// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/bfs_funnel_baseline.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

#include "scenes/mazes/maze_generator.hpp"

namespace warren::studies {
namespace {

/// Directions 0 up, 1 right, 2 down, 3 left; d ^ 2 is the opposite one.
enum Direction : std::uint8_t { up, right, down, left };

constexpr std::uint8_t reached = 4;
constexpr int came_by_shift = 3;  ///< bits 3 and 4 of a reached cell's byte: the direction of the step into it
constexpr std::size_t poll_every = std::size_t{1} << 16;

/// Appends to a list that may fill much of the memory: asks before it grows.
template <class T>
void append(T item, RawVector<T>& list, const Execution& execution) {
  if (list.size() == list.capacity()) execution.reserve(2 * list.size() * sizeof(T));
  list.push_back(item);
}

/// Breadth-first search over the cells' own bytes.
class CellWalk {
 public:
  CellWalk(MazeCells& cells, const Execution& execution)
      : bytes_(cells.bytes()), stride_(cells.stride()), execution_(execution) {}

  bool reaches(std::size_t start, std::size_t goal) {
    std::vector<std::size_t> frontier{start};
    std::vector<std::size_t> next;
    bytes_[start] |= reached;
    for (std::size_t expanded = 0; !frontier.empty() && (bytes_[goal] & reached) == 0; std::swap(frontier, next)) {
      next.clear();
      for (const std::size_t i : frontier) {
        if (++expanded % poll_every == 0) execution_.check();
        expand(i, next);
      }
    }
    return (bytes_[goal] & reached) != 0;
  }
  /// The steps that lead from start to goal.
  RawVector<Direction> steps(std::size_t start, std::size_t goal) const {
    RawVector<Direction> steps;
    for (std::size_t i = goal; i != start;) {
      if (steps.size() % poll_every == 0) execution_.check();
      const auto came_by = static_cast<Direction>((bytes_[i] >> came_by_shift) & 3);
      append(came_by, steps, execution_);
      i = beyond(i, static_cast<Direction>(came_by ^ 2));
    }
    std::reverse(steps.begin(), steps.end());
    return steps;
  }

 private:
  bool open(std::size_t i, Direction d) const {
    switch (d) {
      case up:
        return (bytes_[i] & MazeCells::upper_wall) == 0;
      case right:
        return (bytes_[i] & MazeCells::right_wall) == 0;
      case down:
        return (bytes_[i - 1] & MazeCells::upper_wall) == 0;
      default:
        return i > stride_ && (bytes_[i - stride_] & MazeCells::right_wall) == 0;
    }
  }
  std::size_t beyond(std::size_t i, Direction d) const {
    const std::array<std::size_t, 4> at{i + 1, i + stride_, i - 1, i - stride_};
    return at[d];
  }
  void expand(std::size_t i, std::vector<std::size_t>& next) {
    for (const Direction d : {up, right, down, left}) {
      if (!open(i, d)) continue;
      const std::size_t to = beyond(i, d);
      if ((bytes_[to] & reached) != 0) continue;
      bytes_[to] = static_cast<std::uint8_t>(bytes_[to] | reached | (d << came_by_shift));
      next.push_back(to);
    }
  }

  std::span<std::uint8_t> bytes_;
  std::size_t stride_;
  const Execution& execution_;
};

/// The side between two cells, as one sees it in walking through.
struct Gate {
  Vec2 left;
  Vec2 right;
};

constexpr std::array<Vec2, 4> ahead{{{0, 1}, {1, 0}, {0, -1}, {-1, 0}}};

/// Where a walker stands who goes through the gates along the steps: in front of one of them. The last one is the goal.
struct Spot {
  std::size_t gate = 0;
  Vec2 cell{1.0, 1.0};
};

/// Left of a walker who faces in direction d is the direction before it.
Gate gate_at(const Spot& spot, const RawVector<Direction>& steps, Vec2 goal) {
  if (spot.gate == steps.size()) return {goal, goal};
  const Direction d = steps[spot.gate];
  const Vec2 middle = spot.cell + 0.5 * ahead[d];
  const Vec2 leftward = 0.5 * ahead[(d + 3) % 4];
  return {middle + leftward, middle - leftward};
}

Spot after(const Spot& spot, const RawVector<Direction>& steps) {
  if (spot.gate == steps.size()) return {spot.gate + 1, spot.cell};
  return {spot.gate + 1, spot.cell + ahead[steps[spot.gate]]};
}

double turn(Vec2 a, Vec2 b, Vec2 c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// The taut string through the gates. Half-integer coordinates below 2^23 make every turn exact.
class Funnel {
 public:
  Funnel(Vec2 start, const Execution& execution) : execution_(execution), path_{start}, left_(start), right_(start) {}

  Path<Vec2> pull(const RawVector<Direction>& steps, Vec2 goal) {
    std::size_t gates_seen = 0;
    for (Spot at; at.gate <= steps.size(); at = after(at, steps)) {
      if (++gates_seen % poll_every == 0) execution_.check();
      const Gate gate = gate_at(at, steps, goal);
      if (!narrow_right(gate.right, at) || !narrow_left(gate.left, at)) at = restart_;
    }
    if (path_.back() != goal) append(goal, path_, execution_);
    return std::move(path_);
  }

 private:
  Vec2 apex() const { return path_.back(); }
  /// False where the string bends round the other side's corner: the walk goes on after that corner's gate.
  bool narrow_right(Vec2 p, const Spot& at) {
    if (turn(apex(), right_, p) < 0.0) return true;
    if (apex() != right_ && turn(apex(), left_, p) > 0.0) return bend(left_, left_spot_);
    right_ = p;
    right_spot_ = at;
    return true;
  }
  bool narrow_left(Vec2 p, const Spot& at) {
    if (turn(apex(), left_, p) > 0.0) return true;
    if (apex() != left_ && turn(apex(), right_, p) < 0.0) return bend(right_, right_spot_);
    left_ = p;
    left_spot_ = at;
    return true;
  }
  bool bend(Vec2 corner, Spot spot) {
    append(corner, path_, execution_);
    left_ = right_ = corner;
    left_spot_ = right_spot_ = restart_ = spot;
    return false;
  }

  const Execution& execution_;
  Path<Vec2> path_;
  Vec2 left_;
  Vec2 right_;
  Spot left_spot_;
  Spot right_spot_;
  Spot restart_;
};

}  // namespace

Path<Vec2> bfs_funnel(const Scene& scene, const Execution& execution) {
  MazeCells cells = cells_of_walls(scene.walls, *scene.maze, execution);
  const std::size_t first = cells.index(0, 0);
  const std::size_t last = cells.index(cells.cols() - 1, cells.rows() - 1);
  CellWalk walk(cells, execution);
  if (!walk.reaches(first, last)) return {};
  const Vec2 goal{cells.cols() + 0.5, static_cast<double>(cells.rows())};
  return Funnel({0.5, 1.0}, execution).pull(walk.steps(first, last), goal);
}

}  // namespace warren::studies

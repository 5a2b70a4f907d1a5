// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/maze_outline.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "parallel/chunks.hpp"
#include "worlds/maze_generator.hpp"

namespace warren {
namespace {

constexpr std::size_t grain = std::size_t{1} << 16;

Box box_of_walls(const WallSet& walls, const Execution& execution) {
  std::vector<Box> boxes(chunk_count(walls.size(), grain));
  for_chunks(walls.size(), grain, execution, [&](Range r) {
    Box box;
    for (std::size_t i = r.first; i < r.last; ++i) box.include(box_of(walls.segment(i)));
    boxes[r.first / grain] = box;
  });
  Box all;
  for (const Box& box : boxes) all.include(box);
  return all;
}

/// The size of a maze with these walls' box.
std::optional<MazeHint> size_of_box(const Box& box) {
  const double cols = box.max.x - 0.5;
  const double rows = box.max.y - 0.5;
  constexpr double most = std::numeric_limits<std::uint32_t>::max();
  if (box.empty() || box.min != Vec2{0.5, 0.5} || !(cols >= 1.0 && rows >= 1.0 && cols * rows <= most)) return {};
  if (cols != std::floor(cols) || rows != std::floor(rows)) return {};
  return MazeHint{static_cast<std::uint32_t>(rows), static_cast<std::uint32_t>(cols)};
}

/// What part of the maze's outline a wall covers.
struct Cover {
  double length = 0.0;  ///< whole numbers: sums are exact
  bool closes_a_door = false;
};

Cover cover_of(const Segment& wall, const Box& outline) {
  const Box box = box_of(wall);
  const auto is_on = [](double low, double high, double side) { return low == side && high == side; };
  Cover cover;
  if (is_on(box.min.y, box.max.y, outline.min.y) || is_on(box.min.y, box.max.y, outline.max.y)) {
    cover.length = box.width();
  }
  const bool on_left = is_on(box.min.x, box.max.x, outline.min.x);
  const bool on_right = is_on(box.min.x, box.max.x, outline.max.x);
  if (on_left || on_right) cover.length = box.height();
  cover.closes_a_door = (on_left && box.min.y < outline.min.y + 1.0 && box.height() > 0.0) ||
                        (on_right && box.max.y > outline.max.y - 1.0 && box.height() > 0.0);
  return cover;
}

bool has_outline(const WallSet& walls, const Box& outline, const Execution& execution) {
  std::vector<Cover> covers(chunk_count(walls.size(), grain));
  for_chunks(walls.size(), grain, execution, [&](Range r) {
    Cover sum;
    for (std::size_t i = r.first; i < r.last; ++i) {
      const Cover cover = cover_of(walls.segment(i), outline);
      sum.length += cover.length;
      sum.closes_a_door |= cover.closes_a_door;
    }
    covers[r.first / grain] = sum;
  });
  double length = 0.0;
  bool closed = false;
  for (const Cover& cover : covers) {
    length += cover.length;
    closed |= cover.closes_a_door;
  }
  return !closed && length == 2.0 * (outline.width() + outline.height()) - 2.0;
}

}  // namespace

std::optional<MazeHint> maze_of_walls(const WallSet& walls, const Execution& execution) {
  const Box box = box_of_walls(walls, execution);
  const std::optional<MazeHint> hint = size_of_box(box);
  if (!hint || !has_outline(walls, box, execution) || first_wall_off_grid(walls, *hint, execution)) return {};
  return hint;
}

}  // namespace warren

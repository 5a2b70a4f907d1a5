// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/mazes/maze_outline.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>
#include <vector>

#include "parallel/chunks.hpp"
#include "scenes/mazes/maze_generator.hpp"

namespace warren {
namespace {

constexpr std::size_t outline_grain = std::size_t{1} << 16;

Box box_of_walls(const WallSet& walls, const Execution& execution) {
  std::vector<Box> boxes(chunk_count(walls.size(), outline_grain));
  for_chunks(walls.size(), outline_grain, execution, [&](Range r) {
    Box box;
    for (std::size_t i = r.first; i < r.last; ++i) box.include(box_of(walls.segment(i)));
    boxes[r.first / outline_grain] = box;
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

/// A wall on one side of the outline: 0 bottom, 1 top, 2 left, 3 right.
struct Piece {
  int side;
  double low;
  double high;
  friend bool operator<(const Piece& a, const Piece& b) { return std::tie(a.side, a.low) < std::tie(b.side, b.low); }
};

std::optional<Piece> piece_of(const Segment& wall, const Box& outline) {
  const Box box = box_of(wall);
  if (box.min == box.max) return {};
  if (box.max.y == outline.min.y) return Piece{0, box.min.x, box.max.x};
  if (box.min.y == outline.max.y) return Piece{1, box.min.x, box.max.x};
  if (box.max.x == outline.min.x) return Piece{2, box.min.y, box.max.y};
  if (box.min.x == outline.max.x) return Piece{3, box.min.y, box.max.y};
  return {};
}

/// In order of sides and places.
std::vector<Piece> pieces_of(const WallSet& walls, const Box& outline, const Execution& execution) {
  std::vector<std::vector<Piece>> parts(chunk_count(walls.size(), outline_grain));
  for_chunks(walls.size(), outline_grain, execution, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) {
      if (const auto piece = piece_of(walls.segment(i), outline)) parts[r.first / outline_grain].push_back(*piece);
    }
  });
  std::vector<Piece> pieces;
  for (const auto& part : parts) pieces.insert(pieces.end(), part.begin(), part.end());
  std::sort(pieces.begin(), pieces.end());
  return pieces;
}

bool has_outline(const WallSet& walls, const Box& outline, const Execution& execution) {
  const double low[4] = {outline.min.x, outline.min.x, outline.min.y + 1.0, outline.min.y};
  const double high[4] = {outline.max.x, outline.max.x, outline.max.y, outline.max.y - 1.0};
  double covered[4] = {low[0], low[1], low[2], low[3]};
  for (const Piece& piece : pieces_of(walls, outline, execution)) {
    if (piece.low < low[piece.side] || piece.high > high[piece.side]) return false;  // it closes a door
    if (piece.low > covered[piece.side]) return false;                               // a gap
    covered[piece.side] = std::max(covered[piece.side], piece.high);
  }
  return std::equal(std::begin(covered), std::end(covered), std::begin(high));
}

}  // namespace

std::optional<MazeHint> maze_of_walls(const WallSet& walls, const Execution& execution) {
  const Box box = box_of_walls(walls, execution);
  const std::optional<MazeHint> hint = size_of_box(box);
  if (!hint || !has_outline(walls, box, execution) || first_wall_off_grid(walls, *hint, execution)) return {};
  return hint;
}

}  // namespace warren

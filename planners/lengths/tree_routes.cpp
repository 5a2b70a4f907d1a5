// SPDX-License-Identifier: BSD-3-Clause
#include "planners/lengths/tree_routes.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace warren {
namespace {

[[noreturn]] void refuse_climb() { throw InputError("route index", "its trees contradict its pieces: build it again"); }

class ClimbWalk : public MarkWalk {
 public:
  using MarkWalk::begin;
  using MarkWalk::MarkWalk;

  void step() {
    const std::uint64_t* const here = row();
    if ((here[mark_word::core] >> col() & 1U) != 0) [[unlikely]]
      refuse_climb();
    write();
    const bool is_inside = go(mark_word::low_and_high(here, col()));
    if (!is_inside || is_astray()) [[unlikely]]
      refuse_climb();
  }
};

}  // namespace

void write_climbs(const RouteIndex& index, std::span<const MarkedWay> legs, const Execution& execution) {
  walk_all<ClimbWalk>(index, legs, 16, execution);
}

TreeRoutes::Climber TreeRoutes::climber(LatticePlace from, const Climb& climb) const {
  Climber climber{from, climb, climb.steps, no_piece};
  if (climb.at_core) return climber;
  climber.piece = pieces_.piece_at(climb.last);
  climber.depth += pieces_.piece(climber.piece).depth;
  return climber;
}

/// While they are in pieces of different paths, the one with the larger number, which hangs off the other's path or
/// off another one, leaves its path by the head; what has left all pieces waits for the other. On one path the one
/// below leaves by the child of the other's piece.
void TreeRoutes::climb_to_one_piece(Climber& start, Climber& goal) const {
  const auto order = [](PieceId p) { return p + 1; };  // none is least
  const auto head = [this](PieceId p) { return p == no_piece ? no_piece : pieces_.piece(p).head; };
  while (head(start.piece) != head(goal.piece)) {
    Climber& later = order(start.piece) > order(goal.piece) ? start : goal;
    later.left = head(later.piece);
    later.piece = pieces_.piece(later.piece).up;
  }
  if (start.piece == goal.piece) return;
  Climber& below = start.piece > goal.piece ? start : goal;
  below.piece = std::min(start.piece, goal.piece);
  below.left = below.piece + 1;
}

/// To the door of the last piece that was left.
void TreeRoutes::step_out(Climber& climber) const {
  if (climber.left == no_piece) return;
  const TreePiece& left = pieces_.piece(climber.left);
  climber.at = left.door;
  climber.steps = climber.depth - left.depth + 1;
  pieces_.prefetch(climber.at);
}

/// In one piece both ways lead to its exit, outside of all to the core or the root of their tree, and where they meet
/// both have as many steps left.
TreeJoin TreeRoutes::join(LatticePlace start, LatticePlace goal) const {
  pieces_.prefetch(start);
  pieces_.prefetch(goal);
  index_.look_at_tile(start);
  index_.look_at_tile(goal);
  const std::array<Climb, 2> first = pieces_.climb_both(start, goal);
  Climber from = climber(start, first[0]);
  Climber to = climber(goal, first[1]);
  climb_to_one_piece(from, to);
  step_out(from);
  step_out(to);
  index_.look_at_tile(from.at);
  index_.look_at_tile(to.at);
  const Climb rest_a = rest_of(from);
  const Climb rest_b = rest_of(to);
  const TreeJoin apart{from.steps + rest_a.steps, to.steps + rest_b.steps, rest_a.last, rest_b.last};
  if (from.piece == no_piece && !apart.in_tree()) return apart;
  if (LatticePlaces::tile_of(from.at) != LatticePlaces::tile_of(to.at)) refuse_climb();
  std::uint32_t left_a = rest_a.steps;
  std::uint32_t left_b = rest_b.steps;
  if (std::max(left_a, left_b) > LatticePlaces::tile_places) refuse_climb();
  TileClimb a(index_.marks(), from.at);
  TileClimb b(index_.marks(), to.at);
  for (; left_a > left_b; --left_a) a.step();
  for (; left_b > left_a; --left_b) b.step();
  for (; a.place() != b.place() && left_a > 0; --left_a) {
    a.step();
    b.step();
  }
  if (a.place() != b.place()) refuse_climb();
  return {apart.start_steps - left_a, apart.goal_steps - left_a, a.place(), a.place()};
}

/// In its tile: to the exit of the piece that it is in, or to the core or the root of its tree.
Climb TreeRoutes::rest_of(const Climber& climber) const {
  if (climber.left == no_piece) return climber.climb;
  if (climber.piece == no_piece) return pieces_.climb(climber.at);
  return {climber.at, climber.depth - climber.steps - pieces_.piece(climber.piece).depth, false};
}

/// Pieces become less on the way, and their depths say how far on it their doors are.
void TreeRoutes::cut(MarkedWay climb, std::vector<MarkedWay>& legs) const {
  constexpr std::uint32_t fewest_steps = 1024;  // of a leg that is cut off
  if (climb.steps > 2 * fewest_steps) {
    const Climber climber = this->climber(climb.from, pieces_.climb(climb.from));
    std::uint32_t done = 0;
    for (PieceId number = climber.piece; number != no_piece;) {
      const TreePiece& piece = pieces_.piece(number);
      const std::uint32_t at = climber.depth - piece.depth + 1;
      if (at >= climb.steps + done) break;
      if (at <= done) refuse_climb();
      if (at - done >= fewest_steps) {
        legs.push_back({climb.from, piece.door, at - done, climb.direction, climb.first});
        climb.from = piece.door;
        climb.first += climb.direction * static_cast<std::ptrdiff_t>(at - done);
        climb.steps -= at - done;
        done = at;
      }
      number = number == piece.head ? piece.up : number - 1;
    }
  }
  if (climb.steps > 0) legs.push_back(climb);
}

}  // namespace warren

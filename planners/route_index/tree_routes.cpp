// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_index/tree_routes.hpp"

#include <algorithm>

namespace warren {

TreeRoutes::Climber TreeRoutes::climber(LatticePlace from) const {
  const Climb up = pieces_.climb(from);
  if (up.at_core) return {from, no_piece, up, 0, up.steps};
  const PieceId piece = pieces_.piece_at(up.last);
  return {from, piece, up, 0, up.steps + pieces_.depth(piece)};
}

/// By the exit of a piece that is on its way.
void TreeRoutes::leave(Climber& climber, PieceId by) const {
  climber.at = pieces_.door(by);
  climber.steps = climber.depth - pieces_.depth(by) + 1;
  climber.piece = pieces_.parent(by);
}

/// While they are in pieces of different paths, the one with the larger number, which hangs off the other's path or
/// off another one, leaves its path by the head; what has left all pieces waits for the other.
void TreeRoutes::climb_to_one_piece(Climber& start, Climber& goal) const {
  const auto head = [&](PieceId p) { return p == no_piece ? no_piece : pieces_.head(p); };
  PieceId start_head = head(start.piece);
  PieceId goal_head = head(goal.piece);
  while (start_head != goal_head) {
    if (goal_head == no_piece || (start_head != no_piece && start.piece > goal.piece)) {
      leave(start, start_head);
      start_head = head(start.piece);
    } else {
      leave(goal, goal_head);
      goal_head = head(goal.piece);
    }
  }
  if (start.piece == goal.piece) return;
  if (start.piece > goal.piece) {
    leave(start, goal.piece + 1);
  } else {
    leave(goal, start.piece + 1);
  }
}

TreeJoin TreeRoutes::join(LatticePlace start, LatticePlace goal) const {
  Climber from = climber(start);
  Climber to = climber(goal);
  climb_to_one_piece(from, to);
  for (Climber* climber : {&from, &to}) {
    if (climber->steps > 0) climber->up = pieces_.climb(climber->at);
  }
  if (from.up.last == to.up.last) return meet_in_tile(from, to);
  return {from.steps + from.up.steps, to.steps + to.up.steps, from.up.last, to.up.last};
}

/// Both ways end at the same cell of the tile.
TreeJoin TreeRoutes::meet_in_tile(const Climber& start, const Climber& goal) const {
  LatticePlace a = start.at;
  LatticePlace b = goal.at;
  std::uint32_t left_a = start.up.steps;
  std::uint32_t left_b = goal.up.steps;
  const auto up = [&](LatticePlace p) { return places_.step_inside(p, marks_.direction(p)); };
  for (; left_a > left_b; --left_a) a = up(a);
  for (; left_b > left_a; --left_b) b = up(b);
  for (; a != b && left_a > 0; --left_a) {
    a = up(a);
    b = up(b);
  }
  return {start.steps + start.up.steps - left_a, goal.steps + goal.up.steps - left_a, a, a};
}

void TreeRoutes::append_climb(LatticePlace from, std::uint32_t steps, RawVector<LatticePlace>& cells) const {
  const std::size_t most = std::min<std::size_t>(steps, places_.place_count());
  for (std::size_t i = 0; i < most && !marks_.is_core(from); ++i) {
    cells.push_back(from);
    from = places_.step(from, marks_.direction(from));
  }
}

}  // namespace warren

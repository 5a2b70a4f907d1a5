// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_index/tree_routes.hpp"

#include <algorithm>

namespace warren {

CoreEntry TreeRoutes::core_entry(Place from) const {
  const Climb first = pieces_.climb(from);
  if (first.at_core) return {first.last, first.steps};
  const PieceId piece = pieces_.piece_at(first.last);
  PieceId root = pieces_.head(piece);
  while (pieces_.parent(root) != no_piece) root = pieces_.head(pieces_.parent(root));
  return {pieces_.climb(pieces_.door(root)).last, first.steps + pieces_.depth(piece)};
}

PieceId TreeRoutes::piece_of(Place from) const {
  const Climb climb = pieces_.climb(from);
  return climb.at_core ? no_piece : pieces_.piece_at(climb.last);
}

/// While they are in pieces of different paths, the one with the larger number, which hangs off the other's path or
/// off another one, leaves its path; cells below all pieces count as one.
TreeMeeting TreeRoutes::meeting(Place a, Place b) const {
  PieceId piece_a = piece_of(a);
  PieceId piece_b = piece_of(b);
  const auto head = [&](PieceId p) { return p == no_piece ? no_piece : pieces_.head(p); };
  const auto leave = [&](Place& cell, PieceId& piece, PieceId by) {
    cell = pieces_.door(by);
    piece = pieces_.parent(by);
  };
  while (head(piece_a) != head(piece_b)) {
    const bool a_leaves = piece_b == no_piece || (piece_a != no_piece && piece_a > piece_b);
    if (a_leaves) {
      leave(a, piece_a, head(piece_a));
    } else {
      leave(b, piece_b, head(piece_b));
    }
  }
  if (piece_a != piece_b) {
    if (piece_a > piece_b) {
      leave(a, piece_a, piece_b + 1);
    } else {
      leave(b, piece_b, piece_a + 1);
    }
  }
  return meeting_in_tile(a, b);
}

TreeMeeting TreeRoutes::meeting_in_tile(Place a, Place b) const {
  const Climb end = pieces_.climb(a);
  std::uint32_t left_a = end.steps;
  std::uint32_t left_b = pieces_.climb(b).steps;
  const auto up = [&](Place p) { return places_.step_inside(p, marks_.direction(p)); };
  for (; left_a > left_b; --left_a) a = up(a);
  for (; left_b > left_a; --left_b) b = up(b);
  for (; a != b && left_a > 0; --left_a) {
    a = up(a);
    b = up(b);
  }
  return {a, left_a + (end.at_core ? 0 : pieces_.depth(pieces_.piece_at(end.last)))};
}

void TreeRoutes::append_climb(Place from, std::uint32_t steps, RawVector<Place>& cells) const {
  const std::size_t most = std::min<std::size_t>(steps, places_.place_count());
  for (std::size_t i = 0; i < most && !marks_.is_core(from); ++i) {
    cells.push_back(from);
    from = places_.step(from, marks_.direction(from));
  }
}

}  // namespace warren

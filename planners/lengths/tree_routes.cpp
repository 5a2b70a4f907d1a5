// SPDX-License-Identifier: BSD-3-Clause
#include "planners/lengths/tree_routes.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"

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

/// A bit a cell.
using SeenInTile = std::array<std::uint64_t, LatticePlaces::tile_places / 64>;

/// A climb in a tile that knows where it has been.
class TileWalk {
 public:
  TileWalk(CellMarks marks, LatticePlace from) : climb_(marks, from) { trail_[0] = at(); }

  /// False at its end, and after as many steps as a tile has cells.
  bool step() {
    if (steps_ + 1 == trail_.size() || !climb_.step()) return false;
    trail_[++steps_] = at();
    return true;
  }
  bool was_seen(const SeenInTile& seen) const { return (seen[at() / 64] >> at() % 64 & 1U) != 0; }
  bool mark(SeenInTile& seen) const {
    seen[at() / 64] |= std::uint64_t{1} << at() % 64;
    return true;
  }
  LatticePlace place() const { return climb_.place(); }
  std::uint32_t steps() const { return steps_; }
  /// From where this walk began to where the other one is, where this one has been.
  std::uint32_t steps_to(const TileWalk& other) const {
    const auto* const end = trail_.data() + steps_ + 1;
    const auto* const found = std::find(trail_.data(), end, other.at());
    if (found == end) refuse_climb();
    return static_cast<std::uint32_t>(found - trail_.data());
  }

 private:
  std::uint16_t at() const { return static_cast<std::uint16_t>(climb_.place() % LatticePlaces::tile_places); }

  TileClimb climb_;
  std::uint32_t steps_ = 0;
  std::array<std::uint16_t, LatticePlaces::tile_places> trail_;  // where it was after so many steps
};

}  // namespace

void write_climbs(const RouteIndex& index, std::span<const MarkedWay> legs, const Execution& execution) {
  constexpr std::size_t grain = 16;
  for_chunks(legs.size(), grain, execution,
             [&](Range r) { walk_side_by_side<ClimbWalk>(index, legs.subspan(r.first, r.size())); });
}

TreeRoutes::Climber TreeRoutes::climber(LatticePlace from, const Climb& climb) const {
  Climber climber{from, climb, climb.steps, no_piece};
  if (climb.at_core) return climber;
  enter(climber, pieces_.piece_at(climb.last));
  climber.depth += pieces_.piece(climber.piece).depth;
  return climber;
}

void TreeRoutes::enter(Climber& climber, PieceId piece) const {
  climber.piece = piece;
  climber.head = no_piece;
  if (piece == no_piece) return;
  climber.head = pieces_.piece(piece).head;
  climber.up = pieces_.piece(piece).up;
}

/// While they are in pieces of different paths, the one with the larger number, which hangs off the other's path or
/// off another one, leaves its path by the head; what has left all pieces waits for the other. On one path the one
/// below leaves by the child of the other's piece.
void TreeRoutes::climb_to_one_piece(Climber& start, Climber& goal) const {
  const auto order = [](PieceId p) { return p + 1; };  // none is least
  while (start.head != goal.head) {
    Climber& later = order(start.piece) > order(goal.piece) ? start : goal;
    later.left = later.head;
    enter(later, later.up);
  }
  if (start.piece == goal.piece) return;
  Climber& below = start.piece > goal.piece ? start : goal;
  below.left = std::min(start.piece, goal.piece) + 1;
}

/// To the door of the last piece that was left.
void TreeRoutes::step_out(Climber& climber) const {
  if (climber.left == no_piece) return;
  const TreePiece& left = pieces_.piece(climber.left);
  climber.at = left.door;
  climber.steps = climber.depth - left.depth + 1;
  pieces_.prefetch(climber.at);
}

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
  return from.piece != no_piece ? meet_in_piece(from, to) : meet_at_core(from, to);
}

/// Side by side until one comes where the other has been, before the exit of the piece that they are in at the latest.
TreeJoin TreeRoutes::meet_in_piece(const Climber& start, const Climber& goal) const {
  if (LatticePlaces::tile_of(start.at) != LatticePlaces::tile_of(goal.at)) refuse_climb();
  TileWalk a(marks_, start.at);
  TileWalk b(marks_, goal.at);
  SeenInTile seen{};
  if (start.at == goal.at) return {start.steps, goal.steps, start.at, start.at};
  a.mark(seen);
  b.mark(seen);
  for (bool goes = true; goes;) {
    goes = false;
    if (a.step()) {
      if (a.was_seen(seen)) return {start.steps + a.steps(), goal.steps + b.steps_to(a), a.place(), a.place()};
      goes = a.mark(seen);
    }
    if (b.step()) {
      if (b.was_seen(seen)) return {start.steps + a.steps_to(b), goal.steps + b.steps(), b.place(), b.place()};
      goes = b.mark(seen);
    }
  }
  refuse_climb();
}

/// Both have left all pieces: the core, or the root of their tree, is in the tile of each.
TreeJoin TreeRoutes::meet_at_core(Climber& start, Climber& goal) const {
  if (start.steps > 0) start.climb = pieces_.climb(start.at);
  if (goal.steps > 0) goal.climb = pieces_.climb(goal.at);
  TileClimb a(marks_, start.at);
  TileClimb b(marks_, goal.at);
  std::uint32_t left_a = start.climb.steps;
  std::uint32_t left_b = goal.climb.steps;
  const TreeJoin apart{start.steps + left_a, goal.steps + left_b, start.climb.last, goal.climb.last};
  if (!apart.in_tree()) return apart;
  for (; left_a > left_b; --left_a) a.step();
  for (; left_b > left_a; --left_b) b.step();
  for (; a.place() != b.place() && left_a > 0; --left_a) {
    a.step();
    b.step();
  }
  return {apart.start_steps - left_a, apart.goal_steps - left_a, a.place(), a.place()};
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

// SPDX-License-Identifier: BSD-3-Clause
// What can be reached from a point along straight lines (Lee's rotational plane sweep, 1978), exactly, with contact
// allowed. A ray turns once around the eye, anticlockwise from +x; the pieces that it crosses inside them are kept in
// order (planners/visibility/pieces_on_ray). On each ray that holds ends of pieces these are walked outwards with the
// lanes on which the way may still run: it is stopped by a piece that crosses the ray; an end with a piece on the left
// stops the left lane, one with a piece on the right the right one; where the ray runs along no piece the lanes are
// one. So a way may pass a corner, run along walls and sides, and not slip through where obstacles touch.
//
// O(k log k) for k pieces without crossings; with crossings O(k * pieces crossed by a ray). Only orient2d and
// comparisons of coordinates decide; rounded angles merely sort in advance.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "planners/pieces/plane_pieces.hpp"
#include "planners/visibility/pieces_on_ray.hpp"
#include "planners/visibility/sectors_at_corner.hpp"

namespace warren {

/// Scratch of one thread; refers to the pieces and the execution, which must outlive it.
class RotationalSweep {
 public:
  /// How far the ray turns: half a turn stops before -x.
  enum class Turn : std::uint8_t { whole, upper_half };
  /// What visit() is told instead of a point's number where it reaches the extra target.
  static constexpr PointId target = 0xffffffffU;

  RotationalSweep(const PlanePieces& pieces, const Execution& execution);

  /// near: pieces among which all that are met first by a ray of interest, in any order. wanted: one byte a point, is
  /// it of interest? extra: one more target. departure(q) tells on which lanes the way towards q may begin (no_lane:
  /// q's direction is of no interest). visit(point, lanes on which the way arrives) is called for what is reached.
  /// Throws Stopped.
  template <class Departure, class Visit>
  void run(Vec2 eye, Turn how_far, std::span<const std::uint32_t> near, std::span<const std::uint8_t> wanted,
           std::optional<Vec2> extra, const Departure& departure, const Visit& visit) {
    half_ = how_far == Turn::upper_half;
    prepare(eye, near, extra);
    if (pieces_.crosses()) {
      turn(crossed_, wanted, departure, visit);
    } else {
      turn(nearest_, wanted, departure, visit);
    }
  }

 private:
  static constexpr std::uint32_t none = 0xffffffffU;
  static constexpr std::uint32_t rays_per_poll = 64;  // where pieces cross, one asks each of them

  /// An end of pieces, or the extra target.
  struct Event {
    Vec2 at;
    double place;              // direction_place, rounded
    PointId id;                // `target`: the extra target
    std::uint32_t starts;      // first of the pieces that the ray begins to cross here: a linked list
    std::uint32_t ends;        // first of those that it has crossed
    bool comes_along_a_piece;  // the ray runs along a piece just before it
  };

  /// What the events are sorted by.
  struct Turned {
    double place;
    std::uint32_t event;
  };

  void prepare(Vec2 eye, std::span<const std::uint32_t> near, std::optional<Vec2> extra);
  std::uint32_t event_of(PointId p);
  void add_piece(PointId a, PointId b);
  void add_radial_piece(PointId a, PointId b);
  void sort_events();
  bool nearer_on_ray(Vec2 p, Vec2 q) const;
  bool is_passed(Vec2 p) const { return !half_ || !DirectionOrder(eye_).is_low(p); }
  bool comes_before(const Event& e, const Event& f) const;
  bool same_ray(const Event& e, const Event& f) const;

  template <class Active, class Departure, class Visit>
  void turn(Active& active, std::span<const std::uint8_t> wanted, const Departure& departure, const Visit& visit) {
    active.reset(seen_);
    for (const std::uint32_t piece : crossed_at_first_) active.insert(piece);
    for (std::size_t first = 0, end = 0; first < order_.size(); first = end) {
      bool worth_it = false;
      if (++rays_ % rays_per_poll == 0) execution_.check();
      for (end = first; end < order_.size() && (end == first || same_ray(event(first), event(end))); ++end) {
        for (std::uint32_t p = event(end).ends; p != none; p = next_end_[p]) active.remove(p);
        worth_it = worth_it || event(end).id == target || wanted[event(end).id] != 0;
      }
      if (worth_it) walk(first, end, active, wanted, departure(event(first).at), visit);
      for (std::size_t i = first; i < end; ++i) {
        for (std::uint32_t p = event(i).starts; p != none; p = next_start_[p]) active.insert(p);
      }
    }
  }

  /// Walks outwards along one ray.
  template <class Active, class Visit>
  void walk(std::size_t first, std::size_t end, Active& active, std::span<const std::uint8_t> wanted, Lanes lanes,
            const Visit& visit) const {
    for (std::size_t i = first; i < end && lanes != no_lane; ++i) {
      const Event& e = event(i);
      if (e.id == target) {
        if (!active.hides(e.at)) visit(e.id, lanes);
        continue;
      }
      if (!e.comes_along_a_piece) lanes = both_lanes;
      if (active.hides(e.at)) return;
      if (wanted[e.id] != 0) visit(e.id, lanes);
      if (e.starts != none) lanes &= static_cast<Lanes>(~left_lane);
      if (e.ends != none) lanes &= static_cast<Lanes>(~right_lane);
    }
  }

  const Event& event(std::size_t i) const { return events_[order_[i].event]; }

  const PlanePieces& pieces_;
  const Execution& execution_;
  Vec2 eye_;
  bool half_ = false;  // no events below
  std::uint32_t rays_ = 0;
  std::vector<Event> events_;
  std::vector<Turned> order_;
  std::vector<SeenPiece> seen_;  // pieces that are not seen end on
  std::vector<std::uint32_t> next_start_;
  std::vector<std::uint32_t> next_end_;
  std::vector<std::uint32_t> crossed_at_first_;
  RawVector<std::uint32_t> event_of_;  // a point's event, if events_ says so too: needs no clearing
  NearestPieces nearest_;
  CrossedPieces crossed_;
};

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
#include "serve/api/swept_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "core/base/error.hpp"
#include "core/plane/geometry.hpp"

namespace warren::serve {
namespace {

constexpr std::size_t steps_a_poll = std::size_t{1} << 12U;
constexpr double pixels_apart = 12.0;

struct Shares {
  double first = 0.0;
  double last = 1.0;
};

/// Of a straight way, what lies in the box; nothing where none does.
std::optional<Shares> shares_in(const Box& box, Vec2 from, Vec2 to) {
  Shares seen;
  const auto clip = [&](double begin, double way, double low, double high) {
    if (way == 0.0) return begin >= low && begin <= high;
    const auto [near, far] = std::minmax({(low - begin) / way, (high - begin) / way});
    seen.first = std::max(seen.first, near);
    seen.last = std::min(seen.last, far);
    return seen.first <= seen.last;
  };
  const bool is_seen =
      clip(from.x, to.x - from.x, box.min.x, box.max.x) && clip(from.y, to.y - from.y, box.min.y, box.max.y);
  return is_seen ? std::optional(seen) : std::nullopt;
}

Vec2 at(const PathState& state) { return {state.numbers[0], state.numbers[1]}; }

class BodyWalk {
 public:
  BodyWalk(const Box& box, double apart, const Execution& execution)
      : box_(box), apart_(apart), execution_(execution) {}

  /// Legs that begin so far along the way.
  void go(const PathLegs& legs, double along) {
    along_ = along;
    for (std::size_t leg = 0; leg < legs.leg_count() && !is_full(); ++leg) {
      poll();
      const double length = legs.length(leg);
      const auto seen = std::isfinite(legs.radius(leg)) ? std::optional(Shares{})
                                                        : shares_in(box_, at(legs.at(leg, 0.0)), at(legs.at(leg, 1.0)));
      if (seen && length > 0.0) add_between(legs, leg, *seen, length);
      along_ += length;
    }
  }
  void add(const PathState& state) {
    if (box_.contains(at(state))) places_.push_back(state);
  }
  bool is_full() const { return places_.size() > most_swept_bodies; }
  const std::vector<PathState>& places() const { return places_; }

 private:
  void poll() {
    if (steps_++ % steps_a_poll == 0) execution_.check();
  }
  /// The end of a leg is the next one's start.
  void add_between(const PathLegs& legs, std::size_t leg, const Shares& seen, double length) {
    for (double k = std::ceil((along_ + seen.first * length) / apart_); !is_full(); k += 1.0) {
      poll();
      const double share = std::max(0.0, (k * apart_ - along_) / length);
      if (share >= 1.0 || share > seen.last) return;
      add(legs.at(leg, share));
    }
  }

  Box box_;
  double apart_;
  const Execution& execution_;
  double along_ = 0.0;  // the way up to the next leg
  std::size_t steps_ = 0;
  std::vector<PathState> places_;
};

void walk_curve(const KeptCurve& curve, const Box& box, BodyWalk& walk) {
  std::vector<Vec2> room;
  Answer piece;
  for (std::size_t block = 0; block < curve.block_count() && !walk.is_full(); ++block) {
    if (!curve.box(block).meets(box)) continue;
    const std::span<const Vec2> points = curve.points(block, room);
    piece.path.assign(points.begin(), points.end());
    walk.go(PathLegs(piece), curve.length_before(block));
  }
}

PathState goal_of(const Answer& way, const KeptCurve& curve) {
  PathState state;
  if (way.states.empty()) {
    std::vector<Vec2> room;
    const Vec2 last = curve.points(curve.block_count() - 1, room).back();
    state.numbers = {last.x, last.y};
    return state;
  }
  state.width = way.states.width;
  std::ranges::copy(way.states[way.states.size() - 1], state.numbers.begin());
  return state;
}

}  // namespace

double reach_of(const RobotSpec& robot) {
  if (robot.outline.empty()) return robot.radius;
  double reach = 0.0;
  for (const Vec2 corner : robot.outline) reach = std::max(reach, norm(corner));
  return reach;
}

SweptBodies swept_bodies(const Answer& way, const KeptCurve& curve, const PathView& view, const Execution& execution) {
  const double reach = reach_of(way.problem.robot);
  if (!(reach > 0.0)) throw UsageError("a point has no extent, so it sweeps no more than its path");
  const Box box = view.box.grown(reach);
  for (double apart = std::max(0.5 * reach, pixels_apart * view.pixel);; apart *= 2.0) {
    BodyWalk walk(box, apart, execution);
    if (way.states.empty()) {
      walk_curve(curve, box, walk);
    } else {
      walk.go(PathLegs(way), 0.0);
    }
    walk.add(goal_of(way, curve));
    if (!walk.is_full()) return {apart, walk.places()};
  }
}

}  // namespace warren::serve

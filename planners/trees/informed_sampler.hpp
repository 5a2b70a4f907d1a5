// SPDX-License-Identifier: BSD-3-Clause
// Samples for a search that wants a cheaper path than the one it knows (Gammell, Srinivasa, Barfoot, IROS 2014): from
// the informed set, the states through which the metric allows a path below a cost, and from around the known path.
// The set is drawn by rejection; where states stand in the plane and the ellipse of the places through which a path may
// be so short is smaller than the box of all places, from that ellipse. A pure function of seed, index, cost and path.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "core/base/rng.hpp"
#include "core/base/solution.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/world.hpp"
#include "core/plane/se2.hpp"

namespace warren {

/// Refers to the world. Any number of threads may ask.
template <SteerableWorld W>
class InformedSampler {
 public:
  using State = typename W::State;

  /// goals: at least one.
  InformedSampler(const W& world, const State& start, std::span<const State> goals, std::uint64_t seed)
      : world_(&world), start_(start), goals_(goals.begin(), goals.end()), seed_(random_bits(seed, 0, purpose)) {}

  const std::vector<State>& goals() const { return goals_; }
  /// From the state to the nearest goal, at least: by the metric.
  double rest(const State& state) const {
    double least = std::numeric_limits<double>::infinity();
    for (const State& goal : goals_) least = std::min(least, world_->distance(state, goal));
    return least;
  }
  /// Of a path through the state, at least.
  double least_cost(const State& state) const { return world_->distance(start_, state) + rest(state); }

  /// The index-th sample of the states through which a path may cost less than `most`; nothing where some tries found
  /// none.
  std::optional<State> informed(std::uint64_t index, double most) const {
    const State& goal = goals_[random_bits(seed_, index, own_axes) % goals_.size()];
    for (std::uint64_t attempt = 0; attempt < tries; ++attempt) {
      const std::uint64_t draw = index * tries + attempt;
      std::optional<State> state;
      if constexpr (in_plane) state = in_ellipse(draw, goal, most);
      if (!state) state = uniform_state(*world_, seed_, draw);
      if (least_cost(*state) < most) return state;
    }
    return std::nullopt;
  }
  /// The index-th state near a path of two states or more: a place on it, moved by a half to a 512th of the way towards
  /// a random state. along: lengths_along() of the path.
  State near(const Path<State>& path, std::span<const double> along, std::uint64_t index) const {
    const PlaceOnPath at = place_on_path(along, uniform(seed_, index, own_axes + 1) * along.back());
    const State place = world_->interpolate(path[at.leg], path[at.leg + 1], at.share);
    const auto halvings = static_cast<int>(random_bits(seed_, index, own_axes + 2) % 8);
    const double share = std::ldexp(0.5 * (1.0 - 0.5 * uniform(seed_, index, own_axes + 3)), -halvings);
    return state_between(*world_, place, uniform_state(*world_, seed_, index * tries), share);
  }

 private:
  static constexpr std::uint64_t purpose = 0x696e666f726d6564U;
  static constexpr std::uint64_t tries = 8;     // with 32, cars spent half of a tree's time here
  static constexpr std::uint64_t own_axes = 8;  // from here on, and below 16: no axes of the world
  static constexpr bool in_plane = std::same_as<State, Vec2> || std::same_as<State, Se2>;

  static Vec2 place_of(const State& state) { return {state.x, state.y}; }
  /// A state of the ellipse around the start's place and the goal's; nothing where it is no smaller than the box.
  std::optional<State> in_ellipse(std::uint64_t draw, const State& goal, double most) const {
    const Vec2 from = place_of(start_);
    const Vec2 between = place_of(goal) - from;
    const double width_sq = most * most - dot(between, between);
    if (!(width_sq > 0.0)) return std::nullopt;
    const double width = std::sqrt(width_sq);
    if (!(std::numbers::pi * 0.25 * most * width < box_area())) return std::nullopt;
    const double radius = 0.5 * std::sqrt(uniform(seed_, draw, 0));
    const auto [sine, cosine] = portable::sin_and_cos(2.0 * std::numbers::pi * uniform(seed_, draw, 1));
    const double apart = norm(between);
    const Vec2 along = apart > 0.0 ? (1.0 / apart) * between : Vec2{1.0, 0.0};
    const Vec2 across{-along.y, along.x};
    const Vec2 place = from + 0.5 * between + (radius * most * cosine) * along + (radius * width * sine) * across;
    if constexpr (std::same_as<State, Se2>) {
      return Se2{place.x, place.y, std::numbers::pi * (2.0 * uniform(seed_, draw, 2) - 1.0)};
    } else {
      return place;
    }
  }
  /// Of the places that uniform samples have, at some heading.
  double box_area() const {
    const double last = std::nextafter(1.0, 0.0);
    const auto corner = [&](double x, double y) {
      std::array<double, W::dimension> u{};
      u[0] = x;
      u[1] = y;
      return place_of(world_->at_unit(u));
    };
    const Vec2 first = corner(0.0, 0.0);
    return std::abs(cross(corner(last, 0.0) - first, corner(0.0, last) - first));
  }

  const W* world_;
  State start_;
  std::vector<State> goals_;
  std::uint64_t seed_;
};

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// Makes a path cheaper where ways have a price beyond their length, such as a car's changes of gear. A shortcut between
// two places can't do that: a change falls away only where two ways meet in the same gear. So, round after round, the
// states of a stretch and states drawn near them are joined by all their ways, and the cheapest path through them is
// searched by A* that checks a way when it is the next, in a loop of its own: arrivals in either gear are kept apart,
// where core's best_first keeps one a vertex. What costs more than the stretch does is never looked at. Ends when
// rounds bring less than 0.1 % for a while, or where the price is the length. Of ways that cost as much up to rounding
// the one with fewer legs is taken, near the origin and far. Cost: some 4,000 checked ways a round. The path gets
// cheap, it is no proof of anything.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "core/base/rng.hpp"
#include "core/base/solution.hpp"
#include "core/base/world.hpp"
#include "core/run/execution.hpp"

namespace warren {

struct RedriveOptions {
  std::uint64_t seed = 1;
  std::uint32_t rounds = 40;  ///< at most, for each stretch of the path
};

namespace detail {

/// Driver: a body that drives in gears 1 and -1 (worlds/poses/car_world.hpp).
template <class Driver>
class Redriving {
 public:
  using State = typename Driver::State;
  using Way = typename Driver::Way;

  /// Adds the work to counters.
  Redriving(const Driver& driver, Path<State> path, const RedriveOptions& options, const Execution& execution,
            Counters& counters)
      : driver_(driver),
        path_(std::move(path)),
        options_(options),
        execution_(execution),
        query_(driver.make_query()),
        counters_(counters) {}

  Path<State> run() {
    constexpr std::size_t patience = 10;
    constexpr double worth = 1e-3;
    const std::size_t stretches = (path_.size() + stretch_states - 1) / stretch_states;
    const auto distance = [this](const State& a, const State& b) { return driver_.distance(a, b); };
    std::size_t idle = 0;
    for (std::size_t round = 0; round < options_.rounds * stretches && idle < patience * stretches; ++round) {
      // Where the path costs no more than its length, shortcuts make it cheap.
      if (!(driver_.price(path_) > path_length(path_, distance) * (1.0 + 1e-9))) break;
      const double gain = redrive_stretch(round);
      idle = gain > worth * driver_.price(path_) ? 0 : idle + 1;
    }
    counters_.refused += refused_motions(query_);
    return std::move(path_);
  }

 private:
  static constexpr std::size_t stretch_states = 32;
  static constexpr std::size_t drawn_states = 64;
  static constexpr std::size_t backwards = 20;  // places that lie so far before one in the order are tried, too
  static constexpr double unsure = 1e-6;        // of prices, as rounding has it; a leg costs that to twice that more
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  struct Place {
    State state;
    double along;    // where in the stretch's order
    double to_goal;  // at least
    double leg;      // what a way that leads there costs beside its price, as a share of the stretch's
  };
  /// A way that leads to a place.
  struct Arrival {
    double price;        // since the stretch's begin
    std::size_t before;  // the arrival whence it comes
    std::size_t place;
    Way way;
  };
  using Open = std::pair<double, std::size_t>;  // the least price of the stretch by an arrival; which one
  using Queue = std::priority_queue<Open, std::vector<Open>, std::greater<>>;
  static std::size_t slot(int gear) { return gear > 0 ? 1 : 0; }

  /// What the path gets cheaper by.
  double redrive_stretch(std::size_t round) {
    const std::size_t size = std::min(path_.size(), stretch_states);
    const std::size_t room = path_.size() - size;
    const std::size_t first = room == 0 ? 0 : static_cast<std::size_t>(uniform(options_.seed, round, 8) * (room + 1.0));
    const std::span<const State> stretch = std::span(path_).subspan(first, size);
    gear_before_ = first == 0 ? 0 : driver_.gear_at_end(path_[first - 1], path_[first]);
    gear_after_ = first == room ? 0 : driver_.gear_at_begin(path_[first + size - 1], path_[first + size]);
    const double before = driver_.price(stretch, gear_before_, gear_after_);
    draw_places(round, stretch);
    const Path<State> way = cheaper(before * (1.0 - unsure));
    if (way.empty()) return 0.0;
    const double gain = before - driver_.price(way, gear_before_, gear_after_);
    if (!(gain > 0.0)) return 0.0;
    Path<State> path(path_.begin(), path_.begin() + static_cast<std::ptrdiff_t>(first));
    path.insert(path.end(), way.begin(), way.end());
    path.insert(path.end(), path_.begin() + static_cast<std::ptrdiff_t>(first + size), path_.end());
    path_ = std::move(path);
    return gain;
  }

  /// The stretch's states, and free ones near them or near those drawn before, in the order of the stretch.
  void draw_places(std::size_t round, std::span<const State> stretch) {
    constexpr std::array scales{1.0, 0.5, 0.25, 1.5, 0.1};
    places_.clear();
    // No two places cost the same: else of two on one curve rounding chose the one to come from, far from the origin
    // another one than near it.
    const auto leg = [&](std::uint64_t axis) {
      return unsure * (1.0 + uniform(options_.seed, round * (drawn_states + stretch_states) + places_.size(), axis));
    };
    for (const State& state : stretch) places_.push_back({state, static_cast<double>(places_.size()), 0.0, leg(9)});
    places_.back().along += 1.0;  // behind all that is drawn
    for (std::size_t i = 0; i < drawn_states; ++i) {
      const auto u = [&](std::uint64_t axis) { return uniform(options_.seed, round * drawn_states + i, axis); };
      const bool of_drawn = places_.size() > stretch.size() && u(0) < 0.5;
      const std::size_t first = of_drawn ? stretch.size() : 0;
      const std::size_t last = of_drawn ? places_.size() : stretch.size() - 1;
      const Place& parent = places_[first + static_cast<std::size_t>(u(1) * static_cast<double>(last - first))];
      const State state = driver_.drawn_near(parent.state, {u(2), u(3), u(4), u(5)}, scales[round % scales.size()]);
      const double along = std::clamp(parent.along + u(6) - 0.5, 0.0, static_cast<double>(stretch.size() - 1));
      if (driver_.is_free(state, query_)) places_.push_back({state, along, 0.0, leg(9)});
    }
    std::stable_sort(places_.begin(), places_.end(), [](const Place& a, const Place& b) { return a.along < b.along; });
    for (Place& place : places_) place.to_goal = driver_.distance(place.state, stretch.back());
  }

  /// Through the places for less than `most`; empty: there is no such way.
  Path<State> cheaper(double most) {
    most_ = most;
    arrivals_.clear();
    settled_.assign(places_.size(), {none, none});
    Queue open;
    expand(0, none, open);
    while (!open.empty()) {
      execution_.check();
      const std::size_t next = open.top().second;
      open.pop();
      const Arrival arrival = arrivals_[next];
      if (is_settled(arrival.place, arrival.way.last_gear)) continue;
      ++counters_.edges_checked;
      if (!driver_.is_free_way(arrival.way, query_)) continue;
      ++counters_.edges_free;
      settled_[arrival.place][slot(arrival.way.last_gear)] = next;
      if (arrival.place + 1 < places_.size()) {
        expand(arrival.place, next, open);
        continue;
      }
      std::vector<std::size_t> chain;
      for (std::size_t a = next; a != none; a = arrivals_[a].before) chain.push_back(a);
      Path<State> way{places_.front().state};
      for (auto a = chain.rbegin(); a != chain.rend(); ++a) Driver::append(way, arrivals_[*a].way);
      return way;
    }
    return {};
  }

  void expand(std::size_t place, std::size_t arrived, Queue& open) {
    const int gear = arrived == none ? gear_before_ : arrivals_[arrived].way.last_gear;
    const double price = arrived == none ? 0.0 : arrivals_[arrived].price;
    const State& from = places_[place].state;
    for (std::size_t to = place > backwards ? place - backwards : 1; to < places_.size(); ++to) {
      if (to == place || (is_settled(to, 1) && is_settled(to, -1))) continue;
      if (price + driver_.distance(from, places_[to].state) + places_[to].to_goal >= most_) continue;
      const bool is_end = to + 1 == places_.size();
      for (const Way& way : driver_.ways(from, places_[to].state, most_ - price - places_[to].to_goal)) {
        const double there = price + change(gear, way.first_gear) + way.price + places_[to].leg * most_ +
                             (is_end ? change(way.last_gear, gear_after_) : 0.0);
        const double at_least = there + places_[to].to_goal;
        if (at_least >= most_ || is_settled(to, way.last_gear)) continue;
        open.emplace(at_least, arrivals_.size());
        arrivals_.push_back({there, arrived, to, way});
      }
    }
  }

  bool is_settled(std::size_t place, int gear) const { return settled_[place][slot(gear)] != none; }
  double change(int from, int to) const {
    return from != 0 && to != 0 && from != to ? driver_.gear_change_price() : 0.0;
  }

  const Driver& driver_;
  Path<State> path_;
  const RedriveOptions& options_;
  const Execution& execution_;
  typename Driver::Query query_;
  Counters& counters_;
  // Of the stretch.
  int gear_before_ = 0;  // 0: none
  int gear_after_ = 0;
  double most_ = 0.0;  // what it costs, changes at its ends included
  std::vector<Place> places_;
  std::vector<Arrival> arrivals_;
  std::vector<std::array<std::size_t, 2>> settled_;  // by place and gear: the arrival
};

}  // namespace detail

/// path: free, start to goal, its legs the driver's shortest ways. The result has the same ends and kind of legs, its
/// ways are free by the driver's check, and it is never dearer. Adds the work to counters. Throws Stopped.
template <class Driver>
Path<typename Driver::State> redriven_path(const Driver& driver, Path<typename Driver::State> path,
                                           const RedriveOptions& options, const Execution& execution,
                                           Counters& counters) {
  if (path.size() < 2) return path;
  Counters done;
  path = detail::Redriving<Driver>(driver, std::move(path), options, execution, done).run();
  counters += done;
  return path;
}

}  // namespace warren

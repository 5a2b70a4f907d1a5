// SPDX-License-Identifier: BSD-3-Clause
// Shortens a path in any world whose motions can be cut. Two moves, in turns: a random shortcut joins two places of the
// path by one motion (Geraerts, Overmars, Int. J. Robotics Research 26, 2007, compare the variants); a pull moves a
// state towards the motion that would leave it out. Both are kept only where the new motions are free, by the same
// check as the planner's, and the path gets shorter in `length`, which may be another measure than the world's metric.
// Candidates of a round are judged on all cores against the path as it stands, then made in the order of their gain
// where they don't overlap: the result does not depend on the threads. What rounding may feign is no gain and no
// difference between two, so that a path far from the origin is shortened as it is near it. Ends when rounds bring less
// than 0.01 % for a while. The path gets near a shortest one of its homotopy class; it is no proof of anything.
// improve_path() is for searches that go on and have a path to improve again and again: first it skips states that are
// not needed, then its rounds cut, pull, and let states drift: each a share of the way towards a random state, where
// the share falls by a fifth on failure and doubles on luck, for each state its own: so paths slide along obstacles and
// bodies turn where no straight motion shows the way. Rounds of arms begin with joints that go evenly, one by one (the
// partial shortcuts of that paper). A round ends by leaving out what the motion of its neighbours passes. The metric
// says no first, the checks come last.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <tuple>
#include <vector>

#include "core/base/rng.hpp"
#include "core/base/solution.hpp"
#include "core/base/world.hpp"
#include "parallel/chunks.hpp"

namespace warren {

struct ShortcutOptions {
  std::uint64_t seed = 1;
  std::uint32_t rounds = 400;  ///< at most
};

struct ImproveOptions {
  std::uint64_t seed = 1;
  double worth = 2e-3;         ///< a round that takes off less than this share of the length is idle; >= 0
  std::uint32_t patience = 1;  ///< so many idle rounds in a row are the end; >= 1
  /// It gives up where twice what a round took off would not bring the path below so much.
  double hopeless = std::numeric_limits<double>::infinity();
};

namespace detail {

template <SteerableWorld W, class Length>
class Shortener {
 public:
  using State = typename W::State;

  /// Adds the work to counters.
  Shortener(const W& world, Path<State> path, const Length& length, std::uint64_t seed, const Execution& execution,
            Counters& counters)
      : world_(world),
        path_(std::move(path)),
        drifts_(path_.size(), first_drift),
        length_(length),
        seed_(seed),
        execution_(execution),
        counters_(counters) {}

  /// The rounds of shortcut_path().
  Path<State> shortened(std::uint32_t rounds) {
    const ImproveOptions until{.worth = 1e-4, .patience = 12};
    repeat(rounds, until, whole(),
           [&](std::uint32_t round) { round % 2 == 0 ? cut_corners(round, candidates) : pull(round); });
    return std::move(path_);
  }
  /// Those of improve_path().
  Path<State> improved(const ImproveOptions& options) {
    constexpr std::uint32_t rounds = 400;
    constexpr std::uint64_t drifts = has_joints ? 1 : 4;
    const double begun = whole();
    unsure_ = noise * begun;
    skip();
    repeat(rounds, options, begun, [&](std::uint32_t round) {
      if constexpr (has_joints) straighten(round);
      cut_corners(round, has_joints ? 2 * path_.size() : 16);
      move_states([&](std::size_t v, typename W::Query& query, Counters& counters) {
        path_[v] = moved_to_chord(v, 0.0, 0.25, has_joints ? 0.05 : 1e-3, query, counters).state;
      });
      for (std::uint64_t pass = 0; pass < drifts; ++pass) drift(round * drifts + pass);
      thin();
    });
    return std::move(path_);
  }

 private:
  static constexpr std::uint64_t candidates = 64;
  static constexpr double first_drift = 0.125;
  static constexpr bool has_joints = requires { std::tuple_size<State>::value; };
  static constexpr double noise = 1e-6;  // share of the path's length by which rounding may feign a gain

  /// Replaces the path between two places by `states`.
  struct Change {
    PlaceOnPath from;
    PlaceOnPath to;
    std::vector<State> states;
    double gain = 0.0;
  };
  /// Where a state of the path may go, and what that gains; 0: nowhere.
  struct Moved {
    State state;
    double gain = 0.0;
  };

  double whole() const { return path_length(path_, length_); }
  /// Calls make(round) until rounds are over or are not worth it any more; best: the length before them.
  template <class Make>
  void repeat(std::uint32_t rounds, const ImproveOptions& until, double best, const Make& make) {
    constexpr double ahead = 2.0;  // so many times what it took off is what a round promises
    std::uint32_t idle = 0;
    for (std::uint32_t round = 0; round < rounds && idle < until.patience && path_.size() > 2; ++round) {
      execution_.check();
      unsure_ = noise * best;
      make(round);
      const double now = whole();
      if (now - ahead * (best - now) > until.hopeless) return;
      idle = best - now > until.worth * best ? 0 : idle + 1;
      best = std::min(best, now);
    }
  }
  State at(const PlaceOnPath& p) const { return world_.interpolate(path_[p.leg], path_[p.leg + 1], p.share); }
  /// Before: p lies before q, not on one leg.
  double length_between(const PlaceOnPath& p, const PlaceOnPath& q) const {
    double sum = length_(at(p), path_[p.leg + 1]);
    for (std::size_t i = p.leg + 1; i < q.leg; ++i) sum += length_(path_[i], path_[i + 1]);
    return sum + length_(path_[q.leg], at(q));
  }
  bool is_free(const State& a, const State& b, typename W::Query& query, Counters& counters) const {
    ++counters.edges_checked;
    const bool free = step_to(world_, a, b, false, query) == Step::free;
    counters.edges_free += free ? 1 : 0;
    return free;
  }

  /// along: the world's distance from the path's begin to each state.
  Change shortcut(std::uint64_t round, std::uint64_t index, const std::vector<double>& along, typename W::Query& query,
                  Counters& counters) const {
    const auto place = [&](double way) { return place_on_path(along, way); };
    const std::uint64_t draw = round * candidates + index;
    const double first = uniform(seed_, draw, 0);
    // Half of them anywhere, the others at most an eighth of the path apart: those mend details.
    const double apart = index % 2 == 0 ? uniform(seed_, draw, 1) : 0.125 * uniform(seed_, draw, 1);
    const double last = index % 2 == 0 ? apart : std::min(1.0, first + apart);
    Change change{place(std::min(first, last) * along.back()), place(std::max(first, last) * along.back()), {}, 0.0};
    if (change.from.leg == change.to.leg) return change;
    const State from = at(change.from);
    const State to = at(change.to);
    const double gain = length_between(change.from, change.to) - length_(from, to);
    // What is left of the two motions is checked too: a part of a certified motion is free, but may be so near to an
    // obstacle that only the whole could be certified.
    if (gain > unsure_ && is_free(from, to, query, counters) &&
        is_free(path_[change.from.leg], from, query, counters) &&
        is_free(to, path_[change.to.leg + 1], query, counters)) {
      change.states = {from, to};
      change.gain = gain;
    }
    return change;
  }

  /// The state moved towards where the motion between its neighbours passes, as far as that is free: all the way, or by
  /// a share above `least` that falls by the factor `less`.
  Moved moved_to_chord(std::size_t vertex, double slip, double less, double least, typename W::Query& query,
                       Counters& counters) const {
    const State& before = path_[vertex - 1];
    const State& after = path_[vertex + 1];
    const double way_in = world_.distance(before, path_[vertex]);
    const double way_out = world_.distance(path_[vertex], after);
    if (!(way_in + way_out > 0.0)) return {path_[vertex]};
    const double share = std::clamp(way_in / (way_in + way_out) + slip, 0.0, 1.0);
    const State target = world_.interpolate(before, after, share);
    const double old_length = length_(before, path_[vertex]) + length_(path_[vertex], after);
    for (double t = 1.0; t > least; t *= less) {
      const State moved = state_between(world_, path_[vertex], target, t);
      const double gain = old_length - length_(before, moved) - length_(moved, after);
      if (gain <= unsure_ || !is_free(before, moved, query, counters) || !is_free(moved, after, query, counters))
        continue;
      return {moved, gain};
    }
    return {path_[vertex]};
  }

  /// Joint by joint: between two states of the path, at first its ends, the joint goes evenly where that is free. So
  /// what a tree's samples turned for nothing is taken back where no motion of all joints would be free.
  void straighten(std::uint32_t round) {
    constexpr std::uint64_t purpose = 0x6a6f696e7473U;
    auto query = world_.make_query();
    const auto joints = world_.unit_dimension();
    for (std::size_t joint = 0; joint < joints && path_.size() > 2; ++joint) {
      execution_.check();
      const auto drawn = [&](unsigned axis, std::size_t count) {
        return static_cast<std::size_t>(uniform(seed_ ^ purpose, round * joints + joint, axis) *
                                        static_cast<double>(count));
      };
      const std::size_t from = round == 0 ? 0 : drawn(0, path_.size() - 2);
      const std::size_t to = round == 0 ? path_.size() - 1 : from + 2 + drawn(1, path_.size() - from - 2);
      const std::span<State> old = std::span(path_).subspan(from, to - from + 1);
      Path<State> part(old.begin(), old.end());
      const std::vector<double> along = lengths_along(part, length_);
      for (std::size_t v = 1; v + 1 < part.size() && along.back() > 0.0; ++v) {
        part[v][joint] = world_.interpolate(part.front(), part.back(), along[v] / along.back())[joint];
      }
      bool is_better = along.back() - path_length(part, length_) > unsure_;
      for (std::size_t v = 1; v < part.size() && is_better; ++v) {
        is_better = is_free(part[v - 1], part[v], query, counters_);
      }
      if (is_better) std::copy(part.begin(), part.end(), old.begin());
    }
    counters_.refused += refused_motions(query);
  }

  void cut_corners(std::uint32_t round, std::size_t count) {
    const std::vector<double> along =
        lengths_along(path_, [this](const State& a, const State& b) { return world_.distance(a, b); });
    change(count, [&](std::size_t i, typename W::Query& query, Counters& counters) {
      return shortcut(round, i, along, query, counters);
    });
  }

  void pull(std::uint32_t round) {
    change(path_.size() - 2, [&](std::size_t i, typename W::Query& query, Counters& counters) {
      const double slip = 0.5 * (uniform(seed_, round * candidates + i, 2) - 0.5);
      const Moved moved = moved_to_chord(i + 1, round % 4 == 1 ? slip : 0.0, 0.5, 1e-3, query, counters);
      Change change{{i, 0.0}, {i + 1, 1.0}, {}, moved.gain};
      if (moved.gain > 0.0) change.states = {path_[i], moved.state, path_[i + 2]};
      return change;
    });
  }

  /// From each state straight to the farthest that can be reached so, by halving.
  void skip() {
    auto query = world_.make_query();
    const std::vector<double> along = lengths_along(path_, length_);
    std::size_t kept = 0;
    for (std::size_t from = 0; from + 1 < path_.size();) {
      execution_.check();
      std::size_t to = path_.size() - 1;
      const auto is_shorter = [&] { return length_(path_[from], path_[to]) <= along[to] - along[from] + unsure_; };
      while (to > from + 1 && !(is_shorter() && is_free(path_[from], path_[to], query, counters_))) {
        to = from + (to - from) / 2;
      }
      path_[++kept] = path_[to];
      from = to;
    }
    path_.resize(kept + 1);
    drifts_.resize(kept + 1);
    counters_.refused += refused_motions(query);
  }

  void drift(std::uint64_t pass) {
    constexpr std::uint64_t purpose = 0x64726966747321U;
    constexpr double most = 0.5;
    constexpr double least = 0x1p-14;
    constexpr double less = 0.8;  // by halves they were gone before luck came
    const std::uint64_t seed = random_bits(seed_, pass, purpose);
    move_states([&](std::size_t v, typename W::Query& query, Counters& counters) {
      const State& before = path_[v - 1];
      const State& after = path_[v + 1];
      const State moved = state_between(world_, path_[v], uniform_state(world_, seed, v), drifts_[v]);
      const double old_length = length_(before, path_[v]) + length_(path_[v], after);
      const double gain = old_length - length_(before, moved) - length_(moved, after);
      if (gain > unsure_ && is_free(before, moved, query, counters) && is_free(moved, after, query, counters)) {
        path_[v] = moved;
        drifts_[v] = std::min(most, 2.0 * drifts_[v]);
      } else {
        drifts_[v] = drifts_[v] > least ? less * drifts_[v] : first_drift;
      }
    });
  }

  /// Leaves out states that the motion between their neighbours passes anyway.
  void thin() {
    auto query = world_.make_query();
    std::size_t kept = 0;
    for (std::size_t v = 1; v < path_.size(); ++v) {
      if (v % 256 == 0) execution_.check();
      const bool is_last = v + 1 == path_.size();
      const State& before = path_[kept];
      const auto is_passed = [&] {
        const double direct = length_(before, path_[v + 1]);
        const double around = length_(before, path_[v]) + length_(path_[v], path_[v + 1]);
        return direct <= around && around - direct <= unsure_ && is_free(before, path_[v + 1], query, counters_);
      };
      if (!is_last && is_passed()) continue;
      ++kept;
      path_[kept] = path_[v];
      drifts_[kept] = drifts_[v];
    }
    path_.resize(kept + 1);
    drifts_.resize(kept + 1);
    counters_.refused += refused_motions(query);
  }

  /// Calls judge(i, query, counters) for i = 0 .. count - 1.
  template <class Judge>
  void for_each(std::size_t count, const Judge& judge) {
    constexpr std::size_t grain = 4;
    std::vector<Counters> parts(chunk_count(count, grain));
    for_chunks(count, grain, execution_, [&](Range r) {
      auto query = world_.make_query();
      Counters& counters = parts[r.first / grain];
      for (std::size_t i = r.first; i < r.last; ++i) judge(i, query, counters);
      counters.refused = refused_motions(query);
    });
    for (const Counters& part : parts) counters_ += part;
  }

  /// Moves every other state, then the others: those of a kind don't touch each other, so that they may be moved at
  /// once.
  template <class Move>
  void move_states(const Move& move) {
    for (const std::size_t first : {1U, 2U}) {
      const std::size_t count = path_.size() > first ? (path_.size() - first) / 2 : 0;
      for_each(count, [&](std::size_t i, typename W::Query& query, Counters& counters) {
        move(first + 2 * i, query, counters);
      });
    }
  }

  /// Makes so many candidates, then those that are worth most and don't overlap.
  template <class Make>
  void change(std::size_t count, const Make& make) {
    std::vector<Change> changes(count);
    for_each(count, [&](std::size_t i, typename W::Query& query, Counters& counters) {
      changes[i] = make(i, query, counters);
    });
    std::erase_if(changes, [](const Change& c) { return c.gain <= 0.0; });
    std::vector<const Change*> order;
    for (const Change& change : changes) order.push_back(&change);
    std::stable_sort(order.begin(), order.end(), [](const Change* a, const Change* b) { return a->gain > b->gain; });
    for (auto next = order.begin(); next != order.end();) {  // those that are worth as much: as they were drawn
      const double equal = (*next)->gain - unsure_;
      const auto last = std::find_if(next, order.end(), [&](const Change* c) { return c->gain < equal; });
      std::sort(next, last, std::less<>());
      next = last;
    }
    std::vector<Change> chosen;
    for (const Change* change : order) {
      const bool apart = std::all_of(chosen.begin(), chosen.end(), [&](const Change& c) {
        return change->to.leg < c.from.leg || c.to.leg < change->from.leg;
      });
      if (apart) chosen.push_back(*change);
    }
    if (chosen.empty()) return;
    std::sort(chosen.begin(), chosen.end(), [](const Change& a, const Change& b) { return a.from.leg < b.from.leg; });
    path_ = with(chosen);
  }

  /// chosen: in the path's order, no two on one leg.
  Path<State> with(const std::vector<Change>& chosen) {
    Path<State> path;
    std::vector<double> drifts;
    const auto add = [&](const State& state, double drift) {
      if (!path.empty() && path.back() == state) return;
      path.push_back(state);
      drifts.push_back(drift);
    };
    std::size_t next = 0;  // the first state of the old path that is not yet dealt with
    for (const Change& change : chosen) {
      for (; next <= change.from.leg; ++next) add(path_[next], drifts_[next]);
      for (const State& state : change.states) add(state, first_drift);
      next = change.to.leg + 1;
    }
    for (; next < path_.size(); ++next) add(path_[next], drifts_[next]);
    drifts_ = std::move(drifts);
    return path;
  }

  const W& world_;
  Path<State> path_;
  std::vector<double> drifts_;  // how far each state tries to drift
  const Length& length_;
  const std::uint64_t seed_;
  const Execution& execution_;
  double unsure_ = 0.0;  // gains may be off by so much
  Counters& counters_;
};

}  // namespace detail

/// path: free, start to goal. The result has the same ends, its motions are free by the world's check, and it is never
/// longer in the sum of length(a, b) over its motions, which obeys the triangle inequality along motions. Adds the work
/// to counters. Throws Stopped at the deadline.
template <SteerableWorld W, class Length>
Path<typename W::State> shortcut_path(const W& world, Path<typename W::State> path, const Length& length,
                                      const ShortcutOptions& options, const Execution& execution, Counters& counters) {
  if (path.size() < 3) return path;
  Counters done;
  path = detail::Shortener<W, Length>(world, std::move(path), length, options.seed, execution, done)
             .shortened(options.rounds);
  counters += done;
  return path;
}

/// As shortcut_path(), for searches that go on.
template <SteerableWorld W, class Length>
Path<typename W::State> improve_path(const W& world, Path<typename W::State> path, const Length& length,
                                     const ImproveOptions& options, const Execution& execution, Counters& counters) {
  if (path.size() < 2) return path;
  Counters done;
  path = detail::Shortener<W, Length>(world, std::move(path), length, options.seed, execution, done).improved(options);
  counters += done;
  return path;
}

}  // namespace warren

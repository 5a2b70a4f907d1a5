// SPDX-License-Identifier: BSD-3-Clause
// Shortens a path in any world whose motions can be cut. Two moves, in turns: a random shortcut joins two places of the
// path by one motion (Geraerts, Overmars, Int. J. Robotics Research 26, 2007, compare the variants); a pull moves a
// state towards the motion that would leave it out. Both are kept only where the new motions are free, by the same
// check as the planner's, and the path gets shorter in `length`, which may be another measure than the world's metric.
// Candidates of a round are judged on all cores against the path as it stands, then made in the order of their gain
// where they don't overlap: the result does not depend on the threads. What rounding may feign is no gain and no
// difference between two, so that a path far from the origin is shortened as it is near it.
// Ends when rounds bring less than 0.01 % for a while. The path gets near a shortest one of its homotopy class; it is
// no proof of anything.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
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

namespace detail {

template <SteerableWorld W, class Length>
class Shortener {
 public:
  using State = typename W::State;

  Shortener(const W& world, Path<State> path, const Length& length, const ShortcutOptions& options,
            const Execution& execution)
      : world_(world), path_(std::move(path)), length_(length), options_(options), execution_(execution) {}

  Path<State> run() {
    constexpr int patience = 12;
    constexpr double worth = 1e-4;
    constexpr double noise = 1e-6;
    int idle = 0;
    double best = whole();
    for (std::uint32_t round = 0; round < options_.rounds && idle < patience && path_.size() > 2; ++round) {
      execution_.check();
      unsure_ = noise * best;
      round % 2 == 0 ? cut_corners(round) : pull(round);
      const double now = whole();
      idle = best - now > worth * best ? 0 : idle + 1;
      best = std::min(best, now);
    }
    return std::move(path_);
  }
  const Counters& counters() const { return counters_; }

 private:
  static constexpr std::uint64_t candidates = 64;

  /// A place on the path: on the motion from path_[leg].
  struct Place {
    std::size_t leg = 0;
    double share = 0.0;
  };
  /// Replaces the path between two places by `states`.
  struct Change {
    Place from;
    Place to;
    std::vector<State> states;
    double gain = 0.0;
  };

  double whole() const {
    double sum = 0.0;
    for (std::size_t i = 1; i < path_.size(); ++i) sum += length_(path_[i - 1], path_[i]);
    return sum;
  }
  State at(const Place& p) const { return world_.interpolate(path_[p.leg], path_[p.leg + 1], p.share); }
  double length_between(const Place& p, const Place& q) const;
  bool is_free(const State& a, const State& b, typename W::Query& query, Counters& counters) const {
    ++counters.edges_checked;
    const bool free = world_.is_free(b, query) && world_.is_free_motion(a, b, query);
    counters.edges_free += free ? 1 : 0;
    return free;
  }
  Change shortcut(std::uint64_t round, std::uint64_t index, const std::vector<double>& along, typename W::Query& query,
                  Counters& counters) const;
  Change pulled(std::uint64_t round, std::uint64_t index, std::size_t vertex, typename W::Query& query,
                Counters& counters) const;
  void cut_corners(std::uint32_t round);
  void pull(std::uint32_t round);
  template <class Make>
  void change(std::size_t count, const Make& make);
  void apply(std::vector<Change>& changes);
  Path<State> with(const std::vector<Change>& chosen) const;

  const W& world_;
  Path<State> path_;
  const Length& length_;
  const ShortcutOptions& options_;
  const Execution& execution_;
  double unsure_ = 0.0;  // gains may be off by so much
  Counters counters_;
};

/// Before: p lies before q, not on one leg.
template <SteerableWorld W, class Length>
double Shortener<W, Length>::length_between(const Place& p, const Place& q) const {
  double sum = length_(at(p), path_[p.leg + 1]);
  for (std::size_t i = p.leg + 1; i < q.leg; ++i) sum += length_(path_[i], path_[i + 1]);
  return sum + length_(path_[q.leg], at(q));
}

/// along: the world's distance from the path's begin to each state.
template <SteerableWorld W, class Length>
auto Shortener<W, Length>::shortcut(std::uint64_t round, std::uint64_t index, const std::vector<double>& along,
                                    typename W::Query& query, Counters& counters) const -> Change {
  const auto place = [&](double way) {
    const auto next = std::upper_bound(along.begin() + 1, along.end() - 1, way);
    const auto leg = static_cast<std::size_t>(next - along.begin()) - 1;
    const double length = along[leg + 1] - along[leg];
    return Place{leg, length > 0.0 ? std::clamp((way - along[leg]) / length, 0.0, 1.0) : 0.0};
  };
  const std::uint64_t draw = round * candidates + index;
  const double first = uniform(options_.seed, draw, 0);
  // Half of them anywhere, the others at most an eighth of the path apart: those mend details.
  const double apart = index % 2 == 0 ? uniform(options_.seed, draw, 1) : 0.125 * uniform(options_.seed, draw, 1);
  const double last = index % 2 == 0 ? apart : std::min(1.0, first + apart);
  Change change{place(std::min(first, last) * along.back()), place(std::max(first, last) * along.back()), {}, 0.0};
  if (change.from.leg == change.to.leg) return change;
  const State from = at(change.from);
  const State to = at(change.to);
  const double gain = length_between(change.from, change.to) - length_(from, to);
  // What is left of the two motions is checked too: a part of a certified motion is free, but may be so near to an
  // obstacle that only the whole could be certified.
  if (gain > unsure_ && is_free(from, to, query, counters) && is_free(path_[change.from.leg], from, query, counters) &&
      is_free(to, path_[change.to.leg + 1], query, counters)) {
    change.states = {from, to};
    change.gain = gain;
  }
  return change;
}

/// The state moved towards where the motion between its neighbours passes, as far as that is free.
template <SteerableWorld W, class Length>
auto Shortener<W, Length>::pulled(std::uint64_t round, std::uint64_t index, std::size_t vertex,
                                  typename W::Query& query, Counters& counters) const -> Change {
  const State& before = path_[vertex - 1];
  const State& after = path_[vertex + 1];
  const double way_in = world_.distance(before, path_[vertex]);
  const double way_out = world_.distance(path_[vertex], after);
  Change change{{vertex - 1, 0.0}, {vertex, 1.0}, {}, 0.0};
  if (!(way_in + way_out > 0.0)) return change;
  const double slip = 0.5 * (uniform(options_.seed, round * candidates + index, 2) - 0.5);
  const double share = std::clamp(way_in / (way_in + way_out) + (round % 4 == 1 ? slip : 0.0), 0.0, 1.0);
  const State target = world_.interpolate(before, after, share);
  const double old_length = length_(before, path_[vertex]) + length_(path_[vertex], after);
  for (double t = 1.0; t > 1e-3; t *= 0.5) {
    const State moved = world_.interpolate(path_[vertex], target, t);
    const double gain = old_length - length_(before, moved) - length_(moved, after);
    if (gain <= unsure_ || !is_free(before, moved, query, counters) || !is_free(moved, after, query, counters))
      continue;
    change.gain = gain;
    change.states = {before, moved, after};
    break;
  }
  return change;
}

template <SteerableWorld W, class Length>
void Shortener<W, Length>::cut_corners(std::uint32_t round) {
  std::vector<double> along(path_.size(), 0.0);
  for (std::size_t i = 1; i < path_.size(); ++i) along[i] = along[i - 1] + world_.distance(path_[i - 1], path_[i]);
  change(candidates, [&](std::size_t i, typename W::Query& query, Counters& counters) {
    return shortcut(round, i, along, query, counters);
  });
}

template <SteerableWorld W, class Length>
void Shortener<W, Length>::pull(std::uint32_t round) {
  change(path_.size() - 2, [&](std::size_t i, typename W::Query& query, Counters& counters) {
    return pulled(round, i, i + 1, query, counters);
  });
}

/// Makes so many candidates, then those that are worth most and don't overlap.
template <SteerableWorld W, class Length>
template <class Make>
void Shortener<W, Length>::change(std::size_t count, const Make& make) {
  constexpr std::size_t grain = 4;
  std::vector<Change> changes(count);
  std::vector<Counters> parts(chunk_count(count, grain));
  for_chunks(count, grain, execution_, [&](Range r) {
    auto query = world_.make_query();
    Counters& counters = parts[r.first / grain];
    for (std::size_t i = r.first; i < r.last; ++i) changes[i] = make(i, query, counters);
    counters.refused = refused_motions(query);
  });
  for (const Counters& part : parts) counters_ += part;
  apply(changes);
}

template <SteerableWorld W, class Length>
void Shortener<W, Length>::apply(std::vector<Change>& changes) {
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
template <SteerableWorld W, class Length>
auto Shortener<W, Length>::with(const std::vector<Change>& chosen) const -> Path<State> {
  Path<State> path;
  const auto add = [&](const State& state) {
    if (path.empty() || !(path.back() == state)) path.push_back(state);
  };
  std::size_t next = 0;  // the first state of the old path that is not yet dealt with
  for (const Change& change : chosen) {
    for (; next <= change.from.leg; ++next) add(path_[next]);
    for (const State& state : change.states) add(state);
    next = change.to.leg + 1;
  }
  for (; next < path_.size(); ++next) add(path_[next]);
  return path;
}

}  // namespace detail

/// path: free, start to goal. The result has the same ends, its motions are free by the world's check, and it is never
/// longer in the sum of length(a, b) over its motions, which obeys the triangle inequality along motions. Adds the work
/// to counters. Throws Stopped at the deadline.
template <SteerableWorld W, class Length>
Path<typename W::State> shortcut_path(const W& world, Path<typename W::State> path, const Length& length,
                                      const ShortcutOptions& options, const Execution& execution, Counters& counters) {
  if (path.size() < 3) return path;
  detail::Shortener<W, Length> shortener(world, std::move(path), length, options, execution);
  Path<typename W::State> shorter = shortener.run();
  counters += shortener.counters();
  return shorter;
}

}  // namespace warren

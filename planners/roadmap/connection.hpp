// SPDX-License-Identifier: BSD-3-Clause
// Joins milestones: finds the candidate edges, each pair once, and keeps those whose motion is free. Radius rule: pairs
// within the radius, seen from the smaller vertex. k rule: pairs of which one is among the other's k nearest.
// Chunks of milestones on all cores; parts joined in chunk order. Cost: one neighbour query a milestone, one motion
// check a candidate; memory 8 bytes a free edge, and 4 k a milestone for the k rule.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/solution.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/types.hpp"
#include "core/base/world.hpp"
#include "core/run/execution.hpp"
#include "core/run/trace.hpp"
#include "core/search/graph.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/graph/roadmap_options.hpp"

namespace warren {

// What "auto" means: how many samples a round draws and how milestones are joined, as pure functions of the options and
// of counts, so that the answer is the same on every machine.

/// How the milestones of one round are joined: by a radius, or (radius 0) by the k nearest.
struct ConnectionRule {
  double radius = 0.0;
  std::uint32_t neighbours = 0;
  std::optional<GrowingAttach> attach = {};  ///< of start and goal; none: by the rule too
  friend bool operator==(const ConnectionRule&, const ConnectionRule&) = default;
};

/// Neighbours that the radius rule expects around a milestone in the open; see the table "uniform sampling that
/// connects" in docs/performance.md.
inline constexpr double expected_neighbours = 20.0;
/// A round that leaves start and goal apart is followed by one with so many times the samples,
inline constexpr double growth = 1.6;
/// with twice as many while there are fewer than usual,
inline constexpr double first_growth = 2.0;
/// until there are this many times the usual number: then the answer is not_connected.
inline constexpr double growth_cap = 64.0;

/// Samples that a round usually takes.
template <World W>
std::uint64_t usual_samples(const W& world, const RoadmapOptions& options, const Execution& execution) {
  if (options.sampler == SamplerKind::lattice) return std::uint64_t{options.lattice.rows} * options.lattice.cols;
  const Bitmap* cells = world.milestone_cells();
  if (options.sampler == SamplerKind::cell_centres && cells != nullptr)
    return std::max<std::uint64_t>(1, cells->count());
  if (options.samples) return *options.samples;
  const double suggested = world.suggested_samples(execution);
  return static_cast<std::uint64_t>(std::clamp(suggested, 64.0, static_cast<double>(most_samples)));
}

/// Samples of the first round: fewer in worlds where many questions are easy.
template <World W>
std::uint64_t first_samples(const W& world, const RoadmapOptions& options, const Execution& execution) {
  const std::uint64_t usual = usual_samples(world, options, execution);
  if (options.samples || takes_all_places(options.sampler)) return usual;
  return std::min(usual, world.first_samples());
}

/// Samples of the round after one with `samples`; 0 when there is none.
inline std::uint64_t next_samples(const RoadmapOptions& options, std::uint64_t usual, std::uint64_t samples) {
  if (options.samples || takes_all_places(options.sampler) || samples >= most_samples) return 0;
  if (static_cast<double>(samples) >= growth_cap * static_cast<double>(usual)) return 0;
  if (samples < usual) {
    return std::min(usual, static_cast<std::uint64_t>(std::ceil(first_growth * static_cast<double>(samples))));
  }
  return std::min(most_samples, static_cast<std::uint64_t>(growth * static_cast<double>(samples)));
}

/// volume: of the space that the samples were drawn from, in the world's metric; only for the plane, else the rule is
/// by k. breadth: of its box; where a disc of the usual area sticks far out of it, the radius is that of a strip which
/// has this area within the box. 0: not known.
inline ConnectionRule connection_rule(const RoadmapOptions& options, std::uint64_t samples, double volume,
                                      double breadth = 0.0) {
  if (options.radius) return {*options.radius, 0};
  if (options.neighbours) return {0.0, *options.neighbours};
  if (options.sampler == SamplerKind::lattice) return {1.0, 0};     // the four neighbours in the lattice
  const bool on_curves = options.sampler == SamplerKind::corridor;  // which fill no area evenly
  if (on_curves || !(volume > 0.0)) return {0.0, static_cast<std::uint32_t>(expected_neighbours)};
  const double area = expected_neighbours * volume / static_cast<double>(samples);
  const double strip = breadth > 0.0 ? area / (2.0 * breadth) : 0.0;
  return {std::max(std::sqrt(area / std::numbers::pi), strip), 0};
}

namespace detail {

/// The volume of the ball of radius 1.
inline double unit_ball(std::size_t dimension) {
  if (dimension < 2) return dimension == 0 ? 1.0 : 2.0;
  return 2.0 * std::numbers::pi / static_cast<double>(dimension) * unit_ball(dimension - 2);
}

/// The n-th root of x > 0, n >= 1: Newton's steps from above go down until rounding stops them. Not std::pow, whose
/// last bit is the library's affair.
inline double root(double x, std::size_t n) {
  const auto degree = static_cast<double>(n);
  for (double y = std::max(1.0, x);;) {
    double rest = x;
    for (std::size_t i = 1; i < n; ++i) rest /= y;
    const double next = y + (rest - y) / degree;
    if (!(next < y)) return y;
    y = next;
  }
}

}  // namespace detail

/// k = e (1 + 1/d) ln n, or radius = 2 ((1 + 1/d) V / B ln n / n)^(1/d), with B the volume of the unit ball and V that
/// of the sampled space, which is not less than the free one's; of a space that is one state as of a line. UsageError
/// where the world doesn't tell V.
inline ConnectionRule star_rule(StarRule rule, std::uint64_t samples, std::size_t dimension, double volume) {
  const double n = std::max(static_cast<double>(samples), 2.0);
  dimension = std::max<std::size_t>(dimension, 1);
  const auto d = static_cast<double>(dimension);
  if (rule == StarRule::neighbours) {
    return {0.0, static_cast<std::uint32_t>(std::ceil(std::numbers::e * (1.0 + 1.0 / d) * portable::log(n)))};
  }
  if (!(volume > 0.0)) throw UsageError("@radius: star: this world doesn't tell its volume; say @neighbours star");
  return {2.0 * detail::root((1.0 + 1.0 / d) * volume / detail::unit_ball(dimension) * portable::log(n) / n, dimension),
          0};
}

template <World W>
ConnectionRule connection_rule_for(const W& world, const RoadmapOptions& options, std::uint64_t samples) {
  const bool by_rule = !options.radius && !options.neighbours && options.star == StarRule::none;
  if (options.sampler == SamplerKind::cell_centres && by_rule && world.milestone_cells() != nullptr)
    return {world.milestone_reach(), 0, options.attach};
  const Box box = world.box();
  const double area = W::in_plane ? world.sampled_volume() : 0.0;
  ConnectionRule rule = options.star == StarRule::none
                            ? connection_rule(options, samples, area, std::min(box.width(), box.height()))
                            : star_rule(options.star, samples, world.sampled_dimension(), world.sampled_volume());
  rule.attach = options.attach;
  return rule;
}

/// Start and goal are joined directly when they are no farther apart than this.
inline double direct_reach(const ConnectionRule& rule) {
  return rule.neighbours > 0 ? std::numeric_limits<double>::infinity() : rule.radius;
}

/// Candidate or free edges, one part a chunk of milestones.
using EdgeParts = std::vector<RawVector<Edge>>;

namespace detail {

/// Milestones a chunk: the motion of a point is checked in nanoseconds, that of a body in microseconds.
template <World W>
inline constexpr std::size_t connection_grain = std::same_as<typename W::State, Vec2> ? 2048 : 64;

/// Of how many bunches one is timed.
template <World W>
inline constexpr std::uint32_t bunches_per_clock = std::same_as<typename W::State, Vec2> ? 32 : 1;

/// The k nearest of each of n milestones, k < n, one after the other.
template <World W>
RawVector<VertexId> nearest_of_each(std::size_t n, const StateIndex<W>& index, std::size_t k,
                                    const Execution& execution) {
  execution.reserve(n * k * sizeof(VertexId));
  RawVector<VertexId> ids(n * k);
  for_chunks(n, connection_grain<W>, execution, [&](Range r) {
    std::vector<Neighbour> near;
    for (std::size_t i = r.first; i < r.last; ++i) {
      index.nearest(index.point(static_cast<VertexId>(i)), k, static_cast<VertexId>(i), near);
      std::transform(near.begin(), near.end(), ids.begin() + static_cast<std::ptrdiff_t>(i * k),
                     [](const Neighbour& one) { return one.id; });
    }
  });
  return ids;
}

/// Candidate edges that are put to the world together, and their motions.
template <class State>
class Bunch {
 public:
  void add(const Edge& edge, const State& from, const State& to) {
    edges_[count_] = edge;
    motions_[count_++] = {from, to};
  }
  void clear() { count_ = 0; }
  bool full() const { return count_ == bunch_size; }
  std::span<const Edge> edges() const { return {edges_.data(), count_}; }
  std::span<const Motion<State>> motions() const { return {motions_.data(), count_}; }

 private:
  std::size_t count_ = 0;
  std::array<Edge, bunch_size> edges_;
  std::array<Motion<State>, bunch_size> motions_;
};

/// The candidate edges for which keep(chunk, motions, query) sets their bit.
template <World W, class Keep>
EdgeParts edges_that(const W& world, std::span<const typename W::State> milestones, const StateIndex<W>& index,
                     const ConnectionRule& rule, const Execution& execution, const Keep& keep) {
  const std::size_t k = milestones.empty() ? 0 : std::min<std::size_t>(rule.neighbours, milestones.size() - 1);
  const RawVector<VertexId> nearest =
      k > 0 ? nearest_of_each<W>(milestones.size(), index, k, execution) : RawVector<VertexId>();
  const auto nearest_of = [&](std::size_t i) { return std::span(nearest).subspan(i * k, k); };
  const SearchRadius radius(rule.radius);
  constexpr std::uint64_t bunches_per_poll = 16;  // a milestone may have all others within its radius
  return parts_of_chunks(milestones.size(), connection_grain<W>, execution, [&](Range r) {
    auto query = world.make_query();
    RawVector<Edge> edges;
    edges.reserve(r.size() + r.size() / 4);
    Bunch<typename W::State> bunch;
    std::uint64_t bunches = 0;
    PartClock clock(execution, bunches_per_clock<W>);
    const auto flush = [&] {
      if (++bunches % bunches_per_poll == 0) execution.check();
      clock.begin();
      std::uint32_t kept = keep(r.first / connection_grain<W>, bunch.motions(), query);
      clock.lap(StagePart::checks);
      for (; kept != 0; kept &= kept - 1)
        push_asked(edges, bunch.edges()[static_cast<std::size_t>(std::countr_zero(kept))], execution);
      bunch.clear();
    };
    const auto add = [&](VertexId from, VertexId to) {
      bunch.add({from, to}, milestones[from], milestones[to]);
      if (bunch.full()) flush();
    };
    if (rule.neighbours == 0) index.for_each_later_pair(r, radius, add);
    for (std::size_t next = r.first; k > 0 && next < r.last; ++next) {
      const auto i = static_cast<VertexId>(next);
      for (const VertexId j : nearest_of(i)) {  // each pair once
        const auto theirs = nearest_of(j);
        if (j > i || std::find(theirs.begin(), theirs.end(), i) == theirs.end()) add(i, j);
      }
    }
    if (!bunch.edges().empty()) flush();
    return edges;
  });
}

}  // namespace detail

/// All candidate edges among the milestones, unchecked.
template <World W>
EdgeParts candidate_edges(const W& world, std::span<const typename W::State> milestones, const StateIndex<W>& index,
                          const ConnectionRule& rule, const Execution& execution, Counters& counters) {
  counters.neighbour_queries += milestones.size();
  Execution unclocked = execution;
  unclocked.account = nullptr;  // nothing is checked
  const auto all = [](std::size_t, std::span<const Motion<typename W::State>> motions, typename W::Query&) {
    return (std::uint32_t{1} << motions.size()) - 1;
  };
  return detail::edges_that(world, milestones, index, rule, unclocked, all);
}

/// The free edges among the milestones.
template <World W>
EdgeParts connect_milestones(const W& world, std::span<const typename W::State> milestones, const StateIndex<W>& index,
                             const ConnectionRule& rule, const Execution& execution, Counters& counters) {
  std::vector<Counters> done(chunk_count(milestones.size(), detail::connection_grain<W>));
  const auto keep = [&](std::size_t chunk, std::span<const Motion<typename W::State>> motions,
                        typename W::Query& query) {
    const std::uint32_t bits = world.free_motions(motions, query);
    done[chunk].edges_checked += motions.size();
    done[chunk].edges_free += static_cast<std::uint64_t>(std::popcount(bits));
    done[chunk].refused = refused_motions(query);  // one query a chunk
    return bits;
  };
  EdgeParts parts = detail::edges_that(world, milestones, index, rule, execution, keep);
  for (const Counters& part : done) counters += part;
  counters.neighbour_queries += milestones.size();
  return parts;
}

/// The free edges from `vertex` (start or goal, which stands at `state` and is no milestone) to milestones: those
/// within the rule; where none of them is free, to the nearest free one of the 256 nearest. Or, where the rule says so,
/// those within a radius that grows. Throws Stopped.
template <World W>
RawVector<Edge> attach(const W& world, std::span<const typename W::State> milestones, const StateIndex<W>& index,
                       const ConnectionRule& rule, const typename W::State& state, VertexId vertex, Counters& counters,
                       const Execution& execution) {
  constexpr std::size_t farthest = 256;
  constexpr std::uint64_t checks_per_poll = 64;
  auto query = world.make_query();
  const auto at = embedded(world, state);
  RawVector<Edge> edges;
  std::vector<Neighbour> near;
  std::size_t tried = 0;
  const auto try_rest = [&](bool first_only) {
    ++counters.neighbour_queries;
    for (; tried < near.size() && !(first_only && !edges.empty()); ++tried) {
      if (++counters.edges_checked % checks_per_poll == 0) execution.check();
      if (world.is_free_motion(state, milestones[near[tried].id], query))
        push_asked(edges, {near[tried].id, vertex}, execution);
    }
  };
  if (rule.attach) {
    double radius = rule.attach->radius.value_or(rule.radius);
    if (!(radius > 0.0)) {  // as far as the k nearest
      index.nearest(at, rule.neighbours, no_vertex, near);
      if (near.empty()) return edges;
      radius = near.back().distance;
    }
    const double step = rule.attach->step.value_or(0.5 * radius);
    for (std::uint32_t i = 0; i < rule.attach->tries && edges.empty() && tried < milestones.size(); ++i) {
      index.within(at, SearchRadius(radius + i * step), no_vertex, near);
      try_rest(false);
    }
  } else {
    if (rule.neighbours > 0) {
      index.nearest(at, rule.neighbours, no_vertex, near);
    } else {
      index.within(at, rule.radius, no_vertex, near);
    }
    try_rest(false);
    if (edges.empty()) {
      index.nearest(at, farthest, no_vertex, near);
      tried = 0;
      try_rest(true);
    }
  }
  counters.edges_free += edges.size();
  counters.refused += refused_motions(query);
  return edges;
}

/// The free edges of start (vertex n, for n milestones) and goal (n + 1), the one between them included.
template <World W>
RawVector<Edge> attach_start_and_goal(const W& world, std::span<const typename W::State> milestones,
                                      const StateIndex<W>& index, const ConnectionRule& rule,
                                      const typename W::State& start, const typename W::State& goal, Counters& counters,
                                      const Execution& execution) {
  const auto start_vertex = static_cast<VertexId>(milestones.size());
  const VertexId goal_vertex = start_vertex + 1;
  RawVector<Edge> edges = attach(world, milestones, index, rule, start, start_vertex, counters, execution);
  const RawVector<Edge> at_goal = attach(world, milestones, index, rule, goal, goal_vertex, counters, execution);
  edges.insert(edges.end(), at_goal.begin(), at_goal.end());
  if (world.distance(start, goal) > direct_reach(rule)) return edges;
  auto query = world.make_query();
  ++counters.edges_checked;
  if (world.is_free_motion(start, goal, query)) {
    edges.push_back({start_vertex, goal_vertex});
    ++counters.edges_free;
  }
  counters.refused += refused_motions(query);
  return edges;
}

enum class Heading : std::uint8_t { out, in };

/// The candidate edges of a roadmap whose motions have a direction: from a state to its k nearest, or from the k
/// nearest to it; nearest by the world's metric, in the edge's direction. The metric may be far above the distance of
/// the embedding (a car gets sideways by a loop), so the k are chosen among the 4 k nearest of the embedding. Radius
/// rule: what is within the radius by the metric. Nearest first; of two as near, the smaller vertex. Their distances:
/// the edges' lengths. `except`: the state's own vertex, or no_vertex.
template <World W>
std::vector<Neighbour> one_way_candidates(const W& world, std::span<const typename W::State> states,
                                          const StateIndex<W>& index, const ConnectionRule& rule,
                                          const typename W::State& state, VertexId except, Heading heading) {
  constexpr std::size_t wider = 4;
  const auto at = embedded(world, state);
  std::vector<Neighbour> near;
  if (rule.neighbours > 0) {
    index.nearest(at, wider * rule.neighbours, except, near);
  } else {
    index.within(at, SearchRadius(rule.radius), except, near);
  }
  for (Neighbour& n : near) {
    n.distance = heading == Heading::in ? world.distance(states[n.id], state) : world.distance(state, states[n.id]);
  }
  if (rule.neighbours == 0) std::erase_if(near, [&](const Neighbour& n) { return !(n.distance <= rule.radius); });
  std::sort(near.begin(), near.end());
  if (rule.neighbours > 0 && near.size() > rule.neighbours) near.resize(rule.neighbours);
  return near;
}

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// A world as planners see it: one type a kind of state, so that they are compiled once for all worlds of it. Questions
// are virtual, and those that are asked most come in bunches; the metric of points is inline. What a world need not
// have has an answer all the same, which says that it has none.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/solution.hpp"
#include "core/base/types.hpp"
#include "core/base/world.hpp"
#include "core/plane/cell_walls.hpp"
#include "core/plane/se2.hpp"
#include "core/run/execution.hpp"
#include "core/search/graph.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "spatial/points/neighbours.hpp"

namespace warren {

/// The query of some world.
class AnyQuery {
 public:
  template <class Query>
  explicit AnyQuery(std::in_place_type_t<Query>, Query query)
      : held_(new Query(std::move(query)), [](void* held) { delete static_cast<Query*>(held); }),
        refused_([](const void* held) { return refused_motions(*static_cast<const Query*>(held)); }) {}

  /// Query: the one that it was made of.
  template <class Query>
  Query& as() {
    return *static_cast<Query*>(held_.get());
  }
  std::uint64_t refused() const { return refused_(held_.get()); }

 private:
  std::unique_ptr<void, void (*)(void*)> held_;
  std::uint64_t (*refused_)(const void*);
};
inline std::uint64_t refused_motions(const AnyQuery& query) { return query.refused(); }

/// Numbers of a state and of its embedding, which for angles without end has more.
template <class State>
inline constexpr std::array<std::size_t, 2> numbers_of{std::tuple_size_v<State>, std::tuple_size_v<State> + 2};
template <>
inline constexpr std::array<std::size_t, 2> numbers_of<Vec2>{2, 2};
template <>
inline constexpr std::array<std::size_t, 2> numbers_of<Se2>{3, 4};

/// one_way_: does the way from a to b say nothing of the way back? Any number of threads may ask, each with a query.
template <class S, bool one_way_ = false>
class AnyWorld : NotCopied {
 public:
  using State = S;
  using Query = AnyQuery;
  static constexpr bool one_way = one_way_;
  static constexpr bool in_plane = std::same_as<State, Vec2>;
  static constexpr std::size_t dimension = numbers_of<State>[0];
  using Embedding = std::array<double, numbers_of<State>[1]>;

  virtual ~AnyWorld() = default;

  // As concept SteerableWorld has them.
  virtual Query make_query() const = 0;
  virtual State at_unit(const std::array<double, dimension>& u) const = 0;
  virtual bool is_free(const State& a, Query& query) const = 0;
  virtual bool is_free_motion(const State& a, const State& b, Query& query) const = 0;
  double distance(const State& a, const State& b) const {
    if constexpr (in_plane) return warren::distance(a, b);
    return metric(a, b);
  }
  /// What a free motion costs, >= its distance; the same both ways where these are motions.
  double cost(const State& a, const State& b) const { return motion_cost ? motion_cost(a, b) : distance(a, b); }
  Embedding embed(const State& a) const {
    if constexpr (in_plane) return {a.x, a.y};
    return embedding(a);
  }
  /// As the function of that name.
  virtual Step step_to(const State& known, const State& fresh, bool backward, Query& query) const = 0;
  virtual State interpolate(const State& a, const State& b, double t) const = 0;

  /// at_unit() of each: to states[0] and those behind it.
  virtual void at_units(std::span<const std::array<double, dimension>> units, State* states) const = 0;
  /// Bit i is is_free() of the i-th state; at most bunch_size.
  virtual std::uint32_t free_states(std::span<const State> states, Query& query) const = 0;
  /// Bit i is is_free_motion() of the i-th motion; at most bunch_size, best if they are near each other.
  virtual std::uint32_t free_motions(std::span<const Motion<State>> motions, Query& query) const = 0;

  /// Of the plane, where states are points: what samples are drawn from.
  virtual Box box() const = 0;
  /// Volume of the space that samples are drawn from, in the metric; 0 where the world doesn't tell.
  virtual double sampled_volume() const = 0;
  /// Dimensions of that space: fewer than the world's where some coordinates are always the same.
  virtual std::size_t sampled_dimension() const = 0;
  /// at_unit() looks at so many coordinates, the first ones.
  virtual std::size_t unit_dimension() const = 0;
  /// Samples that a first roadmap needs.
  virtual double suggested_samples(const Execution& execution) const = 0;
  /// Of a roadmap that is tried first, >= 1, where many questions are easy; else as many as there are.
  virtual std::uint64_t first_samples() const = 0;

  /// The index-th sample of a seed from the middles of corridors, a pure function; the uniform one where a world knows
  /// none.
  virtual State corridor_state(std::uint64_t seed, std::uint64_t index) const = 0;
  /// Of a world of cells: those whose middles make a roadmap that joins what the cells join. nullptr: there are no
  /// cells.
  virtual const Bitmap* milestone_cells() const = 0;
  virtual State cell_state(std::uint32_t x, std::uint32_t y) const = 0;  ///< in the middle of a cell
  virtual double milestone_reach() const = 0;  ///< the longest motion that has to be tried between two of them
  /// Which sides of unit cells no motion crosses; empty where that can't be said, or where they are more than
  /// most_cells. Throws Stopped.
  virtual CellSides cell_sides(std::size_t most_cells, const Execution& execution) const = 0;
  /// Of a world of the plane that knows roughly where the robot may be if all but its place stays as it is: a coarse
  /// grid of places, none where that takes too long; where the robot is; the state that is there, else as a.
  virtual bool has_places() const = 0;
  virtual PlaceGrid free_places(const State& a) const = 0;
  virtual Vec2 place_of(const State& a) const = 0;
  virtual State shifted(const State& a, Vec2 to) const = 0;

  /// Where motions cost more than their distance: what a free one costs. Any number of threads may ask.
  std::function<double(const State&, const State&)> motion_cost;

 protected:
  virtual double metric(const State& a, const State& b) const = 0;
  virtual Embedding embedding(const State& a) const = 0;
};

template <World W>
inline constexpr bool is_one_way = requires {
  requires W::one_way;
};

/// What a world is to planners.
template <World W>
using AnyWorldOf = AnyWorld<typename W::State, is_one_way<W>>;

/// Refers to the world.
template <World W>
class WorldView final : public AnyWorldOf<W> {
 public:
  using Any = AnyWorldOf<W>;
  using typename Any::Embedding, typename Any::Query, typename Any::State;
  static constexpr std::size_t dimension = Any::dimension;

  explicit WorldView(const W& world) : world_(world) {}
  explicit WorldView(const W&&) = delete;

  Query make_query() const override { return Query(std::in_place_type<Own>, world_.make_query()); }
  State at_unit(const std::array<double, dimension>& u) const override { return world_.at_unit(u); }
  void at_units(std::span<const std::array<double, dimension>> units, State* states) const override {
    std::transform(units.begin(), units.end(), states, [this](const auto& u) { return world_.at_unit(u); });
  }
  bool is_free(const State& a, Query& query) const override { return world_.is_free(a, own(query)); }
  bool is_free_motion(const State& a, const State& b, Query& query) const override {
    return world_.is_free_motion(a, b, own(query));
  }
  Step step_to(const State& known, const State& fresh, bool backward, Query& query) const override {
    return warren::step_to(world_, known, fresh, backward, own(query));
  }
  State interpolate(const State& a, const State& b, double t) const override {
    if constexpr (SteerableWorld<W>) return world_.interpolate(a, b, t);
    return t < 1.0 ? a : b;
  }
  std::uint32_t free_states(std::span<const State> states, Query& query) const override {
    if constexpr (requires { world_.free_states(states, own(query)); }) return world_.free_states(states, own(query));
    std::uint32_t free = 0;
    for (std::size_t i = 0; i < states.size(); ++i) free |= std::uint32_t{world_.is_free(states[i], own(query))} << i;
    return free;
  }
  std::uint32_t free_motions(std::span<const Motion<State>> motions, Query& query) const override {
    if constexpr (requires { world_.free_motions(motions, own(query)); })
      return world_.free_motions(motions, own(query));
    std::uint32_t free = 0;
    for (std::size_t i = 0; i < motions.size(); ++i) {
      free |= std::uint32_t{world_.is_free_motion(motions[i].from, motions[i].to, own(query))} << i;
    }
    return free;
  }
  Box box() const override {
    if constexpr (requires { world_.box(); }) return world_.box();
    return {};
  }
  double sampled_volume() const override {
    if constexpr (requires { world_.sampled_volume(); }) return world_.sampled_volume();
    if constexpr (requires { world_.sampled_area(); }) return world_.sampled_area();
    return 0.0;
  }
  std::size_t sampled_dimension() const override {
    if constexpr (requires { world_.sampled_dimension(); }) return world_.sampled_dimension();
    return dimension;
  }
  std::size_t unit_dimension() const override {
    if constexpr (requires { world_.unit_dimension(); }) return world_.unit_dimension();
    return dimension;
  }
  double suggested_samples(const Execution& execution) const override {
    if constexpr (requires { world_.suggested_samples(execution); }) return world_.suggested_samples(execution);
    return 1000.0;
  }
  std::uint64_t first_samples() const override {
    if constexpr (requires { world_.first_samples(); }) return world_.first_samples();
    return std::numeric_limits<std::uint64_t>::max();
  }
  State corridor_state(std::uint64_t seed, std::uint64_t index) const override {
    if constexpr (requires { world_.corridor_state(seed, index); }) return world_.corridor_state(seed, index);
    return uniform_state(world_, seed, index);
  }
  const Bitmap* milestone_cells() const override {
    if constexpr (has_cells) return &world_.milestone_cells();
    return nullptr;
  }
  State cell_state(std::uint32_t x, std::uint32_t y) const override {
    if constexpr (has_cells) return world_.cell_state(x, y);
    return {};
  }
  double milestone_reach() const override {
    if constexpr (has_cells) return world_.milestone_reach();
    return 0.0;
  }
  CellSides cell_sides(std::size_t most_cells, const Execution& execution) const override {
    if constexpr (requires { world_.cell_sides(most_cells, execution); })
      return world_.cell_sides(most_cells, execution);
    return {};
  }
  bool has_places() const override { return knows_places; }
  PlaceGrid free_places(const State& a) const override {
    if constexpr (knows_places) return world_.free_places(a);
    return {};
  }
  Vec2 place_of(const State& a) const override {
    if constexpr (knows_places) return world_.place_of(a);
    return {};
  }
  State shifted(const State& a, Vec2 to) const override {
    if constexpr (knows_places) return world_.shifted(a, to);
    return a;
  }

 private:
  using Own = typename W::Query;
  static constexpr bool has_cells = requires(const W& w) { w.milestone_cells(); };
  static constexpr bool knows_places = requires(const W& w, const State& a) { w.free_places(a); };
  static Own& own(Query& query) { return query.template as<Own>(); }
  double metric(const State& a, const State& b) const override { return world_.distance(a, b); }
  Embedding embedding(const State& a) const override { return world_.embed(a); }

  const W& world_;
};

// Neighbours among the states of any world: an index over their embeddings, whose plain distance bounds the metric.

template <World W>
inline constexpr int embedding_dimension =
    std::tuple_size_v<decltype(std::declval<const W&>().embed(std::declval<const typename W::State&>()))>;

template <World W>
using StateIndex = Neighbours<embedding_dimension<W>>;

/// The embedding of a state, as the indices take points.
template <World W>
PointOf<embedding_dimension<W>> embedded(const W& world, const typename W::State& state) {
  const auto point = world.embed(state);
  if constexpr (embedding_dimension<W> == 2) {
    return {point[0], point[1]};
  } else {
    return point;
  }
}

template <World W>
StateIndex<W> index_of_states(const W& world, std::span<const typename W::State> states, const Execution& execution,
                              NeighbourIndex kind = NeighbourIndex::by_counts) {
  if constexpr (std::same_as<typename W::State, Vec2>) {
    return StateIndex<W>(states, execution, kind);
  } else {
    static_assert(embedding_dimension<W> != 2, "an index in the plane refers to its points, and these don't last");
    constexpr std::size_t grain = std::size_t{1} << 14;
    execution.reserve(states.size() * sizeof(PointOf<embedding_dimension<W>>));
    RawVector<PointOf<embedding_dimension<W>>> points(states.size());
    for_each_index(states.size(), grain, execution, [&](std::size_t i) { points[i] = embedded(world, states[i]); });
    return StateIndex<W>(points, execution, kind);
  }
}

// What a planner answers where it has no path. Why start and goal are apart: the sizes of their components and the
// nearest gap between them, one query a milestone of the smaller component against an index over the larger, O(n). Or
// that it was stopped.

/// Of two sets of points, neither of them empty; the order of the points does not matter.
template <int D>
Separation separation_between(std::vector<PointOf<D>> start, std::vector<PointOf<D>> goal, const Execution& execution) {
  Separation result{.start_size = start.size(), .goal_size = goal.size()};
  const bool start_is_smaller = start.size() <= goal.size();
  const auto& small = start_is_smaller ? start : goal;
  const auto& large = start_is_smaller ? goal : start;
  const KdTree<D> index(large, execution);  // a grid would search long where points are far
  constexpr std::size_t grain = 1024;
  struct Gap {
    double distance = std::numeric_limits<double>::infinity();
    std::size_t small = 0;
    std::size_t large = 0;
  };
  const std::vector<Gap> gaps = parts_of_chunks(small.size(), grain, execution, [&](Range r) {
    std::vector<Neighbour> near;
    Gap least;
    for (std::size_t i = r.first; i < r.last; ++i) {
      index.nearest(small[i], 1, no_vertex, near);
      if (near.front().distance < least.distance) least = {near.front().distance, i, near.front().id};
    }
    return least;
  });
  const Gap least = *std::ranges::min_element(gaps, {}, &Gap::distance);
  result.nearest_gap = least.distance;
  const auto place = [](const PointOf<D>& point) {
    if constexpr (D == 2) {
      return std::array{point.x, point.y};
    } else {
      return std::array{point[0], point[1]};
    }
  };
  result.near_start = place(start_is_smaller ? small[least.small] : large[least.large]);
  result.near_goal = place(start_is_smaller ? large[least.large] : small[least.small]);
  return result;
}

/// Of what start and goal are joined with; point(v): where a vertex stands.
template <int D, class PointAt>
Separation separation_of_parts(const Components& parts, VertexId start, VertexId goal, const Execution& execution,
                               const PointAt& point) {
  const auto points_of = [&](VertexId end) {
    std::vector<PointOf<D>> points;
    for (VertexId v = 0; v < parts.label.size(); ++v) {
      execution.poll(v);
      if (parts.connected(v, end)) push_asked(points, point(v), execution);
    }
    return points;
  };
  return separation_between<D>(points_of(start), points_of(goal), execution);
}

template <World W>
Separation separation_of(const W& world, std::span<const typename W::State> states, const Components& components,
                         VertexId start, VertexId goal, const Execution& execution) {
  return separation_of_parts<embedding_dimension<W>>(components, start, goal, execution,
                                                     [&](VertexId v) { return embedded(world, states[v]); });
}

/// What a planner answers when it was stopped: why, and no path. Counts and times stay as they are.
template <class State>
void mark_stopped(Solution<State>& solution, const Stopped& stopped) {
  solution.outcome = Outcome::stopped;
  solution.stop_reason = stopped.reason;
  solution.path.clear();
}

/// Runs a plan; where it is stopped its solution says so.
template <class Plan, class... Ground>
auto run_plan(Plan&& plan, const Ground&... ground) {
  try {
    plan.run(ground...);
  } catch (const Stopped& stopped) {
    mark_stopped(plan.solution(), stopped);
  }
  return std::move(plan.solution());
}

}  // namespace warren

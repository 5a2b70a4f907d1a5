// SPDX-License-Identifier: BSD-3-Clause
// Builds and opens the roadmaps of one body (sampled_solve.hpp says what a Body is), for questions that come later.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/run/execution.hpp"
#include "parallel/sort.hpp"
#include "planners/graph/hierarchy.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/kinds/planned_worlds.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/question/planner_choice.hpp"

namespace warren {

namespace detail {

/// What a state is, be it a point, a pose or joints; an arm has zeros behind those of its variables.
template <class State>
using NumbersOf = std::array<double, sizeof(State) / sizeof(double)>;

/// Has it joints?
template <World W>
inline constexpr bool is_arm_world = requires(const W& world) {
  world.model().variables;
};

/// Numbers that a state has where it is kept.
template <World W>
unsigned state_width(const W& world) {
  if constexpr (is_arm_world<W>) return static_cast<unsigned>(world.unit_dimension());
  return std::is_same_v<typename W::State, Vec2> ? 2 : 3;
}

/// The options of the roadmap's planner, as a solve of this body resolves them.
template <class Body>
RoadmapOptions roadmap_options_of(const SolveRequest& request, const Body& body) {
  RoadmapOptions options = planner_options(request.options, request.scene, WallProblem{}).roadmap;
  options.sampler = body.choose_sampler(request.options, options);
  options.attach = body.attach(request.options);
  return options;
}

/// How far from its reference point a body of the plane reaches, its clearance included.
inline double reach_of(const Problem& problem) { return extent_of(problem.robot) + problem.clearance; }

/// A file may say anything of its states; nobody draws one far from the world or beyond the joints' limits, and motions
/// over there would not end. Throws InputError, Stopped.
template <World W>
void check_drawn(const W& world, const SolveRequest& request, const Problem& problem, std::span<const double> numbers) {
  const unsigned width = state_width(world);
  std::vector<double> low;
  std::vector<double> high;
  if constexpr (is_arm_world<W>) {
    for (std::size_t j = 0; j < width; ++j) {
      low.push_back(world.model().variables[j].low);
      high.push_back(world.model().variables[j].high);
    }
  } else {
    constexpr double turn = 2.0 * std::numbers::pi;
    Box box = obstacle_box(request.scene, request.execution);
    if (request.scene.bounds) box.include(*request.scene.bounds);
    box = box.grown(box.width() + box.height() + reach_of(problem));
    low = {box.min.x, box.min.y, -turn};  // of points two of them
    high = {box.max.x, box.max.y, turn};
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    request.execution.poll(i);
    if (low[i % width] <= numbers[i] && numbers[i] <= high[i % width]) continue;
    throw InputError("roadmap", fmt::format("its state {} is none that the body can have", i / width));
  }
}

/// How little a world tells apart where it proves motions piece by piece; 0 where it knows.
template <World W>
double resolution_of(const W& world) {
  if constexpr (requires { world.resolution(); }) return world.resolution();
  if constexpr (requires { world.body().resolution(); }) return world.body().resolution();
  return 0.0;
}

/// Motions of an old roadmap that keep clear of all that has changed since.
template <World W>
class OldMotions {
 public:
  using State = typename W::State;
  OldMotions(const W& world, const OldRoadmap& old, const Problem& problem, const Execution& execution)
      : world_(world),
        old_(old),
        reach_(reach_of(problem)),
        kept_(problem.clearance + margin + 2.0 * resolution_of(world)),
        outline_(problem.robot.outline) {
    const RoadmapParts parts = old.arrays->parts();
    execution.reserve(parts.vertex_count() * sizeof(vertices_.front()));
    vertices_.reserve(parts.vertex_count());
    double largest = reach_;
    for (VertexId v = 0; v < parts.vertex_count(); ++v) {
      execution.poll(v);
      const Key key = key_of(parts.state(v));
      vertices_.emplace_back(key, v);
      largest = std::max({largest, std::abs(key[0]), std::abs(key[1])});
    }
    const double at_states = largest;
    for (const Box& p : old.places) {
      largest = std::max({largest, std::abs(p.min.x), std::abs(p.min.y), std::abs(p.max.x), std::abs(p.max.y)});
    }
    kept_ += rounding * largest;
    if (largest > 1.25 * at_states) vertices_.clear();  // which changes what planning keeps for rounding, everywhere
    polled_sort(vertices_.begin(), vertices_.end(), execution);
  }
  std::optional<bool> operator()(const State& from, const State& to) const {
    const auto v = vertex_of(from);
    const auto w = vertex_of(to);
    if (!v || !w || may_meet_changes(from, to)) return std::nullopt;
    const auto row = old_.arrays->candidates.neighbours(*v);
    const auto found = std::lower_bound(row.begin(), row.end(), *w);
    if (found == row.end() || *found != *w) return std::nullopt;
    const std::size_t end = old_.arrays->candidates.first_end(*v) + static_cast<std::size_t>(found - row.begin());
    const EdgeState state = edge_state(old_.arrays->edge_states, end);
    return state == EdgeState::unchecked ? std::nullopt : std::optional(state == EdgeState::free);
  }

 private:
  // More than planning keeps beyond what is asked for, there and far from the origin (worlds/poses/obstacle_tree.cpp).
  static constexpr double margin = 1e-6;
  static constexpr double rounding = 2e-13;  // of the largest coordinate
  using Key = std::array<double, 3>;
  static Key key_of(std::span<const double> numbers) {
    return {numbers[0], numbers[1], numbers.size() > 2 ? numbers[2] : 0.0};
  }
  std::optional<VertexId> vertex_of(const State& state) const {
    const std::pair<Key, VertexId> least{key_of(std::bit_cast<NumbersOf<State>>(state)), 0};
    const auto found = std::lower_bound(vertices_.begin(), vertices_.end(), least);
    return found == vertices_.end() || found->first != least.first ? std::nullopt : std::optional(found->second);
  }

  /// Cars drive curves. All others go straight: where a line parts what they sweep from a change, they don't meet it.
  bool may_meet_changes(const State& from, const State& to) const {
    if constexpr (requires { W::one_way; }) {
      const Box swept = world_.curve(from, to).box().grown(reach_ + kept_);
      return std::ranges::any_of(old_.places, [&](const Box& place) { return swept.meets(place); });
    } else {
      const Vec2 way{to.x - from.x, to.y - from.y};
      const double length = norm(way);
      const Vec2 along = length > 0.0 ? (1.0 / length) * way : Vec2{1.0, 0.0};
      const std::array<Vec2, 4> directions{{{1.0, 0.0}, {0.0, 1.0}, along, {-along.y, along.x}}};
      std::array<Extent, 4> swept;
      for (std::size_t i = 0; i < swept.size(); ++i) swept[i] = extent_of(directions[i], from, to);
      return std::ranges::any_of(old_.places, [&](const Box& place) {
        for (std::size_t i = 0; i < swept.size(); ++i) {
          Extent its;
          for (const double x : {place.min.x, place.max.x}) {
            for (const double y : {place.min.y, place.max.y}) its.include(dot(directions[i], {x, y}));
          }
          if (its.low > swept[i].high || its.high < swept[i].low) return false;
        }
        return true;
      });
    }
  }
  struct Extent {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    void include(double x) {
      low = std::min(low, x);
      high = std::max(high, x);
    }
  };
  /// What the body sweeps, along a direction. A corner at r runs beside the chord of where it begins and ends, at most
  /// r turn^2 / 8 from it; nowhere farther than its reach from the reference point.
  Extent extent_of(Vec2 direction, const State& from, const State& to) const {
    Extent way;
    for (const State* end : {&from, &to}) way.include(dot(direction, {end->x, end->y}));
    way = {way.low - reach_, way.high + reach_};
    if constexpr (std::is_same_v<State, Se2>) {
      const double turn = turn_between(from.theta, to.theta);
      const double bulge = reach_ * turn * turn / 8.0;
      Extent corners;
      for (const Se2& end : {from, to}) {
        const Rotation turned(end.theta);
        for (const Vec2 c : outline_) corners.include(dot(direction, end.position() + turned(c)));
      }
      if (!outline_.empty()) way = {std::max(way.low, corners.low - bulge), std::min(way.high, corners.high + bulge)};
    }
    return {way.low - kept_, way.high + kept_};
  }

  const W& world_;
  const OldRoadmap& old_;
  double reach_;
  double kept_;  // how far from the body what changed makes no difference
  std::vector<Vec2> outline_;
  std::vector<std::pair<Key, VertexId>> vertices_;
};

/// Roadmaps below are searched in less time than a person notices.
inline constexpr std::size_t fewest_contracted_states = 65'536;

/// The index of a roadmap whose edges lead both ways and are all known, where that pays. Places in a pattern make ways
/// of one length, of which an index would take another than a search.
template <World W>
Hierarchy hierarchy_of(const W& world, const BuiltRoadmap<typename W::State>& built, SamplerKind sampler,
                       const Execution& execution) {
  const bool in_pattern = takes_all_places(sampler) || sampler == SamplerKind::halton;
  if (is_one_way<W> || in_pattern || built.states.size() < fewest_contracted_states) return {};
  const auto length = [&](VertexId v, VertexId w) {
    return world.distance(built.states[std::min(v, w)], built.states[std::max(v, w)]);
  };
  const Graph free = with_lengths(free_part(built.candidates, built.edge_states, execution), execution, length);
  return contract(free, execution).value_or(Hierarchy{});
}

}  // namespace detail

/// SolveKind::build for a body.
template <class Body>
BuiltArrays build_sampled(const SolveRequest& request) {
  using World = typename Body::World;
  using State = typename World::State;
  const Execution& execution = request.execution;
  const Body body(request);
  const RoadmapOptions options = detail::roadmap_options_of(request, body);
  std::optional<World> world;
  BuiltArrays all;
  {
    const StageTimer timer(execution, "index", all.account.seconds.index);
    body.index(world, options.sampler);
  }
  const bool lazy = request.planner == PlannerKind::lazy_prm;
  KnownMotions<State> known;
  if constexpr (!detail::is_arm_world<World>) {  // arms reach everywhere
    if (request.old != nullptr) known = detail::OldMotions<World>(*world, *request.old, body.problem(), execution);
  }
  BuiltRoadmap<State> built = planned_in<World>().build(WorldView(*world), options, lazy, execution, known);
  all.samples = built.samples;
  all.rule = built.rule;
  all.account.counters = built.counters;
  all.account.seconds += built.seconds;
  RoadmapArrays& arrays = all.arrays;
  if (request.index && !lazy) {
    const StageTimer timer(execution, "contract", all.account.seconds.index, built.states.size());
    arrays.hierarchy = detail::hierarchy_of(*world, built, options.sampler, execution);
  }
  arrays.dimension = detail::state_width(*world);
  arrays.directed = is_one_way<World>;
  execution.reserve(built.states.size() * arrays.dimension * sizeof(double));
  arrays.states.reserve(built.states.size() * arrays.dimension);
  for (const State& state : built.states) {
    execution.poll(arrays.states.size());
    const auto numbers = std::bit_cast<detail::NumbersOf<State>>(state);
    arrays.states.insert(arrays.states.end(), numbers.begin(), numbers.begin() + arrays.dimension);
  }
  arrays.candidates = std::move(built.candidates);
  arrays.edge_states = std::move(built.edge_states);
  return all;
}

namespace detail {
/// With the body, to whose prices motions refer.
template <class Body>
struct SessionOf : SessionIn<typename Body::World> {
  explicit SessionOf(const SolveRequest& request) : body(request) {}
  Body body;
};
}  // namespace detail

/// SolveKind::open for a body. Refers to the request's scene, and to the arrays where they have an index.
template <class Body>
std::unique_ptr<RoadmapSession> open_sampled(const SolveRequest& request, const RoadmapArrays& arrays,
                                             const ConnectionRule& rule) {
  using World = typename Body::World;
  using State = typename World::State;
  auto session = std::make_unique<detail::SessionOf<Body>>(request);
  Body& body = session->body;
  const RoadmapOptions options = detail::roadmap_options_of(request, body);
  body.index(session->world, options.sampler);
  const unsigned width = detail::state_width(*session->world);
  if (arrays.dimension != width || arrays.directed != is_one_way<World>) {
    throw InputError("roadmap", "its states are none of the body that it says it is for");
  }
  session->view.emplace(*session->world);
  if constexpr (requires { body.price_motions(*session->world); })
    session->view->motion_cost = body.price_motions(*session->world);
  if (!(connection_rule_for(*session->view, options, request.samples) == rule)) {
    throw InputError("roadmap", "its rule is not the one that follows from its options");
  }
  detail::check_drawn(*session->world, request, body.problem(), arrays.states);
  if (request.many && !detail::is_arm_world<World> && !request.scene.map)
    session->judged.emplace(request.scene, request.execution);
  const std::span<const double> numbers(arrays.states);
  RawVector<State> states;
  request.execution.reserve(arrays.states.size() * sizeof(double));
  states.reserve(numbers.size() / width);
  for (std::size_t i = 0; i < numbers.size(); i += width) {
    request.execution.poll(i / width);
    detail::NumbersOf<State> all{};
    std::ranges::copy(numbers.subspan(i, width), all.begin());
    states.push_back(std::bit_cast<State>(all));
  }
  const bool lazy = request.planner == PlannerKind::lazy_prm;
  const bool has_index = !arrays.hierarchy.empty() && !lazy && !arrays.directed;
  if (has_index && session->view->motion_cost)
    throw InputError("roadmap", "its index is of lengths, and its ways have a price");
  session->roadmap.emplace(*session->view, std::move(states), arrays.candidates, arrays.edge_states, rule, lazy,
                           request.execution, has_index ? &arrays.hierarchy : nullptr);
  return session;
}

}  // namespace warren

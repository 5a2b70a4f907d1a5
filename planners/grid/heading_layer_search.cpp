// SPDX-License-Identifier: BSD-3-Clause
// States are numbered (j width + i) angles + k. Two more numbers stand for what the ends' states are joined to: edges
// as long as their costs lead from the one, and to the other.
#include "planners/grid/heading_layer_search.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/base/error.hpp"
#include "core/search/search_queues.hpp"
#include "parallel/asked_memory.hpp"
#include "spatial/maps/free_cells.hpp"

namespace warren {
namespace {

constexpr std::size_t bytes_a_label = 12;  // of a search: cost and parent

/// The layers as a search asks for them.
class LayerSteps {
 public:
  LayerSteps(const HeadingLayers& layers, const LayerSearchOptions& options)
      : layers_(layers), face_motion_(options.face_motion), turn_cost_(options.turn_cost) {
    const double diagonal = options.step_cost * (options.diagonal == Diagonal::sqrt2 ? std::numbers::sqrt2 : 1.0);
    for (unsigned s = 0; s < cell_steps.size(); ++s) {
      costs_[s] = is_diagonal(s) ? diagonal : options.step_cost;
      const bool allowed = !is_diagonal(s) || options.diagonal != Diagonal::none;
      if (allowed) steps_.push_back(s);
    }
    steps_facing_.resize(layers_.angles);
    constexpr std::array<unsigned, 8> eighth{5, 6, 7, 4, 0, 3, 2, 1};  // of a full turn: each step's direction
    for (const unsigned s : steps_) {
      if (std::uint64_t{eighth[s]} * layers_.angles % 8 == 0) {
        steps_facing_[std::uint64_t{eighth[s]} * layers_.angles / 8].push_back(s);
      }
    }
  }

  /// Those that there are at some heading.
  const std::vector<unsigned>& steps() const { return steps_; }
  double cost(unsigned step) const { return costs_[step]; }
  /// Calls visit(state, cost) for each state that one step or turn leads to.
  template <class Visit>
  void for_each_next(const LayerState& s, const Visit& visit) const {
    for (const unsigned step : face_motion_ ? steps_facing_[s.k] : steps_) {
      if (may_step(s, step)) visit(LayerState{s.i + cell_steps[step][0], s.j + cell_steps[step][1], s.k}, costs_[step]);
    }
    if (layers_.angles < 2) return;
    for (const std::uint32_t k : {s.k == 0 ? layers_.angles - 1 : s.k - 1, next(s.k)}) {
      if (may_turn(s, k)) visit(LayerState{s.i, s.j, k}, turn_cost_);
    }
  }
  double turn_cost() const { return turn_cost_; }
  const HeadingLayers& layers() const { return layers_; }

 private:
  struct Forward {
    unsigned step;  // of HeadingLayers::steps
    bool backwards;
  };
  static constexpr std::array<Forward, 8> forward_of{
      {{2, true}, {1, true}, {3, true}, {0, true}, {0, false}, {3, false}, {1, false}, {2, false}}};

  bool may_step(const LayerState& s, unsigned step) const {
    const auto [dx, dy] = cell_steps[step];
    const auto i = static_cast<std::uint32_t>(static_cast<std::int64_t>(s.i) + dx);  // wraps below 0: beyond the width
    const auto j = static_cast<std::uint32_t>(static_cast<std::int64_t>(s.j) + dy);
    if (i >= layers_.width || j >= layers_.height || !layers_.is_free(i, j, s.k)) return false;
    if (layers_.moving.empty()) return true;
    const Forward forward = forward_of[step];
    const std::uint32_t bitmap = layers_.moving[s.k][forward.step];
    return forward.backwards ? !layers_.bitmaps[bitmap].test(i, j) : !layers_.bitmaps[bitmap].test(s.i, s.j);
  }
  bool may_turn(const LayerState& s, std::uint32_t to) const {
    if (!layers_.is_free(s.i, s.j, to)) return false;
    if (layers_.turning.empty()) return true;
    const std::uint32_t lower = next(s.k) == to ? s.k : to;
    return !layers_.bitmaps[layers_.turning[lower]].test(s.i, s.j);
  }
  std::uint32_t next(std::uint32_t k) const { return k + 1 == layers_.angles ? 0 : k + 1; }

  const HeadingLayers& layers_;
  bool face_motion_;
  double turn_cost_;
  std::array<double, 8> costs_{};
  std::vector<unsigned> steps_;
  std::vector<std::vector<unsigned>> steps_facing_;  // by heading: those of its direction
};

/// What is left to pay at least from each position, j width + i: a Dijkstra from a vertex behind the goals over
/// positions free at some heading.
SearchState plane_costs(const LayerSteps& steps, std::span<const LayerEnd> goals, const Execution& execution) {
  const HeadingLayers& layers = steps.layers();
  execution.reserve(Bitmap::bytes_for(layers.width, layers.height));
  Bitmap free(layers.width, layers.height, false, [&] { execution.check(); });
  for (std::uint32_t k = 0; k < layers.angles; ++k) {
    const Bitmap& blocked = layers.bitmaps[layers.standing[k]];
    for (std::uint32_t j = 0; j < layers.height; ++j) {
      execution.poll(j);
      const auto to = free.row(j);
      const auto from = blocked.row(j);
      for (std::size_t w = 0; w < to.size(); ++w) to[w] |= ~from[w];
    }
  }
  const auto behind_goals = static_cast<VertexId>(free.size());
  execution.reserve((free.size() + 1) * bytes_a_label);
  SearchState state;
  state.resize(free.size() + 1, [&] { execution.check(); });
  BucketQueue queue;
  const auto neighbours = [&](VertexId v, const auto& visit) {
    if (v == behind_goals) {
      for (const LayerEnd& goal : goals) visit(goal.state.j * layers.width + goal.state.i, goal.cost);
      return;
    }
    for (const unsigned step : steps.steps()) {
      const std::int64_t i = std::int64_t{v % layers.width} - cell_steps[step][0];
      const std::int64_t j = std::int64_t{v / layers.width} - cell_steps[step][1];
      if (free.holds(i, j)) visit(static_cast<VertexId>(j * layers.width + i), steps.cost(step));
    }
  };
  const auto nothing_left = [](VertexId) { return 0.0; };
  const SearchResult all = best_first(behind_goals, no_vertex, neighbours, nothing_left, queue, state,
                                      [&] { return execution.should_stop(); });
  if (all.status == SearchStatus::stopped) execution.check();
  return state;
}

/// One search: numbers of states, neighbours, heuristic.
class LayerAStar {
 public:
  LayerAStar(const LayerSteps& steps, std::span<const LayerEnd> starts, std::span<const LayerEnd> goals,
             const Execution& execution)
      : steps_(steps),
        layers_(steps.layers()),
        starts_(starts),
        execution_(execution),
        plane_costs_(plane_costs(steps, goals, execution)) {
    for (const LayerEnd& goal : goals) goals_.emplace_back(number(goal.state), goal.cost);
    std::sort(goals_.begin(), goals_.end());
    std::vector<char> is_wanted(layers_.angles, 0);
    for (const LayerEnd& goal : goals) is_wanted[goal.state.k] = 1;
    turn_costs_.assign(layers_.angles, std::numeric_limits<double>::infinity());
    for (std::uint32_t k = 0; k < layers_.angles; ++k) {
      for (std::uint32_t to = 0; to < layers_.angles; ++to) {
        if (is_wanted[to] == 0) continue;
        const std::uint32_t apart = k > to ? k - to : to - k;
        turn_costs_[k] = std::min(turn_costs_[k], steps_.turn_cost() * std::min(apart, layers_.angles - apart));
      }
    }
  }

  SearchResult find() {
    execution_.reserve((layers_.states() + 2) * bytes_a_label);
    SearchState state;
    state.resize(layers_.states() + 2, [&] { execution_.check(); });
    BucketQueue queue(steps_.turn_cost());
    const auto neighbours = [&](VertexId v, const auto& visit) {
      if (v == before_starts()) {
        for (const LayerEnd& start : starts_) visit(number(start.state), start.cost);
        return;
      }
      if (v >= goals_.front().first && v <= goals_.back().first) {
        const auto goal = std::lower_bound(goals_.begin(), goals_.end(), Goal{v, 0.0});
        if (goal->first == v) visit(behind_goals(), goal->second);
      }
      steps_.for_each_next(state_of(v), [&](const LayerState& to, double cost) {
        if (plane_costs_.reached(to.j * layers_.width + to.i)) visit(number(to), cost);  // else there is no way on
      });
    };
    const auto heuristic = [&](VertexId v) { return at_least(v); };
    return best_first(before_starts(), behind_goals(), neighbours, heuristic, queue, state,
                      [&] { return execution_.should_stop(); });
  }

  /// Is there no way to a goal's position even for a body that is free wherever some heading is?
  bool is_hopeless() const {
    return std::all_of(starts_.begin(), starts_.end(),
                       [&](const LayerEnd& start) { return std::isinf(at_least(number(start.state))); });
  }

  LayerState state_of(VertexId v) const {
    const VertexId position = v / layers_.angles;
    return {position % layers_.width, position / layers_.width, v % layers_.angles};
  }
  double start_cost(VertexId v) const {
    double least = std::numeric_limits<double>::infinity();  // a state may be among the starts more than once
    for (const LayerEnd& start : starts_) {
      if (number(start.state) == v) least = std::min(least, start.cost);
    }
    return least;
  }
  double goal_cost(VertexId v) const { return std::lower_bound(goals_.begin(), goals_.end(), Goal{v, 0.0})->second; }

 private:
  using Goal = std::pair<VertexId, double>;

  VertexId before_starts() const { return static_cast<VertexId>(layers_.states()); }
  VertexId behind_goals() const { return static_cast<VertexId>(layers_.states() + 1); }
  VertexId number(const LayerState& s) const {
    return static_cast<VertexId>((std::uint64_t{s.j} * layers_.width + s.i) * layers_.angles + s.k);
  }

  double at_least(VertexId v) const {
    if (v >= layers_.states()) return 0.0;  // of the goal; and of the start, which is expanded first
    return plane_costs_.g(v / layers_.angles) + turn_costs_[v % layers_.angles];
  }

  const LayerSteps& steps_;
  const HeadingLayers& layers_;
  std::span<const LayerEnd> starts_;
  const Execution& execution_;
  SearchState plane_costs_;
  std::vector<double> turn_costs_;  // to the nearest goal's heading, from each
  std::vector<Goal> goals_;         // by number
};

void check(const HeadingLayers& layers, std::span<const LayerEnd> starts, std::span<const LayerEnd> goals,
           const LayerSearchOptions& options) {
  const auto check_ends = [&](const char* name, std::span<const LayerEnd> ends) {
    for (const LayerEnd& end : ends) {
      const auto& [i, j, k] = end.state;
      const bool is_inside = i < layers.width && j < layers.height && k < layers.angles;
      if (!is_inside) throw InputError(name, "lies outside of the grid");
      if (!(end.cost >= 0.0) || !std::isfinite(end.cost)) {
        throw InputError(name, "must cost a number from 0", std::to_string(end.cost));
      }
    }
  };
  check_ends("start", starts);
  check_ends("goal", goals);
  for (const double cost : {options.step_cost, options.turn_cost}) {
    if (!(cost > 0.0) || !std::isfinite(cost)) throw InputError("cost", "must be above 0", std::to_string(cost));
  }
  if (layers.states() > HeadingLayers::most_states) throw InputError("grid", "has more than 2^32 - 4 states");
}

std::vector<LayerEnd> free_ends(const HeadingLayers& layers, std::span<const LayerEnd> ends) {
  std::vector<LayerEnd> free(ends.begin(), ends.end());
  std::erase_if(free, [&](const LayerEnd& e) { return !layers.is_free(e.state.i, e.state.j, e.state.k); });
  return free;
}

void count_moves(LayerPath& path, const LayerSearchOptions& options) {
  for (std::size_t n = 1; n < path.states.size(); ++n) {
    const LayerState& a = path.states[n - 1];
    const LayerState& b = path.states[n];
    const bool across = a.i != b.i;
    const bool along = a.j != b.j;
    path.steps += across || along ? 1 : 0;
    path.diagonals += across && along ? 1 : 0;
    path.turns += a.k != b.k ? 1 : 0;
  }
  const double diagonal = options.diagonal == Diagonal::sqrt2 ? std::numbers::sqrt2 : 1.0;
  path.cost = options.step_cost *
                  (static_cast<double>(path.steps - path.diagonals) + diagonal * static_cast<double>(path.diagonals)) +
              options.turn_cost * static_cast<double>(path.turns);
}

}  // namespace

LayerPath layer_search(const HeadingLayers& layers, std::span<const LayerEnd> starts, std::span<const LayerEnd> goals,
                       const LayerSearchOptions& options, const Execution& execution) {
  check(layers, starts, goals, options);
  LayerPath path;
  const std::vector<LayerEnd> from = free_ends(layers, starts);
  const std::vector<LayerEnd> to = free_ends(layers, goals);
  path.start_free = !from.empty();
  path.goal_free = !to.empty();
  if (!path.start_free || !path.goal_free) return path;
  const LayerSteps steps(layers, options);
  LayerAStar search(steps, from, to, execution);
  if (search.is_hopeless()) return path;
  const SearchResult result = search.find();
  if (result.status == SearchStatus::stopped) execution.check();
  path.status = result.status;
  path.expanded = result.expanded;
  if (result.status != SearchStatus::found) return path;
  for (std::size_t n = 1; n + 1 < result.path.size(); ++n)
    push_asked(path.states, search.state_of(result.path[n]), execution);
  count_moves(path, options);
  path.cost += search.start_cost(result.path[1]) + search.goal_cost(result.path[result.path.size() - 2]);
  return path;
}

void for_each_reached(const HeadingLayers& layers, std::span<const LayerEnd> starts, const LayerSearchOptions& options,
                      const Execution& execution, const std::function<void(const LayerState&)>& visit) {
  check(layers, starts, {}, options);
  const LayerSteps steps(layers, options);
  const std::uint32_t columns = layers.width * layers.angles;  // rows of positions, heading after heading
  execution.reserve(Bitmap::bytes_for(columns, layers.height));
  Bitmap met(columns, layers.height, false, [&] { execution.check(); });
  std::vector<LayerState> open;
  const auto meet = [&](const LayerState& s) {
    const std::uint32_t column = s.k * layers.width + s.i;
    if (met.test(column, s.j)) return;
    met.set(column, s.j);
    push_asked(open, s, execution);
  };
  for (const LayerEnd& start : free_ends(layers, starts)) meet(start.state);
  for (std::uint64_t popped = 1; !open.empty(); ++popped) {
    if (popped % expansions_per_poll == 0) execution.check();
    const LayerState s = open.back();
    open.pop_back();
    visit(s);
    steps.for_each_next(s, [&](const LayerState& next, double) { meet(next); });
  }
}

}  // namespace warren

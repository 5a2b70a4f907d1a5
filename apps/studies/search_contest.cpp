// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/search_contest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <type_traits>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "core/search/search_queues.hpp"
#include "pictures/layers/draw_bodies.hpp"
#include "pictures/model/picture.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "spatial/points/point_grid.hpp"

namespace warren::studies {
namespace {

std::vector<Vec2> drawn_points(std::uint32_t size, std::uint64_t seed, const Execution& execution) {
  const double side = std::sqrt(static_cast<double>(size));
  std::vector<Vec2> drawn(size);
  for (std::uint32_t i = 0; i < size; ++i) {
    execution.poll(i);
    drawn[i] = {side * uniform(seed, i, 0), side * uniform(seed, i, 1)};
  }
  const RawVector<std::uint32_t> order = tile_order(drawn, execution);
  std::vector<Vec2> at(size);
  for (std::uint32_t i = 0; i < size; ++i) at[i] = drawn[order[i]];
  return at;
}

RawVector<Edge> edges_within(const std::vector<Vec2>& at, const SearchRadius& radius, const Execution& execution) {
  constexpr std::size_t vertices_per_poll = 1 << 12;
  const PointGrid grid(at, execution);
  RawVector<Edge> edges;
  for (std::size_t v = 0; v < at.size(); v += vertices_per_poll) {
    execution.check();
    grid.for_each_later_pair({v, std::min(v + vertices_per_poll, at.size())}, radius, [&](VertexId i, VertexId j) {
      edges.push_back({i, j});
    });
  }
  return edges;
}

/// Of those of rank 0; where there are none, no two are joined, and it is the first.
VertexId nearest_of(const std::vector<Vec2>& at, const std::vector<std::uint8_t>& ranks, Vec2 place,
                    const Execution& execution) {
  const auto first = std::ranges::find(ranks, 0);
  VertexId nearest = first == ranks.end() ? 0 : static_cast<VertexId>(first - ranks.begin());
  for (VertexId v = 0; v < at.size(); ++v) {
    execution.poll(v);
    if (ranks[v] == 0 && distance(at[v], place) < distance(at[nearest], place)) nearest = v;
  }
  return nearest;
}

/// A* (with the straight distance as heuristic) or Dijkstra. An array that is sorted at each push can take a second for
/// the expansions between two looks at the deadline, so there it is looked at more often.
template <class Queue>
GraphSearch best_first_on(const SearchGraph& from, SearchKind kind) {
  Queue empty;
  SearchState fresh;
  empty.resize(from.graph.vertex_count());
  fresh.resize(from.graph.vertex_count());
  return [&from, is_informed = kind == SearchKind::astar, queue = std::move(empty),
          state = std::move(fresh)](const Execution& execution) mutable {
    constexpr std::uint64_t expansions_per_look = 64;
    [[maybe_unused]] std::uint64_t expansions = 0;
    const auto neighbours = [&](VertexId v, const auto& visit) {
      if constexpr (std::is_same_v<Queue, ResortedArray>) {
        if (++expansions % expansions_per_look == 0) execution.check();
      }
      const std::span<const VertexId> row = from.graph.neighbours(v);
      const std::span<const double> lengths = from.graph.lengths(v);
      for (std::size_t i = 0; i < row.size(); ++i) visit(row[i], lengths[i]);
    };
    const Vec2 goal = from.at[from.goal];
    const auto to_goal = [&](VertexId v) { return is_informed ? distance(from.at[v], goal) : 0.0; };
    queue.clear();
    state.clear();
    try {
      return best_first(from.start, from.goal, neighbours, to_goal, queue, state,
                        [&] { return execution.should_stop(); });
    } catch (const Stopped&) {
      SearchResult stopped;
      stopped.status = SearchStatus::stopped;
      return stopped;
    }
  };
}

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

std::string text_of(const SearchVariant& v) {
  std::string text{name_of(v.search)};
  if (v.queue) text.append(" with ").append(name_of(*v.queue));
  if (v.library != SearchLibrary::warren) text.append(" of ").append(name_of(v.library));
  return text;
}

struct Entrant {
  SearchVariant variant;
  GraphSearch search;
  ComparedRun first;         // what every trial must repeat, and the seconds of the first, cold run
  std::uint64_t trials = 0;  // to be made; 0 for one that its budget cut
};

class SearchContest {
 public:
  SearchContest(const SearchGraph& graph, const SearchContestOptions& options, const Execution& execution,
                Comparison& comparison)
      : graph_(graph), options_(options), execution_(execution), comparison_(comparison) {}

  void run() {
    enter();
    check_all();
    try {
      measure();
    } catch (const Stopped&) {
      take_clock_off();
      throw;
    }
    take_clock_off();
  }

 private:
  void enter() {
    comparison_.problems.push_back(
        {graph_.source, graph_.kind, graph_.graph.vertex_count(), graph_.graph.edge_count(), graph_.unit});
    first_contender_ = comparison_.contenders.size();
    constexpr std::size_t bytes_a_vertex = 40;  // of what a search remembers, and its queue
    constexpr std::size_t bytes_an_end = 28;    // of Boost's copy of the graph
    for (const SearchVariant& v : options_.variants) {
      const std::size_t copied = v.library == SearchLibrary::boost ? 2 * graph_.graph.edge_count() : 0;
      execution_.reserve(bytes_a_vertex * graph_.graph.vertex_count() + bytes_an_end * copied);
      entrants_.push_back({v, graph_search(graph_, v), {}, 0});
      comparison_.contenders.push_back({.problem = comparison_.problems.size() - 1,
                                        .planner = graph_.kind,
                                        .search = std::string{name_of(v.search)},
                                        .queue = v.queue ? std::string{name_of(*v.queue)} : std::string{},
                                        .library = std::string{name_of(v.library)},
                                        .options = graph_.options,
                                        .runs = {}});
    }
  }
  void check_all() {
    std::vector<SearchClaim> claims;
    for (std::size_t i = 0; i < entrants_.size(); ++i) {
      Entrant& entrant = entrants_[i];
      entrant.first = run_once(entrant);
      if (entrant.first.outcome == Outcome::stopped) {
        contender(i).runs.push_back(entrant.first);
        comparison_.notes.push_back(fmt::format("{} on {}: cut by the budget, and measured no further",
                                                text_of(entrant.variant), graph_.source));
        continue;
      }
      entrant.trials = trials_for(entrant.first);
      claims.push_back(
          {entrant.variant, entrant.first.solved(), entrant.first.length, entrant.first.hops, entrant.first.expanded});
    }
    if (const auto contradiction = contradiction_in(claims)) {
      throw std::logic_error(fmt::format("searches of {} contradict each other: {}", graph_.source, *contradiction));
    }
  }
  /// Throws Stopped at a signal; a budget that ends gives Outcome::stopped.
  ComparedRun run_once(Entrant& entrant) const {
    execution_.check();
    const Deadline deadline(execution_.deadline, options_.budget_s);
    Execution within = execution_;
    within.deadline = &deadline;
    const auto begin = Clock::now();
    SearchResult result = entrant.search(within);
    const double seconds = seconds_since(begin);
    if (result.status == SearchStatus::stopped) execution_.check();
    const bool is_found = result.status == SearchStatus::found;
    ComparedRun run{
        .outcome = is_found ? Outcome::solved : Outcome::not_connected, .time_s = seconds, .expanded = result.expanded};
    if (result.status == SearchStatus::stopped || seconds > options_.budget_s) run.outcome = Outcome::stopped;
    if (run.solved()) {
      run.length = path_length(graph_, result.path);
      run.hops = result.path.size() - 1;
    }
    return run;
  }
  std::uint64_t trials_for(const ComparedRun& first) const {
    constexpr double seconds_each = 0.25;  // when nobody says how many trials
    constexpr double fewest_trials = 5.0;
    constexpr double most_trials = 10'000.0;
    if (options_.trials) return *options_.trials;
    const double fitting = std::ceil(seconds_each / std::max(first.time_s, 1e-9));
    return static_cast<std::uint64_t>(std::clamp(fitting, fewest_trials, most_trials));
  }
  void measure() {
    std::uint64_t rounds = 0;
    for (const Entrant& entrant : entrants_) rounds = std::max(rounds, entrant.trials);
    const StageTimer timer(execution_, "compare", nullptr, rounds);
    for (std::uint64_t round = 0; round < rounds; ++round) {
      measure_round(round, rounds);
      execution_.advance(1);
    }
  }
  /// Those with fewer trials than rounds sit some out, evenly.
  void measure_round(std::uint64_t round, std::uint64_t rounds) {
    for (const std::size_t i : turns(entrants_.size(), round)) {
      Entrant& entrant = entrants_[i];
      if (round * entrant.trials / rounds == (round + 1) * entrant.trials / rounds) continue;
      ComparedRun run = run_once(entrant);
      run.seed = contender(i).runs.size() + 1;
      const bool same = run.solved() == entrant.first.solved() && run.expanded == entrant.first.expanded &&
                        run.length == entrant.first.length;
      if (!same && run.outcome != Outcome::stopped) {
        throw std::logic_error(
            fmt::format("{} of {} gives another answer the second time", text_of(entrant.variant), graph_.source));
      }
      contender(i).runs.push_back(run);
    }
    const auto begin = Clock::now();
    clock_s_.push_back(seconds_since(begin));
  }
  void take_clock_off() {
    if (clock_s_.empty()) return;
    const double clock = median_of(clock_s_);
    comparison_.clock_s = std::max(comparison_.clock_s, clock);
    for (std::size_t i = 0; i < entrants_.size(); ++i) {
      for (ComparedRun& run : contender(i).runs) run.time_s = std::max(0.0, run.time_s - clock);
    }
  }
  Contender& contender(std::size_t i) { return comparison_.contenders[first_contender_ + i]; }

  const SearchGraph& graph_;
  const SearchContestOptions& options_;
  const Execution& execution_;
  Comparison& comparison_;
  std::vector<Entrant> entrants_;
  std::size_t first_contender_ = 0;
  std::vector<double> clock_s_;
};

bool differ(double a, double b) { return std::abs(a - b) > 1e-9 * std::max(std::abs(a), std::abs(b)); }

std::optional<std::string> contradiction_between(const SearchClaim& a, const SearchClaim& b) {
  const auto say = [&](std::string_view what, auto of_a, auto of_b) {
    return fmt::format("{}: {} for {}, {} for {}", what, of_a, text_of(a.variant), of_b, text_of(b.variant));
  };
  if (a.found != b.found) return say("a path is found", a.found, b.found);
  if (!a.found) return std::nullopt;
  const bool is_longer = differ(a.length, b.length) && (has_queue(b.variant.search) || b.length < a.length);
  if (has_queue(a.variant.search) && is_longer) return say("lengths", a.length, b.length);
  if (a.variant.search == SearchKind::bfs && b.hops < a.hops) return say("hops", a.hops, b.hops);
  const bool both_ours = a.variant.library == SearchLibrary::warren && b.variant.library == SearchLibrary::warren;
  if (both_ours && a.variant.search == b.variant.search) {
    if (a.length != b.length) return say("lengths", a.length, b.length);
    if (a.expanded != b.expanded) return say("vertices settled", a.expanded, b.expanded);
  }
  if (both_ours && a.variant.search == SearchKind::astar && b.variant.search == SearchKind::dijkstra &&
      a.expanded > b.expanded) {
    return say("vertices settled", a.expanded, b.expanded);
  }
  return std::nullopt;
}

/// Drops the variants of which one of the contenders from `first` on took too long in the median.
void drop_slow_variants(std::vector<SearchVariant>& variants, std::size_t first, std::uint32_t size,
                        Comparison& comparison) {
  constexpr double longest_search_s = 2.0;
  for (std::size_t i = variants.size(); i-- > 0;) {
    const Contender& contender = comparison.contenders[first + i];
    const ComparisonRow row = row_of(contender);
    if (!row.time_s || row.time_s->median <= longest_search_s) continue;
    comparison.notes.push_back(fmt::format("{}: left out beyond {} vertices, where a search takes {:.1f} s",
                                           contender_name(contender, false), size, row.time_s->median));
    variants.erase(variants.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

}  // namespace

SearchGraph geometric_graph(std::uint32_t size, double degree, std::uint64_t seed, const Execution& execution) {
  constexpr double bytes_a_vertex = 80.0;
  constexpr double bytes_an_end = 24.0;
  const double ends = std::min(degree, static_cast<double>(size));
  execution.reserve(static_cast<std::size_t>(size * (bytes_a_vertex + bytes_an_end * ends)));
  SearchGraph made;
  made.source = fmt::format("geometric:{}", size);
  made.kind = "geometric";
  made.options = {{"degree", fmt::format("{}", degree)}, {"seed", std::to_string(seed)}};
  made.at = drawn_points(size, seed, execution);
  const double radius = std::sqrt(degree / std::numbers::pi);
  const std::array<RawVector<Edge>, 1> edges{edges_within(made.at, radius, execution)};
  const auto length = [&](VertexId v, VertexId w) { return distance(made.at[v], made.at[w]); };
  made.graph = with_lengths(assemble_graph(size, edges, execution), execution, length);
  const auto ranks = component_ranks(components(made.graph, execution).label, 1, execution);
  const double side = std::sqrt(static_cast<double>(size));
  made.start = nearest_of(made.at, ranks, {0.0, 0.0}, execution);
  made.goal = nearest_of(made.at, ranks, {side, side}, execution);
  return made;
}

GraphSearch graph_search(const SearchGraph& graph, const SearchVariant& variant) {
  if (variant.library == SearchLibrary::boost) return boost_search(graph, variant.search);
  if (!has_queue(variant.search)) {
    SearchState fresh;
    fresh.resize(graph.graph.vertex_count());
    const bool is_deep = variant.search == SearchKind::dfs;
    return [&graph, is_deep, state = std::move(fresh)](const Execution& execution) mutable {
      state.clear();
      const auto stop = [&] { return execution.should_stop(); };
      return is_deep ? depth_first(graph.graph, graph.start, graph.goal, state, stop)
                     : breadth_first(graph.graph, graph.start, graph.goal, state, stop);
    };
  }
  const QueuePolicy queue = variant.queue.value_or(QueuePolicy::heap);
  if (queue == QueuePolicy::lazy_heap) return best_first_on<LazyHeap>(graph, variant.search);
  if (queue == QueuePolicy::sorted_array) return best_first_on<SortedArray>(graph, variant.search);
  if (queue == QueuePolicy::resorted_array) return best_first_on<ResortedArray>(graph, variant.search);
  if (queue == QueuePolicy::linear_scan) return best_first_on<LinearScan>(graph, variant.search);
  return best_first_on<IndexedHeap<4>>(graph, variant.search);
}

double path_length(const SearchGraph& graph, std::span<const VertexId> path) {
  double length = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const std::span<const VertexId> row = graph.graph.neighbours(path[i - 1]);
    const auto place = static_cast<std::size_t>(std::find(row.begin(), row.end(), path[i]) - row.begin());
    length += graph.graph.lengths(path[i - 1])[place];
  }
  return length;
}

std::optional<std::string> contradiction_in(std::span<const SearchClaim> claims) {
  for (const SearchClaim& a : claims) {
    for (const SearchClaim& b : claims) {
      if (auto contradiction = contradiction_between(a, b)) return contradiction;
    }
  }
  return std::nullopt;
}

void run_search_contest(const SearchGraph& graph, const SearchContestOptions& options, const Execution& execution,
                        Comparison& comparison) {
  SearchContest(graph, options, execution, comparison).run();
}

void run_size_sweep(const SizeSweepOptions& options, const Execution& execution, Comparison& comparison,
                    const std::function<void(std::string_view)>& say) {
  SearchContestOptions contest = options.contest;
  for (const std::uint32_t size : options.sizes) {
    for (std::uint64_t seed = options.first_seed; seed < options.first_seed + options.seeds; ++seed) {
      if (contest.variants.empty()) return;
      const SearchGraph graph = geometric_graph(size, options.degree, seed, execution);
      const std::size_t first = comparison.contenders.size();
      run_search_contest(graph, contest, execution, comparison);
      say(fmt::format("{} vertices, seed {}: {} edges, {} searches", size, seed, graph.graph.edge_count(),
                      contest.variants.size()));
      if (!contest.trials) drop_slow_variants(contest.variants, first, size, comparison);
    }
  }
}

WorldGraph world_graph(const Scene& scene, const Question& question, const SolveOptions& options,
                       const Execution& execution) {
  const RobotKind robot = robot_of(scene, question).kind;
  if (robot != RobotKind::point && robot != RobotKind::disc) {
    throw UsageError(
        fmt::format("{}: searches are compared on graphs in the plane, and a {} has states of its own; "
                    "@planners compares its planners",
                    scene.source, name_of(robot)));
  }
  const ChosenSolver solver = choose_solver(options, scene, question);
  ByProducts made_too;
  const Answer answer = solver.kind->solve({options, scene, question, solver.planner, execution, &made_too});
  if (answer.outcome == Outcome::stopped) throw Stopped{answer.stop_reason.value_or(StopReason::time)};
  WorldGraph made{{}, answer.outcome};
  SearchGraph& graph = made.graph;
  graph.source = scene.source;
  graph.kind = name_of(solver.planner);
  graph.unit = unit_of(scene);
  const bool has_trees = !made_too.trees.empty();
  const PlannedRoadmap<Vec2> roadmap =
      has_trees ? in_the_plane(made_too.trees, execution) : std::move(made_too.roadmap);
  if (roadmap.states.empty()) {
    if (answer.outcome != Outcome::solved) return made;
    throw UsageError(fmt::format("@graph: {} leaves no graph to search", graph.kind));
  }
  graph.options = json_options(answer.options);
  std::erase_if(graph.options, [](const auto& option) { return option.first == "pipeline"; });
  execution.reserve(roadmap.states.size() * sizeof(Vec2));
  graph.at.assign(roadmap.states.begin(), roadmap.states.end());
  const auto length = [&](VertexId v, VertexId w) { return distance(graph.at[v], graph.at[w]); };
  graph.graph = with_lengths(roadmap.graph, execution, length);
  graph.start = static_cast<VertexId>(graph.at.size() - 2);
  graph.goal = static_cast<VertexId>(graph.at.size() - 1);
  return made;
}

}  // namespace warren::studies

// SPDX-License-Identifier: BSD-3-Clause
// PRM by tiles for any sampler and rule of joining: the roadmap of planners/roadmap/prm.hpp, of which only what the
// exact reduction leaves is ever held as a graph.
//
// Milestones stand in tile order, so a tile is a run of them. First the candidate edges between different tiles are
// checked: their ends are kept. Then one thread a tile checks the edges inside, peels the dead ends and contracts the
// chains, all in cache (planners/tiled/roadmap_tile.hpp), and hands back the keys, the edges between them and what lies
// on their chains. The keys of all tiles with the edges between tiles, start and goal make the overlay, which is
// reduced once more where that pays, and searched. The path is as long as the plain pipeline's, on any roadmap; only
// the gain differs: a maze's lattice leaves few of its vertices, a dense uniform roadmap nearly all of them. Candidates
// are found twice, each is checked once. Memory: the milestones, their index (and k neighbours each for that rule), the
// edges between tiles, and the overlay. The same for any number of threads.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/let_go.hpp"
#include "planners/roadmap/prm.hpp"
#include "planners/roadmap/roadmap_search.hpp"
#include "planners/tiled/roadmap_tile.hpp"

namespace warren {

namespace detail {

/// One plan: what its rounds share.
template <World W>
class TiledRoadmapPlan : public Rounds<W> {
 public:
  using State = typename W::State;
  /// An overlay of at least `fewest_to_reduce` vertices is reduced again where that pays.
  TiledRoadmapPlan(const W& world, const State& start, const State& goal, const RoadmapOptions& options,
                   const Execution& execution, std::size_t fewest_to_reduce = fewest_for_both_ends)
      : Rounds<W>(world, start, goal, options, execution), fewest_to_reduce_(fewest_to_reduce) {}

  /// Builds and searches a roadmap with so many samples; true when the answer is final.
  bool round(std::uint64_t samples) {
    samples_ = samples;
    release();
    this->draw(samples);
    connect();
    assemble();
    return joined() && search();
  }
  void finish(PlannedRoadmap<State>*);

 private:
  using Rounds<W>::execution_;
  using Rounds<W>::options_;
  using Rounds<W>::solution_;
  using Rounds<W>::states_;
  using Rounds<W>::world_;

  static constexpr std::size_t tile_size = reduce_grain;

  void release();
  void connect();
  void check_between_tiles(const StateIndex<W>& index, const NearestLists& lists, const ConnectionRule& rule);
  void reduce_tiles(const StateIndex<W>& index, const NearestLists& lists, const ConnectionRule& rule);
  template <class Wanted, class Free>
  void check_tile(Range tile, const StateIndex<W>& index, const NearestLists& lists, const ConnectionRule& rule,
                  Counters& counters, const Wanted& wanted, const Free& free) const;
  void assemble();
  bool joined();
  bool search();
  void append(VertexId from, VertexId to, RawVector<VertexId>& path) const;

  std::size_t milestone_count() const { return states_.size() - 2; }
  std::size_t tile_count() const { return chunk_count(milestone_count(), tile_size); }
  static std::size_t tile_of(VertexId milestone) { return milestone / tile_size; }
  VertexId start_key() const { return first_key_.back(); }
  VertexId goal_key() const { return first_key_.back() + 1; }
  /// The overlay's vertex of a milestone that is a key, of start or of goal.
  VertexId key_of(VertexId vertex) const {
    if (vertex >= milestone_count()) return start_key() + static_cast<VertexId>(vertex - milestone_count());
    const auto& keys = tiles_[tile_of(vertex)].keys;
    if (keys.size() == tile_size) return first_key_[tile_of(vertex)] + vertex % tile_size;  // all of them
    return first_key_[tile_of(vertex)] +
           static_cast<VertexId>(std::lower_bound(keys.begin(), keys.end(), vertex) - keys.begin());
  }
  VertexId vertex_of(VertexId key) const { return vertices_[key]; }
  /// The chain that an edge of the overlay stands for, if it does.
  const ReducedTile::Chain* chain_of(VertexId a, VertexId b) const {
    if (std::max(a, b) >= start_key() || tile_of(vertex_of(a)) != tile_of(vertex_of(b))) return nullptr;
    const std::size_t tile = tile_of(vertex_of(a));
    return tiles_[tile].chain_between(a - first_key_[tile], b - first_key_[tile]);
  }
  double length_between(VertexId a, VertexId b) const {
    const ReducedTile::Chain* const chain = any_chain_ ? chain_of(a, b) : nullptr;
    return chain != nullptr ? chain->length : world_.distance(states_[vertex_of(a)], states_[vertex_of(b)]);
  }

  const std::size_t fewest_to_reduce_;
  std::uint64_t samples_ = 0;
  std::vector<RawVector<Edge>> crossing_;  // free edges between tiles, by the tile that checked them
  RawVector<Edge> end_edges_;              // of start and goal
  RawVector<std::uint8_t> is_kept_;        // of each milestone: has an edge out of its tile
  std::vector<ReducedTile> tiles_;
  std::vector<VertexId> first_key_;  // by tile, and start's
  RawVector<VertexId> vertices_;     // of the overlay: their milestones; start and goal after all of these
  bool any_chain_ = false;
  Graph overlay_;  // with lengths where there are chains
};

/// What the last round has left.
template <World W>
void TiledRoadmapPlan<W>::release() {
  let_go(states_, crossing_, is_kept_, tiles_, first_key_, vertices_);
  overlay_ = Graph();
}

template <World W>
void TiledRoadmapPlan<W>::connect() {
  const std::span<const State> milestones = this->milestones();
  const StateIndex<W> index = this->index_milestones();
  const StageTimer timer(execution_, "connect", solution_.seconds.connect, 2 * milestones.size());
  const ConnectionRule rule = this->rule_for(samples_);
  NearestLists lists;
  if (rule.neighbours > 0) {
    Execution quiet = execution_;
    quiet.progress = nullptr;
    lists = nearest_lists<W>(milestones, index, rule.neighbours, quiet);
  }
  solution_.counters.neighbour_queries += milestones.size();
  execution_.reserve(milestones.size());
  is_kept_.assign(milestones.size(), 0);
  check_between_tiles(index, lists, rule);
  end_edges_ = attach_start_and_goal(world_, milestones, index, rule, this->start_, this->goal_, solution_.counters);
  for (const Edge& edge : end_edges_) {
    if (edge.from < milestones.size()) is_kept_[edge.from] = 1;
  }
  solution_.roadmap.edges += end_edges_.size();
  reduce_tiles(index, lists, rule);
}

/// Calls free(from, to) for the free ones of the tile's candidate edges that are wanted.
template <World W>
template <class Wanted, class Free>
void TiledRoadmapPlan<W>::check_tile(Range tile, const StateIndex<W>& index, const NearestLists& lists,
                                     const ConnectionRule& rule, Counters& counters, const Wanted& wanted,
                                     const Free& free) const {
  auto query = world_.make_query();
  Bunch<State> bunch;
  const auto flush = [&] {
    std::uint32_t kept = free_motions(world_, bunch.motions(), query);
    counters.edges_checked += bunch.motions().size();
    counters.edges_free += static_cast<std::uint64_t>(std::popcount(kept));
    for (; kept != 0; kept &= kept - 1) free(bunch.edges()[static_cast<std::size_t>(std::countr_zero(kept))]);
    bunch.clear();
  };
  const SearchRadius radius(rule.radius);
  for (std::size_t first = tile.first; first < tile.last; first += connection_grain<W>) {
    execution_.check();
    const Range part{first, std::min(tile.last, first + connection_grain<W>)};
    for_each_candidate<W>(index, lists, radius, part, [&](VertexId from, VertexId to) {
      if (!wanted(from, to)) return;
      bunch.add({from, to}, states_[from], states_[to]);
      if (bunch.full()) flush();
    });
  }
  if (!bunch.edges().empty()) flush();
  counters.refused += refused_motions(query);
}

template <World W>
void TiledRoadmapPlan<W>::check_between_tiles(const StateIndex<W>& index, const NearestLists& lists,
                                              const ConnectionRule& rule) {
  crossing_.assign(tile_count(), {});
  std::vector<Counters> counters(tile_count());
  const auto wanted = [](VertexId from, VertexId to) { return tile_of(from) != tile_of(to); };
  for_chunks(milestone_count(), tile_size, execution_, [&](Range r) {
    RawVector<Edge> edges;
    check_tile(r, index, lists, rule, counters[r.first / tile_size], wanted, [&](const Edge& edge) {
      edges.push_back({std::min(edge.from, edge.to), std::max(edge.from, edge.to)});
    });
    crossing_[r.first / tile_size] = std::move(edges);
  });
  for (std::size_t tile = 0; tile < crossing_.size(); ++tile) {
    execution_.check();
    solution_.counters += counters[tile];
    solution_.roadmap.edges += crossing_[tile].size();
    for (const Edge& edge : crossing_[tile]) is_kept_[edge.from] = is_kept_[edge.to] = 1;
  }
}

template <World W>
void TiledRoadmapPlan<W>::reduce_tiles(const StateIndex<W>& index, const NearestLists& lists,
                                       const ConnectionRule& rule) {
  constexpr std::size_t batch = 64;       // tiles between two questions for memory
  constexpr std::size_t part = 1U << 15;  // edges
  tiles_.assign(tile_count(), {});
  const auto wanted = [](VertexId from, VertexId to) { return tile_of(from) == tile_of(to); };
  const auto reduce = [&](Range r) {
    ReducedTile& tile = tiles_[r.first / tile_size];
    EdgeParts edges;
    const auto first = static_cast<VertexId>(r.first);
    check_tile(r, index, lists, rule, tile.counters, wanted, [&](const Edge& edge) {
      if (edges.empty() || edges.back().size() == part) edges.emplace_back().reserve(part);
      edges.back().push_back({edge.from - first, edge.to - first});
    });
    const auto length = [&](VertexId v, VertexId w) { return world_.distance(states_[v], states_[w]); };
    tile.reduce(first, {is_kept_.data() + r.first, r.size()}, std::move(edges), length);
  };
  std::size_t bytes = 0;  // of the last batch: the next one will take about as many
  for (std::size_t tile = 0; tile < tile_count(); tile += batch) {
    execution_.reserve(bytes);
    const std::size_t first = tile * tile_size;
    const std::size_t last = std::min(milestone_count(), first + batch * tile_size);
    for_chunks(last - first, tile_size, execution_, [&](Range r) { reduce({first + r.first, first + r.last}); });
    bytes = 0;
    for (std::size_t t = tile; t < std::min(tile + batch, tile_count()); ++t) bytes += tiles_[t].bytes();
  }
  for (const ReducedTile& tile : tiles_) {
    solution_.counters += tile.counters;
    solution_.roadmap.edges += tile.free_edges;
    solution_.roadmap.components += tile.components;
  }
}

template <World W>
void TiledRoadmapPlan<W>::assemble() {
  const StageTimer timer(execution_, "graph", solution_.seconds.graph);
  first_key_.assign(1, 0);
  for (const ReducedTile& tile : tiles_) {
    first_key_.push_back(first_key_.back() + static_cast<VertexId>(tile.keys.size()));
  }
  execution_.reserve((start_key() + std::size_t{2}) * sizeof(VertexId));
  vertices_.resize(start_key() + std::size_t{2});
  vertices_[start_key()] = static_cast<VertexId>(milestone_count());
  vertices_[goal_key()] = static_cast<VertexId>(milestone_count() + 1);
  for_chunks(tile_count(), 1, execution_, [&](Range r) {
    const std::size_t t = r.first;
    std::copy(tiles_[t].keys.begin(), tiles_[t].keys.end(), vertices_.data() + first_key_[t]);
    for (RawVector<Edge>& part : tiles_[t].edges) {
      for (Edge& edge : part) edge = {first_key_[t] + edge.from, first_key_[t] + edge.to};
    }
    for (Edge& edge : crossing_[t]) edge = {key_of(edge.from), key_of(edge.to)};
  });
  EdgeParts parts;
  for (ReducedTile& tile : tiles_) {
    for (RawVector<Edge>& part : tile.edges) parts.push_back(std::move(part));
    let_go(tile.edges);
  }
  for (RawVector<Edge>& part : crossing_) parts.push_back(std::move(part));
  let_go(crossing_);
  parts.emplace_back();
  for (const Edge& edge : end_edges_) parts.back().push_back({key_of(edge.from), key_of(edge.to)});
  const auto has_chain = [](const ReducedTile& tile) { return !tile.chains.empty(); };
  any_chain_ = std::any_of(tiles_.begin(), tiles_.end(), has_chain);
  const std::size_t n = start_key() + std::size_t{2};
  const auto length = [this](VertexId v, VertexId w) { return length_between(v, w); };
  overlay_ = any_chain_ ? assemble_graph(n, parts, execution_, length) : assemble_graph(n, parts, execution_);
}

template <World W>
bool TiledRoadmapPlan<W>::joined() {
  const StageTimer timer(execution_, "graph", solution_.seconds.graph);
  const Components parts = components(overlay_, execution_);
  solution_.roadmap.components += parts.count;
  if (parts.connected(start_key(), goal_key())) return true;
  solution_.outcome = Outcome::not_connected;
  return false;
}

template <World W>
bool TiledRoadmapPlan<W>::search() {
  const StageTimer timer(execution_, "search", solution_.seconds.search);
  const auto length = [this](VertexId v, VertexId w) { return length_between(v, w); };
  const auto distance = [this](VertexId v, VertexId w) {
    return world_.distance(states_[vertex_of(v)], states_[vertex_of(w)]);
  };
  const RoadmapSearch asked{.start = start_key(),
                            .goal = goal_key(),
                            .length = VertexDistance(length),
                            .estimate = VertexDistance(distance),
                            .search = options_.search,
                            .queue = options_.queue,
                            .execution = execution_};
  const bool reduces = overlay_.vertex_count() >= fewest_to_reduce_ && is_stringy(overlay_, execution_);
  const SearchResult found =
      reduces
          ? search_roadmap(reduce_graph(overlay_, std::array{start_key(), goal_key()}, asked.length, execution_), asked)
          : search_roadmap(overlay_, asked);
  solution_.counters.expanded += found.expanded;
  if (found.status != SearchStatus::found) return false;
  RawVector<VertexId> path{vertex_of(found.path.front())};
  for (std::size_t i = 1; i < found.path.size(); ++i) {
    if (i % 1024 == 0) execution_.check();
    append(found.path[i - 1], found.path[i], path);
  }
  return this->take(path);
}

/// The vertices of an edge of the overlay, without its first.
template <World W>
void TiledRoadmapPlan<W>::append(VertexId from, VertexId to, RawVector<VertexId>& path) const {
  if (const ReducedTile::Chain* const chain = chain_of(from, to)) {
    const RawVector<VertexId>& inner = tiles_[tile_of(vertex_of(from))].inner;
    for (std::size_t i = 0; i < chain->count; ++i) {
      path.push_back(inner[chain->first + (from < to ? i : chain->count - 1 - i)]);
    }
  }
  path.push_back(vertex_of(to));
}

/// Tiles keep no roadmap to ask how far apart its parts are: an answer without a path is not hurried, so the last round
/// is made again in the plain way.
template <World W>
void TiledRoadmapPlan<W>::finish(PlannedRoadmap<State>*) {
  if (solution_.outcome != Outcome::not_connected) return;
  const StageTimer timer(execution_, "connect", solution_.seconds.connect);
  release();
  PrmPlan<W> plain(world_, this->start_, this->goal_, options_, execution_, false);
  plain.round(samples_);
  plain.finish(nullptr);
  solution_.separation = plain.solution().separation;
}

}  // namespace detail

/// Can prm_in_tiles give the answer under these options? A shortest-path search.
inline bool prm_in_tiles_applies(const RoadmapOptions& options) {
  return options.search == SearchKind::astar || options.search == SearchKind::dijkstra;
}

/// Plans as prm() does, with the same milestones and edges; counters differ in what is expanded. Never throws Stopped;
/// InputError for options out of range or where prm_in_tiles_applies() is false.
template <World W>
Solution<typename W::State> prm_in_tiles(const W& world, const typename W::State& start, const typename W::State& goal,
                                         const RoadmapOptions& options, const Execution& execution) {
  if (!prm_in_tiles_applies(options)) throw InputError("pipeline", "tiles keep shortest paths only");
  detail::TiledRoadmapPlan<W> plan(world, start, goal, options, execution);
  return detail::plan_in_rounds<W>(world, start, goal, options, execution, nullptr, plan);
}

}  // namespace warren

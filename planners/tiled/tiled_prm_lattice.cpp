// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiled/tiled_prm_lattice.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/let_go.hpp"
#include "parallel/chunks.hpp"
#include "planners/roadmap/stopped_solution.hpp"
#include "planners/tiled/lattice_tiles.hpp"
#include "planners/tiled/overlay_components.hpp"
#include "planners/tiled/overlay_dijkstra.hpp"
#include "planners/tiled/path_expansion.hpp"
#include "planners/tiled/path_keeper.hpp"
#include "planners/tiled/tile_borders.hpp"
#include "planners/tiled/tile_overlay.hpp"
#include "planners/tiled/tiled_separation.hpp"
#include "planners/tiles/lattice_end_links.hpp"
#include "planners/tiles/lattice_tile_reduction.hpp"
#include "planners/tiles/tile_grid.hpp"
#include "planners/tiles/tile_plane.hpp"
#include "planners/tiles/tile_source.hpp"
#include "planners/tiles/wall_marking.hpp"

namespace warren {
namespace {

/// One plan: what its stages share.
class TiledPlan {
 public:
  TiledPlan(const TiledProblem& problem, const RoadmapOptions& options, const Execution& execution)
      : problem_(problem),
        execution_(execution),
        grid_(problem.cells != nullptr ? TileGrid::of(options.lattice, problem.cells->side_log2())
                                       : TileGrid::of(options.lattice)),
        clearance_(problem.clearance * (1 + 1e-9)) {}

  void run() {
    partition();
    if (!join_ends()) return;
    solution_.counters.rounds = 1;
    reduce_tiles();
    solution_.counters.samples = std::uint64_t{grid_.rows} * grid_.cols;
    if (search_is_elsewhere()) return search_elsewhere();
    build_overlay();
    if (joined()) {
      search();
    } else {
      measure_gap();
    }
  }
  Solution<Vec2>& solution() { return solution_; }

 private:
  void partition();
  bool join_ends();
  LatticeTiles tiles_made() const;
  void reduce_bands();
  std::vector<std::size_t> begin_band(std::uint32_t band);
  void reduce_tiles();
  void expand(const PathExpansion& path, const PathPiece& piece);
  void forget(TileSummary& tile) const;
  void give_pieces(const PathExpansion& path, PathTaker& taker);
  void build_overlay();
  bool joined();
  void search();
  bool search_is_elsewhere() const { return problem_.others != nullptr && problem_.others->searches(); }
  void search_elsewhere();
  void expand_path(const PathExpansion& path);
  void measure_gap();
  Separation gap();

  static constexpr std::size_t most_points = std::size_t{1} << 20;  // of a piece of the path
  static constexpr std::size_t most_tiles = 1024;

  const TiledProblem& problem_;
  const Execution& execution_;
  const TileGrid grid_;
  const double clearance_;
  std::unique_ptr<TileSource> source_;
  Box box_;
  OverlayEnds ends_;
  std::vector<TileSummary> tiles_;
  std::optional<Overlay> overlay_;
  Solution<Vec2> solution_;
};

void TiledPlan::partition() {
  if (problem_.cells != nullptr) {
    source_ = cell_tiles(*problem_.cells, grid_);
  } else {
    const StageTimer timer(execution_, "index", solution_.seconds.index, 2 * problem_.walls.size());
    const double halo = 1.0 + clearance_ * (1 + 1e-9) + 0.01;  // an edge's length, its clearance, and rounding
    source_ = held_tiles(problem_.walls, problem_.more_walls, grid_, halo, problem_.bands, execution_);
  }
  box_ = problem_.box.value_or(source_->box());
}

/// Start and goal: false if one of them is blocked.
bool TiledPlan::join_ends() {
  const LatticeWorld world{grid_, *source_, box_, clearance_};
  constexpr std::size_t many_walls = 100'000;  // as many as make a search by two threads worth it
  Execution own = execution_;
  own.progress = nullptr;
  if (problem_.walls.size() < many_walls) own.threads = 1;
  for_chunks(2, 1, own, [&](Range r) {
    (r.first == 0 ? ends_.start : ends_.goal) = end_links(world, r.first == 0 ? problem_.start : problem_.goal);
  });
  ends_.direct =
      is_direct_candidate(problem_.start, problem_.goal) && is_direct_edge_free(world, problem_.start, problem_.goal);
  if (!ends_.start.free) solution_.outcome = Outcome::start_blocked;
  if (ends_.start.free && !ends_.goal.free) solution_.outcome = Outcome::goal_blocked;
  return ends_.start.free && ends_.goal.free;
}

LatticeTiles TiledPlan::tiles_made() const {
  const std::size_t grain = problem_.cells != nullptr ? 8 : 1;  // a reader's scratch is large
  return {grid_, *source_, box_, clearance_, ends_, grain};
}

/// Walls that are held, a band after the other.
void TiledPlan::reduce_bands() {
  tiles_.resize(grid_.count());
  for (std::uint32_t band = 0; band < source_->band_count(); ++band) {
    const std::vector<std::size_t> tiles = begin_band(band);
    const StageTimer timer(execution_, "connect", solution_.seconds.connect, tiles.size());
    std::vector<TileSummary> made(tiles.size());
    tiles_made().reduce(tiles, made, execution_);
    for (std::size_t i = 0; i < made.size(); ++i) tiles_[tiles[i]] = std::move(made[i]);
  }
}

std::vector<std::size_t> TiledPlan::begin_band(std::uint32_t band) {
  const StageTimer timer(execution_, "index", solution_.seconds.index);
  return source_->begin_band(band, execution_);
}

void TiledPlan::reduce_tiles() {
  execution_.reserve(grid_.count() * sizeof(TileSummary));
  if (source_->band_count() > 1) {
    reduce_bands();
  } else {
    const StageTimer timer(execution_, "connect", solution_.seconds.connect, grid_.count());
    if (problem_.others != nullptr) {
      tiles_ = problem_.others->reduce_all(ends_, execution_);
    } else {
      tiles_.resize(grid_.count());
      tiles_made().reduce({0, grid_.count()}, !problem_.forget, tiles_, problem_.kept, execution_);
    }
  }
  const bool come_from_elsewhere = problem_.others != nullptr || problem_.kept != nullptr;
  if (come_from_elsewhere && !search_is_elsewhere()) check_borders(grid_, tiles_, execution_);
  if (!problem_.forget) source_.reset();
  for (const TileSummary& tile : tiles_) {
    solution_.roadmap.milestones += tile.milestones;
    solution_.roadmap.edges += tile.free_edges;
    solution_.roadmap.components += tile.closed_components;
    solution_.counters.edges_checked += tile.candidate_edges;
    solution_.counters.edges_free += tile.free_edges;
  }
  const std::uint64_t links = ends_.start.links.size() + ends_.goal.links.size() + (ends_.direct ? 1 : 0);
  solution_.counters.kept = solution_.roadmap.milestones;
  solution_.counters.edges_free += links;
  solution_.counters.neighbour_queries = solution_.roadmap.milestones + ends_.start.queries + ends_.goal.queries;
  solution_.counters.edges_checked +=
      ends_.start.checked + ends_.goal.checked + (is_direct_candidate(problem_.start, problem_.goal) ? 1 : 0);
  solution_.roadmap.milestones += 2;
  solution_.roadmap.edges += links;
  solution_.roadmap.end_edges = links;
}

void TiledPlan::build_overlay() {
  {
    const StageTimer timer(execution_, "graph", solution_.seconds.graph, grid_.count());
    overlay_.emplace(grid_, tiles_, ends_, execution_);
    if (problem_.forget && problem_.others == nullptr) let_go(tiles_);
    for (TileSummary& tile : tiles_) {
      if (problem_.forget) forget(tile);
    }
  }
  const StageTimer timer(execution_, "reduce", solution_.seconds.reduce, grid_.count());
  solution_.roadmap.components += overlay_->peel(execution_);
}

bool TiledPlan::joined() {
  const StageTimer timer(execution_, "reduce", solution_.seconds.reduce, overlay_->vertex_count());
  const CoreComponents components = core_components(*overlay_, execution_);
  solution_.roadmap.components += components.count;
  if (!components.joined) solution_.outcome = Outcome::not_connected;
  return components.joined;
}

/// That there is no way is known by now: a budget that does not suffice for the gap leaves it unknown.
void TiledPlan::measure_gap() {
  try {
    solution_.separation = gap();
  } catch (const Stopped& stopped) {
    if (is_signal(stopped.reason)) throw;
  }
}

/// The tiles have been let go of, so those that are met are made again: an answer without a path is not hurried. What
/// others have handed on lacks dead ends, and where they search it is nothing.
Separation TiledPlan::gap() {
  if (source_ == nullptr) partition();
  if (problem_.others != nullptr) {
    overlay_.reset();
    let_go(tiles_);  // before the next ones come
    tiles_ = problem_.others->reduce_whole(ends_, execution_);
    check_borders(grid_, tiles_, execution_);
    overlay_.emplace(grid_, tiles_, ends_, execution_);
  }
  const auto remake = [&](std::size_t tile, TilePlane& plane) {
    WallMarker marker(clearance_);
    tiles_made().make_plane(tile, *source_->reader(), marker, plane);
  };
  const auto keys = [&](std::size_t tile, TilePlane& plane) {
    if (!tiles_.empty()) return tiles_[tile].keys;
    remake(tile, plane);
    tiles_made().keep_linked(plane);
    return TileReduction(plane).reduce(plane).keys;
  };
  const int margin = WallMarker(clearance_).margin();
  const auto begin = [&](std::uint32_t band) { return source_->begin_band(band, execution_); };
  const TileMaker maker{margin, source_->band_count(), begin, keys, remake};
  return tile_separation(*overlay_, grid_, ends_, maker, execution_);
}

/// Makes the tiles of a piece again. Where others make them the keys are here, and those hand the chains' steps back.
void TiledPlan::expand(const PathExpansion& path, const PathPiece& piece) {
  if (problem_.others == nullptr) {
    if (tiles_.empty()) execution_.reserve(grid_.count() * sizeof(TileSummary));
    tiles_.resize(grid_.count());
    std::vector<TileSummary> made(piece.tiles.size());
    tiles_made().reduce(piece.tiles, made, execution_);
    for (std::size_t i = 0; i < made.size(); ++i) tiles_[piece.tiles[i]] = std::move(made[i]);
    return;
  }
  const std::vector<PathChain> chains = path.chains_of(piece.legs);
  std::vector<TileChain> asked;
  for (const PathChain& chain : chains) {
    const auto& keys = tiles_[chain.tile].keys;
    asked.push_back({chain.tile, keys[chain.from], keys[chain.to], chain.length});
  }
  const std::vector<std::vector<std::uint8_t>> steps = problem_.others->steps_of(asked, execution_);
  for (std::size_t i = 0; i < chains.size(); ++i) {
    TileSummary& tile = tiles_[chains[i].tile];
    tile.chains.push_back(
        {chains[i].from, chains[i].to, static_cast<std::uint32_t>(tile.steps.size()), chains[i].length});
    tile.steps.insert(tile.steps.end(), steps[i].begin(), steps[i].end());
  }
  for (const std::size_t t : piece.tiles) {
    std::stable_sort(tiles_[t].chains.begin(), tiles_[t].chains.end(),
                     [](const Chain& a, const Chain& b) { return a.from < b.from; });
  }
}

void TiledPlan::forget(TileSummary& tile) const {
  if (problem_.others == nullptr) let_go(tile.keys);
  let_go(tile.chains, tile.steps);
  tile.crossings = {};
}

/// The keys of a path say which tiles it passes: what the search needs no more of the others stays forgotten.
void TiledPlan::give_pieces(const PathExpansion& path, PathTaker& taker) {
  taker.begin(path.point_count());
  RawVector<Vec2> points;
  for (std::size_t leg = 0; leg < path.leg_count();) {
    const PathPiece piece = path.piece_from(leg, most_points, most_tiles);
    {
      const StageTimer timer(execution_, "search", solution_.seconds.search, piece.tiles.size());
      expand(path, piece);
      const std::size_t count = path.point_count(piece.legs);
      if (count > points.capacity()) execution_.reserve(count * sizeof(Vec2));
      points.resize(count);
      path.write(piece.legs, tiles_, points.data());
      for (const std::size_t tile : piece.tiles) forget(tiles_[tile]);
    }
    taker.add(points);
    leg = piece.legs.last;
  }
}

void TiledPlan::expand_path(const PathExpansion& path) {
  PathKeeper keeper(solution_.path, execution_);
  if (problem_.forget) give_pieces(path, problem_.taker != nullptr ? *problem_.taker : keeper);
  solution_.outcome = Outcome::solved;
}

void TiledPlan::search() {
  std::optional<PathExpansion> path;
  SearchResult found;
  {
    const StageTimer timer(execution_, "search", solution_.seconds.search, overlay_->vertex_count());
    found = search_steps(*overlay_, ends_, execution_);
    solution_.counters.expanded = found.expanded;
    path.emplace(*overlay_, grid_, ends_, found.path, execution_);
    if (!problem_.forget) solution_.path = path->points(tiles_);
  }
  expand_path(*path);
}

/// The overlay is then that of the path alone.
void TiledPlan::search_elsewhere() {
  std::optional<PathExpansion> path;
  RawVector<VertexId> vertices;
  {
    const StageTimer timer(execution_, "search", solution_.seconds.search);
    const ToldRoute route = problem_.others->search(ends_, execution_);
    solution_.roadmap.components += route.components;
    solution_.counters.expanded = route.expanded;
    if (route.joined) {
      tiles_ = tiles_of(route, grid_, ends_, execution_);
      overlay_.emplace(grid_, tiles_, ends_, execution_);
      for (TileSummary& tile : tiles_) forget(tile);
      vertices = vertices_of(route, *overlay_, tiles_, execution_);
      path.emplace(*overlay_, grid_, ends_, vertices, execution_);
    }
  }
  if (path) return expand_path(*path);
  solution_.outcome = Outcome::not_connected;
  measure_gap();
}

}  // namespace

bool tiled_prm_applies(const RoadmapOptions& options, double clearance) {
  const bool own_rule =
      options.star == StarRule::none && !options.neighbours && (!options.radius || *options.radius == 1.0);
  const bool shortest = options.search == SearchKind::astar || options.search == SearchKind::dijkstra;
  return options.sampler == SamplerKind::lattice && own_rule && shortest && clearance <= WallMarker::largest_clearance;
}

Solution<Vec2> tiled_prm(const TiledProblem& problem, const RoadmapOptions& options, const Execution& execution) {
  options.validate();
  if (!(problem.clearance >= 0.0)) throw InputError("clearance", "must be a number, at least 0");
  if (!tiled_prm_applies(options, problem.clearance)) {
    throw InputError("pipeline", "tiles take only the lattice at radius 1 with a clearance of at most 8");
  }
  if (problem.cells != nullptr && !(problem.clearance < most_cell_clearance / (1 + 1e-8))) {
    throw InputError("clearance", "must be below half a cell where walls are made tile by tile");
  }
  TiledPlan plan(problem, options, execution);
  try {
    plan.run();
  } catch (const Stopped& stopped) {
    mark_stopped(plan.solution(), stopped);
  }
  return std::move(plan.solution());
}

}  // namespace warren

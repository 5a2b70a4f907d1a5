// SPDX-License-Identifier: BSD-3-Clause
#include "planners/tiled/tiled_prm_lattice.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "planners/roadmap/stopped_solution.hpp"
#include "planners/tiled/overlay_components.hpp"
#include "planners/tiled/overlay_dijkstra.hpp"
#include "planners/tiled/path_expansion.hpp"
#include "planners/tiled/path_keeper.hpp"
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
  template <class Numbers>
  void reduce(std::size_t count, const Numbers& tile_at, bool with_steps);
  void reduce_tiles();
  void keep_linked(TilePlane& plane) const;
  void make_plane(std::size_t tile, TileReader& reader, WallMarker& marker, TilePlane& plane) const;
  void give_pieces(const PathExpansion& path, PathTaker& taker);
  void build_overlay();
  bool joined();
  void search();
  void measure_gap();

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
    source_ = held_tiles(problem_.walls, problem_.more_walls, grid_, halo, execution_);
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

void TiledPlan::keep_linked(TilePlane& plane) const {
  for (const EndLinks* end : {&ends_.start, &ends_.goal}) {
    for (const EndLink& link : end->links) {
      if (grid_.tile_at(link.col, link.row) != plane.tile()) continue;
      *plane.at(static_cast<int>(link.col - grid_.first_col(plane.tile())),
                static_cast<int>(link.row - grid_.first_row(plane.tile()))) |= plane_bit::kept;
    }
  }
}

/// The tile's roadmap before its reduction.
void TiledPlan::make_plane(std::size_t tile, TileReader& reader, WallMarker& marker, TilePlane& plane) const {
  plane.reset(tile, box_);
  marker.mark(reader.read(tile), plane);
}

/// Fills in the summaries of tile_at(0) .. tile_at(count - 1).
template <class Numbers>
void TiledPlan::reduce(std::size_t count, const Numbers& tile_at, bool with_steps) {
  const std::size_t grain = problem_.cells != nullptr ? 8 : 1;  // a reader's scratch is large
  if (tiles_.empty()) execution_.reserve(grid_.count() * sizeof(TileSummary));
  tiles_.resize(grid_.count());
  for_chunks(count, grain, execution_, [&](Range r) {
    const std::unique_ptr<TileReader> reader = source_->reader();
    WallMarker marker(clearance_);
    TilePlane plane(grid_, marker.margin());
    TileReduction reduction(plane);
    std::size_t bytes = std::size_t{grid_.side()} * grid_.side() / 4;  // the next tile will take about as many
    for (std::size_t i = r.first; i < r.last; ++i) {
      const std::size_t tile = tile_at(i);
      execution_.reserve(bytes);
      make_plane(tile, *reader, marker, plane);
      keep_linked(plane);
      tiles_[tile] = reduction.reduce(plane);
      bytes = tiles_[tile].bytes();
      if (!with_steps) tiles_[tile].steps = {};
    }
  });
}

void TiledPlan::reduce_tiles() {
  const StageTimer timer(execution_, "connect", solution_.seconds.connect, grid_.count());
  reduce(
      grid_.count(), [](std::size_t i) { return i; }, !problem_.forget);
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
    if (problem_.forget) tiles_ = {};
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

/// The tiles have been let go of, so those that are met are made again: an answer without a path is not hurried.
void TiledPlan::measure_gap() {
  if (source_ == nullptr) partition();
  const auto remake = [&](std::size_t tile, TilePlane& plane) {
    WallMarker marker(clearance_);
    make_plane(tile, *source_->reader(), marker, plane);
  };
  const auto keys = [&](std::size_t tile, TilePlane& plane) {
    if (!tiles_.empty()) return tiles_[tile].keys;
    remake(tile, plane);
    keep_linked(plane);
    return TileReduction(plane).reduce(plane).keys;
  };
  const int margin = WallMarker(clearance_).margin();
  solution_.separation = tile_separation(*overlay_, grid_, ends_, {margin, keys, remake}, execution_);
}

/// The keys of a path say which tiles it passes: what the search needs no more of the others stays forgotten.
void TiledPlan::give_pieces(const PathExpansion& path, PathTaker& taker) {
  taker.begin(path.point_count());
  RawVector<Vec2> points;
  for (std::size_t leg = 0; leg < path.leg_count();) {
    const PathPiece piece = path.piece_from(leg, most_points, most_tiles);
    {
      const StageTimer timer(execution_, "search", solution_.seconds.search, piece.tiles.size());
      reduce(
          piece.tiles.size(), [&](std::size_t i) { return piece.tiles[i]; }, true);
      const std::size_t count = path.point_count(piece.legs);
      if (count > points.capacity()) execution_.reserve(count * sizeof(Vec2));
      points.resize(count);
      path.write(piece.legs, tiles_, points.data());
      for (const std::size_t tile : piece.tiles) tiles_[tile] = {};
    }
    taker.add(points);
    leg = piece.legs.last;
  }
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
  PathKeeper keeper(solution_.path, execution_);
  if (problem_.forget) give_pieces(*path, problem_.taker != nullptr ? *problem_.taker : keeper);
  solution_.outcome = Outcome::solved;
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

// SPDX-License-Identifier: BSD-3-Clause
#include "planners/mazes/tiled_prm_lattice.hpp"

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/raw_vector.hpp"
#include "parallel/asked_memory.hpp"
#include "planners/graph/no_path.hpp"

namespace warren {
namespace {

// Why start and goal are apart, for the tiled pipeline: the keys of both components are found on the overlay, then the
// roadmap of each tile that has some of them is made once more and flooded from them. Only asked where there is no
// path. Cost: as much again as these tiles, one nearest-neighbour query a milestone of the smaller component, and 16 to
// 40 bytes a milestone of the two.

/// Called from several threads, each with a plane of its own of that margin.
struct TileMaker {
  int margin;
  std::uint32_t bands;  ///< of tiles, which are made one after the other
  /// Returns the band's tiles; called by no thread but the first, while no tile is made.
  std::function<std::vector<std::size_t>(std::uint32_t band)> begin;
  /// The tile's keys as its reduction gave them; may use the plane up.
  std::function<std::vector<std::uint16_t>(std::size_t tile, TilePlane& plane)> keys;
  /// Makes the tile's roadmap in the plane, as before its reduction.
  std::function<void(std::size_t tile, TilePlane& plane)> remake;
};

using Points = std::vector<Vec2>;

/// Marks the overlay vertices that `from` reaches, peeled ones included.
void flood(const Overlay& overlay, VertexId from, std::uint8_t mark, RawVector<std::uint8_t>& marks,
           const Execution& execution) {
  std::vector<VertexId> stack{from};
  marks[from] = mark;
  std::uint64_t seen = 0;
  while (!stack.empty()) {
    if (++seen % 65536 == 0) execution.check();
    const VertexId v = stack.back();
    stack.pop_back();
    for (const OverlayEnd& end : overlay.ends(v)) {
      if (marks[end.target] != 0) continue;
      marks[end.target] = mark;
      push_asked(stack, end.target, execution);
    }
  }
}

/// Appends the milestones that the vertex reaches inside the plane's tile, and takes them off the plane.
void flood_plane(TilePlane& plane, int first_col, int first_row, Points& points) {
  const TileGrid& grid = plane.grid();
  std::vector<std::pair<int, int>> stack{{first_col, first_row}};
  while (!stack.empty()) {
    const auto [col, row] = stack.back();
    stack.pop_back();
    if (col < 0 || row < 0 || col >= plane.width() || row >= plane.height()) continue;
    const unsigned bits = std::exchange(*plane.at(col, row), std::uint8_t{0});
    if ((bits & plane_bit::milestone) == 0) continue;
    points.push_back(TileGrid::point(grid.first_col(plane.tile()) + col, grid.first_row(plane.tile()) + row));
    if ((bits & plane_bit::right) != 0) stack.emplace_back(col + 1, row);
    if ((bits & plane_bit::up) != 0) stack.emplace_back(col, row + 1);
    if ((bits & plane_bit::left) != 0) stack.emplace_back(col - 1, row);
    if ((bits & plane_bit::down) != 0) stack.emplace_back(col, row - 1);
  }
}

Points joined(const std::vector<std::pair<Points, Points>>& parts, Points std::pair<Points, Points>::*side, Vec2 end,
              const Execution& execution) {
  std::size_t total = 1;
  for (const auto& part : parts) total += (part.*side).size();
  execution.reserve(2 * total * sizeof(Vec2));
  Points all{end};
  all.reserve(total);
  for (const auto& part : parts) all.insert(all.end(), (part.*side).begin(), (part.*side).end());
  return all;
}

/// Throws Stopped, also where the memory limit does not allow for the milestones of both.
Separation tile_separation(const Overlay& overlay, const TileGrid& grid, const OverlayEnds& ends,
                           const TileMaker& maker, const Execution& execution) {
  constexpr std::uint8_t of_start = 1;
  constexpr std::uint8_t of_goal = 2;
  execution.reserve(overlay.vertex_count());
  RawVector<std::uint8_t> marks(overlay.vertex_count());
  std::fill(marks.begin(), marks.end(), std::uint8_t{0});
  flood(overlay, overlay.start(), of_start, marks, execution);
  flood(overlay, overlay.goal(), of_goal, marks, execution);
  const auto is_met = [&](std::size_t tile) {
    const auto mark_of = [&](VertexId v) { return marks.data() + v; };
    return std::any_of(mark_of(overlay.first_key(tile)), mark_of(overlay.first_key(tile + 1)),
                       [](std::uint8_t mark) { return mark != 0; });
  };
  execution.reserve(grid.count() * sizeof(std::pair<Points, Points>));
  std::vector<std::pair<Points, Points>> parts(grid.count());
  const auto find_points = [&](std::size_t tile) {
    TilePlane plane(grid, maker.margin);
    execution.reserve(std::size_t{grid.side()} * grid.side() * sizeof(Vec2));
    const std::vector<std::uint16_t> keys = maker.keys(tile, plane);
    maker.remake(tile, plane);
    for (std::size_t k = 0; k < keys.size(); ++k) {
      const std::uint8_t mark = marks[overlay.first_key(tile) + k];
      if (mark == 0) continue;
      const int side = static_cast<int>(grid.side());
      flood_plane(plane, keys[k] % side, keys[k] / side, mark == of_start ? parts[tile].first : parts[tile].second);
    }
  };
  for (std::uint32_t band = 0; band < maker.bands; ++band) {
    const std::vector<std::size_t> tiles = maker.begin(band);
    for_chunks(tiles.size(), 1, execution, [&](Range r) {
      if (is_met(tiles[r.first])) find_points(tiles[r.first]);
    });
  }
  using Part = std::pair<Points, Points>;
  return separation_between<2>(joined(parts, &Part::first, ends.start.at, execution),
                               joined(parts, &Part::second, ends.goal.at, execution), execution);
}

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
  Execution own = execution_.quiet();
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

/// The parts of a run are the same for any number of threads: of so many tiles each.
bool take_kept(KeptParts& kept, std::size_t first, std::uint32_t side, std::span<TileSummary> summaries) {
  const auto bytes = kept.find(PartKind::tiles, first);
  if (!bytes) return false;
  ValueUnpacker from(*bytes, "a kept part of the tiles");
  for (TileSummary& tile : summaries) tile = unpack_summary(from, side);
  if (!from.is_done()) from.refuse();
  return true;
}

void keep(KeptParts& kept, std::size_t first, std::span<const TileSummary> summaries) {
  ValuePacker packer;
  for (const TileSummary& tile : summaries) pack_summary(tile, packer);
  kept.keep(PartKind::tiles, first, packer.bytes());
}

}  // namespace

bool tiled_prm_applies(const RoadmapOptions& options, double clearance) {
  const bool own_rule =
      options.star == StarRule::none && !options.neighbours && (!options.radius || *options.radius == 1.0);
  const bool shortest = has_queue(options.search);
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
  return run_plan(plan);
}

/// The scratch of one thread.
class LatticeTiles::Maker {
 public:
  explicit Maker(const LatticeTiles& tiles)
      : tiles_(tiles),
        reader_(tiles.source_.reader()),
        marker_(tiles.clearance_),
        plane_(tiles.grid_, marker_.margin()),
        reduction_(plane_),
        bytes_(std::size_t{tiles.grid_.side()} * tiles.grid_.side() / 4) {}

  TileSummary make(std::size_t tile, const Execution& execution) {
    execution.reserve(bytes_);
    tiles_.make_plane(tile, *reader_, marker_, plane_);
    tiles_.keep_linked(plane_);
    TileSummary summary = reduction_.reduce(plane_);
    bytes_ = summary.bytes();
    return summary;
  }

 private:
  const LatticeTiles& tiles_;
  std::unique_ptr<TileReader> reader_;
  WallMarker marker_;
  TilePlane plane_;
  TileReduction reduction_;
  std::size_t bytes_;  // of the last tile: the next one will take about as many
};

void LatticeTiles::make_plane(std::size_t tile, TileReader& reader, WallMarker& marker, TilePlane& plane) const {
  plane.reset(tile, box_);
  marker.mark(reader.read(tile), plane);
}

void LatticeTiles::keep_linked(TilePlane& plane) const {
  for (const EndLinks* end : {&ends_.start, &ends_.goal}) {
    for (const EndLink& link : end->links) {
      if (grid_.tile_at(link.col, link.row) != plane.tile()) continue;
      *plane.at(static_cast<int>(link.col - grid_.first_col(plane.tile())),
                static_cast<int>(link.row - grid_.first_row(plane.tile()))) |= plane_bit::kept;
    }
  }
}

void LatticeTiles::reduce(Range tiles, bool with_steps, std::span<TileSummary> summaries, KeptParts* kept,
                          const Execution& execution) const {
  for_chunks(tiles.size(), grain_, execution, [&](Range r) {
    const std::span<TileSummary> part = summaries.subspan(r.first, r.size());
    if (kept != nullptr && take_kept(*kept, tiles.first + r.first, grid_.side(), part)) return;
    Maker maker(*this);
    for (std::size_t i = 0; i < part.size(); ++i) {
      part[i] = maker.make(tiles.first + r.first + i, execution);
      if (!with_steps) let_go(part[i].steps);
    }
    if (kept != nullptr) keep(*kept, tiles.first + r.first, part);
  });
}

void LatticeTiles::reduce(std::span<const std::size_t> tiles, std::span<TileSummary> summaries,
                          const Execution& execution) const {
  for_chunks(tiles.size(), grain_, execution, [&](Range r) {
    Maker maker(*this);
    for (std::size_t i = r.first; i < r.last; ++i) summaries[i] = maker.make(tiles[i], execution);
  });
}

}  // namespace warren

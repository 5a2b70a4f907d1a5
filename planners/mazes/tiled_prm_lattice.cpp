// SPDX-License-Identifier: BSD-3-Clause
#include "planners/mazes/tiled_prm_lattice.hpp"

#include <algorithm>
#include <cassert>
#include <memory>
#include <numeric>
#include <set>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/raw_vector.hpp"
#include "parallel/asked_memory.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/graph/assemble_graph.hpp"

namespace warren {
namespace {

// Why start and goal are apart, for the tiled pipeline: the keys of both components are found on the overlay, then the
// roadmap of each tile that has some of them is made once more and flooded from them. Only asked where there is no
// path. Cost: as much again as these tiles, one nearest-neighbour query a milestone of the smaller component, and 16 to
// 40 bytes a milestone of the two.

using Points = std::vector<Vec2>;
/// Milestones that the start reaches, and those that the goal does.
using PointsOfBoth = std::pair<Points, Points>;

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

Points joined_points(const std::vector<PointsOfBoth>& parts, Points PointsOfBoth::*side, Vec2 end,
                     const Execution& execution) {
  std::size_t total = 1;
  for (const auto& part : parts) total += (part.*side).size();
  execution.reserve(2 * total * sizeof(Vec2));
  Points all{end};
  all.reserve(total);
  for (const auto& part : parts) all.insert(all.end(), (part.*side).begin(), (part.*side).end());
  return all;
}

constexpr std::size_t legs_a_chunk = 1024;

/// The first chain of so many steps between keys from < to of a tile; there must be one.
const Chain& chain_between(const TileSummary& tile, std::uint32_t from, std::uint32_t to, std::uint32_t steps) {
  const auto first = std::ranges::lower_bound(tile.chains, from, {}, &Chain::from);
  const auto found = std::find_if(first, tile.chains.end(),
                                  [&](const Chain& chain) { return chain.to == to && chain.length == steps; });
  assert(found != tile.chains.end() && found->from == from);
  return *found;
}

constexpr Vec2 directions[4] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};

/// Some legs in a row.
struct PathPiece {
  Range legs;
  std::vector<std::size_t> tiles;  // those that it passes, ascending
};

/// A path of the overlay with all that its chains stand for, whole or in pieces: a piece needs the summaries of the
/// tiles that it passes and no others. A leg leads from one vertex of the path to the next. Memory: 8 bytes a leg.
/// Refers to all that it is made of.
class PathExpansion {
 public:
  /// path: from start to goal. Throws Stopped.
  PathExpansion(const Overlay& overlay, const TileGrid& grid, const OverlayEnds& ends, std::span<const VertexId> path,
                const Execution& execution)
      : overlay_(overlay), grid_(grid), ends_(ends), path_(path), execution_(execution) {
    execution.reserve((leg_count() + 1) * sizeof(std::size_t));
    first_.assign(leg_count() + 1, 1);
    for_each_index(leg_count(), legs_a_chunk, execution.quiet(), [&](std::size_t i) {
      const bool is_link = !overlay_.is_key(path_[i]) || !overlay_.is_key(path_[i + 1]);
      first_[i + 1] = is_link ? 1 : overlay_.steps_between(path_[i], path_[i + 1]);
    });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
  }

  std::size_t leg_count() const { return path_.size() - 1; }
  std::size_t point_count() const { return first_.back(); }
  /// Points of a piece, its first leg's beginning among them.
  std::size_t point_count(Range legs) const { return first_[legs.last] - first_[legs.first] + 1; }
  /// As many legs from `first` on as have so many points and pass so many tiles, at least one.
  PathPiece piece_from(std::size_t first) const {
    constexpr std::size_t most_points = std::size_t{1} << 20;
    constexpr std::size_t most_tiles = 1024;
    std::set<std::size_t> tiles;
    std::size_t last_tile = grid_.count();
    const auto pass = [&](VertexId v) {
      if (!overlay_.is_key(v)) return;
      const std::size_t tile = overlay_.tile_of(v);
      if (tile != last_tile) tiles.insert(tile);
      last_tile = tile;
    };
    pass(path_[first]);
    std::size_t last = first;
    while (last < leg_count()) {
      if (last > first && (point_count({first, last}) >= most_points || tiles.size() >= most_tiles)) break;
      if (last % legs_a_chunk == 0) execution_.check();
      pass(path_[++last]);
    }
    return {{first, last}, {tiles.begin(), tiles.end()}};
  }
  /// Those of more than one step among these legs, in their order; their ends are key numbers of their tiles.
  std::vector<TileChain> chains_of(Range legs) const {
    std::vector<TileChain> chains;
    for (std::size_t leg = legs.first; leg < legs.last; ++leg) {
      if (leg % legs_a_chunk == 0) execution_.check();
      if (first_[leg + 1] - first_[leg] > 1) chains.push_back(chain_of(leg));
    }
    return chains;
  }
  /// Writes the points of a piece, its first leg's beginning among them; `tiles` has the summaries by number. In
  /// parallel. Throws Stopped.
  void write(Range legs, std::span<const TileSummary> tiles, Vec2* out) const {
    *out = place_of(path_[legs.first], tiles);
    for_chunks(legs.size(), legs_a_chunk, execution_, [&](Range r) {
      for (std::size_t leg = legs.first + r.first; leg < legs.first + r.last; ++leg) {
        Vec2* const at = out + 1 + (first_[leg] - first_[legs.first]);
        if (first_[leg + 1] - first_[leg] == 1) {
          *at = place_of(path_[leg + 1], tiles);
          continue;
        }
        const TileChain taken = chain_of(leg);
        const TileSummary& tile = tiles[taken.tile];
        const Chain& chain = chain_between(tile, taken.from, taken.to, taken.length);
        const bool forward = path_[leg] < path_[leg + 1];
        const std::uint8_t* const steps = tile.steps.data() + chain.first_step;
        Vec2 place = place_of(path_[leg], tiles);
        for (std::uint32_t i = 0; i < chain.length; ++i) {
          place = place + directions[forward ? steps[i] : steps[chain.length - 1 - i] ^ 2U];
          at[i] = place;
        }
      }
    });
  }
  /// All points.
  Path<Vec2> points(std::span<const TileSummary> tiles) const {
    Path<Vec2> points;
    reserve_touched(points, point_count(), execution_);
    points.resize(point_count());  // not with a value: the library of g++ 12 is slow at that
    write({0, leg_count()}, tiles, points.data());
    return points;
  }

 private:
  Vec2 place_of(VertexId v, std::span<const TileSummary> tiles) const {
    if (v == overlay_.start()) return ends_.start.at;
    if (v == overlay_.goal()) return ends_.goal.at;
    const std::size_t tile = overlay_.tile_of(v);
    const std::uint32_t local = tiles[tile].keys[v - overlay_.first_key(tile)];
    const std::uint32_t side = grid_.side();
    return TileGrid::point(grid_.first_col(tile) + local % side, grid_.first_row(tile) + local / side);
  }
  /// Of a leg of more than one step.
  TileChain chain_of(std::size_t leg) const {
    const std::size_t tile = overlay_.tile_of(path_[leg]);
    const VertexId first = overlay_.first_key(tile);
    const auto [low, high] = std::minmax(path_[leg], path_[leg + 1]);
    return {tile, static_cast<std::uint16_t>(low - first), static_cast<std::uint16_t>(high - first),
            static_cast<std::uint32_t>(first_[leg + 1] - first_[leg])};
  }

  const Overlay& overlay_;
  const TileGrid& grid_;
  const OverlayEnds& ends_;
  std::span<const VertexId> path_;
  const Execution& execution_;
  std::vector<std::size_t> first_;  // where the points of each leg go, its beginning not counted; and the end
};

/// Makes tiles: the scratch of one thread. Refers to what the world refers to, and to ends.
class TileMaker {
 public:
  TileMaker(const LatticeWorld& world, const OverlayEnds& ends)
      : world_(world),
        ends_(ends),
        reader_(world.tiles.reader()),
        marker_(world.clearance),
        plane_(world.grid, marker_.margin()),
        reduction_(plane_),
        bytes_(std::size_t{world.grid.side()} * world.grid.side() / 4) {}

  /// The tile's roadmap before its reduction, good until the next is made.
  TilePlane& plane_of(std::size_t tile) {
    plane_.reset(tile, world_.box);
    marker_.mark(reader_->read(tile), plane_);
    return plane_;
  }
  TileSummary make(std::size_t tile, const Execution& execution) {
    execution.reserve(bytes_);
    plane_of(tile);
    keep_linked();
    TileSummary summary = reduction_.reduce(plane_);
    bytes_ = summary.bytes();
    return summary;
  }

 private:
  /// What start and goal join stays.
  void keep_linked() {
    for (const EndLinks* end : {&ends_.start, &ends_.goal}) {
      for (const EndLink& link : end->links) {
        if (world_.grid.tile_at(link.col, link.row) != plane_.tile()) continue;
        *plane_.at(static_cast<int>(link.col - world_.grid.first_col(plane_.tile())),
                   static_cast<int>(link.row - world_.grid.first_row(plane_.tile()))) |= plane_bit::kept;
      }
    }
  }

  const LatticeWorld world_;
  const OverlayEnds& ends_;
  std::unique_ptr<TileReader> reader_;
  WallMarker marker_;
  TilePlane plane_;
  TileReduction reduction_;
  std::size_t bytes_;  // of the last tile: the next one will take about as many
};

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
    make_all();
    solution_.counters.samples = std::uint64_t{grid_.rows} * grid_.cols;
    if (search_is_elsewhere()) return search_elsewhere();
    build_overlay();
    if (joined()) return search();
    measure_gap();
  }
  Solution<Vec2>& solution() { return solution_; }

 private:
  void partition() {
    if (problem_.cells != nullptr) {
      source_ = cell_tiles(*problem_.cells, grid_);
    } else {
      const StageTimer timer(execution_, "index", solution_.seconds.index, 2 * problem_.walls.size());
      const double halo = 1.0 + clearance_ * (1 + 1e-9) + 0.01;  // an edge's length, its clearance, and rounding
      std::optional<TileBands> asked;
      if (problem_.bands > 0) asked = TileBands{std::min(problem_.bands, grid_.tile_cols)};
      source_ = std::make_unique<WallPartition>(problem_.walls, problem_.more_walls, grid_, halo, execution_, asked);
    }
    box_ = problem_.box.value_or(source_->box());
  }

  LatticeWorld world() const { return {grid_, *source_, box_, clearance_}; }

  /// Start and goal: false if one of them is blocked.
  bool join_ends() {
    const LatticeWorld world = this->world();
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

  /// Tiles that a thread makes at once.
  std::size_t grain() const { return problem_.cells != nullptr ? 8 : 1; }  // a reader's scratch is large
  /// Fills in the summaries of these tiles, with steps.
  void make(std::span<const std::size_t> tiles) {
    std::vector<TileSummary> made = reduce_tiles(world(), ends_, grain(), tiles, execution_);
    for (std::size_t i = 0; i < made.size(); ++i) tiles_[tiles[i]] = std::move(made[i]);
  }

  /// Walls that are held, a band after the other.
  void make_bands() {
    tiles_.resize(grid_.count());
    for (std::uint32_t band = 0; band < source_->band_count(); ++band) {
      std::vector<std::size_t> tiles;
      {
        const StageTimer timer(execution_, "index", solution_.seconds.index);
        tiles = source_->begin_band(band, execution_);
      }
      const StageTimer timer(execution_, "connect", solution_.seconds.connect, tiles.size());
      make(tiles);
    }
  }

  void make_all() {
    execution_.reserve(grid_.count() * sizeof(TileSummary));
    if (source_->band_count() > 1) {
      make_bands();
    } else {
      const StageTimer timer(execution_, "connect", solution_.seconds.connect, grid_.count());
      tiles_ = problem_.others != nullptr ? problem_.others->reduce_all(ends_, execution_)
                                          : reduce_tiles(world(), ends_, grain(), {0, grid_.count()}, !problem_.forget,
                                                         problem_.kept, execution_);
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

  /// Makes the tiles of a piece again. Where others make them the keys are here, and those hand the chains' steps back.
  void expand(const PathExpansion& path, const PathPiece& piece) {
    if (problem_.others == nullptr) {
      if (tiles_.empty()) execution_.reserve(grid_.count() * sizeof(TileSummary));
      tiles_.resize(grid_.count());
      return make(piece.tiles);
    }
    const std::vector<TileChain> chains = path.chains_of(piece.legs);
    std::vector<TileChain> asked = chains;
    for (TileChain& chain : asked) {
      for (std::uint16_t* end : {&chain.from, &chain.to}) *end = tiles_[chain.tile].keys[*end];
    }
    const std::vector<std::vector<std::uint8_t>> steps = problem_.others->steps_of(asked, execution_);
    for (std::size_t i = 0; i < chains.size(); ++i) {
      TileSummary& tile = tiles_[chains[i].tile];
      tile.chains.push_back(
          {chains[i].from, chains[i].to, static_cast<std::uint32_t>(tile.steps.size()), chains[i].length});
      tile.steps.insert(tile.steps.end(), steps[i].begin(), steps[i].end());
    }
    for (const std::size_t t : piece.tiles) std::ranges::stable_sort(tiles_[t].chains, {}, &Chain::from);
  }

  void forget(TileSummary& tile) const {
    if (problem_.others == nullptr) let_go(tile.keys);
    let_go(tile.chains, tile.steps);
    tile.crossings = {};
  }

  /// The keys of a path say which tiles it passes: what the search needs no more of the others stays forgotten.
  void give_pieces(const PathExpansion& path, PathTaker& taker) {
    taker.begin(path.point_count());
    RawVector<Vec2> points;
    for (std::size_t leg = 0; leg < path.leg_count();) {
      const PathPiece piece = path.piece_from(leg);
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

  void build_overlay() {
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

  bool joined() {
    const StageTimer timer(execution_, "reduce", solution_.seconds.reduce, overlay_->vertex_count());
    const Components parts = components(*overlay_, {0, overlay_->vertex_count()}, execution_);
    solution_.roadmap.components += parts.count;
    return parts.connected(overlay_->start(), overlay_->goal());
  }

  void search() {
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

  bool search_is_elsewhere() const { return problem_.others != nullptr && problem_.others->searches(); }

  /// The overlay is then that of the path alone.
  void search_elsewhere() {
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
    measure_gap();
  }

  void expand_path(const PathExpansion& path) {
    PathKeeper keeper(solution_.path, execution_);
    if (problem_.forget) give_pieces(path, problem_.taker != nullptr ? *problem_.taker : keeper);
    solution_.outcome = Outcome::solved;
  }

  /// That there is no way is known by now: a budget that does not suffice for the gap leaves it unknown.
  void measure_gap() {
    solution_.outcome = Outcome::not_connected;
    try {
      solution_.separation = gap();
    } catch (const Stopped& stopped) {
      if (is_signal(stopped.reason)) throw;
    }
  }

  /// The tiles have been let go of, so those that are met are made again: an answer without a path is not hurried. What
  /// others have handed on lacks dead ends, and where they search it is nothing.
  Separation gap() {
    if (source_ == nullptr) partition();
    if (problem_.others != nullptr) {
      overlay_.reset();
      let_go(tiles_);  // before the next ones come
      tiles_ = problem_.others->reduce_whole(ends_, execution_);
      check_borders(grid_, tiles_, execution_);
      overlay_.emplace(grid_, tiles_, ends_, execution_);
    }
    const RawVector<VertexId> label =  // peeled vertices among them
        joined_labels(overlay_->vertex_count(), execution_.quiet(), [&](VertexId v, const auto& join) {
          for (const OverlayEnd& end : overlay_->ends(v)) join(end.target);
        });
    execution_.reserve(grid_.count() * sizeof(PointsOfBoth));
    std::vector<PointsOfBoth> parts(grid_.count());
    for (std::uint32_t band = 0; band < source_->band_count(); ++band) {
      const std::vector<std::size_t> tiles = source_->begin_band(band, execution_);
      for_chunks(tiles.size(), 1, execution_,
                 [&](Range r) { parts[tiles[r.first]] = reached_points(tiles[r.first], label); });
    }
    return separation_between<2>(joined_points(parts, &PointsOfBoth::first, ends_.start.at, execution_),
                                 joined_points(parts, &PointsOfBoth::second, ends_.goal.at, execution_), execution_);
  }

  /// The milestones that the tile's keys of both components reach inside it; label: of each key's component.
  PointsOfBoth reached_points(std::size_t tile, const RawVector<VertexId>& label) const {
    const std::span<const VertexId> own(label.data() + overlay_->first_key(tile),
                                        label.data() + overlay_->first_key(tile + 1));
    const VertexId of_start = label[overlay_->start()];
    const VertexId of_goal = label[overlay_->goal()];
    const auto is_of_one = [&](VertexId of_key) { return of_key == of_start || of_key == of_goal; };
    if (std::none_of(own.begin(), own.end(), is_of_one)) return {};
    execution_.reserve(std::size_t{grid_.side()} * grid_.side() * sizeof(Vec2));
    TileMaker maker(world(), ends_);
    const std::vector<std::uint16_t> keys = tiles_.empty() ? maker.make(tile, execution_).keys : tiles_[tile].keys;
    TilePlane& plane = maker.plane_of(tile);
    PointsOfBoth points;
    for (std::size_t k = 0; k < keys.size(); ++k) {
      if (!is_of_one(own[k])) continue;
      const int side = static_cast<int>(grid_.side());
      flood_plane(plane, keys[k] % side, keys[k] / side, own[k] == of_start ? points.first : points.second);
    }
    return points;
  }

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

std::vector<TileSummary> reduce_tiles(const LatticeWorld& world, const OverlayEnds& ends, std::size_t grain,
                                      Range tiles, bool with_steps, KeptParts* kept, const Execution& execution) {
  std::vector<TileSummary> summaries(tiles.size());
  for_chunks(tiles.size(), grain, execution, [&](Range r) {
    const std::span<TileSummary> part = std::span(summaries).subspan(r.first, r.size());
    if (kept != nullptr && take_kept(*kept, tiles.first + r.first, world.grid.side(), part)) return;
    TileMaker maker(world, ends);
    for (std::size_t i = 0; i < part.size(); ++i) {
      part[i] = maker.make(tiles.first + r.first + i, execution);
      if (!with_steps) let_go(part[i].steps);
    }
    if (kept != nullptr) keep(*kept, tiles.first + r.first, part);
  });
  return summaries;
}

std::vector<TileSummary> reduce_tiles(const LatticeWorld& world, const OverlayEnds& ends, std::size_t grain,
                                      std::span<const std::size_t> tiles, const Execution& execution) {
  std::vector<TileSummary> summaries(tiles.size());
  for_chunks(tiles.size(), grain, execution, [&](Range r) {
    TileMaker maker(world, ends);
    for (std::size_t i = r.first; i < r.last; ++i) summaries[i] = maker.make(tiles[i], execution);
  });
  return summaries;
}

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// The roadmap of a maze's lattice, held as a route index (planners/lengths) instead of states and edges: two bits a
// cell for its edges, and about one byte a cell by which any question is answered exactly without a search.
//
// Ends are joined to the lattice as solve() joins them (roadmap_query.cpp): to the milestones within a step that they
// reach freely, and where there is none to the nearest of the 256 nearest that they do. An end on a milestone that has
// an edge needs no look at the walls; others have one (WallsNearEnds), and the walls of a file are made first.
//
// The walls of a kept maze as its judge looks them up (KeptCells): by bits of the file, read by code of verify/ and
// held against the world's hash, or by bits of its own. Some milliseconds or a second once, at 10^8 cells; then each
// look is free.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "parallel/once.hpp"
#include "planners/lengths/core_graph.hpp"
#include "planners/lengths/route_index.hpp"
#include "scenes/scene/scene.hpp"
#include "solve/question/question.hpp"
#include "solve/question/solve_options.hpp"
#include "verify/streamed/verify_cells.hpp"
#include "worlds/plane/maze_world.hpp"

namespace warren {

/// Immutable; any number of threads may look.
struct KeptCells {
  /// Looks for a wall on each side of the rim.
  KeptCells(std::unique_ptr<const LookedUpWalls> cells, std::size_t count);
  /// The walls around the cells that meet a box, unit by unit, and some of the rim: what a scene of them all says of
  /// motions in the box, this one does.
  Scene walls_in(const Box& box) const;

  std::unique_ptr<const LookedUpWalls> walls;  ///< as the judge sees them
  std::size_t wall_count;                      ///< of the world: not of units
 private:
  std::vector<Segment> rim_;  // a unit of each side: the reference point stays in the box of all walls
};

inline bool is_nothing_but_maze(const Scene& scene) {
  return scene.maze && !scene.bounds && scene.polygons.empty() && !scene.map && !has_solids(scene);
}
/// Of the words of a lattice, which must outlive it, where walls stand wherever it has no passage; `where` names them.
/// Throws InputError for a world of another hash, Stopped.
std::unique_ptr<KeptCells> cells_of_words(const std::string& where, MazeHint maze, std::span<const std::uint64_t> right,
                                          std::span<const std::uint64_t> up, const std::string& hash,
                                          const Execution& execution);
/// Of walls that are held. Nothing for worlds that hold more than a maze of units on its grid. Throws Stopped.
std::unique_ptr<KeptCells> cells_of_scene(const Scene& scene, const Execution& execution);

/// The world of a roadmap. Whoever asks a lattice in a file for a length needs none of its walls, and making those of
/// 10^8 cells takes a second and 1.6 GB: there they are made when a picture or an explanation first needs them. A judge
/// and ends off the lattice look them up one by one, where bits say them. Moves leave references to scenes valid only
/// where the whole was made later. Any number of threads may ask.
class KeptWorld {
 public:
  using Make = std::function<Scene(const Execution&)>;
  using LookUp = std::function<std::unique_ptr<KeptCells>(const Execution&)>;

  KeptWorld() = default;
  explicit KeptWorld(Scene whole) : outline_(std::move(whole)) {}
  /// `outline`: all but the walls; make() gives the whole, or throws what whole() shall.
  /// look_up: what looked_up() shall give, or nothing.
  KeptWorld(Scene outline, Make make, LookUp look_up = {})
      : outline_(std::move(outline)), later_(std::make_unique<Later>(std::move(make), std::move(look_up))) {}

  /// Name, maze, bounds, body and what else a world says in a few words; its walls may be missing.
  const Scene& outline() const { return outline_; }
  /// Throws InputError for a world that is not what its file promises, Stopped; the next call then tries again.
  const Scene& whole(const Execution& execution) const {
    if (later_ == nullptr) return outline_;
    return later_->whole.get(execution, [&] { return std::make_unique<Scene>(later_->make(execution)); });
  }
  /// The same, which nobody keeps: for what is seldom asked. Throws as whole() does.
  Scene copy_of_whole(const Execution& execution) const {
    return later_ == nullptr ? outline_ : later_->make(execution);
  }
  /// Can its walls be looked up without being made?
  bool is_looked_up() const { return later_ != nullptr && later_->look_up; }
  /// Its walls as they can be looked up without being made, which are all that there is; nullptr: they can't be. Throws
  /// as whole() does.
  const KeptCells* looked_up(const Execution& execution) const {
    if (!is_looked_up()) return nullptr;
    return &later_->cells.get(execution, [&] { return later_->look_up(execution); });
  }

 private:
  struct Later {
    Later(Make how, LookUp look) : make(std::move(how)), look_up(std::move(look)) {}
    Make make;
    LookUp look_up;
    MadeOnce<Scene> whole;
    MadeOnce<KeptCells> cells;
  };
  Scene outline_;
  std::unique_ptr<Later> later_;  // nullptr: the outline is the whole
};

// The walls near ends that are no milestones of a lattice. Where they can be looked up, that is all there is to it;
// else the first few such ends cost a pass over all walls each; from then on an index of them all is asked, which takes
// as long as some forty passes and 20 to 40 bytes a wall. Where the memory does not hold it, each end goes on costing a
// pass.

/// Cells each way that an end looks at: the 256 nearest lie within 10.
inline constexpr int widest_look = 11;

/// Refers to the world. Any number of threads may ask.
class WallsNearEnds {
 public:
  /// `reach`: what the body's reference point keeps from all walls.
  WallsNearEnds(const KeptWorld& world, double reach) : world_(world), reach_(reach) {}

  /// Calls look(const MazeWorld&) with a world that is the whole one for all motions within the widest look of p.
  /// Throws Stopped, InputError.
  template <class Look>
  void look(Vec2 p, const Execution& execution, const Look& look) const {
    if (const KeptCells* cells = world_.looked_up(execution); cells != nullptr) {
      return look(MazeWorld(cells->walls_in(room_of_motions(p)), reach_, execution));
    }
    const Scene& whole = world_.whole(execution);
    if (const auto* indexed = index(execution); indexed != nullptr && *indexed) return look(**indexed);
    look(MazeWorld(around(whole, p, execution), reach_, execution));
  }
  /// An end will be looked at: the index is made now, on the execution's threads, if its turn has come.
  void expect(const Execution& execution) const {
    if (world_.looked_up(execution) == nullptr) index(execution);
  }

 private:
  /// nullptr: its turn has not come; none: too large.
  const std::optional<MazeWorld>* index(const Execution& execution) const;
  Box room_of_motions(Vec2 p) const {
    Box near;
    near.include(p);
    return near.grown(widest_look + 1.0 + 2.0 * reach_);
  }
  Scene around(const Scene& whole, Vec2 p, const Execution& execution) const;

  const KeptWorld& world_;
  double reach_;
  MadeOnce<std::optional<MazeWorld>> indexed_;
};

/// where_it_pays ("auto"): of large lattices that are no open space; none: never.
enum class IndexChoice : std::uint8_t { where_it_pays, none };
constexpr auto enum_names(IndexChoice) { return std::array<std::string_view, 2>{"auto", "none"}; }

/// Lattices below are searched in less time than a person notices, and their roadmap is one that all can read.
inline constexpr std::uint64_t fewest_indexed_cells = 65'536;

// The walls of a maze in two bits a cell instead of 16 bytes a wall, where they are those that a maze has: unit walls
// in the course's order (scenes/mazes/maze_generator.hpp). Cells column by column, from the lowest row up; of cell i,
// bits 2 (i mod 32) and the next of word i / 32: its right wall stands, its upper one does.

/// Nothing where the scene's walls are others, or in another order. Throws Stopped.
std::optional<RawVector<std::uint64_t>> maze_bits(const Scene& scene, const Execution& execution);

/// What wall_passages() gives, three times as fast, where the scene is nothing but walls on its maze's grid inside
/// their outline and the reach leaves the middles of cells alone: a motion is free unless a wall stands across it, for
/// no other comes nearer than a half. Nothing elsewhere. Throws Stopped.
std::optional<LatticePassages> passages_of_maze(const Scene& scene, double reach, const Execution& execution);

/// Are the scene's walls, to the bit, those of a maze where a wall stands wherever the lattice has no passage? Throws
/// Stopped.
bool has_walls_of(const LatticePassages& lattice, const Scene& scene, const Execution& execution);

/// The walls of that maze. Throws Stopped.
WallSet walls_of_lattice(const LatticePassages& lattice, const Execution& execution);

/// The walls again, to the bit. Throws InputError naming `where` for another number of words, Stopped.
WallSet walls_of_maze_bits(const std::string& where, MazeHint maze, std::span<const std::uint64_t> bits,
                           const Execution& execution);

/// The index of a maze whose lattice is the roadmap, where that is to be had: nullptr for other worlds and options, for
/// small lattices, and where the index doesn't pay. Throws InputError, Stopped.
std::unique_ptr<RouteIndex> lattice_index(const Scene& scene, const Question& body, const SolveOptions& options,
                                          const Execution& execution);

}  // namespace warren

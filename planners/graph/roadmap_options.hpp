// SPDX-License-Identifier: BSD-3-Clause
// How roadmaps are built and searched, and how trees are grown: the options that planners share, as plain aggregates.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/enum_names.hpp"
#include "core/base/error.hpp"
#include "core/base/types.hpp"
#include "core/base/world.hpp"
#include "spatial/points/neighbours.hpp"

namespace warren {

/// What A* takes the way to the goal for, of points of the plane. Edges are as long as they are, so an estimate that
/// may be longer than the straight line loses the shortest path: by the Manhattan distance it may come out sqrt(2)
/// times as long, by the octile one 1.083 times. Such a search goes from the start alone and never looks at a settled
/// vertex again, as those do that are programmed so. Of dx and dy: euclidean: the straight line. manhattan: dx + dy.
/// octile: along axes and diagonals. chebyshev: the larger. zero: nothing, which makes A* Dijkstra's search.
enum class HeuristicKind : std::uint8_t { euclidean, manhattan, octile, chebyshev, zero };
constexpr auto enum_names(HeuristicKind) {
  return std::array<std::string_view, 5>{"euclidean", "manhattan", "octile", "chebyshev", "zero"};
}

/// Is it never more than the straight line?
constexpr bool never_overestimates(HeuristicKind kind) {
  return kind != HeuristicKind::manhattan && kind != HeuristicKind::octile;
}

/// The estimate between two states; of bodies that have more than a place the world's metric, whatever the kind.
template <World W>
double estimated_way(const W& world, HeuristicKind kind, const typename W::State& a, const typename W::State& b) {
  if constexpr (std::same_as<typename W::State, Vec2>) {
    const double dx = std::abs(a.x - b.x);
    const double dy = std::abs(a.y - b.y);
    if (kind == HeuristicKind::manhattan) return dx + dy;
    if (kind == HeuristicKind::octile) return std::max(dx, dy) + (std::numbers::sqrt2 - 1.0) * std::min(dx, dy);
    if (kind == HeuristicKind::chebyshev) return std::max(dx, dy);
    if (kind == HeuristicKind::zero) return 0.0;
  }
  return world.distance(a, b);
}

/// uniform: in the plane stratified, one sample drawn uniformly in each of as many equal boxes as there are samples,
/// which joins mazes with a quarter of the milestones that independent draws need (docs/performance.md); else
/// independent. lattice: the cell centres of a maze. halton: the Halton sequence, shifted by the seed. random:
/// independent uniform. gaussian, bridge, mixture: planners/roadmap/sampler.hpp. corridor: the middles of a map's
/// corridors, by the distance transform (worlds/rasters/corridor_points.hpp); where the world knows none, as random.
/// cell_centres: of a map (spatial/maps/free_cells.hpp), all at once; for worlds without cells as random.
enum class SamplerKind : std::uint8_t {
  uniform,
  lattice,
  halton,
  random,
  gaussian,
  bridge,
  mixture,
  corridor,
  cell_centres
};
constexpr auto enum_names(SamplerKind) {
  return std::array<std::string_view, 9>{"uniform", "lattice", "halton",   "random",      "gaussian",
                                         "bridge",  "mixture", "corridor", "cell-centres"};
}
/// Does this kind take all its places at once, so that there is no number of samples to choose?
constexpr bool takes_all_places(SamplerKind kind) {
  return kind == SamplerKind::lattice || kind == SamplerKind::cell_centres;
}
/// The rules of PRM* (Karaman, Frazzoli, Int. J. Robotics Research 30(7), 2011), by which the number of neighbours or
/// the radius follows the number of samples so that paths approach the shortest ones.
enum class StarRule : std::uint8_t { none, neighbours, radius };
/// How a graph is searched: by cost and estimate, by cost, by the number of edges, or depth first.
enum class SearchKind : std::uint8_t { astar, dijkstra, bfs, dfs };
constexpr auto enum_names(SearchKind) { return std::array<std::string_view, 4>{"astar", "dijkstra", "bfs", "dfs"}; }
/// Do the open vertices stand in a queue by cost, so that the path is the shortest?
constexpr bool has_queue(SearchKind search) { return search == SearchKind::astar || search == SearchKind::dijkstra; }
/// What holds the open vertices of astar and dijkstra; the path has the same length with each of them.
enum class QueueKind : std::uint8_t { heap, lazy_heap, sorted_array, resorted_array };
constexpr auto enum_names(QueueKind) {
  return std::array<std::string_view, 4>{"heap", "lazy-heap", "sorted-array", "resorted-array"};
}

/// Cell centres (1..cols) x (1..rows): what SamplerKind::lattice needs to know.
struct LatticeSize {
  std::uint32_t rows = 0;  ///< of cells; y of their centres is 1 .. rows
  std::uint32_t cols = 0;  ///< of cells; x of their centres is 1 .. cols
};

/// Start and goal are joined to all milestones within a radius to which their motion is free; while there is none, the
/// radius grows by a step, up to `tries` radii in all (after the study's query, which did this with the wrong metric).
struct GrowingAttach {
  std::optional<double> radius = {};  ///< the first, > 0; none: the rule's radius, or as far as its k nearest
  std::optional<double> step = {};    ///< > 0; none: half of the first radius
  std::uint32_t tries = 10;           ///< 1 .. 10,000
  friend bool operator==(const GrowingAttach&, const GrowingAttach&) = default;
};

inline constexpr std::uint64_t most_samples = std::uint64_t{1} << 31;  ///< of a roadmap, and nodes of a tree
inline constexpr std::uint32_t most_neighbours = 4096;                 ///< of a milestone

/// How a roadmap is made and searched. validate() refuses values outside the stated ranges with InputError.
struct RoadmapOptions {
  SamplerKind sampler = SamplerKind::uniform;    ///< where states are drawn
  LatticeSize lattice = {};                      ///< only for SamplerKind::lattice; both >= 1
  std::optional<std::uint64_t> samples = {};     ///< states drawn, 1 .. 2^31; none: grow until start and goal connect
  std::optional<std::uint32_t> neighbours = {};  ///< k of the k nearest, 1 .. 4096; none: by the sampler's rule
  std::optional<double> radius = {};      ///< longest edge, world units, > 0 (replaces neighbours); none: by rule
  StarRule star = StarRule::none;         ///< instead of neighbours and radius
  std::uint64_t seed = 1;                 ///< any value
  SearchKind search = SearchKind::astar;  ///< of the roadmap
  QueueKind queue = QueueKind::heap;      ///< of astar and dijkstra
  HeuristicKind heuristic = HeuristicKind::euclidean;          ///< of astar, for points of the plane
  NeighbourIndex neighbour_index = NeighbourIndex::by_counts;  ///< of the milestones
  /// How start and goal are joined; none: by the rule, and where that finds nothing to the nearest that will do.
  std::optional<GrowingAttach> attach = {};
  bool tells_separation = true;  ///< where there is no path: how far apart are the parts? Takes a pass over the roadmap

  /// Throws InputError for values outside their ranges.
  void validate() const {
    if (samples && (*samples < 1 || *samples > most_samples)) {
      throw InputError("samples", "must be from 1 to 2^31", std::to_string(*samples));
    }
    if (neighbours && (*neighbours < 1 || *neighbours > most_neighbours)) {
      throw InputError("neighbours", "must be from 1 to 4096", std::to_string(*neighbours));
    }
    if (radius && !(*radius > 0.0 && std::isfinite(*radius))) {
      throw InputError("radius", "must be a positive number", std::to_string(*radius));
    }
    if (attach) {
      const auto positive = [](const std::optional<double>& x) { return !x || (*x > 0.0 && std::isfinite(*x)); };
      if (!positive(attach->radius) || !positive(attach->step) || attach->tries < 1) {
        throw InputError("attach", "takes a positive radius and step, and one try or more");
      }
    }
    if (neighbours && radius) throw InputError("radius", "replaces the number of neighbours: give one of the two");
    if (star != StarRule::none && (neighbours || radius)) {
      throw InputError("neighbours", "follow from the samples by the rules of PRM*: give a number or the rule");
    }
    if (sampler == SamplerKind::lattice && (lattice.rows < 1 || lattice.cols < 1)) {
      throw InputError("lattice", "needs the rows and columns of the maze");
    }
  }
};

inline constexpr std::uint32_t most_trees = 4096;  ///< at once

/// How trees are grown by rrt and rrt_connect.
struct RrtOptions {
  /// Not lattice. None: uniform at first; a search that takes longer has narrow passages, so from then on every other
  /// sample is a gaussian one, near the obstacles.
  std::optional<SamplerKind> sampler = {};
  /// rrt_connect, where no sampler is asked for: first the way over the places that are free at one heading
  /// (planners/trees/rrt_connect.hpp). Off for ways that differ from seed to seed.
  bool places = true;
  std::optional<double> step = {};  ///< longest motion of a tree, in the world's metric, > 0; none: by world
  /// rrt_connect: a vertex that a motion from has failed is grown towards samples within so many steps alone, for of
  /// those farther away obstacles near to it take the most (dynamic domain: Yershova, Jaillet, Simeon, LaValle, ICRA
  /// 2005); a tree of less than half the other's states goes on; and from the 200th motion on a state is followed by
  /// one more towards its sample. >= 1; none: towards any sample, in turns, a state at once.
  std::optional<double> domain = {};
  /// rrt_connect of arms: a motion towards a sample moves so many joints on average, others each time, for one of all
  /// joints of a long arm is seldom free. > 0; none: all.
  std::optional<double> moving = {};
  double goal_bias = 0.05;  ///< share of the samples that are the goal, 0 .. 1; only for rrt
  /// A tree of so many gives up (rrt_connect: start's and goal's together), and after 64 times as many samples.
  std::uint64_t nodes = 100'000;  ///< 2 .. 2^31
  std::uint32_t trees = 1;        ///< grown independently at once, 1 .. 4096; the first to arrive answers
  std::uint64_t seed = 1;         ///< any value

  /// Throws InputError for values outside their ranges.
  void validate() const {
    if (sampler == SamplerKind::lattice) throw InputError("sampler", "lattice is for roadmaps of mazes, not for trees");
    if (step && !(*step > 0.0 && std::isfinite(*step))) {
      throw InputError("step", "must be a positive number", std::to_string(*step));
    }
    if (domain && !(*domain >= 1.0 && std::isfinite(*domain))) {
      throw InputError("domain", "must be a number from 1 on", std::to_string(*domain));
    }
    if (moving && !(*moving > 0.0)) throw InputError("moving", "must be a number above 0", std::to_string(*moving));
    if (!(goal_bias >= 0.0 && goal_bias <= 1.0)) {
      throw InputError("goal bias", "must be from 0 to 1", std::to_string(goal_bias));
    }
    if (nodes < 2 || nodes > most_samples) {
      throw InputError("nodes", "must be from 2 to 2^31", std::to_string(nodes));
    }
    if (trees < 1 || trees > most_trees) throw InputError("trees", "must be from 1 to 4096", std::to_string(trees));
  }
  /// Of a tree's index-th sample.
  SamplerKind sampler_of(std::uint64_t index) const {
    constexpr std::uint64_t first_gaussian = 512;
    const bool near = index >= first_gaussian && index % 2 != 0;
    return sampler.value_or(near ? SamplerKind::gaussian : SamplerKind::uniform);
  }
};

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
#include "solve/kinds/geometric_roadmaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/sort.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "solve/kinds/plane_steps.hpp"

namespace warren {
namespace {

constexpr std::size_t polled = std::size_t{1} << 14;
constexpr std::size_t most_corners_made_anew = 1000;

/// Known: VisibilityRoadmap or DiscRoadmap.
template <class Known>
RoadmapArrays arrays_of(const Known& known, const SolveRequest& request) {
  request.execution.reserve(known.graph.graph().targets().size() * sizeof(VertexId));
  const auto at = [&](VertexId v) { return known.graph.positions()[v]; };
  return free_arrays(at, known.graph.graph(), request.execution);
}

/// Doors, of which those of one cell are joined, but for the shut ones.
RoadmapArrays arrays_of(const CellRoadmap& known, const SolveRequest& request) {
  const auto& [cells, doors] = std::tie(known.cells.cells, known.cells.doors);
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i % polled == 0) request.execution.check();
    for (std::size_t a = 0; a < cells[i].doors.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const auto [from, to] = std::minmax(cells[i].doors[a], cells[i].doors[b]);
        if (to != no_number && !doors[from].shut && !doors[to].shut) edges.push_back({from, to});
      }
    }
  }
  polled_sort(edges.begin(), edges.end(), request.execution);
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  const auto at = [&](VertexId door) { return known.points.middle(door); };
  return free_arrays(at, assemble_graph(doors.size(), edges, request.execution), request.execution);
}

RoadmapArrays arrays_of(const AxisRoadmap& known, const SolveRequest& request) {
  const StraightLines lines =
      axis_lines(known, axis_clearance(voronoi_problem(request.scene, request.question)), request.execution);
  const auto at = [&](VertexId v) { return lines.points[v]; };
  return free_arrays(at, assemble_graph(lines.points.size(), lines.edges, request.execution), request.execution);
}

RoadmapArrays arrays_of(const SkeletonRoadmap& known, const SolveRequest& request) {
  const SkeletonLines lines = skeleton_lines(known, request.execution);
  const auto at = [&](VertexId v) { return cell_centre(*request.scene.map, lines.cells[v]); };
  return free_arrays(at, assemble_graph(lines.cells.size(), lines.edges, request.execution), request.execution);
}

/// Checks what solving checks before it plans, so that what can't be asked is not built.
template <class Known>
void check(const SolveRequest& request) {
  if constexpr (std::is_same_v<Known, AxisRoadmap>) {
    voronoi_problem(request.scene, request.question);
    check_axis_box(request.scene);
  } else if constexpr (std::is_same_v<Known, SkeletonRoadmap>) {
    map_problem(request.scene, request.question);
  } else {
    touching_problem(request);
  }
}

VisibilityEdges edges_of(const SolveRequest& request) {
  return request.options.visibility.full ? VisibilityEdges::full : VisibilityEdges::reduced;
}

template <class Known>
void make(std::optional<Known>& known, const SolveRequest& request) {
  check<Known>(request);
  const Execution& execution = request.execution;
  if constexpr (std::is_same_v<Known, SkeletonRoadmap>) {
    const double radius = map_problem(request.scene, request.question).reach() / request.scene.map->cell;
    known.emplace(request.scene.map->blocked, radius, execution);
  } else {
    PlaneObstacles obstacles = plane_obstacles(request.scene, execution);
    without_clashes(request, [&] {
      if constexpr (std::is_same_v<Known, VisibilityRoadmap>) {
        known.emplace(obstacles, edges_of(request), execution);
      } else if constexpr (std::is_same_v<Known, DiscRoadmap>) {
        known.emplace(obstacles, execution);
      } else {
        known.emplace(std::move(obstacles), execution);
      }
    });
  }
}

[[noreturn]] void refuse_arrays(const SolveRequest& request) {
  throw InputError(fmt::format("the roadmap of {}", request.scene.source),
                   fmt::format("is not the one that {} makes of its world; build it anew", name_of(request.planner)));
}

bool same(const RoadmapArrays& a, const RoadmapArrays& b) {
  return a.dimension == b.dimension && a.directed == b.directed && std::ranges::equal(a.states, b.states) &&
         std::ranges::equal(a.candidates.offsets(), b.candidates.offsets()) &&
         std::ranges::equal(a.candidates.targets(), b.candidates.targets()) &&
         std::ranges::equal(a.edge_states, b.edge_states);
}

template <class Known>
std::unique_ptr<RoadmapSession> open(const SolveRequest& request, const RoadmapArrays& arrays) {
  auto session = std::make_unique<GeometricSession<Known>>(arrays);
  make(session->known, request);
  if (!same(arrays, arrays_of(*session->known, request))) refuse_arrays(request);
  return session;
}

/// The file's edges; its states are the world's corners.
template <class Known>
std::unique_ptr<RoadmapSession> open_large_sight(const SolveRequest& request, const RoadmapArrays& arrays) {
  auto session = std::make_unique<GeometricSession<Known>>(arrays);
  check<Known>(request);
  const Execution& execution = request.execution;
  execution.reserve(arrays.candidates.targets().size() * sizeof(VertexId));
  const PlaneObstacles obstacles = plane_obstacles(request.scene, execution);
  if constexpr (std::is_same_v<Known, DiscRoadmap>) {
    session->known.emplace(obstacles, arrays.candidates, execution);
  } else {
    session->known.emplace(obstacles, edges_of(request), arrays.candidates, execution);
  }
  const auto at = [&](VertexId v) { return session->known->graph.positions()[v]; };
  if (session->known->graph.size() != arrays.candidates.vertex_count() ||
      !same(arrays, free_arrays(at, arrays.candidates, execution))) {
    refuse_arrays(request);
  }
  return session;
}

template <class Known>
std::unique_ptr<RoadmapSession> open_sight(const SolveRequest& request, const RoadmapArrays& arrays) {
  const bool large = arrays.candidates.vertex_count() > most_corners_made_anew;
  return large ? open_large_sight<Known>(request, arrays) : open<Known>(request, arrays);
}

/// Is the roadmap for what keeps a distance from its obstacles?
bool is_for_discs(const SolveRequest& request) { return touching_problem(request).reach() > 0.0; }

template <class Known>
RoadmapArrays built(const SolveRequest& request) {
  std::optional<Known> known;
  make(known, request);
  return arrays_of(*known, request);
}

}  // namespace

BuiltArrays build_geometric(const SolveRequest& request) {
  BuiltArrays all;
  if (request.planner == PlannerKind::visibility) {
    all.arrays = is_for_discs(request) ? built<DiscRoadmap>(request) : built<VisibilityRoadmap>(request);
  } else if (request.planner == PlannerKind::cells) {
    all.arrays = built<CellRoadmap>(request);
  } else if (request.scene.map) {
    all.arrays = built<SkeletonRoadmap>(request);
  } else {
    all.arrays = built<AxisRoadmap>(request);
  }
  return all;
}

std::unique_ptr<RoadmapSession> open_geometric(const SolveRequest& request, const RoadmapArrays& arrays,
                                               const ConnectionRule&) {
  const auto opened = [&]() -> std::unique_ptr<RoadmapSession> {
    if (request.planner == PlannerKind::cells) return open<CellRoadmap>(request, arrays);
    if (request.planner == PlannerKind::voronoi) {
      return request.scene.map ? open<SkeletonRoadmap>(request, arrays) : open<AxisRoadmap>(request, arrays);
    }
    return is_for_discs(request) ? open_sight<DiscRoadmap>(request, arrays)
                                 : open_sight<VisibilityRoadmap>(request, arrays);
  };
  std::unique_ptr<RoadmapSession> session = opened();
  if (request.many && !request.scene.map) session->judged.emplace(request.scene, request.execution);
  return session;
}

}  // namespace warren

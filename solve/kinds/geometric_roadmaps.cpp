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
    request.execution.poll(i);
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

/// edges: of what sees each other, where they are known.
template <class Known>
void make(std::optional<Known>& known, const SolveRequest& request, [[maybe_unused]] std::optional<Graph> edges = {}) {
  const Execution& execution = request.execution;
  if constexpr (std::is_same_v<Known, SkeletonRoadmap>) {
    const double radius = map_problem(request.scene, request.question).reach() / request.scene.map->cell;
    known.emplace(request.scene.map->blocked, radius, execution);
  } else {
    // What solving checks before it plans, so that what can't be asked is not built.
    if constexpr (std::is_same_v<Known, AxisRoadmap>) {
      voronoi_problem(request.scene, request.question);
      check_axis_box(request.scene, execution);
    } else {
      touching_problem(request);
    }
    PlaneObstacles obstacles = plane_obstacles(request.scene, execution);
    without_clashes(request, [&] {
      if constexpr (std::is_same_v<Known, VisibilityRoadmap>) {
        const bool full = request.options.visibility.full;
        known.emplace(obstacles, full ? VisibilityEdges::full : VisibilityEdges::reduced, execution, std::move(edges));
      } else if constexpr (std::is_same_v<Known, DiscRoadmap>) {
        known.emplace(obstacles, execution, std::move(edges));
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

/// Of many corners that see each other with the file's edges; its states are the world's corners.
template <class Known>
std::unique_ptr<RoadmapSession> open(const SolveRequest& request, const RoadmapArrays& arrays) {
  auto session = std::make_unique<GeometricSession<Known>>(arrays);
  constexpr bool has_corners = std::is_same_v<Known, VisibilityRoadmap> || std::is_same_v<Known, DiscRoadmap>;
  std::optional<Graph> edges;
  if (has_corners && arrays.candidates.vertex_count() > most_corners_made_anew) {
    request.execution.reserve(arrays.candidates.targets().size() * sizeof(VertexId));
    edges = arrays.candidates;
  }
  make(session->known, request, std::move(edges));
  if constexpr (has_corners) {
    if (session->known->graph.size() != arrays.candidates.vertex_count()) refuse_arrays(request);
  }
  if (!same(arrays, arrays_of(*session->known, request))) refuse_arrays(request);
  return session;
}

/// What `function` makes of the planner's roadmap; visibility has another one for what keeps a distance.
template <class Function>
auto by_planner(const SolveRequest& request, const Function& function) {
  if (request.planner == PlannerKind::cells) return function.template operator()<CellRoadmap>();
  if (request.planner == PlannerKind::voronoi) {
    return request.scene.map ? function.template operator()<SkeletonRoadmap>()
                             : function.template operator()<AxisRoadmap>();
  }
  return touching_problem(request).reach() > 0.0 ? function.template operator()<DiscRoadmap>()
                                                 : function.template operator()<VisibilityRoadmap>();
}

}  // namespace

BuiltArrays build_geometric(const SolveRequest& request) {
  BuiltArrays all;
  all.arrays = by_planner(request, [&]<class Known>() {
    std::optional<Known> known;
    make(known, request);
    return arrays_of(*known, request);
  });
  return all;
}

std::unique_ptr<RoadmapSession> open_geometric(const SolveRequest& request, const RoadmapArrays& arrays,
                                               const ConnectionRule&) {
  std::unique_ptr<RoadmapSession> session =
      by_planner(request, [&]<class Known>() { return open<Known>(request, arrays); });
  if (request.many && !request.scene.map) session->judged.emplace(request.scene, request.execution);
  return session;
}

}  // namespace warren

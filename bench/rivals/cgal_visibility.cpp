// SPDX-License-Identifier: BSD-3-Clause
// warren's visibility graph beside CGAL's visibility regions: disjoint polygons of a seed in their bounds; from every
// corner CGAL computes the region that it sees (triangular expansion and rotational sweep, exact constructions), whose
// vertices that are corners are the neighbours. One thread; the contestants take turns; the least CPU time of each
// counts, what each prepares once (arrangement, triangulation; index) included. All rows are compared outside of the
// clock. In general position: a region without needles leaves out what is seen past a corner that is grazed.
//   rival_cgal_visibility [POLYGONS [REPEATS]]
#include <CGAL/Arr_segment_traits_2.h>
#include <CGAL/Arrangement_2.h>
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Rotational_sweep_visibility_2.h>
#include <CGAL/Triangular_expansion_visibility_2.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <map>
#include <stdexcept>
#include <vector>

#include "bench/rivals/stopwatch.hpp"
#include "planners/visibility/visibility_graph.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "scenes/scene/polygon_generator.hpp"

namespace warren {
namespace {

using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Arrangement = CGAL::Arrangement_2<CGAL::Arr_segment_traits_2<Kernel>>;
using Expansion = CGAL::Triangular_expansion_visibility_2<Arrangement, CGAL::Tag_true>;
using Sweep = CGAL::Rotational_sweep_visibility_2<Arrangement, CGAL::Tag_true>;
using Rows = std::vector<std::vector<VertexId>>;

Kernel::Point_2 point(Vec2 p) { return {p.x, p.y}; }

PlaneObstacles world_of(std::uint64_t polygons) {
  PolygonOptions options;
  options.count = polygons;
  return plane_obstacles(polygon_scene(options, {}), {});
}

Rows rows_by_warren(const PlaneObstacles& world) {
  const Execution one_thread{.threads = 1};
  const VisibleCorners corners(world, one_thread);
  const VisibilityGraph visibility(corners, VisibilityEdges::full, one_thread);
  Rows rows(visibility.size());
  for (VertexId v = 0; v < rows.size(); ++v) {
    const auto row = visibility.graph().neighbours(v);
    rows[v].assign(row.begin(), row.end());
  }
  return rows;
}

/// Corners are numbered as warren numbers them: in the order in which the polygons have them.
template <class Visibility>
Rows rows_by_cgal(const PlaneObstacles& world) {
  std::vector<Kernel::Segment_2> sides;
  std::map<Kernel::Point_2, VertexId> number;
  for (std::size_t p = 0; p < world.polygons.size(); ++p) {
    const auto ring = world.polygons[p];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      number.emplace(point(ring[i]), static_cast<VertexId>(number.size()));
      sides.emplace_back(point(ring[i]), point(ring[(i + 1) % ring.size()]));
    }
  }
  const Box& b = world.bounds.value();
  const Vec2 frame[] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
  for (std::size_t i = 0; i < 4; ++i) sides.emplace_back(point(frame[i]), point(frame[(i + 1) % 4]));
  Arrangement plane;
  CGAL::insert_non_intersecting_curves(plane, sides.begin(), sides.end());
  const Visibility visibility(plane);
  Rows rows(number.size());
  for (auto e = plane.halfedges_begin(); e != plane.halfedges_end(); ++e) {
    const auto corner = number.find(e->target()->point());
    if (corner == number.end() || e->face()->number_of_inner_ccbs() != world.polygons.size()) continue;
    if (e->face()->is_unbounded()) continue;
    Arrangement region;
    visibility.compute_visibility(e->target()->point(), e, region);
    std::vector<VertexId>& row = rows[corner->second];
    for (auto v = region.vertices_begin(); v != region.vertices_end(); ++v) {
      const auto seen = number.find(v->point());
      if (seen != number.end() && seen != corner) row.push_back(seen->second);
    }
    std::sort(row.begin(), row.end());
  }
  return rows;
}

template <class Contestant>
void time(const char* name, const Rows& truth, double& best, const Contestant& contestant) {
  const Stopwatch watch;
  const Rows rows = contestant();
  best = std::min(best, watch.read().cpu_s);
  if (rows == truth) return;
  for (std::size_t v = 0; v < truth.size(); ++v) {
    if (rows[v] != truth[v])
      std::fprintf(stderr, "corner %zu: %zu and %zu neighbours\n", v, truth[v].size(), rows[v].size());
  }
  throw std::runtime_error(std::string(name) + " sees other corners");
}

void compare(std::uint64_t polygons, int repeats) {
  const PlaneObstacles world = world_of(polygons);
  const Rows truth = rows_by_warren(world);
  std::size_t ends = 0;
  for (const auto& row : truth) ends += row.size();
  constexpr double never = std::numeric_limits<double>::infinity();
  double warren_s = never;
  double expansion_s = never;
  double sweep_s = never;
  for (int i = 0; i < repeats; ++i) {
    time("warren", truth, warren_s, [&] { return rows_by_warren(world); });
    time("triangular expansion", truth, expansion_s, [&] { return rows_by_cgal<Expansion>(world); });
    time("rotational sweep", truth, sweep_s, [&] { return rows_by_cgal<Sweep>(world); });
  }
  std::printf("%6zu corners %8zu edges: warren %.3f ms, CGAL's expansion %.1f ms (%.0f), its sweep %.1f ms (%.0f)\n",
              truth.size(), ends / 2, 1e3 * warren_s, 1e3 * expansion_s, expansion_s / warren_s, 1e3 * sweep_s,
              sweep_s / warren_s);
}

}  // namespace
}  // namespace warren

int main(int argc, char** argv) {
  try {
    const int repeats = argc > 2 ? std::atoi(argv[2]) : 3;
    if (argc > 1) {
      warren::compare(std::strtoull(argv[1], nullptr, 10), repeats);
    } else {
      for (const std::uint64_t polygons : {7U, 30U, 100U}) warren::compare(polygons, repeats);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plane_planners.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "tools/answer_json.hpp"
#include "worlds/plane_obstacles.hpp"

namespace warren {
namespace {

constexpr OptionSpec specs[] = {
    {"--full", "", "visibility: all visible edges instead of those that shortest paths take"},
    {"--sampled-edges", "D",
     "visibility: test edges at points D apart instead of exactly, and say which edges are wrong"},
};

}  // namespace

std::span<const OptionSpec> plane_option_specs() { return specs; }

WallProblem touching_problem(const SolveRequest& request) {
  const std::string_view planner = name_of(request.planner);
  const WallProblem problem = wall_problem(request.scene, request.problem, Contact::allowed);
  if (problem.reach() > 0.0) {
    throw UsageError(fmt::format(
        "--planner: {} plans for a point, which may touch obstacles; a disc or a clearance of {} needs prm, lazy-prm "
        "or voronoi, or --clearance 0 and --robot point",
        planner, problem.reach()));
  }
  if (problem.contact == Contact::blocked) {
    throw UsageError(
        fmt::format("--contact: paths of {} may touch obstacles; prm, lazy-prm and voronoi keep off them", planner));
  }
  return problem;
}

void describe_plane_planner(Answer& answer, const SolveRequest& request, const WallProblem& problem,
                            const SearchChoice& search) {
  answer.problem = problem.general();
  answer.planner = name_of(request.planner);
  answer.search = name_of(search.search);
  answer.seed = search.seed;
  if (const auto queue = request.arguments.value("--queue")) answer.options.emplace_back("queue", json_string(*queue));
}

PlaneObstacles indexed_obstacles(const SolveRequest& request, Answer& answer) {
  const StageTimer timer(request.execution, "index", answer.seconds.index, request.scene.polygons.size());
  return plane_obstacles(request.scene, request.execution);
}

}  // namespace warren

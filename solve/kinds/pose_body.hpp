// SPDX-License-Identifier: BSD-3-Clause
// What turning polygons and cars have in common as bodies of SampledSolve: their states are poses (x, y, theta), and a
// goal X,Y without a heading is met in any: as the body started, and as poses_to_meet() has them. Roadmaps try those
// first that have at least half of the most room, the nearest to the start of them first, so that in the open nothing
// turns for nothing; then the others, the roomiest first.
#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "solve/kinds/plane_steps.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/kinds/sampled_solve.hpp"

namespace warren {

class PoseBody : public UsualBody<PoseProblem> {
 public:
  static constexpr bool judged_by_index = true;

  PoseBody(const SolveRequest& request, PoseProblem problem) : UsualBody(request, std::move(problem)) {}

  template <class World>
  std::vector<Se2> goals(const World& world) const {
    auto query = world.make_query();
    std::vector<Se2> poses =
        poses_to_meet(scene_, problem_, execution_, [&](const Se2& pose) { return world.is_free(pose, query); });
    if (!problem_.any_heading()) return poses;
    const Se2 as_started{problem_.goal[0], problem_.goal[1], wrapped_angle(problem_.start.theta)};
    if (std::ranges::find(poses, as_started) == poses.end()) poses.insert(poses.begin(), as_started);
    return poses;
  }
  static SamplerKind choose_sampler(const SolveOptions& options, const RoadmapOptions& roadmap) {
    if (options.sampler && takes_all_places(*options.sampler)) {
      throw UsageError(
          fmt::format("@sampler: {} is for points and discs in mazes and on maps; a turning body takes the others",
                      name_of(*options.sampler)));
    }
    return roadmap.sampler == SamplerKind::lattice ? SamplerKind::uniform : roadmap.sampler;
  }
  template <class World>
  std::vector<Se2> best_first(const World& world, const std::vector<Se2>& goals) const {
    if (goals.size() < 2) return goals;
    auto query = world.make_query();
    std::vector<std::pair<double, Se2>> by_room;
    for (const Se2& goal : goals) by_room.emplace_back(world.clearance(goal, largest_coordinate, query), goal);
    std::ranges::stable_sort(by_room, [](const auto& a, const auto& b) { return a.first > b.first; });
    const auto is_roomy = [enough = 0.5 * by_room.front().first](const auto& goal) { return goal.first >= enough; };
    const auto roomy = std::ranges::partition_point(by_room, is_roomy);
    std::stable_sort(by_room.begin(), roomy, [&](const auto& a, const auto& b) {
      return world.distance(problem_.start, a.second) < world.distance(problem_.start, b.second);
    });
    std::vector<Se2> sorted;
    for (const auto& [room, goal] : by_room) sorted.push_back(goal);
    return sorted;
  }
  template <class World>
  bool provably_apart(const World&, const std::vector<Se2>& goals) const {
    return std::ranges::all_of(goals, [&](const Se2& goal) {
      return warren::provably_apart(*scene_.map, problem_.robot, problem_.start, goal, execution_);
    });
  }
};

}  // namespace warren

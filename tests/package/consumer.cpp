// SPDX-License-Identifier: BSD-3-Clause
// Asks the installed library for a way around a wall, by two planners, and lets the judge see both; an impossible wish
// is an error that says what it is about.
#include <string>
#include <vector>
#include <warren/warren.hpp>

namespace {

bool is_a_way_round(const warren::Scene& scene, warren::PlannerKind planner) {
  const warren::Question question{.start = {2.0, 5.0}, .goal = {8.0, 5.0}, .clearance = 0.1};
  const warren::Answer answer = warren::solve(scene, question, {.planner = planner, .roadmap = {.samples = 500}});
  return answer.verified && answer.path.size() > 2 && warren::verify(scene, answer).verified;
}

bool is_refused(const warren::Scene& scene) try {
  warren::solve(scene, {.start = {2.0, 5.0}, .goal = {8.0, 5.0}, .clearance = -1.0});
  return false;
} catch (const warren::Error& error) {
  return std::string(error.what()).find("clearance") != std::string::npos;
}

}  // namespace

int main() {
  const std::vector<warren::Segment> walls = {{{5.0, 1.0}, {5.0, 9.0}}};
  warren::Scene scene;
  scene.walls = warren::WallSet::narrowest(walls);
  scene.bounds = warren::Box{{0.0, 0.0}, {10.0, 10.0}};
  const bool good = is_a_way_round(scene, warren::PlannerKind::prm) &&
                    is_a_way_round(scene, warren::PlannerKind::lazy_prm) && is_refused(scene);
  return good ? 0 : 1;
}

// SPDX-License-Identifier: BSD-3-Clause
#include "apps/studies/planner_contest.hpp"

#include <gtest/gtest.h>

#include <iterator>

#include "core/base/error.hpp"
#include "scenes/files/read_world_io.hpp"
#include "tests/paths.hpp"
#include "tests/seeds.hpp"
#include "worlds/rasters/lattice_polygons.hpp"

namespace warren::studies {
namespace {

std::string example(const char* name) { return test::source_dir() + "/examples/worlds/" + name; }

struct AskedWorld {
  std::string source;
  Question question = {};
};

/// A world of each kind, and the bodies that differ in what shortens their paths.
std::vector<AskedWorld> worlds() {
  const Question across{.robot = RobotSpec{}, .start = {0.5, 0.5}, .goal = {4.3, 0.5}};
  std::vector<AskedWorld> all{{"maze:6x6,loops=0.3"},       {test::source_dir() + "/tests/data/sparse.scene"},
                              {example("poly-easy.scene")}, {example("car-20.scene")},
                              {example("puma.scene")},      {example("flat.yaml"), across}};
  all.push_back(all.back());
  all.back().question.robot = robot_value("here", "polygon -0.1 -0.1 0.1 -0.1 0.1 0.1 -0.1 0.1");
  all.back().question.start.push_back(0.0);
  all.back().question.goal.push_back(0.0);
  return all;
}

bool same(const Answer& a, const Answer& b) {
  return a.outcome == b.outcome && a.length == b.length && a.path.size() == b.path.size() &&
         a.states.size() == b.states.size() && a.counters == b.counters;
}

/// Asks with four seeds; says whether any changed the answer. None where the planner does not take world or options.
std::optional<bool> changes(const Scene& scene, const PlannerContender& contender, bool* claimed) {
  try {
    const Answer first = solve_contender(scene, contender, 1, {});
    *claimed = depends_on_seed(first, contender.options, scene);
    for (std::uint64_t seed = 2; seed <= 4; ++seed) {
      if (!same(first, solve_contender(scene, contender, seed, {}))) return true;
    }
    return false;
  } catch (const UsageError&) {
    return std::nullopt;
  }
}

TEST(PlannerContest, NoSeedChangesWhatIsSaidToBeDeterministic) {
  int claims = 0;
  int changed = 0;
  const std::vector<AskedWorld> all = worlds();
  for (const std::uint64_t i : test::seeds(all.size(), 4, 0)) {
    const AskedWorld& world = all[i];
    Scene scene = read_world(world.source);
    if (scene.map) add_map_walls(scene, {});
    for (const PlannerKind planner : all_planners) {
      for (const bool optimise : {false, true}) {
        PlannerContender contender{
            .options = {.planner = planner, .optimise = optimise}, .question = world.question, .dealt = {}};
        if (planner == PlannerKind::grid && !scene.map) contender.options.grid = {.cell = 0.25, .angles = 8};
        SCOPED_TRACE(world.source + " " + std::string(name_of(planner)) + (optimise ? " optimise" : ""));
        bool claimed = true;
        const auto any = changes(scene, contender, &claimed);
        if (!any) continue;
        EXPECT_TRUE(claimed || !*any);
        claims += claimed ? 0 : 1;
        changed += *any ? 1 : 0;
      }
    }
  }
  const int fewest = test::asks_all() ? 12 : 4;
  EXPECT_GE(claims, fewest);
  EXPECT_GE(changed, fewest);
}

}  // namespace
}  // namespace warren::studies

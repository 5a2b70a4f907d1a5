// SPDX-License-Identifier: BSD-3-Clause
// Roadmap files whose checksums are right and whose contents nobody built: of cars that only drive forwards, cars that
// back up, bodies that turn, and arms. Each is refused by one sentence or answered by a path that a judge has verified.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "planners/graph/assemble_graph.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "planners/roadmap/build_roadmap.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/kept/roadmap_file_io.hpp"
#include "solve/kept/roadmap_query.hpp"
#include "solve/solve.hpp"
#include "tests/paths.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

struct ForgedCase {
  std::string name;
  std::string world;
};

std::vector<ForgedCase> forged_cases() {
  const std::string worlds = test::source_dir() + "/examples/worlds/";
  return {{"Dubins", worlds + "car-20.scene"},
          {"Reeds-Shepp", worlds + "parking-lot.scene"},
          {"turning", worlds + "poly-easy.scene"},
          {"arm", worlds + "puma.scene"}};
}

class ForgedRoadmap : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("warren_forged_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static Roadmap built(const ForgedCase& c, PlannerKind planner) {
    SolveOptions options{.planner = planner, .seed = 2};
    options.roadmap.samples = 120;
    return build(read_world(c.world), {}, options);
  }

  /// What reading and asking says: "refused: …", or the name of the outcome. A path is verified, or it is no answer.
  std::string fate_of(Roadmap& roadmap, const RoadmapSearchFields& how = {}) const {
    const std::string file = (folder_ / "forged.roadmap").string();
    write_roadmap(roadmap, file);
    try {
      const Roadmap read = read_roadmap(file);
      const Answer answer = RoadmapQuery(read).ask({}, {}, how, {.budget = std::chrono::seconds(20)});
      EXPECT_NE(answer.outcome, Outcome::stopped) << "it goes on and on";
      EXPECT_EQ(answer.verified, answer.outcome == Outcome::solved);
      return std::string(name_of(answer.outcome));
    } catch (const InputError& error) {
      const std::string text = error.what();
      EXPECT_EQ(text.find('\n'), std::string::npos);
      return "refused: " + text;
    }
  }

 private:
  std::filesystem::path folder_;
};

void set_all(RoadmapArrays& arrays, EdgeState state) {
  for (std::size_t end = 0; end < arrays.candidates.targets().size(); ++end) {
    set_edge_state(arrays.edge_states, end, state);
  }
  arrays.component = free_components(arrays.parts(), {});
}

/// The same states, joined by these edges.
void join(RoadmapArrays& arrays, const std::vector<Edge>& edges, EdgeState state) {
  const std::size_t n = arrays.candidates.vertex_count();
  RawVector<Edge> part(edges.begin(), edges.end());
  arrays.candidates = arrays.directed ? one_way_graph(n, EdgeParts{part}, {}) : assemble_graph(n, edges, {});
  arrays.edge_states.assign(edge_state_words(arrays.candidates.targets().size()), 0);
  set_all(arrays, state);
}

std::vector<Edge> random_edges(const RoadmapArrays& arrays, std::uint64_t seed, std::size_t count) {
  const std::size_t n = arrays.candidates.vertex_count();
  std::vector<Edge> edges;
  for (std::uint64_t i = 0; edges.size() < count; ++i) {
    const auto pick = [&](std::uint32_t axis) {
      return static_cast<VertexId>(uniform(seed, i, axis) * static_cast<double>(n));
    };
    const Edge e{pick(0), pick(1)};
    if (e.from == e.to) continue;
    edges.push_back(arrays.directed ? e : Edge{std::min(e.from, e.to), std::max(e.from, e.to)});
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

TEST_F(ForgedRoadmap, EdgesThatSayTheyAreFreeAreJudged) {
  std::size_t refused = 0;
  for (const ForgedCase& c : forged_cases()) {
    SCOPED_TRACE(c.name);
    Roadmap roadmap = built(c, PlannerKind::prm);
    set_all(roadmap.arrays, EdgeState::free);
    refused += fate_of(roadmap).starts_with("refused: ") ? 1U : 0U;
    for (const std::uint64_t seed : test::seeds(12, 3, 0)) {
      join(roadmap.arrays, random_edges(roadmap.arrays, seed, 700), EdgeState::free);
      refused += fate_of(roadmap).find("leads through an obstacle") != std::string::npos ? 1U : 0U;
      join(roadmap.arrays, random_edges(roadmap.arrays, seed, 300), EdgeState::blocked);
      EXPECT_EQ(fate_of(roadmap).find("refused"), std::string::npos);
    }
  }
  EXPECT_GT(refused, test::share(12));
}

TEST_F(ForgedRoadmap, UncheckedEdgesAreAskedAboutWhoeverDrewThem) {
  std::size_t solved = 0;
  for (const ForgedCase& c : forged_cases()) {
    for (const PlannerKind planner : {PlannerKind::prm, PlannerKind::lazy_prm}) {
      SCOPED_TRACE(c.name);
      Roadmap roadmap = built(c, planner);
      for (std::uint64_t seed = 0; seed < 4; ++seed) {
        join(roadmap.arrays, random_edges(roadmap.arrays, seed, 700), EdgeState::unchecked);
        const std::string fate = fate_of(roadmap);
        EXPECT_FALSE(fate.starts_with("refused")) << fate;
        solved += fate == "solved" ? 1U : 0U;
      }
    }
  }
  EXPECT_GT(solved, 4U);
}

TEST_F(ForgedRoadmap, StatesThatTheBodyCanNotHaveAreRefused) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const ForgedCase& c : forged_cases()) {
    for (const std::uint64_t index : test::seeds(8, 2, 0)) {
      const double value = std::array{std::nan(""), infinity, 1e300, -1e60, 1e59, 1e9, 999.0, 300.0}[index];
      for (const PlannerKind planner : {PlannerKind::prm, PlannerKind::lazy_prm}) {
        SCOPED_TRACE(c.name + " " + std::to_string(value));
        Roadmap roadmap = built(c, planner);
        const unsigned width = roadmap.arrays.dimension;
        for (unsigned axis = 0; axis < width; ++axis) {
          const double before = roadmap.arrays.states[std::size_t{width} * 17 + axis];
          roadmap.arrays.states[std::size_t{width} * 17 + axis] = value;
          EXPECT_TRUE(fate_of(roadmap).starts_with("refused: ")) << "axis " << axis;
          roadmap.arrays.states[std::size_t{width} * 17 + axis] = before;
        }
      }
    }
  }
}

/// States in range that nobody drew, on edges that say they are free.
TEST_F(ForgedRoadmap, StatesInRangeThatNobodyDrewAreJudged) {
  for (const ForgedCase& c : forged_cases()) {
    Roadmap roadmap = built(c, PlannerKind::prm);
    const unsigned width = roadmap.arrays.dimension;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      SCOPED_TRACE(c.name + " " + std::to_string(seed));
      Roadmap forged = built(c, seed % 2 == 0 ? PlannerKind::prm : PlannerKind::lazy_prm);
      for (std::size_t i = 0; i < forged.arrays.states.size(); ++i) {  // each number that of another state
        const auto v = static_cast<std::size_t>(uniform(seed, i, 0) * static_cast<double>(count_states(roadmap)));
        forged.arrays.states[i] = roadmap.arrays.states[v * width + i % width];
      }
      if (seed % 2 == 0) set_all(forged.arrays, EdgeState::free);
      const std::string fate = fate_of(forged);
      EXPECT_TRUE(fate == "solved" || fate == "not_connected" ||
                  fate.find("leads through an obstacle") != std::string::npos)
          << fate;
    }
  }
}

/// A file that names another body, planner or steering than its states have.
TEST_F(ForgedRoadmap, ABodyThatItsStatesAreNotForIsRefused) {
  const std::vector<std::function<void(Roadmap&)>> forgeries{
      [](Roadmap& r) { r.robot = RobotSpec{.kind = RobotKind::point}; },
      [](Roadmap& r) { r.arrays.directed = !r.arrays.directed; },
      [](Roadmap& r) { r.arrays.dimension = r.arrays.dimension == 6 ? 3 : 6; },
      [](Roadmap& r) { r.options.planner = PlannerKind::visibility; },
      [](Roadmap& r) { r.options.planner = PlannerKind::voronoi; },
      [](Roadmap& r) { r.options.cells.doors = DoorKind::funnel; },
      [](Roadmap& r) { r.options.visibility.full = true; },
      [](Roadmap& r) { r.options.roadmap.samples = 0; }};
  for (const ForgedCase& c : forged_cases()) {
    for (std::size_t i = 0; i < forgeries.size(); ++i) {
      SCOPED_TRACE(c.name + " " + std::to_string(i));
      Roadmap roadmap = built(c, PlannerKind::prm);
      forgeries[i](roadmap);
      EXPECT_TRUE(fate_of(roadmap).starts_with("refused: "));
    }
  }
}

/// A rule follows from the options: one that doesn't could keep a question busy for ever.
TEST_F(ForgedRoadmap, RulesThatNobodyMadeAreRefused) {
  const std::vector<ConnectionRule> rules{
      {1e60, 0},
      {0.0, 0},
      {0.0, 1'000'000'000},
      {1e-300, 0},
      {0.0, 10, GrowingAttach{.radius = 1e-300, .step = 1e-300, .tries = 1'000'000'000}},
      {0.0, 10, GrowingAttach{.radius = -1.0, .step = -1.0, .tries = 1'000'000'000}},
      {0.0, 10, GrowingAttach{.radius = 1e300, .step = 1e300, .tries = 1'000'000'000}}};
  for (const ForgedCase& c : forged_cases()) {
    for (std::size_t i = 0; i < rules.size(); ++i) {
      SCOPED_TRACE(c.name + " " + std::to_string(i));
      Roadmap roadmap = built(c, PlannerKind::prm);
      roadmap.rule = rules[i];
      EXPECT_TRUE(fate_of(roadmap).starts_with("refused: "));
    }
  }
}

}  // namespace
}  // namespace warren

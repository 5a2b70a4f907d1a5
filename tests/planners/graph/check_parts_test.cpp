// SPDX-License-Identifier: BSD-3-Clause
#include "planners/graph/roadmap_arrays.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "core/base/error.hpp"
#include "tests/planners/graph/owned_parts.hpp"
#include "tests/refusals.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

using test::OwnedParts;
using test::parts_of;

/// "" where all is sound.
std::string refusal(const RoadmapParts& parts, unsigned threads = 1) {
  return test::refusal<InputError>([&] { check_parts(parts, "a.roadmap", {.threads = threads}); });
}

/// Vertices 0 to 5; rows 0: 1 2, 1: 0 2, 2: 0 1 3, 3: 2 4, 4: 3. Free are 0-1, 1-3 and 3-4 by the sum of their numbers.
OwnedParts six(bool directed = false) { return parts_of(6, {{0, 1}, {0, 2}, {1, 2}, {2, 3}, {3, 4}}, directed); }

TEST(CheckParts, TakesWhatIsSound) {
  EXPECT_EQ(refusal(six().parts()), "");
  EXPECT_EQ(refusal(six(true).parts()), "");
  EXPECT_EQ(refusal(parts_of(0, {}, false).parts()), "");
  EXPECT_EQ(refusal(parts_of(3, {}, false).parts()), "");
  for (const std::uint64_t seed : test::seeds(20, 1, 0)) {
    for (const bool directed : {false, true}) {
      const OwnedParts owned = test::random_parts(seed, 17'000, 30'000, directed);
      for (const unsigned threads : {1U, 3U}) EXPECT_EQ(refusal(owned.parts(), threads), "") << seed;
    }
  }
}

struct Fault {
  void (*change)(OwnedParts& owned, RoadmapParts& parts);
  const char* said;
};

/// Each rule, where it is broken.
constexpr std::array faults{
    Fault{[](OwnedParts&, RoadmapParts& p) { p.dimension = 15; },
          "dimension: expected 2 to 14 numbers a state (found: 15)"},
    Fault{[](OwnedParts&, RoadmapParts& p) { p.dimension = 3; }, "states: expected 18 elements (found: 12)"},
    Fault{[](OwnedParts&, RoadmapParts& p) { p.first = {}; },
          "first: expected one element more than vertices (found: 0)"},
    Fault{[](OwnedParts&, RoadmapParts& p) { p.states = p.states.first(10); },
          "states: expected 12 elements (found: 10)"},
    Fault{[](OwnedParts&, RoadmapParts& p) { p.to = p.to.first(9); }, "to: expected 10 elements (found: 9)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.first.back() = 11; }, "to: expected 11 elements (found: 10)"},
    Fault{[](OwnedParts&, RoadmapParts& p) { p.edge_states = {}; }, "edge_states: expected 1 elements (found: 0)"},
    Fault{[](OwnedParts&, RoadmapParts& p) { p.component = p.component.first(5); },
          "component: expected 6 elements (found: 5)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.states[7] = std::numeric_limits<double>::infinity(); },
          "states[7]: expected a finite number of at most 1e60 (found: inf)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.states[11] = std::numeric_limits<double>::quiet_NaN(); },
          "states[11]: expected a finite number of at most 1e60 (found: nan)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.first[0] = 1; }, "first[0]: expected 0 (found: 1)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.first[2] = 1; }, "first[2]: expected no less than 2 (found: 1)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.first[3] = 4'000'000'000U; },
          "first[4]: expected no less than 4000000000 (found: 9)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.to[1] = 6; }, "to[1]: expected a vertex below 6 (found: 6)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.to[9] = no_vertex; }, "to[9]: expected a vertex below 6"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.to[4] = 7; }, "to[4]: expected a vertex below 6 (found: 7)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.to[9] = 4; },
          "to[9]: expected no edge from a vertex to itself (found: 4)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.to[0] = 0; },
          "to[0]: expected no edge from a vertex to itself (found: 0)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.to[6] = 2; },
          "to[6]: expected no edge from a vertex to itself (found: 2)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.to[0] = 2; },
          "to[1]: expected more than 2, the one before it in its row (found: 2)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { std::swap(o.to[4], o.to[5]); },
          "to[5]: expected more than 1, the one before it in its row (found: 0)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.edge_states[0] |= std::uint64_t{3} << 6U; },
          "edge_states of end 3: expected 0, 1 or 2 (found: 3)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.edge_states[0] |= std::uint64_t{1} << 20U; },
          "edge_states[0]: expected zeros behind the last end"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.edge_states[0] |= std::uint64_t{1} << 63U; },
          "edge_states[0]: expected zeros behind the last end"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.to[8] = 5; },
          "to[8]: the edge from 3 to 5: expected to stand in the other vertex's row, too (found: once)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.to[7] = 1; },
          "to[6]: the edge from 2 to 3: expected to stand in the other vertex's row, too (found: once)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.set(0, 2, EdgeState::unchecked); },
          "to[1]: the edge from 0 to 2: expected the same state at both ends (found: two)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.component[1] = 1; },
          "component[1]: expected the smallest vertex that free edges lead to, 0 (found: 1)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.component[5] = 0; },
          "component[5]: expected the smallest vertex that free edges lead to, 5 (found: 0)"},
    Fault{[](OwnedParts& o, RoadmapParts&) { o.component[5] = no_vertex; }, "component[5]: expected"},
};

TEST(CheckParts, NamesTheArrayAndTheElementThatBreakARule) {
  for (const Fault& fault : faults) {
    OwnedParts owned = six();
    RoadmapParts parts = owned.parts();
    fault.change(owned, parts);
    EXPECT_EQ(refusal(parts).substr(0, 11 + std::string(fault.said).size()), std::string("a.roadmap: ") + fault.said);
  }
}

/// A lower end without its twin, where all upper ends have theirs.
TEST(CheckParts, FindsTheEdgeThatLeadsDownAlone) {
  OwnedParts owned = parts_of(5, {{0, 1}, {1, 2}}, false);
  owned.to.push_back(0);
  owned.first[4] = owned.first[5] = 5;
  owned.label();
  EXPECT_EQ(refusal(owned.parts()),
            "a.roadmap: to[4]: the edge from 3 to 0: expected to stand in the other vertex's row, too (found: once)");
  owned.directed = true;
  EXPECT_EQ(refusal(owned.parts()), "");
}

TEST(CheckParts, JoinsDirectedEdgesInAnyDirection) {
  OwnedParts owned = parts_of(4, {{3, 1}, {1, 2}}, true);
  for (const auto& [v, w] : {std::pair{3U, 1U}, std::pair{1U, 2U}}) owned.set(v, w, EdgeState::free);
  owned.component = {0, 1, 1, 1};
  EXPECT_EQ(refusal(owned.parts()), "");
  owned.set(1, 2, EdgeState::blocked);
  EXPECT_NE(refusal(owned.parts()), "");
  owned.component[2] = 2;
  EXPECT_EQ(refusal(owned.parts()), "");
}

TEST(CheckParts, NamesTheSameElementForAnyNumberOfThreads) {
  const OwnedParts sound = test::random_parts(7, 100'000, 150'000, false);
  const auto said_by_all = [&](const OwnedParts& owned) {
    const std::string said = refusal(owned.parts());
    for (const std::uint64_t i : test::seeds(3, 1, 0))
      EXPECT_EQ(refusal(owned.parts(), std::array{2U, 3U, 8U}[i]), said);
    return said;
  };
  OwnedParts owned = sound;
  for (const std::size_t i : {199'999U, 70'001U, 150'000U}) owned.states[i] = -1e300;
  EXPECT_TRUE(said_by_all(owned).starts_with("a.roadmap: states[70001]: expected"));
  owned = sound;
  for (const VertexId v : {99'999U, 61'234U, 80'000U}) owned.component[v] += 1;
  EXPECT_TRUE(said_by_all(owned).starts_with("a.roadmap: component[61234]: expected"));
}

}  // namespace
}  // namespace warren

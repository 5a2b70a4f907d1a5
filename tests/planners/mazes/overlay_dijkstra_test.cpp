// SPDX-License-Identifier: BSD-3-Clause
// The oracle relaxes the edges of a random overlay until nothing changes.
#include "planners/mazes/overlay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include "core/base/rng.hpp"
#include "core/run/execution.hpp"

namespace warren {
namespace {

constexpr double unreached = std::numeric_limits<double>::infinity();

/// One tile whose chains are drawn at random, each key with at most four: any graph, not only a plane one.
struct StepCase {
  TileGrid grid = TileGrid::of({64, 64});
  std::vector<TileSummary> tiles{1};
  OverlayEnds ends;
};

StepCase random_case(std::uint64_t seed, std::uint32_t keys, std::uint32_t chains, std::uint32_t longest) {
  StepCase c;
  SequentialRng rng(seed);
  TileSummary& tile = c.tiles[0];
  if (keys > 4096) c.grid = TileGrid::of({256, 256}, 8);
  for (std::uint32_t k = 0; k < keys; ++k) tile.keys.push_back(static_cast<std::uint16_t>(k));
  std::vector<int> degree(keys, 0);
  for (std::uint32_t i = 0; i < chains; ++i) {
    const std::uint32_t near = 1 + rng.below(40);
    const std::uint32_t from = rng.below(keys);
    const std::uint32_t to = std::min(keys - 1, from + near);
    if (from == to || degree[from] == 4 || degree[to] == 4) continue;
    ++degree[from];
    ++degree[to];
    tile.chains.push_back({static_cast<std::uint16_t>(from), static_cast<std::uint16_t>(to), 0,
                           1 + static_cast<std::uint32_t>(rng.below(longest))});
  }
  std::sort(tile.chains.begin(), tile.chains.end(), [](const Chain& a, const Chain& b) { return a.from < b.from; });
  const auto link = [&](std::uint32_t key) {
    const std::uint32_t side = c.grid.side();
    return EndLink{key % side, key / side, static_cast<double>(rng.below(1000)) / 999.0};
  };
  for (std::uint32_t i = 0; i < 3; ++i) {
    c.ends.start.links.push_back(link(rng.below(keys / 4)));
    c.ends.goal.links.push_back(link(keys - 1 - rng.below(keys / 4)));
  }
  return c;
}

struct Link {
  VertexId from;
  VertexId to;
  double length;
};

std::vector<Link> links_of(const StepCase& c, const Overlay& overlay) {
  std::vector<Link> links;
  const auto both = [&](VertexId a, VertexId b, double length) {
    links.push_back({a, b, length});
    links.push_back({b, a, length});
  };
  for (const Chain& chain : c.tiles[0].chains) both(chain.from, chain.to, chain.length);
  const auto key = [&](const EndLink& link) { return link.row * c.grid.side() + link.col; };
  for (const EndLink& link : c.ends.start.links) both(overlay.start(), key(link), link.length);
  for (const EndLink& link : c.ends.goal.links) both(overlay.goal(), key(link), link.length);
  if (c.ends.direct) both(overlay.start(), overlay.goal(), distance(c.ends.start.at, c.ends.goal.at));
  return links;
}

double shortest_by_relaxing(const std::vector<Link>& links, const Overlay& overlay) {
  std::vector<double> length(overlay.vertex_count(), unreached);
  length[overlay.start()] = 0.0;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Link& link : links) {
      if (length[link.from] + link.length >= length[link.to]) continue;
      length[link.to] = length[link.from] + link.length;
      changed = true;
    }
  }
  return length[overlay.goal()];
}

/// Sum of the shortest edges between a path's vertices; infinity where two have none.
double length_along(std::span<const VertexId> path, const std::vector<Link>& links) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    double least = unreached;
    for (const Link& link : links) {
      if (link.from == path[i - 1] && link.to == path[i]) least = std::min(least, link.length);
    }
    sum += least;
  }
  return sum;
}

void expect_shortest(const StepCase& c) {
  Overlay overlay(c.grid, c.tiles, c.ends, {});
  overlay.peel({});
  const std::vector<Link> links = links_of(c, overlay);
  const double expected = shortest_by_relaxing(links, overlay);
  const SearchResult found = search_steps(overlay, c.ends, {});
  if (expected == unreached) {
    EXPECT_EQ(found.status, SearchStatus::exhausted);
    EXPECT_TRUE(found.path.empty());
    return;
  }
  ASSERT_EQ(found.status, SearchStatus::found);
  EXPECT_NEAR(found.length, expected, 1e-12 * expected);
  EXPECT_EQ(found.path.front(), overlay.start());
  EXPECT_EQ(found.path.back(), overlay.goal());
  EXPECT_NEAR(length_along(found.path, links), expected, 1e-12 * expected);
}

TEST(StepSearch, FindsAShortestPathWhateverTheLengths) {
  int connected = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::uint32_t keys = seed % 3 == 0 ? 8 : 300;
    const std::uint32_t longest = seed % 4 == 0 ? 1 : seed % 4 == 1 ? 9 : seed % 4 == 2 ? 700 : 60'000;
    const StepCase c = random_case(seed, keys, keys * (seed % 5 == 0 ? 1 : 3), longest);
    expect_shortest(c);
    Overlay overlay(c.grid, c.tiles, c.ends, {});
    connected += shortest_by_relaxing(links_of(c, overlay), overlay) < unreached ? 1 : 0;
  }
  EXPECT_GT(connected, 100);
  EXPECT_LT(connected, 200);
}

TEST(StepSearch, TakesTheDirectWayWhereItIsNoLonger) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    StepCase c = random_case(seed, 6, 8, 1);
    c.ends.direct = true;
    c.ends.goal.at = {0.05 * static_cast<double>(seed), 0.0};
    expect_shortest(c);
  }
}

TEST(StepSearch, TwoThreadsTakeTheStepsOfOne) {
  for (const std::uint32_t longest : {1U, 20U}) {
    const StepCase c = random_case(4 + longest, 65'000, 200'000, longest);
    Overlay overlay(c.grid, c.tiles, c.ends, {});
    overlay.peel({});
    Execution one;
    one.threads = 1;
    const SearchResult expected = search_steps(overlay, c.ends, one);
    ASSERT_EQ(expected.status, SearchStatus::found);
    EXPECT_GT(expected.expanded, 1'000U);
    Execution two;
    two.threads = 2;
    for (int i = 0; i < 10; ++i) {
      const SearchResult found = search_steps(overlay, c.ends, two);
      EXPECT_EQ(found.path, expected.path);
      EXPECT_EQ(found.length, expected.length);
      EXPECT_EQ(found.expanded, expected.expanded);
    }
  }
}

TEST(StepSearch, StopsAtTheDeadline) {
  const StepCase c = random_case(5, 3000, 9000, 20);
  const Overlay overlay(c.grid, c.tiles, c.ends, {});
  const Deadline ended(0.0);
  Execution execution;
  execution.deadline = &ended;
  EXPECT_THROW(search_steps(overlay, c.ends, execution), Stopped);
}

/// What ranks agree on: neither an entry of a key that is settled counts, nor how far a side has looked ahead.
TEST(StepSide, TheLeastIsThatOfOpenLabels) {
  StepCase c;
  for (std::uint16_t key = 0; key < 8; ++key) c.tiles[0].keys.push_back(key);
  c.tiles[0].chains.push_back({0, 1, 0, 5});
  c.ends.start.links.push_back({0, 0, 0.5});
  c.ends.goal.links.push_back({1, 0, 0.5});
  const Overlay overlay(c.grid, c.tiles, c.ends, {});
  const auto whole = static_cast<VertexId>(overlay.vertex_count());
  StepSide side(overlay, 60, {}, {0, whole});
  side.clear(0, whole);
  side.begin(5, 9.0);
  side.begin(5, 4.0);
  EXPECT_EQ(side.least(), 4.0);
  side.settle_at(4);
  EXPECT_EQ(side.least(), unreached) << "its entry at 9 is of a longer way";
  side.begin(6, 20.0);
  EXPECT_EQ(side.least(), 20.0);
  side.receive({7, 12.0});
  EXPECT_EQ(side.least(), 12.0) << "nearer than what was looked at";
}

}  // namespace
}  // namespace warren

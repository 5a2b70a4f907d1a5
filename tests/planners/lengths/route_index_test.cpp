// SPDX-License-Identifier: BSD-3-Clause
#include "planners/lengths/route_index.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "core/run/execution.hpp"
#include "tests/planners/lengths/lattice_mazes.hpp"
#include "tests/refusals.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

using Bytes = std::vector<std::byte>;

MazeOptions loopy(std::uint32_t side) {
  return {.rows = side, .cols = side + 30, .seed = 5, .algorithm = MazeAlgorithm::backtracker, .loops = 0.1};
}

std::map<std::string, Bytes> bytes_of(const RouteIndex& index) {
  std::map<std::string, Bytes> bytes;
  for (const RouteSection& s : route_sections(index))
    bytes[std::string(s.name)] = Bytes(s.bytes.begin(), s.bytes.end());
  return bytes;
}

TEST(RouteIndex, AllBytesAreTheSameForAnyNumberOfThreads) {
  for (const double loops : {0.0, 0.02, 0.1}) {
    MazeOptions maze = loopy(test::asks_all() ? 600 : 300);
    maze.loops = loops;
    const auto expected = bytes_of(RouteIndex(test::maze_passages(maze), {}, {.threads = 1}));
    for (const unsigned threads : {2U, 3U, 8U}) {
      const auto found = bytes_of(RouteIndex(test::maze_passages(maze), {}, {.threads = threads}));
      for (const auto& [name, bytes] : expected) {
        EXPECT_TRUE(found.at(name) == bytes) << name << " on " << threads << " threads, loops " << loops;
      }
    }
  }
}

TEST(RouteIndex, OpenSpaceIsRefusedByCountingJunctions) {
  const MazeOptions open{.rows = 20, .cols = 20, .seed = 1, .algorithm = MazeAlgorithm::kruskal, .loops = 1.0};
  const std::string said = test::refusal<InputError>([&] { RouteIndex(test::maze_passages(open), {}, {}); });
  EXPECT_NE(said.find("(found: 397 of 400)"), std::string::npos) << said;
  EXPECT_TRUE(route_index_pays(3, 10));
  EXPECT_FALSE(route_index_pays(31, 100));
}

TEST(RouteIndex, LeavesOutOfRangeAreRefused) {
  EXPECT_THROW(RouteIndexOptions{.leaf = most_leaf_junctions + 1}.validate(), InputError);
}

TEST(RouteIndex, ADeadlineStopsTheBuilding) {
  const Deadline over(0.0);
  EXPECT_THROW(RouteIndex(test::maze_passages(loopy(100)), {}, {.deadline = &over}), Stopped);
}

/// Sections with bytes of their own, aligned as a mapped file's are.
struct Copies {
  std::vector<std::vector<std::uint64_t>> words;
  std::vector<RouteSection> sections;
  explicit Copies(const RouteIndex& index) : sections(route_sections(index)) {
    for (RouteSection& s : sections) {
      words.emplace_back((s.bytes.size() + 7) / 8);
      if (!s.bytes.empty()) std::memcpy(words.back().data(), s.bytes.data(), s.bytes.size());
      s.bytes = std::as_bytes(std::span(words.back())).first(s.bytes.size());
    }
  }
  std::size_t number(std::string_view name) const {
    for (std::size_t i = 0; i < sections.size(); ++i) {
      if (sections[i].name == name) return i;
    }
    return sections.size();
  }
};

TEST(RouteSections, AnIndexOfViewsAnswersTheSame) {
  for (const double loops : {0.0, 0.1}) {
    MazeOptions maze = loopy(150);
    maze.loops = loops;
    const RouteIndex built(test::maze_passages(maze), {}, {});
    const Copies copies(built);
    const RouteIndex viewed = route_index_of({maze.rows, maze.cols}, copies.sections);
    EXPECT_EQ(bytes_of(viewed), bytes_of(built));
    RouteQuery expected(built);
    RouteQuery found(viewed);
    for (CellId a = 0; a < maze.rows * maze.cols; a += 373) {
      for (CellId b = 0; b < maze.rows * maze.cols; b += 911) {
        ASSERT_EQ(found.length(a, b), expected.length(a, b)) << a << ' ' << b;
      }
      EXPECT_EQ(found.path(a, 7), expected.path(a, 7));
    }
  }
}

/// Bytes that are wrong until somebody looks at their block of 64.
struct Unseen {
  explicit Unseen(RouteSection& section)
      : right(section.bytes.begin(), section.bytes.end()),
        words((right.size() + 7) / 8, ~std::uint64_t{0}),
        done(right.size() / 64 + 1) {
    const auto look = [](const void* owner, std::size_t block) { static_cast<const Unseen*>(owner)->show(block); };
    section.bytes = std::as_bytes(std::span(words)).first(right.size());
    section.first_look = {&done, 0, 64, this, look};
  }
  void show(std::size_t block) const {
    const std::size_t first = 64 * block;
    std::memcpy(reinterpret_cast<std::byte*>(words.data()) + first, right.data() + first,
                std::min<std::size_t>(64, right.size() - first));
    done.set(block);
  }
  Bytes right;
  mutable std::vector<std::uint64_t> words;
  mutable LastingMarks done;
};

TEST(RouteSections, NothingIsReadInPartsBeforeItWasLookedAt) {
  for (const double loops : {0.0, 0.02, 0.1}) {
    MazeOptions maze = loopy(200);
    maze.loops = loops;
    const RouteIndex built(test::maze_passages(maze), {}, {});
    std::vector<RouteSection> sections = route_sections(built);
    std::vector<std::unique_ptr<Unseen>> unseen;
    for (RouteSection& s : sections) {
      if (is_read_in_parts(s.name) && !s.bytes.empty()) unseen.push_back(std::make_unique<Unseen>(s));
    }
    EXPECT_GE(unseen.size(), 3U);
    const RouteIndex viewed = route_index_of({maze.rows, maze.cols}, sections);
    RouteQuery expected(built);
    RouteQuery found(viewed);
    for (std::uint64_t i = 0; i < 200; ++i) {
      const auto a = static_cast<CellId>(random_bits(1, i, 0) % (maze.rows * maze.cols));
      const auto b = static_cast<CellId>(random_bits(1, i, 1) % (maze.rows * maze.cols));
      ASSERT_EQ(found.length(a, b), expected.length(a, b)) << a << ' ' << b;
      ASSERT_EQ(found.path(a, b), expected.path(a, b)) << a << ' ' << b;
    }
  }
}

TEST(RouteSections, AMissingSectionIsNamed) {
  const RouteIndex built(test::maze_passages(loopy(70)), {}, {});
  for (const RouteSection& gone : route_sections(built)) {
    std::vector<RouteSection> rest;
    for (const RouteSection& s : route_sections(built)) {
      if (s.name != gone.name) rest.push_back(s);
    }
    const std::string said = test::refusal<InputError>([&] { route_index_of({70, 100}, rest); });
    EXPECT_NE(said.find(gone.name), std::string::npos) << gone.name << ' ' << said;
  }
}

/// Whoever makes a file may write anything beside a length: nobody walks in circles.
TEST(RouteSections, WaysThatLeadNowhereAreRefused) {
  const RouteIndex built(test::maze_passages(loopy(150)), {}, {});
  RouteQuery right(built);
  for (const std::uint16_t way : {0x0000, 0x0001, 0x0002, 0x0003, 0x1555, 0xfffe, 0xffff}) {
    Copies copies(built);
    const std::size_t number = copies.number("front.ways");
    const std::size_t bytes = copies.sections[number].bytes.size();
    for (std::size_t i = 0; i < bytes / sizeof(way); ++i) {
      std::memcpy(reinterpret_cast<std::byte*>(copies.words[number].data()) + i * sizeof(way), &way, sizeof(way));
    }
    const RouteIndex forged = route_index_of({150, 180}, copies.sections);
    RouteQuery query(forged);
    std::size_t refused = 0;
    for (CellId a = 0; a < 150 * 180; a += 997) {
      const CellId b = 150 * 180 - 1 - a;
      try {
        EXPECT_EQ(query.path(a, b).size(), right.path(a, b).size());
      } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find("route index"), std::string::npos) << error.what();
        ++refused;
      }
      EXPECT_EQ(query.length(a, b), right.length(a, b)) << "lengths look at no ways";
    }
    EXPECT_GT(refused, 10U) << way;
  }
}

/// Chains whose marks are gone, or go on everywhere.
TEST(RouteSections, ChainsThatLeadElsewhereAreRefused) {
  const RouteIndex built(test::maze_passages(loopy(150)), {}, {});
  for (const bool on : {false, true}) {
    Copies copies(built);
    std::vector<std::uint64_t>& marks = copies.words[copies.number("marks")];
    for (std::size_t row = 0; row < marks.size(); row += mark_word::count) {
      const std::uint64_t core = marks[row + mark_word::core];
      for (const std::size_t word : {mark_word::low, mark_word::high}) {
        marks[row + word] = on ? marks[row + word] | core : marks[row + word] & ~core;
      }
    }
    const RouteIndex forged = route_index_of({150, 180}, copies.sections);
    RouteQuery query(forged);
    std::size_t refused = 0;
    for (CellId a = 0; a < 150 * 180; a += 997) {
      refused += test::refusal<InputError>([&] { query.path(a, 150 * 180 - 1 - a); }).empty() ? 0 : 1;
    }
    EXPECT_GT(refused, 20U) << on;
  }
}

/// Any number in any array may be wrong: it is refused, or answers are wrong and nothing else is.
TEST(RouteSections, WrongNumbersAreRefusedOrHarmless) {
  const RouteIndex built(test::maze_passages(loopy(70)), {}, {});
  std::size_t refused = 0;  // where all was checked
  std::size_t taken = 0;
  std::size_t found_wrong = 0;  // by questions alone
  for (std::size_t section = 0; section < route_sections(built).size(); ++section) {
    for (const std::uint64_t i : test::seeds(60, 15, 0)) {
      Copies copies(built);
      if (copies.words[section].empty()) continue;
      std::uint64_t& word = copies.words[section][random_bits(section, i, 0) % copies.words[section].size()];
      word ^= std::uint64_t{1} << random_bits(section, i, 1) % 64;
      for (const bool checked : {false, true}) {
        try {
          const RouteIndex index = route_index_of({70, 100}, copies.sections);
          if (checked) check_route_arrays(index.places(), index.arrays());
          RouteQuery query(index);
          for (CellId a = 0; a < 7000; a += 71) query.path(a, (a * 31) % 7000);
          taken += checked ? 1 : 0;
        } catch (const InputError& error) {
          ASSERT_EQ(std::string(error.what()).find("cell:"), std::string::npos);
          ++(checked ? refused : found_wrong);
        }
      }
    }
  }
  EXPECT_GT(refused, found_wrong) << "a check of everything finds more than questions do";
  EXPECT_GT(found_wrong, test::share(50));
  EXPECT_GT(taken, test::share(100));
}

}  // namespace
}  // namespace warren

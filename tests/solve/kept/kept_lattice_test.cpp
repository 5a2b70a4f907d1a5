// SPDX-License-Identifier: BSD-3-Clause
// Lattices in files: asked without their walls, whose walls are those of the world, and whose lengths are those of a
// breadth-first search.
#include <gtest/gtest.h>

#include <unistd.h>

#include <array>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/files/read_world_io.hpp"
#include "solve/kept/roadmap_file.hpp"
#include "solve/kept/roadmap_file_io.hpp"
#include "solve/kept/roadmap_query.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

/// A roadmap's file, which goes with it.
class KeptFile : NotCopied {
 public:
  explicit KeptFile(const Roadmap& roadmap)
      : path_((std::filesystem::temp_directory_path() / ("warren_lattice_" + std::to_string(::getpid()))).string()) {
    write_roadmap(roadmap, path_);
  }
  ~KeptFile() { std::filesystem::remove(path_); }
  const std::string& path() const { return path_; }
  std::string bytes() const {
    std::ifstream in(path_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

 private:
  std::string path_;
};

TEST(KeptLattice, IsReadBackFromItsFileWithTheSameBytes) {
  const Roadmap roadmap = build(read_world("maze:256x260,loops=0.05"));
  const KeptFile file(roadmap);
  const Roadmap read = read_roadmap(file.path());
  ASSERT_NE(read.lattice, nullptr);
  const Answer answer = RoadmapQuery(read).ask({}, {});
  EXPECT_TRUE(answer.verified);
  EXPECT_EQ(answer.path, RoadmapQuery(roadmap).ask({}, {}).path);
  const std::string bytes = file.bytes();
  EXPECT_TRUE(bytes == KeptFile(read).bytes());
}

TEST(KeptLattice, AFileHasNoWallsWhereItsPassagesSayThem) {
  Scene scene = read_world("maze:250x271,loops=0.05");
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) walls.push_back(scene.walls.segment(i));
  {
    const KeptFile file(build(scene));
    const RoadmapFile sections(file.path(), {});
    EXPECT_EQ(sections.find("maze.walls"), nullptr);
    EXPECT_EQ(sections.find("world.walls"), nullptr);
    const Roadmap read = read_roadmap(file.path());
    EXPECT_EQ(read.world.outline().walls.size(), 0U);
    const WallSet& again = read.world.whole({}).walls;
    ASSERT_EQ(again.size(), walls.size());
    for (std::size_t i = 0; i < walls.size(); ++i) ASSERT_EQ(again.segment(i), walls[i]) << i;
  }
  std::swap(walls[100], walls[101]);  // another order is another world
  scene.walls = WallSet::narrowest(walls);
  const KeptFile file(build(scene));
  EXPECT_NE(RoadmapFile(file.path(), {}).find("world.walls"), nullptr);
  EXPECT_EQ(read_roadmap(file.path()).world.whole({}).walls.segment(100), walls[100]);
}

TEST(KeptLattice, LengthsNeedNoWallsAndPathsRefuseAWorldThatIsAnother) {
  Roadmap roadmap = build(read_world("maze:256x256"));
  roadmap.world_hash = "0123456789abcdef";
  const KeptFile file(roadmap);
  const Roadmap read = read_roadmap(file.path());
  const RoadmapQuery query(read);
  QuestionScratch scratch;
  EXPECT_EQ(query.length_within({3, 4}, {200, 100}, {}, {}, scratch).outcome, Outcome::solved);
  for (const bool on_lattice : {true, false}) {
    EXPECT_THROW(query.ask({3, on_lattice ? 4.0 : 4.2}, {200, 100}), InputError);
    EXPECT_THROW(query.length_within({3, 4.2}, {200, 100}, {}, {}, scratch), InputError);
  }
}

TEST(KeptLattice, BitsOfAFileAnswerAsWallsThatAreHeldDo) {
  for (const char* maze : {"maze:256x260,loops=0.05", "maze:300x230,algorithm=kruskal,seed=4"}) {
    const Roadmap held = build(read_world(maze));
    const KeptFile file(held);
    const Roadmap read = read_roadmap(file.path());
    ASSERT_NE(read.world.looked_up({}), nullptr);
    ASSERT_EQ(held.world.looked_up({}), nullptr);
    const RoadmapQuery by_pass(held, Execution{}, Questions::one);
    const RoadmapQuery by_own_bits(held, Execution{}, Questions::many);
    const RoadmapQuery by_file(read, Execution{}, Questions::one);
    std::mt19937_64 random(7);
    const auto place = [&](double step) {  // beside the maze and on its walls, too
      const auto number = [&] {
        return step * static_cast<double>(random() % static_cast<std::uint64_t>(262.0 / step));
      };
      return std::vector<double>{number(), number()};
    };
    const std::vector<std::uint64_t> asked = test::seeds(60, 6, 0);
    for (unsigned i = 0; i < 60; ++i) {
      SCOPED_TRACE(i);
      const double step = i % 3 == 0 ? 1.0 : i % 3 == 1 ? 0.5 : 0.37;
      const std::vector<double> start = place(step);
      const std::vector<double> goal = place(step);
      if (std::find(asked.begin(), asked.end(), i) == asked.end()) continue;
      const RoadmapSearchFields how{.optimise = i % 10 == 0};
      const Answer expected = by_pass.ask(start, goal, how);
      for (const RoadmapQuery* query : {&by_own_bits, &by_file}) {
        const Answer found = query->ask(start, goal, how);
        EXPECT_EQ(found.outcome, expected.outcome);
        EXPECT_EQ(found.path, expected.path);
        EXPECT_EQ(found.length, expected.length);
        EXPECT_EQ(found.min_clearance, expected.min_clearance);
        EXPECT_EQ(found.world.walls, expected.world.walls);
        EXPECT_EQ(found.world.hash, expected.world.hash);
        EXPECT_EQ(found.world.kind, expected.world.kind);
      }
    }
  }
}

TEST(KeptLattice, ABlockedEndIsExplainedWithoutMakingAllWalls) {
  const std::string maze = "maze:256x260,loops=0.05";
  const Roadmap held = build(read_world(maze), {.robot = RobotSpec{.kind = RobotKind::disc, .radius = 0.15}});
  const KeptFile file(held);
  Roadmap read = read_roadmap(file.path());
  const Scene outline = read.world.outline();
  read.world = KeptWorld(
      outline, [](const Execution&) -> Scene { throw std::logic_error("all walls are made"); },
      [&](const Execution& execution) {
        return cells_of_words(read.file->name(), *outline.maze,
                              read.file->section<std::uint64_t>("passages.right", execution),
                              read.file->section<std::uint64_t>("passages.up", execution), read.world_hash, execution);
      });
  const RoadmapQuery by_walls(held);
  const RoadmapQuery by_bits(read, Execution{}, Questions::many);
  const std::vector<std::vector<double>> places{{7.3, 8.45},  {0.6, 100.2}, {20.5, 30.5}, {99.55, 3.1}, {-4, 7},
                                                {100, 258.5}, {300, 300},   {258, 12.2},  {258, 259},   {12.5, 260.45}};
  std::size_t blocked = 0;
  for (const std::uint64_t index : test::seeds(places.size(), 4, 0)) {
    const std::vector<double>& place = places[index];
    SCOPED_TRACE(std::to_string(place[0]) + " " + std::to_string(place[1]));
    for (const bool is_start : {true, false}) {
      const std::vector<double> other{5, 5};
      const Answer expected = by_walls.ask(is_start ? place : other, is_start ? other : place, {});
      const Answer found = by_bits.ask(is_start ? place : other, is_start ? other : place, {});
      ASSERT_EQ(found.outcome, expected.outcome);
      EXPECT_EQ(found.blocked.has_value(), is_blocked(found.outcome)) << "ask() tells it, as solve() does";
      ASSERT_EQ(found.blocked.has_value(), expected.blocked.has_value());
      if (!found.blocked) continue;
      ++blocked;
      EXPECT_EQ(found.blocked->is_start, is_start);
      EXPECT_EQ(found.blocked->by.substr(0, 4), expected.blocked->by.substr(0, 4));
      EXPECT_EQ(found.blocked->room, expected.blocked->room);
      EXPECT_EQ(found.blocked->needed, expected.blocked->needed);
      EXPECT_EQ(found.blocked->hint, expected.blocked->hint);
      EXPECT_EQ(found.blocked->depth.has_value(), expected.blocked->depth.has_value());
      ASSERT_EQ(found.blocked->free_place.size(), 2U);
      EXPECT_LT(found.blocked->distance, expected.blocked->distance + 1.0);
      EXPECT_EQ(by_walls.ask(found.blocked->free_place, found.blocked->free_place, {}).outcome, Outcome::solved);
    }
  }
  EXPECT_GT(blocked, test::share(10));
}

/// What is done beside the judge takes longer than all before it, and it comes first on one thread: counted as the
/// judge's it would be there twice.
TEST(KeptLattice, WhatIsDoneBesideTheJudgeIsNotTakenForVerification) {
  using Clock = std::chrono::steady_clock;
  const KeptFile file(build(read_world("maze:256x260")));
  const Roadmap read = read_roadmap(file.path());
  const RoadmapQuery query(read);
  double beside_s = 0.0;
  Clock::time_point asked;
  QuestionScratch scratch;
  scratch.beside_judge = [&](const Answer&) {
    const Clock::time_point begin = Clock::now();
    while (Clock::now() - begin <= 2 * (begin - asked)) {
    }
    beside_s = std::chrono::duration<double>(Clock::now() - begin).count();
  };
  asked = Clock::now();
  const Answer answer = query.ask_within({1, 1}, {260, 256}, {}, {.threads = 1}, scratch);
  ASSERT_TRUE(answer.verified);
  EXPECT_GT(beside_s, 0.0);
  EXPECT_LE(answer.seconds.verify + beside_s, answer.solve_s);
}

/// The oracle: a breadth-first search of the cells between the maze's walls as they stand in the world.
class MazeFlood {
 public:
  explicit MazeFlood(const Scene& scene) : rows_(scene.maze->rows), cols_(scene.maze->cols) {
    open_.assign(rows_ * cols_, 15);
    for (std::size_t i = 0; i < scene.walls.size(); ++i) close(scene.walls.segment(i));
  }
  /// Steps from a cell, columns and rows from 1, to all cells; -1: none lead there.
  std::vector<int> steps_from(std::size_t col, std::size_t row) const {
    std::vector<int> steps(rows_ * cols_, -1);
    std::vector<std::size_t> queue{number(col, row)};
    steps[queue[0]] = 0;
    const std::size_t next[] = {1, cols_, ~std::size_t{0}, ~cols_ + 1};
    for (std::size_t i = 0; i < queue.size(); ++i) {
      for (unsigned d = 0; d < 4; ++d) {
        if ((open_[queue[i]] >> d & 1U) == 0) continue;
        const std::size_t to = queue[i] + next[d];
        if (steps[to] != -1) continue;
        steps[to] = steps[queue[i]] + 1;
        queue.push_back(to);
      }
    }
    return steps;
  }
  std::size_t number(std::size_t col, std::size_t row) const { return (row - 1) * cols_ + col - 1; }

 private:
  void close_side(double x, double y, unsigned direction) {
    if (x < 1 || y < 1 || x > static_cast<double>(cols_) || y > static_cast<double>(rows_)) return;
    open_[number(static_cast<std::size_t>(x), static_cast<std::size_t>(y))] &= ~(1U << direction);
  }
  void close(const Segment& wall) {
    for (double y = wall.a.y + 0.5; y < wall.b.y; ++y) {
      close_side(wall.a.x - 0.5, y, 0);
      close_side(wall.a.x + 0.5, y, 2);
    }
    for (double x = wall.a.x + 0.5; x < wall.b.x; ++x) {
      close_side(x, wall.a.y - 0.5, 1);
      close_side(x, wall.a.y + 0.5, 3);
    }
    open_[number(1, 1)] &= ~4U;  // the outline's openings lead out of the maze
    open_[number(cols_, rows_)] &= ~1U;
  }
  std::size_t rows_;
  std::size_t cols_;
  std::vector<unsigned> open_;
};

TEST(KeptLattice, LengthsFromAFileAreThoseOfABreadthFirstSearch) {
  std::mt19937 random(11);
  const auto any = [&](std::uint32_t most) { return 1 + random() % most; };
  std::size_t pairs = 0;
  const std::vector<std::uint64_t> kinds = test::seeds(9, 3, 0);
  for (const std::uint64_t kind : kinds) {
    const char* algorithm = std::array{"backtracker", "kruskal", "wilson"}[kind / 3];
    const char* loops = std::array{"0", "0.01", "0.1"}[kind % 3];
    const std::string source = std::string("maze:250x271,seed=7,algorithm=") + algorithm + ",loops=" + loops;
    SCOPED_TRACE(source);
    const MazeFlood flood(read_world(source));
    const KeptFile file(build(read_world(source)));
    const Roadmap read = read_roadmap(file.path());
    const RoadmapQuery query(read);
    QuestionScratch scratch;
    for (int start = 0; start < 6; ++start) {
      const std::size_t col = any(271);
      const std::size_t row = any(250);
      const std::vector<int> steps = flood.steps_from(col, row);
      for (int goal = 0; goal < 20; ++goal, ++pairs) {
        const std::size_t to_col = any(271);
        const std::size_t to_row = any(250);
        const LengthAnswer answer =
            query.length_within({static_cast<double>(col), static_cast<double>(row)},
                                {static_cast<double>(to_col), static_cast<double>(to_row)}, {}, {}, scratch);
        ASSERT_EQ(answer.outcome, Outcome::solved);
        ASSERT_EQ(answer.length, steps[flood.number(to_col, to_row)])
            << col << ',' << row << " to " << to_col << ',' << to_row;
      }
    }
  }
  EXPECT_EQ(pairs, 120 * kinds.size());
}

}  // namespace
}  // namespace warren

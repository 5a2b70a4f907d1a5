// SPDX-License-Identifier: BSD-3-Clause
// The oracle is the judge that passes over all walls.
#include "verify/streamed/verify_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

/// The words of a roadmap's file for the maze, as docs/file_formats.md has them.
struct FileWords {
  std::vector<std::uint64_t> right, up;
  explicit FileWords(const MazeCells& cells) {
    const std::size_t stride = (cells.cols() + 63) / 64;
    right.assign(stride * cells.rows(), 0);
    up = right;
    for (std::uint32_t row = 0; row < cells.rows(); ++row) {
      for (std::uint32_t col = 0; col < cells.cols(); ++col) {
        const std::uint64_t bit = std::uint64_t{1} << col % 64;
        if (col + 1 < cells.cols() && !cells.wall_right(col, row)) right[row * stride + col / 64] |= bit;
        if (row + 1 < cells.rows() && !cells.wall_above(col, row)) up[row * stride + col / 64] |= bit;
      }
    }
  }
};

/// One maze as three judges see it.
struct LookedUpMaze {
  explicit LookedUpMaze(const MazeOptions& maze)
      : cells(generate_maze(maze, {})),
        scene(maze_scene(maze, false, {})),
        words(cells),
        passages("test", maze.rows, maze.cols, words.right, words.up),
        lines(scene.walls, maze.rows, maze.cols, {}) {}
  MazeCells cells;
  Scene scene;
  FileWords words;
  JudgedPassages passages;
  JudgedGridLines lines;

  void expect_same(const std::vector<Vec2>& path, const VerifyOptions& options) const {
    const Verification expected = verify_path(scene, path, options, {});
    for (const LookedUpWalls* walls :
         {static_cast<const LookedUpWalls*>(&passages), static_cast<const LookedUpWalls*>(&lines)}) {
      const Verification found = verify_steps(*walls, path, options, {.threads = 2});
      EXPECT_EQ(found.verified, expected.verified);
      EXPECT_EQ(std::bit_cast<std::uint64_t>(found.length), std::bit_cast<std::uint64_t>(expected.length));
      EXPECT_EQ(std::bit_cast<std::uint64_t>(found.min_clearance), std::bit_cast<std::uint64_t>(expected.min_clearance))
          << found.min_clearance << " and " << expected.min_clearance;
      ASSERT_EQ(found.first_violation.has_value(), expected.first_violation.has_value());
      if (!found.first_violation) continue;
      EXPECT_EQ(found.first_violation->leg, expected.first_violation->leg);
    }
  }

  /// Steps at random that no wall blocks; turns back as seldom as it can, so that it gets far.
  std::vector<Vec2> walk(std::uint64_t seed, std::size_t steps) const {
    SequentialRng rng(seed);
    auto col = static_cast<std::uint32_t>(rng.below(cells.cols()));
    auto row = static_cast<std::uint32_t>(rng.below(cells.rows()));
    std::vector<Vec2> path{{col + 1.0, row + 1.0}};
    for (std::size_t i = 0; i < 8 * steps && path.size() <= steps; ++i) {
      const std::uint64_t d = rng.below(4);
      const bool closed = d == 0   ? col + 1 == cells.cols() || cells.wall_right(col, row)
                          : d == 1 ? row + 1 == cells.rows() || cells.wall_above(col, row)
                          : d == 2 ? col == 0 || cells.wall_right(col - 1, row)
                                   : row == 0 || cells.wall_above(col, row - 1);
      if (closed) continue;
      col = d == 0 ? col + 1 : d == 2 ? col - 1 : col;
      row = d == 1 ? row + 1 : d == 3 ? row - 1 : row;
      path.push_back({col + 1.0, row + 1.0});
    }
    return path;
  }
};

TEST(VerifySteps, JudgesAsAmongWallsThatAreHeld) {
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> sizes{{2, 2},  {2, 70},  {70, 2},
                                                                   {5, 64}, {64, 65}, {130, 129}};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const auto& [rows, cols] : sizes) {
      const LookedUpMaze judged(
          {rows, cols, seed, MazeAlgorithm::kruskal, seed % 4 == 0 ? 0.0 : 0.3 * static_cast<double>(seed % 4)});
      SCOPED_TRACE("seed " + std::to_string(seed) + " of " + std::to_string(rows) + " x " + std::to_string(cols));
      const std::vector<Vec2> path = judged.walk(seed, 200);
      for (const double clearance : {0.0, 0.1, 0.4999, 0.5, 0.7}) {
        judged.expect_same(path, {.radius = clearance > 0.2 ? 0.0 : 0.05,
                                  .clearance = clearance,
                                  .start = path.front(),
                                  .goal = path.back()});
      }
    }
  }
}

TEST(VerifySteps, EndsBesideTheLatticeAreJudgedAsTheyAre) {
  for (const std::uint64_t seed : test::seeds(20)) {
    SCOPED_TRACE(seed);
    const LookedUpMaze judged({60, 75, seed, MazeAlgorithm::kruskal, 0.2});
    SequentialRng rng(seed);
    for (unsigned i = 0; i < 20; ++i) {
      const std::vector<Vec2> inner = judged.walk(seed * 100 + i, 50);
      const auto beside = [&](Vec2 p) {
        return Vec2{p.x + 0.01 * static_cast<double>(rng.below(140)) - 0.7,
                    p.y + 0.01 * static_cast<double>(rng.below(140)) - 0.7};
      };
      std::vector<Vec2> path{beside(inner.front())};
      for (const Vec2 p : inner) path.push_back(p);
      path.push_back(beside(inner.back()));
      judged.expect_same(path, {.clearance = 0.1});
      judged.expect_same(path, {.start = path.front(), .goal = path[1]});
    }
  }
}

TEST(VerifySteps, RefusesWhatTheJudgeOfHeldWallsRefuses) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    const LookedUpMaze judged({40, 66, seed, MazeAlgorithm::kruskal, 0.1});
    SequentialRng rng(seed);
    std::vector<Vec2> path = judged.walk(seed, 100);
    const auto i = static_cast<std::size_t>(rng.below(path.size()));
    const Vec2 far[] = {{1.0, 0.0},  {0.0, 1.0},   {-1.0, 0.0}, {0.0, -1.0},
                        {0.45, 0.0}, {0.0, -0.48}, {0.3, 0.4},  {1e-9, 0.0}};
    for (const Vec2 off : far) {  // through a wall, or near one, or out of the box, or nothing of the kind
      std::vector<Vec2> broken = path;
      broken[i] = broken[i] + off;
      judged.expect_same(broken, {.clearance = 0.1});
      broken.assign(path.begin(), path.begin() + static_cast<std::ptrdiff_t>(i) + 1);
      broken.push_back(path[i] + off);  // there and back
      for (std::size_t k = i; k < path.size(); ++k) broken.push_back(path[k]);
      judged.expect_same(broken, {.clearance = 0.1});
    }
    path.erase(path.begin() + static_cast<std::ptrdiff_t>(i));  // a leg of two units, or round a corner
    if (!path.empty()) judged.expect_same(path, {.clearance = 0.1});
  }
}

TEST(VerifySteps, EachWallOfTheMazeStopsTheStepThroughIt) {
  const LookedUpMaze judged({67, 66, 3, MazeAlgorithm::kruskal, 0.4});
  std::size_t walls = 0;
  for (const std::uint64_t row_number : test::seeds(67, 20, 0)) {
    const auto row = static_cast<std::uint32_t>(row_number);
    for (std::uint32_t col = 0; col < 66; ++col) {
      const Vec2 p{col + 1.0, row + 1.0};
      for (const bool upwards : {false, true}) {
        const Vec2 to = upwards ? Vec2{p.x, p.y + 1.0} : Vec2{p.x + 1.0, p.y};
        if (to.x > 66.0 || to.y > 67.0) continue;
        const bool stands = upwards ? judged.cells.wall_above(col, row) : judged.cells.wall_right(col, row);
        walls += stands ? 1 : 0;
        const Vec2 inside{p.x + 0.2, p.y + 0.1};  // ends that are no steps are judged by themselves
        const std::array<std::array<Vec2, 5>, 3> there_and_back{
            {{p, to, p, to, p}, {to, p, to, p, to}, {inside, p, to, p, inside}}};
        for (const auto& path : there_and_back) {
          EXPECT_EQ(verify_steps(judged.passages, path, {}, {}).verified, !stands) << p.x << ' ' << p.y;
          EXPECT_EQ(verify_steps(judged.lines, path, {}, {}).verified, !stands) << p.x << ' ' << p.y;
        }
      }
    }
  }
  EXPECT_GT(walls, test::share(1000, 250));
}

TEST(VerifySteps, LengthsOfLongPathsAreAddedAsTheJudgeAddsThem) {
  const LookedUpMaze judged({300, 300, 7, MazeAlgorithm::kruskal, 1.0});
  std::vector<Vec2> path{{1.3, 1.1}};
  for (std::uint32_t row = 1; row <= 300; ++row) {
    for (std::uint32_t col = 1; col <= 300; ++col) path.push_back({row % 2 == 1 ? col * 1.0 : 301.0 - col, row * 1.0});
  }
  path.push_back({1.2, 300.37});
  judged.expect_same(path, {.clearance = 0.1});
}

TEST(JudgedGridLines, RefuseWallsThatNoSuchMazeHas) {
  const auto refused = [](std::vector<Segment> walls) {
    EXPECT_THROW(JudgedGridLines(WallSet::narrowest(walls), 3, 4, {}), InputError);
  };
  const std::vector<Segment> around{{{0.5, 0.5}, {4.5, 0.5}}, {{0.5, 3.5}, {4.5, 3.5}}};
  EXPECT_NO_THROW(JudgedGridLines(WallSet::narrowest(around), 3, 4, {}));
  refused({around[0]});
  for (const Segment& odd : {Segment{{1, 1.5}, {2, 1.5}}, Segment{{0.5, 0.5}, {1.5, 1.5}},
                             Segment{{1.5, 1.5}, {1.5, 1.5}}, Segment{{4.5, 1.5}, {5.5, 1.5}}}) {
    refused({around[0], around[1], odd});
  }
}

TEST(JudgedPassages, RefuseAnotherNumberOfWords) {
  const std::vector<std::uint64_t> words(6);
  EXPECT_NO_THROW(JudgedPassages("file", 3, 65, words, words));
  EXPECT_THROW(JudgedPassages("file", 3, 64, words, words), InputError);
  EXPECT_THROW(JudgedPassages("file", 3, 65, words, std::span(words).first(5)), InputError);
}

}  // namespace
}  // namespace warren

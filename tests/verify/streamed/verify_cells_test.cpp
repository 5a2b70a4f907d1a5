// SPDX-License-Identifier: BSD-3-Clause
// The oracle is the judge of walls that are held.
#include "verify/streamed/verify_cells.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/rng.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "tests/seeds.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {
namespace {

struct Judged {
  Scene scene;
  HeldCells cells;
  Judged(const MazeOptions& maze, unsigned side_log2)
      : scene(maze_scene(maze, false, {})), cells(generate_maze(maze, {}), side_log2) {}

  void expect_same(const std::vector<Vec2>& path, const VerifyOptions& options) const {
    const Verification expected = verify_path(scene, path, options, {});
    const Verification found = verify_among_cells(cells, path, options, {.threads = 2});
    EXPECT_EQ(found.verified, expected.verified);
    EXPECT_EQ(found.length, expected.length);
    EXPECT_NEAR(found.min_clearance, expected.min_clearance, 1e-12);
    ASSERT_EQ(found.first_violation.has_value(), expected.first_violation.has_value());
    if (!found.first_violation) return;
    EXPECT_EQ(found.first_violation->leg, expected.first_violation->leg);
    const auto kind = [](const std::string& obstacle) { return obstacle.substr(0, obstacle.find_first_of(": ")); };
    EXPECT_EQ(kind(found.first_violation->obstacle), kind(expected.first_violation->obstacle));
  }
};

/// Steps between neighbours of the grid, whatever stands between them; the walls say which.
std::vector<Vec2> walk(std::uint64_t seed, std::uint32_t side, std::size_t steps, const MazeCells* keep_off) {
  SequentialRng rng(seed);
  auto col = static_cast<std::uint32_t>(rng.below(side));
  auto row = static_cast<std::uint32_t>(rng.below(side));
  std::vector<Vec2> path{{col + 1.0, row + 1.0}};
  for (std::size_t i = 0; i < steps; ++i) {
    const std::uint64_t d = rng.below(4);
    if ((d == 0 && col + 1 == side) || (d == 1 && row + 1 == side) || (d == 2 && col == 0) || (d == 3 && row == 0))
      continue;
    if (keep_off != nullptr) {
      const bool closed = d == 0   ? keep_off->wall_right(col, row)
                          : d == 1 ? keep_off->wall_above(col, row)
                          : d == 2 ? keep_off->wall_right(col - 1, row)
                                   : keep_off->wall_above(col, row - 1);
      if (closed) continue;
    }
    col += d == 0 ? 1 : 0;
    col -= d == 2 ? 1 : 0;
    row += d == 1 ? 1 : 0;
    row -= d == 3 ? 1 : 0;
    path.push_back({col + 1.0, row + 1.0});
  }
  return path;
}

TEST(VerifyAmongCells, JudgesAsAmongWallsThatAreHeld) {
  for (const std::uint64_t seed : test::seeds(20)) {
    const MazeOptions maze{40, 40, seed, MazeAlgorithm::kruskal, seed % 3 == 0 ? 0.9 : 0.0};
    const MazeCells cells = generate_maze(maze, {});
    for (const unsigned side_log2 : {0U, 3U, 8U}) {
      const Judged judged(maze, side_log2);
      for (const double clearance : {0.0, 0.1, 0.5, 0.6, 3.0}) {
        SCOPED_TRACE("seed " + std::to_string(seed) + " side 2^" + std::to_string(side_log2) + " clearance " +
                     std::to_string(clearance));
        judged.expect_same(walk(seed, 40, 300, &cells), {.clearance = clearance});
        judged.expect_same(walk(seed, 40, 3, nullptr), {.radius = 0.05, .clearance = clearance});
      }
    }
  }
}

TEST(VerifyAmongCells, JudgesLegsOfAnyKind) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    const MazeOptions maze{30, 30, seed, MazeAlgorithm::backtracker, seed % 2 == 0 ? 1.0 : 0.97};
    const Judged judged(maze, 3);
    SequentialRng rng(seed);
    const auto number = [&] { return 0.5 + 30.0 * static_cast<double>(rng.next() >> 11) * 0x1p-53; };
    const std::vector<Vec2> path{{number(), number()}, {number(), number()}, {number(), number()}};
    judged.expect_same(path, {.clearance = 0.01 * static_cast<double>(seed)});
    judged.expect_same({path[0]}, {});
    judged.expect_same({path[0], {31.0, 4.0}}, {});
    judged.expect_same({path[0], path[1]}, {.start = Vec2{1, 1}, .goal = path[1]});
  }
}

TEST(VerifyAmongCells, RefusesWhatItDoesNotJudge) {
  const Judged judged({5, 5, 1}, 3);
  const std::vector<Vec2> path{{1, 1}};
  EXPECT_THROW(verify_among_cells(judged.cells, path, {.contact = Contact::allowed}, {}), InputError);
  EXPECT_THROW(verify_among_cells(judged.cells, {}, {}, {}), InputError);
}

}  // namespace
}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// The worlds and bodies of the matrix: each small, so that thousands of answers take a minute. What a file says and
// what the matrix's own judge looks at are written from the same lists.
#pragma once

#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "tests/matrix/arm_check.hpp"
#include "tests/matrix/plane_check.hpp"

namespace warren::test {

struct MatrixWorld {
  std::string name;
  std::string kind;  ///< plane, map, space, mixed or empty: a word of planners.table
  PlaneObstacles plane;
  SpaceObstacles space;
  std::array<double, 3> start{};  ///< of bodies in the plane; points and discs leave the heading out
  std::array<double, 3> goal{};
  double clearance = 0.0;   ///< of all bodies but a point
  double body_scale = 1.0;  ///< bodies of the plane that turn are drawn so large
  bool is_strange = false;  ///< drawn by a seed: ends may be blocked, and no planner need find a way
  std::vector<std::pair<std::string, std::string>> files{};  ///< names and texts; the first is the world
};

/// For failures of tests.
inline std::ostream& operator<<(std::ostream& out, const MatrixWorld& world) { return out << world.name; }

struct MatrixBody {
  std::string name;
  std::string kind;   ///< point, disc, polygon, car or arm: a word of planners.table
  std::string robot;  ///< as `--robot` takes it; FOLDER stands for where the world's files lie
  PlaneBody plane;
  std::optional<ArmBody> arm{};
};

/// What arms are asked everywhere.
std::vector<double> arm_start();
std::vector<double> arm_goal();
/// The files of the arms that have some, for each world's folder: names and texts.
std::vector<std::pair<std::string, std::string>> arm_files();

/// The listed ones, and some strange ones: as many as the environment's WARREN_MATRIX_SEEDS says, for a long run.
std::vector<MatrixWorld> matrix_worlds();
/// A pure function of the seed.
MatrixWorld strange_world(std::uint64_t seed);
/// `scale`: of those that turn, and of their tightest turns.
std::vector<MatrixBody> matrix_bodies(double scale);

}  // namespace warren::test

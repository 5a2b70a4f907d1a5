// SPDX-License-Identifier: BSD-3-Clause
// warren's shortest curves beside OMPL's: Dubins and Reeds-Shepp distances on random pairs of poses, seed by seed the
// same: how many agree to 1e-9, where ours or theirs is shorter and by how much, the first such pairs, and nanoseconds
// a pair.
#include <fmt/core.h>
#include <ompl/base/spaces/DubinsStateSpace.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/util/Console.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "bench/rivals/stopwatch.hpp"
#include "core/base/rng.hpp"
#include "worlds/poses/steering_curve.hpp"

namespace warren {
namespace {

namespace ob = ompl::base;

Se2 random_pose(std::uint64_t index) {
  return {10.0 * uniform(1, index, 0), 10.0 * uniform(1, index, 1), 6.283 * uniform(1, index, 2) - 3.1415};
}

/// Tells where the two disagree, and whether the shorter way is one (ours always is: its end is compared).
template <class Curve, class Space>
void compare_lengths(const char* name, std::uint64_t pairs) {
  Space space(1.0);
  auto* from = space.allocState()->template as<ob::SE2StateSpace::StateType>();
  auto* to = space.allocState()->template as<ob::SE2StateSpace::StateType>();
  const auto theirs = [&](const Se2& a, const Se2& b) {
    from->setXY(a.x, a.y);
    from->setYaw(a.theta);
    to->setXY(b.x, b.y);
    to->setYaw(b.theta);
    return space.distance(from, to);
  };
  std::uint64_t agree = 0;
  std::uint64_t shorter = 0;
  std::uint64_t longer = 0;
  double most_shorter = 0.0;
  double most_longer = 0.0;
  for (std::uint64_t i = 0; i < pairs; ++i) {
    const Se2 a = random_pose(2 * i);
    const Se2 b = random_pose(2 * i + 1);
    const double ours = Curve::shortest(a, b, 1.0).length;
    const double gap = theirs(a, b) - ours;
    if (std::abs(gap) <= 1e-9) {
      ++agree;
      continue;
    }
    ++(gap > 0.0 ? shorter : longer);
    most_shorter = std::max(most_shorter, gap);
    most_longer = std::max(most_longer, -gap);
    if (shorter + longer > 3) continue;
    fmt::print("  {} {} {} -> {} {} {}: ours {:.9f}, theirs {:.9f}\n", a.x, a.y, a.theta, b.x, b.y, b.theta, ours,
               ours + gap);
  }
  double sum = 0.0;
  const Stopwatch our_watch;
  for (std::uint64_t i = 0; i < pairs; ++i)
    sum += Curve::shortest(random_pose(2 * i), random_pose(2 * i + 1), 1.0).length;
  const double our_s = our_watch.read().cpu_s;
  const Stopwatch their_watch;
  for (std::uint64_t i = 0; i < pairs; ++i) sum += theirs(random_pose(2 * i), random_pose(2 * i + 1));
  const double their_s = their_watch.read().cpu_s;
  const double scale = 1e9 / static_cast<double>(pairs);
  fmt::print(
      "{:<12} {} pairs: {} agree to 1e-9; ours shorter {} (by {:.3g} at most), theirs shorter {} (by {:.3g}); {:.0f} "
      "and {:.0f} ns a pair (mean of all lengths {:.3f})\n",
      name, pairs, agree, shorter, most_shorter, longer, most_longer, scale * our_s, scale * their_s,
      sum / (2.0 * static_cast<double>(pairs)));
  space.freeState(from);
  space.freeState(to);
}

int run(int argc, char** argv) {
  std::uint64_t pairs = 100'000;
  CLI::App app("warren's shortest curves beside OMPL's");
  app.add_option("--pairs", pairs, "pairs of poses")->check(CLI::PositiveNumber);
  CLI11_PARSE(app, argc, argv);
  ompl::msg::setLogLevel(ompl::msg::LOG_ERROR);
  compare_lengths<DubinsCurve, ob::DubinsStateSpace>("Dubins", pairs);
  compare_lengths<ReedsSheppCurve, ob::ReedsSheppStateSpace>("Reeds-Shepp", pairs);
  return 0;
}

}  // namespace
}  // namespace warren

int main(int argc, char** argv) {
  try {
    return warren::run(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}

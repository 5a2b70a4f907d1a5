// SPDX-License-Identifier: BSD-3-Clause
// What "auto" means: how many samples a round draws and how milestones are joined, as pure functions of the options and
// of counts, so that the answer is the same on every machine.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "core/run/execution.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/graph/roadmap_options.hpp"

namespace warren {

/// How the milestones of one round are joined: by a radius, or (radius 0) by the k nearest.
struct ConnectionRule {
  double radius = 0.0;
  std::uint32_t neighbours = 0;
  std::optional<GrowingAttach> attach = {};  ///< of start and goal; none: by the rule too
  friend bool operator==(const ConnectionRule&, const ConnectionRule&) = default;
};

/// Neighbours that the radius rule expects around a milestone in the open; see the table "uniform sampling that
/// connects" in docs/performance.md.
inline constexpr double expected_neighbours = 20.0;
/// A round that leaves start and goal apart is followed by one with so many times the samples,
inline constexpr double growth = 1.6;
/// with twice as many while there are fewer than usual,
inline constexpr double first_growth = 2.0;
/// until there are this many times the usual number: then the answer is not_connected.
inline constexpr double growth_cap = 64.0;

/// Samples that a round usually takes.
template <World W>
std::uint64_t usual_samples(const W& world, const RoadmapOptions& options, const Execution& execution) {
  if (options.sampler == SamplerKind::lattice) return std::uint64_t{options.lattice.rows} * options.lattice.cols;
  const Bitmap* cells = world.milestone_cells();
  if (options.sampler == SamplerKind::cell_centres && cells != nullptr)
    return std::max<std::uint64_t>(1, cells->count());
  if (options.samples) return *options.samples;
  const double suggested = world.suggested_samples(execution);
  return static_cast<std::uint64_t>(std::clamp(suggested, 64.0, static_cast<double>(most_samples)));
}

/// Samples of the first round: fewer in worlds where many questions are easy.
template <World W>
std::uint64_t first_samples(const W& world, const RoadmapOptions& options, const Execution& execution) {
  const std::uint64_t usual = usual_samples(world, options, execution);
  if (options.samples || takes_all_places(options.sampler)) return usual;
  return std::min(usual, world.first_samples());
}

/// Samples of the round after one with `samples`; 0 when there is none.
inline std::uint64_t next_samples(const RoadmapOptions& options, std::uint64_t usual, std::uint64_t samples) {
  if (options.samples || takes_all_places(options.sampler) || samples >= most_samples) return 0;
  if (static_cast<double>(samples) >= growth_cap * static_cast<double>(usual)) return 0;
  if (samples < usual) {
    return std::min(usual, static_cast<std::uint64_t>(std::ceil(first_growth * static_cast<double>(samples))));
  }
  return std::min(most_samples, static_cast<std::uint64_t>(growth * static_cast<double>(samples)));
}

/// volume: of the space that the samples were drawn from, in the world's metric; only for the plane, else the rule is
/// by k. breadth: of its box; where a disc of the usual area sticks far out of it, the radius is that of a strip which
/// has this area within the box. 0: not known.
inline ConnectionRule connection_rule(const RoadmapOptions& options, std::uint64_t samples, double volume,
                                      double breadth = 0.0) {
  if (options.radius) return {*options.radius, 0};
  if (options.neighbours) return {0.0, *options.neighbours};
  if (options.sampler == SamplerKind::lattice) return {1.0, 0};     // the four neighbours in the lattice
  const bool on_curves = options.sampler == SamplerKind::corridor;  // which fill no area evenly
  if (on_curves || !(volume > 0.0)) return {0.0, static_cast<std::uint32_t>(expected_neighbours)};
  const double area = expected_neighbours * volume / static_cast<double>(samples);
  const double strip = breadth > 0.0 ? area / (2.0 * breadth) : 0.0;
  return {std::max(std::sqrt(area / std::numbers::pi), strip), 0};
}

namespace detail {

/// The volume of the ball of radius 1.
inline double unit_ball(std::size_t dimension) {
  if (dimension < 2) return dimension == 0 ? 1.0 : 2.0;
  return 2.0 * std::numbers::pi / static_cast<double>(dimension) * unit_ball(dimension - 2);
}

/// The n-th root of x > 0, n >= 1: Newton's steps from above go down until rounding stops them. Not std::pow, whose
/// last bit is the library's affair.
inline double root(double x, std::size_t n) {
  const auto degree = static_cast<double>(n);
  for (double y = std::max(1.0, x);;) {
    double rest = x;
    for (std::size_t i = 1; i < n; ++i) rest /= y;
    const double next = y + (rest - y) / degree;
    if (!(next < y)) return y;
    y = next;
  }
}

}  // namespace detail

/// k = e (1 + 1/d) ln n, or radius = 2 ((1 + 1/d) V / B ln n / n)^(1/d), with B the volume of the unit ball and V that
/// of the sampled space, which is not less than the free one's. UsageError where the world doesn't tell V.
inline ConnectionRule star_rule(StarRule rule, std::uint64_t samples, std::size_t dimension, double volume) {
  const double n = std::max(static_cast<double>(samples), 2.0);
  const auto d = static_cast<double>(dimension);
  if (rule == StarRule::neighbours) {
    return {0.0, static_cast<std::uint32_t>(std::ceil(std::numbers::e * (1.0 + 1.0 / d) * portable::log(n)))};
  }
  if (!(volume > 0.0)) throw UsageError("@radius: star: this world doesn't tell its volume; say @neighbours star");
  return {2.0 * detail::root((1.0 + 1.0 / d) * volume / detail::unit_ball(dimension) * portable::log(n) / n, dimension),
          0};
}

template <World W>
ConnectionRule connection_rule_for(const W& world, const RoadmapOptions& options, std::uint64_t samples) {
  const bool by_rule = !options.radius && !options.neighbours && options.star == StarRule::none;
  if (options.sampler == SamplerKind::cell_centres && by_rule && world.milestone_cells() != nullptr)
    return {world.milestone_reach(), 0, options.attach};
  const Box box = world.box();
  ConnectionRule rule =
      options.star == StarRule::none
          ? connection_rule(options, samples, world.sampled_area(), std::min(box.width(), box.height()))
          : star_rule(options.star, samples, world.sampled_dimension(), world.sampled_volume());
  rule.attach = options.attach;
  return rule;
}

}  // namespace warren

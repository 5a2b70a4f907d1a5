// SPDX-License-Identifier: BSD-3-Clause
// Where states come from, for any world: the index-th sample of a seed, a pure function of the arguments.
//
// uniform, random: independent and uniform. halton: the Halton sequence shifted by the seed. gaussian (Boor, Overmars,
// van der Stappen, ICRA 1999): a free state with a blocked one nearby, so samples crowd along the obstacles. bridge
// (Hsu, Jiang, Reif, Sun, ICRA 2003): a free state halfway between two blocked ones, so samples crowd in narrow
// passages. mixture: of four samples two are uniform, one gaussian and one bridge. "Nearby" is a normal deviate in each
// coordinate of the unit cube that states are made from, mirrored at its faces.
// gaussian and bridge try up to 32 pairs a sample and cost as many collision tests; where none will do there is no
// sample, and in trees, which need one, a uniform one.
//
// The milestones of a roadmap are the free ones of its samples, numbered tile by tile, which is worth 3 to 6 times in
// neighbour queries and 5 to 8 in search. O(samples); in the plane 16 bytes a milestone, and 40 a sample while sorting.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/error.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/rng.hpp"
#include "core/base/solution.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/types.hpp"
#include "core/base/world.hpp"
#include "core/plane/se2.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "spatial/points/point_grid.hpp"

namespace warren {

namespace detail {

inline constexpr std::array<std::uint64_t, 14> halton_bases{2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43};

/// What each digit behind the point is worth in a base, the first one first.
template <std::uint64_t base>
constexpr auto digit_values() {
  std::array<double, 64> values{};
  double value = 1.0;
  for (double& digit : values) digit = value /= static_cast<double>(base);
  return values;
}

/// The digits of a number behind the point, in reverse.
template <std::uint64_t base>
double radical_inverse(std::uint64_t number) {
  static constexpr auto values = digit_values<base>();
  double sum = 0.0;
  for (std::size_t place = 0; number > 0; ++place, number /= base) {
    sum += values[place] * static_cast<double>(number % base);
  }
  return sum;
}

inline constexpr std::uint64_t sample_tries = 32;
inline constexpr double gaussian_spread = 0.05;  ///< standard deviation in unit coordinates
inline constexpr double bridge_spread = 0.1;

/// A standard normal deviate: Box, Muller, Ann. Math. Statist. 29 (1958).
inline double normal(std::uint64_t seed, std::uint64_t index, std::uint64_t axis) {
  const double radius = std::sqrt(-2.0 * portable::log(1.0 - uniform(seed, index, 2 * axis)));
  return radius * portable::cos(2.0 * std::numbers::pi * uniform(seed, index, 2 * axis + 1));
}

/// Into [0, 1), mirrored at the ends; x within a few units of it.
inline double mirrored(double x) {
  x = std::abs(std::remainder(x, 2.0));
  return x < 1.0 ? x : std::nextafter(1.0, 0.0);
}

/// Of a pair of points of the unit cube, `spread` apart in each coordinate on average. The second costs ten times as
/// much as the first, so it is made when it is asked for. Axes below 16 are the uniform sample's.
template <std::size_t D>
std::array<double, D> first_of_pair(std::uint64_t seed, std::uint64_t index, std::uint64_t attempt) {
  std::array<double, D> point;
  for (std::size_t axis = 0; axis < D; ++axis) point[axis] = uniform(seed, index, 16 + attempt * 4 * D + axis);
  return point;
}
template <std::size_t D>
std::array<double, D> second_of_pair(std::array<double, D> point, std::uint64_t seed, std::uint64_t index,
                                     std::uint64_t attempt, double spread) {
  for (std::size_t axis = 0; axis < D; ++axis) {
    point[axis] = mirrored(point[axis] + spread * normal(seed, index, 8 + attempt * 2 * D + D + axis));
  }
  return point;
}

template <World W>
std::optional<typename W::State> gaussian_state(const W& world, std::uint64_t seed, std::uint64_t index,
                                                typename W::Query& query) {
  for (std::uint64_t attempt = 0; attempt < sample_tries; ++attempt) {
    const auto first = first_of_pair<W::dimension>(seed, index, attempt);
    const auto a = world.at_unit(first);
    const auto b = world.at_unit(second_of_pair(first, seed, index, attempt, gaussian_spread));
    const bool a_is_free = world.is_free(a, query);
    if (a_is_free != world.is_free(b, query)) return a_is_free ? a : b;
  }
  return std::nullopt;
}

template <World W>
std::optional<typename W::State> bridge_state(const W& world, std::uint64_t seed, std::uint64_t index,
                                              typename W::Query& query) {
  for (std::uint64_t attempt = 0; attempt < sample_tries; ++attempt) {
    const auto first = first_of_pair<W::dimension>(seed, index, attempt);
    if (world.is_free(world.at_unit(first), query)) continue;
    const auto second = second_of_pair(first, seed, index, attempt, bridge_spread);
    if (world.is_free(world.at_unit(second), query)) continue;
    std::array<double, W::dimension> middle;
    for (std::size_t axis = 0; axis < W::dimension; ++axis) middle[axis] = 0.5 * (first[axis] + second[axis]);
    const auto state = world.at_unit(middle);
    if (world.is_free(state, query)) return state;
  }
  return std::nullopt;
}

}  // namespace detail

/// The index-th point of the Halton sequence in bases 2, 3, 5, …, shifted by a random vector of the seed
/// (Cranley-Patterson), so that seeds differ. The coordinates that the world's states are made of, the others 0.
template <World W>
std::array<double, W::dimension> halton_point(const W& world, std::uint64_t seed, std::uint64_t index) {
  static_assert(W::dimension <= detail::halton_bases.size());
  const std::size_t axes = world.unit_dimension();
  const auto coordinate = [&]<std::size_t axis>(std::integral_constant<std::size_t, axis>) {
    if (axis >= axes) return 0.0;
    const double value = detail::radical_inverse<detail::halton_bases[axis]>(index + 1) + uniform(seed, 0, axis);
    return value < 1.0 ? value : value - 1.0;
  };
  const auto all = [&]<std::size_t... axis>(std::index_sequence<axis...>) {
    return std::array{coordinate(std::integral_constant<std::size_t, axis>{})...};
  };
  return all(std::make_index_sequence<W::dimension>{});
}

/// Do samples of this kind depend on what is free?
constexpr bool looks_at_obstacles(SamplerKind kind) {
  return kind == SamplerKind::gaussian || kind == SamplerKind::bridge || kind == SamplerKind::mixture;
}

/// A free state, for the kinds that look at obstacles; nothing where none was found.
template <World W>
std::optional<typename W::State> obstacle_sample(const W& world, SamplerKind kind, std::uint64_t seed,
                                                 std::uint64_t index, typename W::Query& query) {
  const std::uint64_t turn = kind == SamplerKind::mixture ? index % 4 : 0;
  if (kind == SamplerKind::gaussian || turn == 1) return detail::gaussian_state(world, seed, index, query);
  if (kind == SamplerKind::bridge || turn == 3) return detail::bridge_state(world, seed, index, query);
  const auto state = uniform_state(world, seed, index);
  if (!world.is_free(state, query)) return std::nullopt;
  return state;
}

/// A state that may be blocked: of the kinds that draw one by one and look at no obstacle; uniform for all others.
template <World W>
typename W::State plain_sample(const W& world, SamplerKind kind, std::uint64_t seed, std::uint64_t index) {
  if (kind == SamplerKind::halton) return world.at_unit(halton_point(world, seed, index));
  if (kind == SamplerKind::corridor) return world.corridor_state(seed, index);
  return uniform_state(world, seed, index);
}

/// A state to grow towards: free or not.
template <World W>
typename W::State target_state(const W& world, SamplerKind kind, std::uint64_t seed, std::uint64_t index,
                               typename W::Query& query) {
  if (looks_at_obstacles(kind)) {
    if (const auto state = obstacle_sample(world, kind, seed, index, query)) return *state;
  }
  return plain_sample(world, kind, seed, index);
}

/// Samples for a search that wants a cheaper path than the one it knows (Gammell, Srinivasa, Barfoot, IROS 2014): from
/// the informed set, the states through which the metric allows a path below a cost, and from around the known path.
/// The set is drawn by rejection; where states stand in the plane and the ellipse of the places through which a path
/// may be so short is smaller than the box of all places, from that ellipse. A pure function of seed, index, cost and
/// path. Refers to the world. Any number of threads may ask.
template <SteerableWorld W>
class InformedSampler {
 public:
  using State = typename W::State;

  /// goals: at least one.
  InformedSampler(const W& world, const State& start, std::span<const State> goals, std::uint64_t seed)
      : world_(&world), start_(start), goals_(goals.begin(), goals.end()), seed_(random_bits(seed, 0, purpose)) {}

  const std::vector<State>& goals() const { return goals_; }
  /// From the state to the nearest goal, at least: by the metric.
  double rest(const State& state) const {
    double least = std::numeric_limits<double>::infinity();
    for (const State& goal : goals_) least = std::min(least, world_->distance(state, goal));
    return least;
  }
  /// Of a path through the state, at least.
  double least_cost(const State& state) const { return world_->distance(start_, state) + rest(state); }

  /// The index-th sample of the states through which a path may cost less than `most`; nothing where some tries found
  /// none.
  std::optional<State> informed(std::uint64_t index, double most) const {
    const State& goal = goals_[random_bits(seed_, index, own_axes) % goals_.size()];
    for (std::uint64_t attempt = 0; attempt < tries; ++attempt) {
      const std::uint64_t draw = index * tries + attempt;
      std::optional<State> state;
      if constexpr (in_plane) state = in_ellipse(draw, goal, most);
      if (!state) state = uniform_state(*world_, seed_, draw);
      if (least_cost(*state) < most) return state;
    }
    return std::nullopt;
  }
  /// The index-th state near a path of two states or more: a place on it, moved by a half to a 512th of the way towards
  /// a random state. along: lengths_along() of the path.
  State near(const Path<State>& path, std::span<const double> along, std::uint64_t index) const {
    const PlaceOnPath at = place_on_path(along, uniform(seed_, index, own_axes + 1) * along.back());
    const State place = world_->interpolate(path[at.leg], path[at.leg + 1], at.share);
    const auto halvings = static_cast<int>(random_bits(seed_, index, own_axes + 2) % 8);
    const double share = std::ldexp(0.5 * (1.0 - 0.5 * uniform(seed_, index, own_axes + 3)), -halvings);
    return state_between(*world_, place, uniform_state(*world_, seed_, index * tries), share);
  }

 private:
  static constexpr std::uint64_t purpose = 0x696e666f726d6564U;
  static constexpr std::uint64_t tries = 8;     // with 32, cars spent half of a tree's time here
  static constexpr std::uint64_t own_axes = 8;  // from here on, and below 16: no axes of the world
  static constexpr bool in_plane = std::same_as<State, Vec2> || std::same_as<State, Se2>;

  static Vec2 place_of(const State& state) { return {state.x, state.y}; }
  /// A state of the ellipse around the start's place and the goal's; nothing where it is no smaller than the box.
  std::optional<State> in_ellipse(std::uint64_t draw, const State& goal, double most) const {
    const Vec2 from = place_of(start_);
    const Vec2 between = place_of(goal) - from;
    const double width_sq = most * most - dot(between, between);
    if (!(width_sq > 0.0)) return std::nullopt;
    const double width = std::sqrt(width_sq);
    if (!(std::numbers::pi * 0.25 * most * width < box_area())) return std::nullopt;
    const double radius = 0.5 * std::sqrt(uniform(seed_, draw, 0));
    const auto [sine, cosine] = portable::sin_and_cos(2.0 * std::numbers::pi * uniform(seed_, draw, 1));
    const double apart = norm(between);
    const Vec2 along = apart > 0.0 ? (1.0 / apart) * between : Vec2{1.0, 0.0};
    const Vec2 across{-along.y, along.x};
    const Vec2 place = from + 0.5 * between + (radius * most * cosine) * along + (radius * width * sine) * across;
    if constexpr (std::same_as<State, Se2>) {
      return Se2{place.x, place.y, std::numbers::pi * (2.0 * uniform(seed_, draw, 2) - 1.0)};
    } else {
      return place;
    }
  }
  /// Of the places that uniform samples have, at some heading.
  double box_area() const {
    const double last = std::nextafter(1.0, 0.0);
    const auto corner = [&](double x, double y) {
      std::array<double, W::dimension> u{};
      u[0] = x;
      u[1] = y;
      return place_of(world_->at_unit(u));
    };
    const Vec2 first = corner(0.0, 0.0);
    return std::abs(cross(corner(last, 0.0) - first, corner(0.0, last) - first));
  }

  const W* world_;
  State start_;
  std::vector<State> goals_;
  std::uint64_t seed_;
};

/// The index-th point of the lattice (1..cols) x (1..rows), row by row.
constexpr Vec2 lattice_point(LatticeSize size, std::uint64_t index) {
  return {static_cast<double>(index % size.cols + 1), static_cast<double>(index / size.cols + 1)};
}

/// The unit square cut into `count` strata: rows of equal height, as many as make the strata of a box of this height
/// over width about square; each row cut evenly, so that there are exactly `count`.
class Strata {
 public:
  /// The strata first .. next - 1 are a row.
  struct Row {
    std::uint64_t number = 0;
    std::uint64_t first = 0;
    std::uint64_t next = 0;
  };
  Strata(std::uint64_t count, double height_over_width) : count_(count) {
    const auto n = static_cast<double>(count);
    rows_ = static_cast<std::uint64_t>(std::clamp(std::round(std::sqrt(n * height_over_width)), 1.0, n));
  }
  Row row_of(std::uint64_t index) const {
    const std::uint64_t row = std::min(index * rows_ / count_, rows_ - 1);
    return {row, (row * count_ + rows_ - 1) / rows_, ((row + 1) * count_ + rows_ - 1) / rows_};
  }
  /// A random point in a stratum of this row.
  std::array<double, 2> point(std::uint64_t seed, std::uint64_t index, const Row& row) const {
    return {
        (static_cast<double>(index - row.first) + uniform(seed, index, 0)) / static_cast<double>(row.next - row.first),
        (static_cast<double>(row.number) + uniform(seed, index, 1)) / static_cast<double>(rows_)};
  }

 private:
  std::uint64_t count_;
  std::uint64_t rows_;
};

namespace detail {

/// Calls visit(sample) for the samples of a range, of `count` in all: a pure function of options, index and count. In
/// the plane uniform ones are stratified; a row of strata is found once.
template <World W, class Visit>
void for_each_sample(const W& world, const RoadmapOptions& options, Range range, std::uint64_t count,
                     const Visit& visit) {
  if constexpr (std::same_as<typename W::State, Vec2>) {
    if (options.sampler == SamplerKind::lattice) {
      Vec2 at = lattice_point(options.lattice, range.first);
      for (std::size_t i = range.first; i < range.last; ++i) {
        visit(at);
        at = at.x < options.lattice.cols ? Vec2{at.x + 1.0, at.y} : Vec2{1.0, at.y + 1.0};
      }
      return;
    }
    if (options.sampler == SamplerKind::uniform) {
      const Box box = world.box();
      const Strata strata(count, box.width() > 0.0 ? box.height() / box.width() : 1.0);
      Strata::Row row;
      std::array<std::array<double, 2>, bunch_size> units;
      std::array<Vec2, bunch_size> states;
      for (std::size_t first = range.first; first < range.last; first += bunch_size) {
        const std::size_t held = std::min(bunch_size, range.last - first);
        for (std::size_t i = 0; i < held; ++i) {
          if (first + i >= row.next) row = strata.row_of(first + i);
          units[i] = strata.point(options.seed, first + i, row);
        }
        world.at_units({units.data(), held}, states.data());
        std::for_each_n(states.begin(), held, visit);
      }
      return;
    }
  }
  for (std::size_t i = range.first; i < range.last; ++i) visit(plain_sample(world, options.sampler, options.seed, i));
}

/// Writes the free ones of a range of samples down, one after the other; returns the end.
template <World W>
typename W::State* write_free_samples(const W& world, const RoadmapOptions& options, Range range, std::uint64_t count,
                                      typename W::State* out) {
  auto query = world.make_query();
  if (looks_at_obstacles(options.sampler)) {
    for (std::size_t i = range.first; i < range.last; ++i) {
      if (const auto state = obstacle_sample(world, options.sampler, options.seed, i, query)) *out++ = *state;
    }
    return out;
  }
  std::array<typename W::State, bunch_size> bunch;
  std::size_t held = 0;
  const auto flush = [&] {
    std::uint32_t bits = world.free_states({bunch.data(), held}, query);
    for (; bits != 0; bits &= bits - 1) *out++ = bunch[static_cast<std::size_t>(std::countr_zero(bits))];
    held = 0;
  };
  for_each_sample(world, options, range, count, [&](const typename W::State& state) {
    bunch[held++] = state;
    if (held == bunch_size) flush();
  });
  flush();
  return out;
}

template <World W>
RawVector<typename W::State> in_tile_order(const W& world, const RawVector<typename W::State>& states,
                                           const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  execution.reserve(states.size() * (sizeof(Vec2) + 16 + sizeof(typename W::State)));
  RawVector<std::uint32_t> order;
  if constexpr (std::same_as<typename W::State, Vec2>) {
    order = tile_order(states, execution);
  } else {
    RawVector<Vec2> places(states.size());  // the first two numbers of the embeddings
    for_each_index(states.size(), grain, execution, [&](std::size_t i) {
      const auto point = world.embed(states[i]);
      places[i] = {point[0], point[1]};
    });
    order = tile_order(places, execution);
  }
  RawVector<typename W::State> sorted;
  sorted.reserve(states.size() + 2);  // start and goal will follow
  sorted.resize(states.size());
  for_each_index(states.size(), grain, execution, [&](std::size_t i) { sorted[i] = states[order[i]]; });
  return sorted;
}

/// The middles of a map's cells, in tile order.
template <World W>
RawVector<typename W::State> cell_centre_milestones(const W& world, const Execution& execution) {
  constexpr std::size_t rows = 32;
  const Bitmap& cells = *world.milestone_cells();
  execution.reserve(cells.count() * sizeof(typename W::State));
  auto parts = parts_of_chunks(cells.height(), rows, execution, [&](Range r) {
    RawVector<typename W::State> part;
    for (auto y = static_cast<std::uint32_t>(r.first); y < r.last; ++y) {
      cells.for_each_in_row(y, [&](std::uint32_t x) { part.push_back(world.cell_state(x, y)); });
    }
    return part;
  });
  const RawVector<typename W::State> states = joined_parts(parts, execution);
  parts.clear();
  return in_tile_order(world, states, execution);
}

}  // namespace detail

/// The free ones of samples 0 .. count - 1, in tile order. Throws InputError for a lattice with more points than
/// milestones can be numbered, and Stopped.
template <World W>
RawVector<typename W::State> draw_milestones(const W& world, const RoadmapOptions& options, std::uint64_t count,
                                             const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 12;
  if (options.sampler == SamplerKind::lattice && count > most_samples)
    throw InputError("lattice", "has more than 2^31 cells; use the tiled pipeline");
  if (options.sampler == SamplerKind::cell_centres && world.milestone_cells() != nullptr)
    return detail::cell_centre_milestones(world, execution);
  execution.reserve(count * sizeof(typename W::State));
  RawVector<typename W::State> states(count);
  const std::vector<Range> parts = parts_of_chunks(count, grain, execution, [&](Range r) {
    const auto* const end = detail::write_free_samples(world, options, r, count, states.data() + r.first);
    return Range{r.first, static_cast<std::size_t>(end - states.data())};
  });
  auto end = states.begin();
  for (const Range& part : parts) {
    const auto at = [&](std::size_t i) { return states.begin() + static_cast<std::ptrdiff_t>(i); };
    execution.check();
    end = at(part.first) == end ? at(part.last) : std::copy(at(part.first), at(part.last), end);
  }
  states.erase(end, states.end());
  return detail::in_tile_order(world, states, execution);
}

}  // namespace warren

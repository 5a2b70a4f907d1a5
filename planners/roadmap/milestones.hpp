// SPDX-License-Identifier: BSD-3-Clause
// Draws the milestones of a roadmap: samples are pure functions of (seed, index), the free ones are kept and numbered
// tile by tile, which is worth 3 to 6 times in neighbour queries and 5 to 8 in search. O(samples); in the plane 16
// bytes a milestone, and 40 a sample while sorting.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/base/world.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "planners/roadmap/lattice_milestones.hpp"
#include "planners/roadmap/sampler.hpp"
#include "spatial/points/tile_order.hpp"

namespace warren {

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

/// The index-th of `count` strata of the unit square, and a random point in it.
inline std::array<double, 2> stratified_point(std::uint64_t seed, std::uint64_t index, std::uint64_t count,
                                              double height_over_width) {
  const Strata strata(count, height_over_width);
  return strata.point(seed, index, strata.row_of(index));
}

inline double height_over_width(const Box& box) { return box.width() > 0.0 ? box.height() / box.width() : 1.0; }

/// The index-th of `count` samples: a pure function of the arguments.
template <World W>
typename W::State sample_state(const W& world, const RoadmapOptions& options, std::uint64_t index,
                               std::uint64_t count) {
  if constexpr (std::same_as<typename W::State, Vec2>) {
    if (options.sampler == SamplerKind::lattice) return lattice_point(options.lattice, index);
    if (options.sampler == SamplerKind::uniform) {
      return world.at_unit(stratified_point(options.seed, index, count, height_over_width(world.box())));
    }
  }
  if (options.sampler == SamplerKind::halton) return world.at_unit(halton_point<W::dimension>(options.seed, index));
  if constexpr (CorridorWorld<W>) {
    if (options.sampler == SamplerKind::corridor) return world.corridor_state(options.seed, index);
  }
  return uniform_state(world, options.seed, index);
}

namespace detail {

/// Calls visit(sample) for the samples of a range: the same as sample_state, but a row of strata is found once.
template <World W, class Visit>
void for_each_sample(const W& world, const RoadmapOptions& options, Range range, std::uint64_t count,
                     const Visit& visit) {
  if constexpr (std::same_as<typename W::State, Vec2>) {
    if (options.sampler == SamplerKind::uniform) {
      const Strata strata(count, height_over_width(world.box()));
      Strata::Row row;
      for (std::size_t i = range.first; i < range.last; ++i) {
        if (i >= row.next) row = strata.row_of(i);
        visit(world.at_unit(strata.point(options.seed, i, row)));
      }
      return;
    }
  }
  for (std::size_t i = range.first; i < range.last; ++i) visit(sample_state(world, options, i, count));
}

/// Bit i is set if states[i] is free; at most bunch_size states.
template <World W>
std::uint32_t free_states(const W& world, std::span<const typename W::State> states, typename W::Query& query) {
  std::uint32_t free = 0;
  if constexpr (BunchWorld<W>) {
    free = world.free_states(states, query);
  } else {
    for (std::size_t i = 0; i < states.size(); ++i) free |= std::uint32_t{world.is_free(states[i], query)} << i;
  }
  return free;
}

/// The free ones of a range of samples.
template <World W>
void append_free_samples(const W& world, const RoadmapOptions& options, Range range, std::uint64_t count,
                         RawVector<typename W::State>& free) {
  auto query = world.make_query();
  std::array<typename W::State, bunch_size> bunch;
  std::size_t held = 0;
  const auto flush = [&] {
    std::uint32_t bits = free_states(world, std::span<const typename W::State>(bunch.data(), held), query);
    for (; bits != 0; bits &= bits - 1) free.push_back(bunch[static_cast<std::size_t>(std::countr_zero(bits))]);
    held = 0;
  };
  for_each_sample(world, options, range, count, [&](const typename W::State& state) {
    bunch[held++] = state;
    if (held == bunch_size) flush();
  });
  flush();
}

/// Joins parts in their order.
template <class T>
RawVector<T> joined(const std::vector<RawVector<T>>& parts, const Execution& execution, std::size_t spare = 0) {
  std::vector<std::size_t> first(parts.size() + 1, 0);
  for (std::size_t i = 0; i < parts.size(); ++i) first[i + 1] = first[i] + parts[i].size();
  execution.reserve((first.back() + spare) * sizeof(T));
  RawVector<T> all;
  all.reserve(first.back() + spare);
  all.resize(first.back());
  for_chunks(parts.size(), 1, execution, [&](Range r) {
    std::copy(parts[r.first].begin(), parts[r.first].end(), all.begin() + static_cast<std::ptrdiff_t>(first[r.first]));
  });
  return all;
}

/// The first two coordinates of the embeddings; the states themselves where they are points of the plane.
template <World W>
auto plane_positions(const W& world, const RawVector<typename W::State>& states, const Execution& execution) {
  if constexpr (std::same_as<typename W::State, Vec2>) {
    return std::span<const Vec2>(states);
  } else {
    constexpr std::size_t grain = std::size_t{1} << 14;
    RawVector<Vec2> positions(states.size());
    for_chunks(states.size(), grain, execution, [&](Range r) {
      for (std::size_t i = r.first; i < r.last; ++i) {
        const auto point = world.embed(states[i]);
        positions[i] = {point[0], point[1]};
      }
    });
    return positions;
  }
}

template <World W>
RawVector<typename W::State> in_tile_order(const W& world, const RawVector<typename W::State>& states,
                                           const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  execution.reserve(states.size() * (sizeof(Vec2) + 16 + sizeof(typename W::State)));
  const TileOrder order = tile_order(plane_positions(world, states, execution), execution);
  RawVector<typename W::State> sorted;
  sorted.reserve(states.size() + 2);  // start and goal will follow
  sorted.resize(states.size());
  for_chunks(states.size(), grain, execution, [&](Range r) {
    for (std::size_t i = r.first; i < r.last; ++i) sorted[i] = states[order.sample_of[i]];
  });
  return sorted;
}

/// The middles of a map's cells, in tile order.
template <CellWorld W>
RawVector<typename W::State> cell_centre_milestones(const W& world, const Execution& execution, std::size_t spare) {
  constexpr std::size_t rows = 32;
  const auto& cells = world.milestone_cells();
  std::vector<RawVector<typename W::State>> parts(chunk_count(cells.height(), rows));
  execution.reserve(cells.count() * sizeof(typename W::State));
  for_chunks(cells.height(), rows, execution, [&](Range r) {
    RawVector<typename W::State>& part = parts[r.first / rows];
    for (auto y = static_cast<std::uint32_t>(r.first); y < r.last; ++y) {
      const auto words = cells.row(y);
      for (std::uint32_t w = 0; w < words.size(); ++w) {
        for (std::uint64_t rest = words[w]; rest != 0; rest &= rest - 1) {
          part.push_back(world.cell_state(64 * w + static_cast<std::uint32_t>(std::countr_zero(rest)), y));
        }
      }
    }
  });
  const RawVector<typename W::State> states = joined(parts, execution, spare);
  parts.clear();
  return in_tile_order(world, states, execution);
}

}  // namespace detail

/// The free ones of samples 0 .. count - 1, in tile order.
template <World W>
RawVector<typename W::State> draw_milestones(const W& world, const RoadmapOptions& options, std::uint64_t count,
                                             const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 12;
  constexpr std::size_t spare = 2;  // start and goal will follow
  if constexpr (std::same_as<typename W::State, Vec2>) {
    if (options.sampler == SamplerKind::lattice) {
      return lattice_milestones(world, options.lattice, count, execution, spare);
    }
  }
  if constexpr (CellWorld<W>) {
    if (options.sampler == SamplerKind::cell_centres) {
      return detail::cell_centre_milestones(world, execution, spare);
    }
  }
  execution.reserve(count * sizeof(typename W::State));
  std::vector<RawVector<typename W::State>> parts(chunk_count(count, grain));
  for_chunks(count, grain, execution, [&](Range r) {
    RawVector<typename W::State>& part = parts[r.first / grain];
    part.reserve(r.size());
    if (looks_at_obstacles(options.sampler)) {
      auto query = world.make_query();
      for (std::size_t i = r.first; i < r.last; ++i) {
        if (const auto state = obstacle_sample(world, options.sampler, options.seed, i, query)) part.push_back(*state);
      }
      return;
    }
    detail::append_free_samples(world, options, r, count, part);
  });
  RawVector<typename W::State> states = detail::joined(parts, execution, spare);
  parts.clear();
  return detail::in_tile_order(world, states, execution);
}

}  // namespace warren

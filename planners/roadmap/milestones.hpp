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

#include "core/base/bitmap.hpp"
#include "core/base/error.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/any_world.hpp"
#include "planners/graph/roadmap_options.hpp"
#include "planners/roadmap/sampler.hpp"
#include "spatial/points/point_grid.hpp"

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

/// The first two coordinates of the embeddings; the states themselves where they are points of the plane.
template <World W>
auto plane_positions(const W& world, const RawVector<typename W::State>& states, const Execution& execution) {
  if constexpr (std::same_as<typename W::State, Vec2>) {
    return std::span<const Vec2>(states);
  } else {
    constexpr std::size_t grain = std::size_t{1} << 14;
    RawVector<Vec2> positions(states.size());
    for_each_index(states.size(), grain, execution, [&](std::size_t i) {
      const auto point = world.embed(states[i]);
      positions[i] = {point[0], point[1]};
    });
    return positions;
  }
}

template <World W>
RawVector<typename W::State> in_tile_order(const W& world, const RawVector<typename W::State>& states,
                                           const Execution& execution) {
  constexpr std::size_t grain = std::size_t{1} << 14;
  execution.reserve(states.size() * (sizeof(Vec2) + 16 + sizeof(typename W::State)));
  const RawVector<std::uint32_t> order = tile_order(plane_positions(world, states, execution), execution);
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

// SPDX-License-Identifier: BSD-3-Clause
// Oracles of the grid planners' tests: a plain Dijkstra over a plain array, and a judge of cell paths that looks at
// nothing but the bitmap and the rule.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <queue>
#include <tuple>
#include <vector>

#include "core/base/bitmap.hpp"
#include "core/base/rng.hpp"
#include "planners/grid/grid_search.hpp"

namespace warren::grid_oracle {

inline bool may_step(const Bitmap& blocked, int x, int y, int dx, int dy, Diagonal diagonal) {
  const auto is_free = [&](int u, int v) {
    return u >= 0 && v >= 0 && u < static_cast<int>(blocked.width()) && v < static_cast<int>(blocked.height()) &&
           !blocked.holds(u, v);
  };
  if (dx == 0 && dy == 0) return false;
  if (dx != 0 && dy != 0) {
    return diagonal != Diagonal::none && is_free(x + dx, y + dy) && is_free(x + dx, y) && is_free(x, y + dy);
  }
  return is_free(x + dx, y + dy);
}

inline double step_cost(int dx, int dy, Diagonal diagonal) {
  return dx != 0 && dy != 0 && diagonal == Diagonal::sqrt2 ? std::sqrt(2.0) : 1.0;
}

/// Length of a shortest path; infinity if there is none.
inline double shortest(const Bitmap& blocked, Cell start, Cell goal, Diagonal diagonal) {
  const auto width = static_cast<int>(blocked.width());
  const double infinity = std::numeric_limits<double>::infinity();
  if (blocked.test(start.x, start.y) || blocked.test(goal.x, goal.y)) return infinity;
  std::vector<double> length(blocked.size(), infinity);
  using Entry = std::tuple<double, int, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto index = [&](int x, int y) { return static_cast<std::size_t>(y * width + x); };
  const auto sx = static_cast<int>(start.x);
  const auto sy = static_cast<int>(start.y);
  length[index(sx, sy)] = 0.0;
  queue.emplace(0.0, sx, sy);
  while (!queue.empty()) {
    const auto [d, x, y] = queue.top();
    queue.pop();
    if (d > length[index(x, y)]) continue;
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        if (!may_step(blocked, x, y, dx, dy, diagonal)) continue;
        const double through = d + step_cost(dx, dy, diagonal);
        if (through < length[index(x + dx, y + dy)]) {
          length[index(x + dx, y + dy)] = through;
          queue.emplace(through, x + dx, y + dy);
        }
      }
    }
  }
  return length[index(static_cast<int>(goal.x), static_cast<int>(goal.y))];
}

/// Cost of the cells as a path; infinity where a step is not allowed or an end is wrong.
inline double judged(const Bitmap& blocked, const std::vector<Cell>& cells, Cell start, Cell goal, Diagonal diagonal) {
  const double infinity = std::numeric_limits<double>::infinity();
  if (cells.empty() || !(cells.front() == start) || !(cells.back() == goal)) return infinity;
  double cost = 0.0;
  for (std::size_t i = 1; i < cells.size(); ++i) {
    const int x = static_cast<int>(cells[i - 1].x);
    const int y = static_cast<int>(cells[i - 1].y);
    const int dx = static_cast<int>(cells[i].x) - x;
    const int dy = static_cast<int>(cells[i].y) - y;
    if (std::abs(dx) > 1 || std::abs(dy) > 1 || !may_step(blocked, x, y, dx, dy, diagonal)) return infinity;
    cost += step_cost(dx, dy, diagonal);
  }
  return cost;
}

/// Blobs, walls with doors, or noise, by seed.
inline Bitmap random_map(std::uint64_t seed, std::uint32_t longest = 150) {
  const auto width = static_cast<std::uint32_t>(2 + random_bits(seed, 0, 0) % longest);
  const auto height = static_cast<std::uint32_t>(2 + random_bits(seed, 0, 1) % (longest / 2));
  Bitmap map(width, height);
  const double share = 0.45 * uniform(seed, 0, 2);
  if (seed % 3 == 0) {
    for (std::uint32_t y = 0; y < height; ++y) {
      for (std::uint32_t x = 0; x < width; ++x) {
        if (uniform(seed, 1 + x, y) < share) map.set(x, y);
      }
    }
  } else if (seed % 3 == 1) {
    for (std::uint32_t i = 0; i < width * height * share / 12; ++i) {
      const auto x = static_cast<std::uint32_t>(random_bits(seed, i, 3) % width);
      const auto y = static_cast<std::uint32_t>(random_bits(seed, i, 4) % height);
      const auto w = static_cast<std::uint32_t>(1 + random_bits(seed, i, 5) % 6);
      for (std::uint32_t v = y; v < std::min(height, y + w); ++v) map.set_run(v, x, std::min(width, x + 7 - w));
    }
  } else {
    for (std::uint32_t x = 3; x < width; x += 5) {
      for (std::uint32_t y = 0; y < height; ++y) map.set(x, y);
      map.clear(x, static_cast<std::uint32_t>(random_bits(seed, x, 6) % height));
      map.clear(x, static_cast<std::uint32_t>(random_bits(seed, x, 7) % height));
    }
  }
  return map;
}

inline Cell random_cell(const Bitmap& map, std::uint64_t seed, std::uint64_t index) {
  for (std::uint64_t i = 0; i < 50; ++i) {
    const Cell c{static_cast<std::uint32_t>(random_bits(seed, index, 2 * i + 8) % map.width()),
                 static_cast<std::uint32_t>(random_bits(seed, index, 2 * i + 9) % map.height())};
    if (!map.test(c.x, c.y)) return c;
  }
  return {};
}

}  // namespace warren::grid_oracle

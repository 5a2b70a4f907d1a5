// SPDX-License-Identifier: BSD-3-Clause
// Homotopy classes of paths over cells by other cuts than the planner's: from one cell of each hole a ray leads to the
// right, through whatever is there, rays of one row one above the other. And the cheapest paths of the cheapest classes
// by a Dijkstra over pairs of cell and word, with no bound on the words of a cell.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include "core/base/bitmap.hpp"
#include "tests/planners/grid/grid_oracle.hpp"

namespace warren::class_oracle {

using Word = std::vector<int>;

inline void append(Word& word, int letter) {
  if (!word.empty() && word.back() == -letter) {
    word.pop_back();
  } else {
    word.push_back(letter);
  }
}

/// The rightmost cell of each hole (of these the first), as the rays begin there.
inline std::vector<Cell> ray_starts(const Bitmap& blocked, double least) {
  std::set<std::pair<int, int>> seen;
  std::vector<Cell> starts;
  const auto width = static_cast<int>(blocked.width());
  const auto height = static_cast<int>(blocked.height());
  for (int x = 0; x < width; ++x) {
    for (int y = 0; y < height; ++y) {
      if (!blocked.holds(x, y) || seen.contains({x, y})) continue;
      std::vector<std::pair<int, int>> component{{x, y}};
      seen.insert({x, y});
      for (std::size_t i = 0; i < component.size(); ++i) {
        for (int dx = -1; dx <= 1; ++dx) {
          for (int dy = -1; dy <= 1; ++dy) {
            const std::pair<int, int> next{component[i].first + dx, component[i].second + dy};
            if (blocked.holds(next.first, next.second) && seen.insert(next).second) component.push_back(next);
          }
        }
      }
      int low_x = width;
      int high_x = 0;
      int low_y = height;
      int high_y = 0;
      for (const auto& [u, v] : component) {
        low_x = std::min(low_x, u);
        high_x = std::max(high_x, u);
        low_y = std::min(low_y, v);
        high_y = std::max(high_y, v);
      }
      if (low_x == 0 || low_y == 0 || high_x + 1 == width || high_y + 1 == height) continue;
      if (1 + std::max(high_x - low_x, high_y - low_y) < least) continue;
      for (const auto& [u, v] : component) {
        if (u != high_x) continue;
        starts.push_back({static_cast<std::uint32_t>(u), static_cast<std::uint32_t>(v)});
        break;
      }
    }
  }
  return starts;
}

/// A step up from row y leaves it to the right of what begins in that row, across its rays from the lowest on.
inline void step(Word& word, const std::vector<Cell>& rays, Cell from, Cell to) {
  if (from.y == to.y) return;
  const bool up = to.y > from.y;
  const Cell lower = up ? from : to;
  const auto crosses = [&](const Cell& ray) { return ray.y == lower.y && lower.x > ray.x; };
  const auto count = static_cast<int>(rays.size());
  for (int n = 0; n < count; ++n) {
    const int i = up ? n : count - 1 - n;
    if (crosses(rays[static_cast<std::size_t>(i)])) append(word, up ? i + 1 : -(i + 1));
  }
}

inline Word word_of(const std::vector<Cell>& rays, const std::vector<Cell>& cells) {
  Word word;
  for (std::size_t i = 1; i < cells.size(); ++i) step(word, rays, cells[i - 1], cells[i]);
  return word;
}

using Weigh = std::function<std::uint64_t(Cell, Cell)>;

/// The costs of the cheapest classes, at most so many times the least; none where that takes too many states.
inline std::optional<std::vector<std::uint64_t>> cheapest(const Bitmap& blocked, const std::vector<Cell>& rays,
                                                          const Weigh& weigh, Cell start, Cell goal, std::size_t count,
                                                          double stretch) {
  std::map<std::tuple<std::uint32_t, std::uint32_t, Word>, std::uint64_t> best;
  std::set<std::tuple<std::uint64_t, std::uint32_t, std::uint32_t, Word>> open;
  std::vector<std::uint64_t> costs;
  open.emplace(0, start.x, start.y, Word{});
  best[{start.x, start.y, {}}] = 0;
  constexpr std::size_t most = 30'000;
  while (!open.empty() && costs.size() < count) {
    if (best.size() > most) return std::nullopt;
    const auto [cost, x, y, word] = *open.begin();
    open.erase(open.begin());
    if (!costs.empty() && static_cast<double>(cost) > stretch * static_cast<double>(costs.front())) break;
    if (Cell{x, y} == goal) costs.push_back(cost);
    for (int dx = -1; dx <= 1; ++dx) {
      for (int dy = -1; dy <= 1; ++dy) {
        if (!grid_oracle::may_step(blocked, static_cast<int>(x), static_cast<int>(y), dx, dy, Diagonal::sqrt2))
          continue;
        const Cell to{x + static_cast<std::uint32_t>(dx), y + static_cast<std::uint32_t>(dy)};
        Word next = word;
        step(next, rays, {x, y}, to);
        const std::uint64_t there = cost + weigh({x, y}, to);
        const auto [known, is_new] = best.try_emplace({to.x, to.y, next}, there);
        if (!is_new) {
          if (known->second <= there) continue;
          open.erase({known->second, to.x, to.y, next});
          known->second = there;
        }
        open.emplace(there, to.x, to.y, next);
      }
    }
  }
  return costs;
}

}  // namespace warren::class_oracle

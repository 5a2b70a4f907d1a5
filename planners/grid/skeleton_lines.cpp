// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/skeleton_lines.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "parallel/polled_sort.hpp"
#include "planners/grid/map_skeleton.hpp"
#include "planners/grid/numbered_cells.hpp"

namespace warren {
namespace {

constexpr std::size_t cells_per_poll = 4096;

/// Follows the skeleton from side to side: chains of cells with two neighbours each, between those that have more or
/// fewer. One use.
class LinesOfSkeleton {
 public:
  LinesOfSkeleton(const SkeletonRoadmap& roadmap, const Execution& execution)
      : blocked_(roadmap.blocked),
        execution_(execution),
        cells_(map_skeleton(roadmap.blocked, roadmap.field, {}, execution, SkeletonEnds::stay)),
        passed_(cells_.size(), 0) {}

  SkeletonLines run() {
    for (VertexId v = 0; v < cells_.size(); ++v) {
      poll(v);
      if (neighbours(v).size() != 2) follow_all(v);
    }
    for (VertexId v = 0; v < cells_.size(); ++v) {  // what is left are rings
      poll(v);
      if (passed_[v] == 0 && neighbours(v).size() == 2) follow(v, neighbours(v).front());
    }
    return numbered();
  }

 private:
  struct Neighbours {
    std::array<VertexId, 4> cell{};
    std::size_t count = 0;
    std::size_t size() const { return count; }
    VertexId front() const { return cell[0]; }
    auto begin() const { return cell.begin(); }
    auto end() const { return cell.begin() + static_cast<std::ptrdiff_t>(count); }
  };

  void poll(std::size_t i) const {
    if (i % cells_per_poll == 0) execution_.check();
  }
  Neighbours neighbours(VertexId v) const {
    constexpr std::array<std::array<int, 2>, 4> sides{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    Neighbours found;
    const Cell c = cells_.cell(v);
    for (const auto& [dx, dy] : sides) {
      const std::int64_t x = std::int64_t{c.x} + dx;
      const std::int64_t y = std::int64_t{c.y} + dy;
      if (!cells_.holds(x, y)) continue;
      found.cell[found.count++] = cells_.number(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
    }
    return found;
  }

  /// Each chain once: from the end that comes first, or from either where it is walked by its own cells.
  void follow_all(VertexId v) {
    passed_[v] = 1;
    for (const VertexId next : neighbours(v)) {
      const bool chain = neighbours(next).size() == 2;
      if (chain ? passed_[next] == 0 : v < next) follow(v, next);
    }
    if (neighbours(v).size() == 0) points_.push_back(v);
  }

  /// From one cell over the next to where the chain ends, or closes.
  void follow(VertexId from, VertexId next) {
    chain_.assign({from, next});
    while (next != from && neighbours(next).size() == 2) {
      poll(chain_.size());
      passed_[next] = 1;
      const Neighbours near = neighbours(next);
      const VertexId before = chain_[chain_.size() - 2];
      next = near.cell[0] == before ? near.cell[1] : near.cell[0];
      chain_.push_back(next);
    }
    passed_[from] = 1;
    cut_corners();
    add_lines();
  }

  std::pair<std::int64_t, std::int64_t> step(VertexId v, VertexId w) const {
    const Cell a = cells_.cell(v);
    const Cell b = cells_.cell(w);
    return {std::int64_t{b.x} - a.x, std::int64_t{b.y} - a.y};
  }
  bool is_diagonal(VertexId v, VertexId w) const {
    const auto [dx, dy] = step(v, w);
    const Cell a = cells_.cell(v);
    return dx != 0 && dy != 0 && !blocked_.holds(a.x + dx, a.y) && !blocked_.holds(a.x, a.y + dy);
  }

  /// Two steps round a corner become one across it, from the chain's begin on.
  void cut_corners() {
    std::size_t kept = 1;
    for (std::size_t i = 1; i < chain_.size(); ++i) {
      if (i + 1 < chain_.size() && is_diagonal(chain_[kept - 1], chain_[i + 1])) ++i;
      chain_[kept++] = chain_[i];
    }
    chain_.resize(kept);
  }

  void add_lines() {
    VertexId begin = chain_.front();
    for (std::size_t i = 1; i < chain_.size(); ++i) {
      const bool goes_on = i + 1 < chain_.size() && step(chain_[i - 1], chain_[i]) == step(chain_[i], chain_[i + 1]);
      if (goes_on) continue;
      if (begin != chain_[i]) lines_.push_back({std::min(begin, chain_[i]), std::max(begin, chain_[i])});
      begin = chain_[i];
    }
  }

  /// Cells that are vertices, numbered in their order.
  SkeletonLines numbered() {
    for (const Edge& line : lines_) points_.insert(points_.end(), {line.from, line.to});
    polled_sort(points_.begin(), points_.end(), execution_);
    points_.erase(std::unique(points_.begin(), points_.end()), points_.end());
    polled_sort(lines_.begin(), lines_.end(), execution_);
    lines_.erase(std::unique(lines_.begin(), lines_.end()), lines_.end());
    const auto number = [&](VertexId v) {
      return static_cast<VertexId>(std::lower_bound(points_.begin(), points_.end(), v) - points_.begin());
    };
    SkeletonLines result;
    for (const VertexId v : points_) result.cells.push_back(cells_.cell(v));
    for (const Edge& line : lines_) result.edges.push_back({number(line.from), number(line.to)});
    return result;
  }

  const Bitmap& blocked_;
  const Execution& execution_;
  NumberedCells cells_;
  std::vector<std::uint8_t> passed_;
  std::vector<VertexId> chain_;
  std::vector<VertexId> points_;
  std::vector<Edge> lines_;
};

}  // namespace

SkeletonLines skeleton_lines(const SkeletonRoadmap& roadmap, const Execution& execution) {
  return LinesOfSkeleton(roadmap, execution).run();
}

}  // namespace warren

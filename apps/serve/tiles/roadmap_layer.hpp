// SPDX-License-Identifier: BSD-3-Clause
// A roadmap as tiles above the world: its milestones and free edges, in one ink, by component, or by how far they are
// from a start.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "apps/serve/tiles/web_tile.hpp"
#include "core/base/items_by_key.hpp"
#include "planners/graph/roadmap_arrays.hpp"
#include "planners/lengths/core_graph.hpp"
#include "solve/kept/roadmap_query.hpp"

namespace warren::serve {
/// A roadmap's milestones and free edges by place. Milestones are filed in a grid; an edge is found by its ends, which
/// are no farther from a box that it meets than it is long. The few longest are in a list of their own: one of them
/// would let each box look at all edges. Immutable; any number of threads may look.
class PlacedRoadmap {
 public:
  struct Edge {
    VertexId from, to;
  };
  /// Refers to the arrays. Four bytes a milestone, eight more meanwhile, and eight for one free edge in 256. Throws
  /// Stopped.
  PlacedRoadmap(const RoadmapParts& parts, const Execution& execution);

  Vec2 at(VertexId v) const { return {parts_.state(v)[0], parts_.state(v)[1]}; }
  std::uint64_t milestones() const { return by_cell_.items.size(); }
  std::uint64_t free_edges() const { return free_edges_; }
  /// Visits milestones in the box until visit says false. Throws Stopped.
  template <class Visit>
  void for_each_milestone(const Box& box, const Execution& execution, const Visit& visit) const {
    const std::size_t right = column(box.max.x);
    const std::size_t top = row(box.max.y);
    std::size_t seen = 0;
    for (std::size_t y = row(box.min.y); y <= top; ++y) {
      for (std::size_t x = column(box.min.x); x <= right; ++x) {
        if (seen++ % 256 == 0) execution.check();
        for (const VertexId v : by_cell_.of(y * side_ + x)) {
          if (seen++ % 1024 == 0) execution.check();
          if (box.contains(at(v)) && !visit(v)) return;
        }
      }
    }
  }
  /// Visits each free edge that may meet the box once, until visit says false. Throws Stopped.
  template <class Visit>
  void for_each_edge_near(const Box& box, const Execution& execution, const Visit& visit) const {
    for (std::size_t i = 0; i < long_edges_.size(); ++i) {
      if (i % 1024 == 0) execution.check();
      if (!visit(long_edges_[i])) return;
    }
    for_each_milestone(box.grown(reach_), execution, [&](VertexId v) {
      return for_each_edge_of(v, [&](Edge edge) { return length(edge) > reach_ || visit(edge); });
    });
  }

 private:
  /// Visits the free edges that v has, each of one end alone, until visit says false; true: it never did.
  template <class Visit>
  bool for_each_edge_of(VertexId v, const Visit& visit) const {
    for (std::size_t end = parts_.first[v]; end < parts_.first[v + 1]; ++end) {
      const Edge edge{v, parts_.to[end]};
      if (!parts_.directed && v >= edge.to) continue;
      if (parts_.state_of_end(end) == EdgeState::free && !visit(edge)) return false;
    }
    return true;
  }
  double length(Edge edge) const;
  std::size_t cell_at(double share) const;
  std::size_t column(double x) const { return cell_at((x - box_.min.x) / std::max(box_.width(), 1e-300)); }
  std::size_t row(double y) const { return cell_at((y - box_.min.y) / std::max(box_.height(), 1e-300)); }
  void file_milestones(const Execution& execution);
  void part_long_edges(const Execution& execution);

  RoadmapParts parts_;
  Box box_;               // of all milestones
  std::size_t side_ = 1;  // of the grid, in cells
  ItemsByKey by_cell_;    // milestones
  std::uint64_t free_edges_ = 0;
  double reach_ = 0.0;  // the length of the longest edge that is not in long_edges_
  std::vector<Edge> long_edges_;
};

/// A tile with more edges shows its milestones alone, each a pixel, which from afar are a shade.
inline constexpr std::size_t most_drawn_edges = 20'000;
/// Of the largest components, the largest first; the last one is for all others.
inline constexpr std::array<Rgb, 8> component_inks{{colors::series[0],
                                                    colors::series[1],
                                                    colors::series[2],
                                                    colors::series[3],
                                                    colors::series[4],
                                                    colors::series[5],
                                                    colors::series[7],
                                                    {138, 146, 158}}};

enum class RoadmapInk : std::uint8_t { one, by_component };

/// Immutable; any number of threads may draw.
class RoadmapLayer : public PlacedRoadmap {
 public:
  /// Refers to the arrays. Six bytes a milestone, and eight more meanwhile. Throws Stopped.
  RoadmapLayer(const RoadmapParts& parts, const Execution& execution);

  /// A PNG of what lies in the box. Throws Stopped.
  std::string draw(const Box& box, double pixel, RoadmapInk ink, const Execution& execution) const;
  /// The same with which of at most 16 inks each milestone has; none: all have the first.
  std::string draw(const Box& box, double pixel, std::span<const Rgb> inks, std::span<const std::uint8_t> of_milestone,
                   const Execution& execution) const;
  /// Milestones in each of component_inks.
  const std::array<std::uint64_t, component_inks.size()>& milestones_of_ink() const { return of_ink_; }
  /// Components that share the last ink.
  std::uint64_t small_components() const { return small_components_; }

 private:
  std::vector<std::uint8_t> ranks_;
  std::array<std::uint64_t, component_inks.size()> of_ink_ = {};
  std::uint64_t small_components_ = 0;
};

/// Of a milestone that the start does not reach, beside the steps' own numbers.
inline constexpr std::uint8_t unreached_ink = step_inks.size();

/// How far the milestones of a roadmap are from a start, along its free edges: what a layer of the service colours.
struct StartDistances {
  std::vector<std::uint8_t> inks;  ///< one a milestone: the step of its distance, or unreached_ink
  Steps steps;
  std::uint64_t reached = 0;
  double farthest = 0.0;  ///< 0 where none is reached
};

/// Of points and discs in a roadmap whose edges are checked, by one search from the start, which is linked as a
/// question links it. start: two numbers. Throws UsageError where the body does not fit there or the roadmap is another
/// one, InputError, Stopped.
StartDistances start_distances(const RoadmapQuery& query, const std::vector<double>& start, const Execution& execution);

/// A PNG of the passages of a maze's lattice, from middle to middle of unit cells, the first of which is at (1, 1):
/// empty where a cell has less than 8 pixels. Throws Stopped.
std::string draw_passages(const LatticePassages& passages, const Box& box, double pixel, const Execution& execution);
/// Tiles whose pixels are larger show no passages.
inline constexpr double largest_pixel_of_passages = 1.0 / 8.0;

}  // namespace warren::serve

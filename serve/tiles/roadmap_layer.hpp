// SPDX-License-Identifier: BSD-3-Clause
// A roadmap as tiles above the world: its milestones and free edges, in one ink or by component. Milestones are filed
// by place; an edge is found by its ends, which are no farther from a tile that it meets than the longest edge is long.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "parallel/execution.hpp"
#include "pictures/model/colors.hpp"
#include "planners/route_trees/lattice_passages.hpp"
#include "roadmaps/graph/roadmap_parts.hpp"
#include "serve/tiles/tile_grid.hpp"

namespace warren {

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
                                                    {148, 156, 168}}};

enum class RoadmapInk : std::uint8_t { one, by_component };

/// Immutable; any number of threads may draw.
class RoadmapLayer {
 public:
  /// Refers to the arrays. Six bytes a milestone, and eight more meanwhile. Throws Stopped.
  RoadmapLayer(const RoadmapParts& parts, const Execution& execution);

  /// A PNG of what lies in the box. Throws Stopped.
  std::string draw(const Box& box, double pixel, RoadmapInk ink, const Execution& execution) const;
  /// Which of component_inks the milestone has.
  std::uint8_t rank(VertexId v) const { return ranks_[v]; }
  std::uint64_t milestones() const { return order_.size(); }
  std::uint64_t free_edges() const { return free_edges_; }
  /// Milestones in each of component_inks.
  const std::array<std::uint64_t, component_inks.size()>& milestones_of_ink() const { return of_ink_; }
  /// Components that share the last ink.
  std::uint64_t small_components() const { return small_components_; }

 private:
  struct Edge {
    VertexId from, to;
  };
  Vec2 at(VertexId v) const;
  std::size_t cell_at(double share) const;
  std::size_t column(double x) const;
  std::size_t row(double y) const;
  void file_milestones(const Execution& execution);
  void measure_edges(const Execution& execution);
  void rank_components(const Execution& execution);
  template <class Visit>
  void for_each_in(const Box& box, const Execution& execution, const Visit& visit) const;
  std::vector<Edge> edges_in(const Box& box, const Execution& execution) const;

  RoadmapParts parts_;
  Box box_;                           // of all milestones
  std::size_t side_ = 1;              // of the grid, in cells
  double longest_ = 0.0;              // of the free edges, by x or y
  std::vector<std::uint32_t> first_;  // of each cell, in order_
  std::vector<VertexId> order_;
  std::vector<std::uint8_t> ranks_;
  std::uint64_t free_edges_ = 0;
  std::array<std::uint64_t, component_inks.size()> of_ink_ = {};
  std::uint64_t small_components_ = 0;
};

/// A PNG of the passages of a maze's lattice, from middle to middle of unit cells, the first of which is at (1, 1):
/// empty where a cell has less than 8 pixels. Throws Stopped.
std::string draw_passages(const LatticePassages& passages, const Box& box, double pixel, const Execution& execution);
/// Are there passages in tiles of such pixels?
constexpr bool shows_passages(double pixel) { return pixel <= 1.0 / 8.0; }

}  // namespace warren

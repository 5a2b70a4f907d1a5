// SPDX-License-Identifier: BSD-3-Clause
// A roadmap as tiles above the world: its milestones and free edges, in one ink or by component.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "parallel/execution.hpp"
#include "pictures/model/colors.hpp"
#include "planners/route_trees/lattice_passages.hpp"
#include "roadmaps/graph/roadmap_parts.hpp"
#include "serve/tiles/placed_roadmap.hpp"
#include "serve/tiles/tile_grid.hpp"

namespace warren::serve {

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
class RoadmapLayer {
 public:
  /// Refers to the arrays. Six bytes a milestone, and eight more meanwhile. Throws Stopped.
  RoadmapLayer(const RoadmapParts& parts, const Execution& execution);

  /// A PNG of what lies in the box. Throws Stopped.
  std::string draw(const Box& box, double pixel, RoadmapInk ink, const Execution& execution) const;
  /// The same with which of at most 16 inks each milestone has; none: all have the first.
  std::string draw(const Box& box, double pixel, std::span<const Rgb> inks, std::span<const std::uint8_t> of_milestone,
                   const Execution& execution) const;
  /// Which of component_inks the milestone has.
  std::uint8_t rank(VertexId v) const { return ranks_[v]; }
  std::uint64_t milestones() const { return placed_.milestones(); }
  std::uint64_t free_edges() const { return placed_.free_edges(); }
  /// Milestones in each of component_inks.
  const std::array<std::uint64_t, component_inks.size()>& milestones_of_ink() const { return of_ink_; }
  /// Components that share the last ink.
  std::uint64_t small_components() const { return small_components_; }

 private:
  void rank_components(std::span<const VertexId> component, const Execution& execution);
  std::vector<PlacedRoadmap::Edge> edges_in(const Box& box, const Execution& execution) const;

  PlacedRoadmap placed_;
  std::vector<std::uint8_t> ranks_;
  std::array<std::uint64_t, component_inks.size()> of_ink_ = {};
  std::uint64_t small_components_ = 0;
};

/// A PNG of the passages of a maze's lattice, from middle to middle of unit cells, the first of which is at (1, 1):
/// empty where a cell has less than 8 pixels. Throws Stopped.
std::string draw_passages(const LatticePassages& passages, const Box& box, double pixel, const Execution& execution);
/// Tiles whose pixels are larger show no passages.
inline constexpr double largest_pixel_of_passages = 1.0 / 8.0;

}  // namespace warren::serve

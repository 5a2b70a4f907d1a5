// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/tiles/roadmap_layer.hpp"

#include <cmath>
#include <cstddef>

#include "core/base/error.hpp"
#include "core/search/search.hpp"
#include "parallel/sort.hpp"
#include "pictures/formats/raster.hpp"
#include "pictures/model/picture.hpp"
#include "planners/graph/roadmap_search.hpp"

namespace warren::serve {
namespace {

// A tile that lies above the world's: lines and dots in a few inks, transparent where there are none. Where inks meet,
// a pixel has the one that covers most of it.

constexpr unsigned shades = 15;  // of an ink, beside none

/// Of one thread.
class InkTile {
 public:
  /// At most 16 inks, which outlive it. What draws asks the execution for a quarter of a MiB an ink that is used.
  InkTile(std::span<const Rgb> inks, const Execution& execution)
      : inks_(inks), execution_(execution), masks_(inks.size()) {}

  /// The pixels of that ink.
  Mask& of(std::size_t ink) {
    if (!masks_[ink]) masks_[ink].emplace(TileGrid::pixels, TileGrid::pixels, execution_);
    return *masks_[ink];
  }
  /// A PNG. Throws Stopped.
  std::string png() const {
    std::vector<std::uint8_t> opacities;
    for (unsigned shade = 1; shade <= shades; ++shade) {
      opacities.push_back(static_cast<std::uint8_t>(255 * shade / shades));
    }
    PixelTile tile;
    for (std::size_t i = 0; i < tile.bytes.size(); ++i) {
      unsigned most = 0;
      for (std::size_t ink = 0; ink < masks_.size(); ++ink) {
        const unsigned shade = masks_[ink] ? masks_[ink]->pixels()[i] >> 4U : 0;
        if (shade <= most) continue;
        most = shade;
        tile.bytes[i] = static_cast<std::uint8_t>(shades * ink + shade);
      }
    }
    return png_of_inks(tile, inks_, opacities, execution_);
  }

 private:
  std::span<const Rgb> inks_;
  const Execution& execution_;
  std::vector<std::optional<Mask>> masks_;
};

constexpr double edge_pixels = 1.3;
constexpr double milestone_pixels = 4.0;
constexpr double edge_opacity = 0.75;
constexpr double far_opacity = 0.6;
/// One edge in so many may be in the list that each box looks at.
constexpr std::uint64_t edges_a_long_one = 256;

/// The free edges, with the start as the last but one: a question from a place to itself links it, and hands them out.
PlannedRoadmap<Vec2> linked(const RoadmapQuery& query, const std::vector<double>& start, const Execution& execution) {
  const RoadmapParts parts = query.roadmap().arrays.parts();
  execution.reserve(parts.to.size_bytes() + (parts.first.size() * (sizeof(Vec2) + sizeof(EdgeEnd))));
  QuestionScratch scratch;
  ByProducts kept;
  const Answer answer = query.ask_within(start, start, {}, execution, scratch, &kept);
  if (answer.outcome == Outcome::stopped) throw Stopped(answer.stop_reason.value_or(StopReason::time));
  if (answer.outcome == Outcome::start_blocked) throw UsageError("from: the body does not fit there");
  if (kept.roadmap.states.size() != count_states(query.roadmap()) + 2) {
    throw UsageError("from: a roadmap of this kind does not say how the start is linked");
  }
  return std::move(kept.roadmap);
}

SearchState searched(const PlannedRoadmap<Vec2>& roadmap, const Execution& execution) {
  const std::size_t count = roadmap.states.size();
  const auto next = [&](VertexId v, const auto& visit) {
    for (const VertexId w : roadmap.graph.neighbours(v)) visit(w, distance(roadmap.states[v], roadmap.states[w]));
  };
  const auto no_estimate = [](VertexId) { return 0.0; };
  SearchState state;
  search_best_first(QueueKind::heap, count, static_cast<VertexId>(count - 2), no_vertex, next, no_estimate, state,
                    execution);
  execution.check();
  return state;
}

}  // namespace

RoadmapLayer::RoadmapLayer(const RoadmapParts& parts, const Execution& execution) : PlacedRoadmap(parts, execution) {
  const std::span<const VertexId> component = parts.component;
  constexpr auto others = static_cast<std::uint8_t>(component_inks.size() - 1);
  const std::size_t count = component.size();
  execution.reserve(count * (2 * sizeof(std::uint32_t) + 1));
  ranks_ = component_ranks(component, others, execution);
  for (VertexId v = 0; v < count; ++v) {
    execution.poll(v);
    ++of_ink_[ranks_[v]];
    if (component[v] == v && ranks_[v] == others) ++small_components_;
  }
}

std::string RoadmapLayer::draw(const Box& box, double pixel, RoadmapInk ink, const Execution& execution) const {
  if (ink == RoadmapInk::one) return draw(box, pixel, std::span(component_inks).first(1), {}, execution);
  return draw(box, pixel, component_inks, ranks_, execution);
}

std::string RoadmapLayer::draw(const Box& box, double pixel, std::span<const Rgb> inks,
                               std::span<const std::uint8_t> of_milestone, const Execution& execution) const {
  const OnTile on_tile{box, pixel};
  InkTile tile(inks, execution);
  const Box reach = box.grown(milestone_pixels * pixel);
  std::vector<Edge> edges;  // one more than are drawn where there are too many
  for_each_edge_near(reach, execution, [&](Edge edge) {
    if (reach.meets(box_of({at(edge.from), at(edge.to)}))) edges.push_back(edge);
    return edges.size() <= most_drawn_edges;
  });
  const bool is_far = edges.size() > most_drawn_edges;
  for (std::size_t i = 0; i < edges.size() && !is_far; ++i) {
    if (i % 64 == 0) execution.check();
    const auto [from, to] = edges[i];
    Mask& mask = tile.of(of_milestone.empty() ? 0 : std::max(of_milestone[from], of_milestone[to]));
    mask.draw_line(on_tile(at(from)), on_tile(at(to)), edge_pixels, edge_opacity);
  }
  for_each_milestone(reach, execution, [&](VertexId v) {
    const Vec2 p = on_tile(at(v));
    tile.of(of_milestone.empty() ? 0 : of_milestone[v])
        .draw_line(p, p, is_far ? 1.0 : milestone_pixels, is_far ? far_opacity : 1.0);
    return true;
  });
  return tile.png();
}

StartDistances start_distances(const RoadmapQuery& query, const std::vector<double>& start,
                               const Execution& execution) {
  const PlannedRoadmap<Vec2> roadmap = linked(query, start, execution);
  const SearchState state = searched(roadmap, execution);
  StartDistances found;
  execution.reserve(roadmap.states.size());
  found.inks.assign(roadmap.states.size() - 2, unreached_ink);
  for (VertexId v = 0; v < found.inks.size(); ++v) {
    execution.poll(v);
    if (!state.reached(v)) continue;
    ++found.reached;
    found.farthest = std::max(found.farthest, state.g(v));
  }
  found.steps = Steps::up_to(found.farthest, found.farthest);
  for (VertexId v = 0; v < found.inks.size(); ++v) {
    execution.poll(v);
    if (state.reached(v)) found.inks[v] = static_cast<std::uint8_t>(found.steps.of(state.g(v)));
  }
  return found;
}

std::string draw_passages(const LatticePassages& passages, const Box& box, double pixel, const Execution& execution) {
  InkTile tile(std::span<const Rgb>(component_inks).first(1), execution);
  const OnTile on_tile{box, pixel};
  const LatticeSize size = passages.size();
  const auto cell = [](double at, std::uint32_t count) {
    return static_cast<std::uint32_t>(std::clamp(std::floor(at) - 1.0, 0.0, count - 1.0));
  };
  const std::uint32_t right = cell(box.max.x + 1.0, size.cols);
  const std::uint32_t top = cell(box.max.y + 1.0, size.rows);
  for (std::uint32_t y = cell(box.min.y, size.rows); y <= top && pixel <= largest_pixel_of_passages; ++y) {
    execution.check();
    for (std::uint32_t x = cell(box.min.x, size.cols); x <= right; ++x) {
      const unsigned open = passages.open_at(x, y);
      const Vec2 middle{x + 1.0, y + 1.0};
      const auto passage = [&](Vec2 to) {
        tile.of(0).draw_line(on_tile(middle), on_tile(middle + to), edge_pixels, edge_opacity);
      };
      if ((open & 1U) != 0) passage({1, 0});
      if ((open & 2U) != 0) passage({0, 1});
      if (open != 0) tile.of(0).draw_line(on_tile(middle), on_tile(middle), milestone_pixels);
    }
  }
  return tile.png();
}

PlacedRoadmap::PlacedRoadmap(const RoadmapParts& parts, const Execution& execution) : parts_(parts) {
  file_milestones(execution);
  part_long_edges(execution);
}

std::size_t PlacedRoadmap::cell_at(double share) const {
  const auto side = static_cast<double>(side_);
  return static_cast<std::size_t>(std::clamp(share * side, 0.0, side - 1.0));
}

double PlacedRoadmap::length(Edge edge) const {
  const Vec2 off = at(edge.to) - at(edge.from);
  return std::max(std::abs(off.x), std::abs(off.y));
}

void PlacedRoadmap::file_milestones(const Execution& execution) {
  constexpr std::size_t milestones_a_cell = 8;
  constexpr std::size_t most_side = 1024;
  const std::size_t count = parts_.vertex_count();
  const double cells = static_cast<double>(count) / milestones_a_cell;
  side_ = std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(cells)), 1, most_side);
  for (VertexId v = 0; v < count; ++v) {
    execution.poll(v);
    box_.include(at(v));
  }
  by_cell_ = counting_sort(count, side_ * side_, execution, [&](std::size_t v) {
    const Vec2 p = at(static_cast<VertexId>(v));
    return row(p.y) * side_ + column(p.x);
  });
}

void PlacedRoadmap::part_long_edges(const Execution& execution) {
  constexpr int least_exponent = -1074;
  constexpr int most_exponent = 1024;
  std::array<std::uint64_t, most_exponent - least_exponent + 1> of_bin{};  // edges
  const auto bin = [&](Edge edge) -> std::size_t {
    const double how_long = length(edge);
    int exponent = least_exponent;
    if (how_long > 0.0) std::frexp(how_long, &exponent);  // of 0 it says 0, the exponent of 0.5
    return static_cast<std::size_t>(std::clamp(exponent, least_exponent, most_exponent) - least_exponent);
  };
  const auto for_each_edge = [&](const auto& visit) {
    for (VertexId v = 0; v < parts_.vertex_count(); ++v) {
      if (v % 1024 == 0) execution.check();
      for_each_edge_of(v, [&](Edge edge) { return visit(edge), true; });
    }
  };
  for_each_edge([&](Edge edge) {
    ++free_edges_;
    ++of_bin[bin(edge)];
  });
  const std::uint64_t most_long = free_edges_ / edges_a_long_one;
  std::size_t first_long = of_bin.size();
  std::uint64_t longer = 0;
  while (first_long > 1 && longer + of_bin[first_long - 1] <= most_long) longer += of_bin[--first_long];
  execution.reserve(longer * sizeof(Edge));
  long_edges_.reserve(longer);
  for_each_edge([&](Edge edge) {
    if (bin(edge) >= first_long) {
      long_edges_.push_back(edge);
    } else {
      reach_ = std::max(reach_, length(edge));
    }
  });
}

}  // namespace warren::serve

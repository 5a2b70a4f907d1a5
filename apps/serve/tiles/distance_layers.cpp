// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/tiles/distance_layers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/base/error.hpp"
#include "core/search/search.hpp"
#include "parallel/chunks.hpp"
#include "planners/graph/queue_choice.hpp"

namespace warren::serve {
namespace {

constexpr std::size_t row_pixels = TileGrid::pixels;
constexpr std::size_t stride = 4;  // pixels, of places between which a distance is told by theirs
constexpr std::size_t rows_a_chunk = 16;

/// At the middles of squares into which the box is cut. Nothing of those that are no number.
std::vector<double> some_distances(const PlaceDistances& distances, const Box& box, const Execution& execution) {
  constexpr std::size_t squares = 61;  // of a side: no divisor of what worlds are made of
  std::vector<double> found(squares * squares);
  for_chunks(squares, 1, execution, [&](Range rows) {
    for (std::size_t i = rows.first * squares; i < rows.last * squares; ++i) {
      const double x = (static_cast<double>(i % squares) + 0.5) / squares;
      const double y = (static_cast<double>(i / squares) + 0.5) / squares;
      found[i] = distances.at({box.min.x + x * box.width(), box.min.y + y * box.height()});
    }
  });
  std::erase_if(found, [](double d) { return !std::isfinite(d); });
  return found;
}

Steps steps_of(std::vector<double> some) {
  if (some.empty()) return {};
  std::sort(some.begin(), some.end());
  return Steps::up_to(some[some.size() - 1 - some.size() / 20], some.back());
}

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

ClearanceLayer::ClearanceLayer(const WorldTiles& tiles, const Box& box, double needed, const Execution& execution)
    : grid_(tiles.grid()),
      largest_pixel_(tiles.largest_pixel_of_distances()),
      distances_(tiles.distances(execution)),
      needed_(needed),
      steps_(steps_of(some_distances(*distances_, box, execution))) {}

/// 0 for what is no number.
std::uint8_t ClearanceLayer::ink_of(double distance) const {
  if (!(distance >= 0.0)) return 0;
  if (distance < needed_) return static_cast<std::uint8_t>(step_inks.size() + 1);
  return static_cast<std::uint8_t>(steps_.of(distance) + 1);
}

std::string ClearanceLayer::draw(const TilePlace& place, const Execution& execution) const {
  PixelTile tile;
  const Box box = grid_.box_of(place);
  const double pixel = grid_.pixel(place.zoom);
  if (pixel <= largest_pixel_) {
    if (distances_->are_dear()) {
      draw_between(tile, box, pixel, execution);
    } else {
      draw_each(tile, box, pixel, execution);
    }
    distances_->leave_out(tile, box, pixel, execution);
  }
  std::array<Rgb, step_inks.size() + 1> inks;
  std::copy(step_inks.begin(), step_inks.end(), inks.begin());
  inks.back() = too_near_ink;
  return png_of_steps(tile, inks, execution);
}

void ClearanceLayer::draw_each(PixelTile& tile, const Box& box, double pixel, const Execution& execution) const {
  for_chunks(row_pixels, rows_a_chunk, execution, [&](Range rows) {
    for (std::size_t y = rows.first; y < rows.last; ++y) {
      for (std::size_t x = 0; x < row_pixels; ++x) {
        const Vec2 middle{static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5};
        tile.at(x, y) = ink_of(distances_->at({box.min.x + middle.x * pixel, box.max.y - middle.y * pixel}));
      }
    }
  });
}

/// Distances change by no more than the way, so between places they are off by less than that between these.
void ClearanceLayer::draw_between(PixelTile& tile, const Box& box, double pixel, const Execution& execution) const {
  constexpr std::size_t places = row_pixels / stride + 1;  // of a row, both ends included
  std::vector<double> found(places * places);
  const double way = static_cast<double>(stride) * pixel;
  for_chunks(places, 1, execution, [&](Range rows) {
    for (std::size_t i = rows.first * places; i < rows.last * places; ++i) {
      found[i] = distances_->at(
          {box.min.x + static_cast<double>(i % places) * way, box.max.y - static_cast<double>(i / places) * way});
    }
  });
  const auto mixed = [](double a, double b, double share) { return a + share * (b - a); };
  for (std::size_t y = 0; y < row_pixels; ++y) {
    const double down = (static_cast<double>(y % stride) + 0.5) / stride;
    for (std::size_t x = 0; x < row_pixels; ++x) {
      const double right = (static_cast<double>(x % stride) + 0.5) / stride;
      const double* at = &found[y / stride * places + x / stride];
      tile.at(x, y) = ink_of(mixed(mixed(at[0], at[1], right), mixed(at[places], at[places + 1], right), down));
    }
  }
}

StartDistances start_distances(const RoadmapQuery& query, const std::vector<double>& start,
                               const Execution& execution) {
  const PlannedRoadmap<Vec2> roadmap = linked(query, start, execution);
  const SearchState state = searched(roadmap, execution);
  constexpr VertexId polled = VertexId{1} << 16U;
  StartDistances found;
  execution.reserve(roadmap.states.size());
  found.inks.assign(roadmap.states.size() - 2, unreached_ink);
  for (VertexId v = 0; v < found.inks.size(); ++v) {
    if (v % polled == 0) execution.check();
    if (!state.reached(v)) continue;
    ++found.reached;
    found.farthest = std::max(found.farthest, state.g(v));
  }
  found.steps = Steps::up_to(found.farthest, found.farthest);
  for (VertexId v = 0; v < found.inks.size(); ++v) {
    if (v % polled == 0) execution.check();
    if (state.reached(v)) found.inks[v] = static_cast<std::uint8_t>(found.steps.of(state.g(v)));
  }
  return found;
}

}  // namespace warren::serve

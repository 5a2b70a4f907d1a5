// SPDX-License-Identifier: BSD-3-Clause
#include "serve/tiles/roadmap_layer.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "serve/tiles/ink_tile.hpp"

namespace warren {
namespace {

constexpr double edge_pixels = 1.3;
constexpr double milestone_pixels = 4.0;
constexpr double edge_opacity = 0.75;
constexpr double far_opacity = 0.6;
constexpr std::size_t items_a_poll = std::size_t{1} << 14U;

struct OnTile {
  Box box;
  double pixel;
  Vec2 operator()(Vec2 p) const { return {(p.x - box.min.x) / pixel, (box.max.y - p.y) / pixel}; }
};

}  // namespace

RoadmapLayer::RoadmapLayer(const RoadmapParts& parts, const Execution& execution) : parts_(parts) {
  file_milestones(execution);
  measure_edges(execution);
  rank_components(execution);
}

Vec2 RoadmapLayer::at(VertexId v) const {
  const std::span<const double> state = parts_.state(v);
  return {state[0], state[1]};
}

std::size_t RoadmapLayer::cell_at(double share) const {
  const auto side = static_cast<double>(side_);
  return static_cast<std::size_t>(std::clamp(share * side, 0.0, side - 1.0));
}

std::size_t RoadmapLayer::column(double x) const { return cell_at((x - box_.min.x) / std::max(box_.width(), 1e-300)); }

std::size_t RoadmapLayer::row(double y) const { return cell_at((y - box_.min.y) / std::max(box_.height(), 1e-300)); }

void RoadmapLayer::file_milestones(const Execution& execution) {
  constexpr std::size_t milestones_a_cell = 8;
  constexpr std::size_t most_side = 1024;
  const auto count = static_cast<VertexId>(parts_.vertex_count());
  const auto poll = [&](VertexId v) {
    if (v % items_a_poll == 0) execution.check();
  };
  const double cells = static_cast<double>(count) / milestones_a_cell;
  side_ = std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(cells)), 1, most_side);
  execution.reserve(count * (sizeof(VertexId) + 1) + (side_ * side_ + 1) * sizeof(std::uint32_t));
  for (VertexId v = 0; v < count; ++v) {
    poll(v);
    box_.include(at(v));
  }
  first_.assign(side_ * side_ + 1, 0);
  const auto cell_of = [&](VertexId v) { return row(at(v).y) * side_ + column(at(v).x); };
  for (VertexId v = 0; v < count; ++v) {
    poll(v);
    ++first_[cell_of(v)];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& first : first_) first = sum += first;  // the end of each cell, from which it is filled
  order_.resize(count);
  for (VertexId v = count; v-- > 0;) {
    poll(v);
    order_[--first_[cell_of(v)]] = v;
  }
}

void RoadmapLayer::measure_edges(const Execution& execution) {
  for (VertexId v = 0; v < parts_.vertex_count(); ++v) {
    if (v % 1024 == 0) execution.check();
    for (std::size_t end = parts_.first[v]; end < parts_.first[v + 1]; ++end) {
      if (parts_.state_of_end(end) != EdgeState::free) continue;
      ++free_edges_;
      const Vec2 off = at(parts_.to[end]) - at(v);
      longest_ = std::max({longest_, std::abs(off.x), std::abs(off.y)});
    }
  }
  if (!parts_.directed) free_edges_ /= 2;
}

void RoadmapLayer::rank_components(const Execution& execution) {
  constexpr auto others = static_cast<std::uint8_t>(component_inks.size() - 1);
  const std::size_t count = parts_.component.size();
  const auto for_each = [&](const auto& visit) {
    for (VertexId v = 0; v < count; ++v) {
      if (v % items_a_poll == 0) execution.check();
      visit(v);
    }
  };
  execution.reserve(2 * count * sizeof(std::uint32_t));
  std::vector<std::uint32_t> sizes(count, 0);
  for_each([&](VertexId v) { ++sizes[parts_.component[v]]; });
  // A milestone that no edge is known to join is grey, however few there are.
  const auto is_before = [&](VertexId a, VertexId b) { return sizes[a] != sizes[b] ? sizes[a] > sizes[b] : a < b; };
  std::vector<VertexId> largest;
  for_each([&](VertexId v) {
    if (sizes[v] == 0) return;
    ++small_components_;
    if (sizes[v] == 1 || (largest.size() == others && is_before(largest.back(), v))) return;
    largest.insert(std::ranges::upper_bound(largest, v, is_before), v);
    if (largest.size() > others) largest.pop_back();
  });
  small_components_ -= largest.size();
  ranks_.assign(count, others);
  for (std::size_t rank = 0; rank < largest.size(); ++rank) ranks_[largest[rank]] = static_cast<std::uint8_t>(rank);
  // A root is the smallest of its component, so it has its rank before others look.
  for_each([&](VertexId v) { ++of_ink_[ranks_[v] = ranks_[parts_.component[v]]]; });
}

/// Until visit says false.
template <class Visit>
void RoadmapLayer::for_each_in(const Box& box, const Execution& execution, const Visit& visit) const {
  const std::size_t right = column(box.max.x);
  const std::size_t top = row(box.max.y);
  std::size_t seen = 0;
  for (std::size_t y = row(box.min.y); y <= top; ++y) {
    for (std::size_t x = column(box.min.x); x <= right; ++x) {
      if (seen++ % 256 == 0) execution.check();
      for (std::uint32_t i = first_[y * side_ + x]; i < first_[y * side_ + x + 1]; ++i) {
        if (seen++ % 1024 == 0) execution.check();
        if (box.contains(at(order_[i])) && !visit(order_[i])) return;
      }
    }
  }
}

/// One more than are drawn where there are too many.
std::vector<RoadmapLayer::Edge> RoadmapLayer::edges_in(const Box& box, const Execution& execution) const {
  std::vector<Edge> edges;
  for_each_in(box.grown(longest_), execution, [&](VertexId v) {
    for (std::size_t end = parts_.first[v]; end < parts_.first[v + 1]; ++end) {
      const VertexId to = parts_.to[end];
      const bool stands_here = parts_.directed || v < to;
      if (!stands_here || parts_.state_of_end(end) != EdgeState::free) continue;
      if (!box.meets(box_of({at(v), at(to)}))) continue;
      edges.push_back({v, to});
      if (edges.size() > most_drawn_edges) return false;
    }
    return true;
  });
  return edges;
}

std::string RoadmapLayer::draw(const Box& box, double pixel, RoadmapInk ink, const Execution& execution) const {
  const OnTile on_tile{box, pixel};
  InkTile tile(std::span<const Rgb>(component_inks).first(ink == RoadmapInk::one ? 1 : component_inks.size()),
               execution);
  const auto mask_of = [&](VertexId v) -> Mask& { return tile.of(ink == RoadmapInk::one ? 0 : ranks_[v]); };
  const Box reach = box.grown(milestone_pixels * pixel);
  const std::vector<Edge> edges = edges_in(reach, execution);
  const bool is_far = edges.size() > most_drawn_edges;
  for (std::size_t i = 0; i < edges.size() && !is_far; ++i) {
    if (i % 64 == 0) execution.check();
    mask_of(edges[i].from).draw_line(on_tile(at(edges[i].from)), on_tile(at(edges[i].to)), edge_pixels, edge_opacity);
  }
  for_each_in(reach, execution, [&](VertexId v) {
    const Vec2 p = on_tile(at(v));
    mask_of(v).draw_line(p, p, is_far ? 1.0 : milestone_pixels, is_far ? far_opacity : 1.0);
    return true;
  });
  return tile.png();
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
  for (std::uint32_t y = cell(box.min.y, size.rows); y <= top && shows_passages(pixel); ++y) {
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

}  // namespace warren

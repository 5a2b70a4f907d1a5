// SPDX-License-Identifier: BSD-3-Clause
#include "serve/tiles/placed_roadmap.hpp"

#include <array>
#include <cmath>

namespace warren::serve {
namespace {

constexpr std::size_t milestones_a_poll = std::size_t{1} << 14U;
/// One edge in so many may be in the list that each box looks at.
constexpr std::uint64_t edges_a_long_one = 256;

}  // namespace

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
  const auto count = static_cast<VertexId>(parts_.vertex_count());
  const auto poll = [&](VertexId v) {
    if (v % milestones_a_poll == 0) execution.check();
  };
  const double cells = static_cast<double>(count) / milestones_a_cell;
  side_ = std::clamp<std::size_t>(static_cast<std::size_t>(std::sqrt(cells)), 1, most_side);
  execution.reserve(count * sizeof(VertexId) + (side_ * side_ + 1) * sizeof(std::uint32_t));
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

template <class Visit>
void PlacedRoadmap::for_each_edge(const Execution& execution, const Visit& visit) const {
  for (VertexId v = 0; v < parts_.vertex_count(); ++v) {
    if (v % 1024 == 0) execution.check();
    for (std::size_t end = parts_.first[v]; end < parts_.first[v + 1]; ++end) {
      if (is_edge(v, end)) visit(Edge{v, parts_.to[end]});
    }
  }
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
  for_each_edge(execution, [&](Edge edge) {
    ++free_edges_;
    ++of_bin[bin(edge)];
  });
  const std::uint64_t most_long = free_edges_ / edges_a_long_one;
  std::size_t first_long = of_bin.size();
  std::uint64_t longer = 0;
  while (first_long > 1 && longer + of_bin[first_long - 1] <= most_long) longer += of_bin[--first_long];
  execution.reserve(longer * sizeof(Edge));
  long_edges_.reserve(longer);
  for_each_edge(execution, [&](Edge edge) {
    if (bin(edge) >= first_long) {
      long_edges_.push_back(edge);
    } else {
      reach_ = std::max(reach_, length(edge));
    }
  });
}

}  // namespace warren::serve

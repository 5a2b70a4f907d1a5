// SPDX-License-Identifier: BSD-3-Clause
// A roadmap from lists of states and edges: it owns what RoadmapParts refers to.
#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "planners/graph/roadmap_arrays.hpp"
#include "planners/graph/roadmap_search.hpp"

namespace warren {

struct ListedEdge {
  VertexId from;
  VertexId to;
  EdgeState state = EdgeState::free;
};

class ListedRoadmap {
 public:
  ListedRoadmap(unsigned dimension, bool directed, std::vector<double> states, std::vector<ListedEdge> edges)
      : dimension_(dimension), directed_(directed), states_(std::move(states)), first_(1, 0) {
    if (!directed) {
      for (std::size_t i = 0, n = edges.size(); i < n; ++i)
        edges.push_back({edges[i].to, edges[i].from, edges[i].state});
    }
    std::sort(edges.begin(), edges.end(), [](const ListedEdge& a, const ListedEdge& b) {
      return std::tuple(a.from, a.to) < std::tuple(b.from, b.to);
    });
    const std::size_t vertices = states_.size() / dimension;
    edge_states_.resize(edge_state_words(edges.size()));
    for (std::size_t end = 0; end < edges.size(); ++end) {
      first_.resize(edges[end].from + std::size_t{1}, static_cast<EdgeEnd>(end));
      to_.push_back(edges[end].to);
      set_edge_state(edge_states_, end, edges[end].state);
    }
    first_.resize(vertices + 1, static_cast<EdgeEnd>(edges.size()));
    label_components(edges);
  }

  RoadmapParts parts() const { return {dimension_, directed_, states_, first_, to_, edge_states_, component_}; }
  /// The length of an edge: |difference| of the states.
  double operator()(VertexId v, VertexId w) const {
    double sum = 0;
    for (unsigned i = 0; i < dimension_; ++i) {
      const double difference = states_[v * dimension_ + i] - states_[w * dimension_ + i];
      sum += difference * difference;
    }
    return std::sqrt(sum);
  }
  VertexDistance length() const { return VertexDistance(*this); }

 private:
  void label_components(const std::vector<ListedEdge>& edges) {
    for (VertexId v = 0; v + std::size_t{1} < first_.size(); ++v) component_.push_back(v);
    for (bool changed = true; changed;) {
      changed = false;
      for (const ListedEdge& edge : edges) {
        const VertexId least = std::min(component_[edge.from], component_[edge.to]);
        if (edge.state != EdgeState::free || component_[edge.from] == component_[edge.to]) continue;
        component_[edge.from] = component_[edge.to] = least;
        changed = true;
      }
    }
  }

  unsigned dimension_;
  bool directed_;
  std::vector<double> states_;
  std::vector<EdgeEnd> first_;
  std::vector<VertexId> to_;
  std::vector<std::uint64_t> edge_states_;
  std::vector<VertexId> component_;
};

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// nanoflann as packaged, to stand beside our k-d tree in the same run.
#pragma once

#include <cmath>
#include <nanoflann.hpp>
#include <span>
#include <utility>
#include <vector>

#include "spatial/points/neighbours.hpp"

namespace warren::bench {

/// nanoflann 1.4.3 as a user would call it: leaf 10, squares made plain again.
class PlainFlann {
 public:
  explicit PlainFlann(std::span<const Vec2> points) : view_{points}, tree_(2, view_) {}
  void nearest(Vec2 p, std::size_t k, VertexId except, std::vector<Neighbour>& out) const {
    places_.resize(k + 1);
    squares_.resize(k + 1);
    const std::size_t count = tree_.knnSearch(&p.x, k + 1, places_.data(), squares_.data());
    out.clear();
    for (std::size_t i = 0; i < count && out.size() < k; ++i) {
      if (places_[i] != except) out.push_back({places_[i], std::sqrt(squares_[i])});
    }
  }
  void within(Vec2 p, const SearchRadius& radius, VertexId except, std::vector<Neighbour>& out) const {
    pairs_.clear();
    tree_.radiusSearch(&p.x, radius.square() * (1.0 + 1e-12), pairs_, {});
    out.clear();
    for (const auto& [id, square] : pairs_) {
      if (id != except && square <= radius.square()) out.push_back({id, std::sqrt(square)});
    }
  }

 private:
  struct View {
    std::span<const Vec2> points;
    std::size_t kdtree_get_point_count() const { return points.size(); }
    double kdtree_get_pt(std::size_t i, std::size_t axis) const { return axis == 0 ? points[i].x : points[i].y; }
    template <class BoundingBox>
    bool kdtree_get_bbox(BoundingBox&) const {
      return false;
    }
  };
  View view_;
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, View>, View, 2, std::uint32_t> tree_;
  mutable std::vector<std::uint32_t> places_;
  mutable std::vector<double> squares_;
  mutable std::vector<std::pair<std::uint32_t, double>> pairs_;
};

}  // namespace warren::bench

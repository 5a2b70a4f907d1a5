// SPDX-License-Identifier: BSD-3-Clause
#include "planners/cells/cell_route.hpp"

#include <utility>

#include "core/plane/geometry.hpp"

namespace warren {
namespace {

/// The posts on one side of a string, from its last fixed point on: a chain that bends around them.
class RouteChain {
 public:
  bool empty() const { return first_ == posts_.size(); }
  std::span<const Vec2> posts() const { return std::span(posts_).subspan(first_); }
  void push(Vec2 post) { posts_.push_back(post); }
  void pop_back() { posts_.pop_back(); }
  void pop_front() { ++first_; }
  void clear() {
    posts_.clear();
    first_ = 0;
  }

 private:
  std::vector<Vec2> posts_;
  std::size_t first_ = 0;
};

/// A string from a point on through gates, each of which has one post: on its left or on its right. Between two calls
/// of tie() the posts come in the sweep's order or against it, so no chain turns by half a circle.
class Funnel {
 public:
  explicit Funnel(Vec2 from) : apex_(from), path_{from} {}

  void pass(Vec2 post, bool on_left) {
    if (post == apex_) return;
    RouteChain& own = on_left ? left_ : right_;
    const int inwards = on_left ? 1 : -1;  // the sign of a turn that keeps the own chain convex
    while (!own.empty()) {
      const std::span<const Vec2> posts = own.posts();
      const Vec2 before = posts.size() == 1 ? apex_ : posts[posts.size() - 2];
      if (orient2d(before, posts.back(), post) * inwards > 0) break;
      own.pop_back();
    }
    if (own.empty()) move_apex(on_left ? right_ : left_, post, inwards);
    own.push(post);
  }

  /// Fixes the string to a point that it can't but pass.
  void tie(Vec2 at) {
    pass(at, true);
    path_.insert(path_.end(), left_.posts().begin(), left_.posts().end());
    if (!(path_.back() == at)) path_.push_back(at);
    left_.clear();
    right_.clear();
    apex_ = at;
  }

  Path<Vec2> take() { return std::move(path_); }

 private:
  /// Bends the string around the other side's posts that stand in the way to `to`.
  void move_apex(RouteChain& other, Vec2 to, int inwards) {
    while (!other.empty() && orient2d(apex_, other.posts().front(), to) * inwards < 0) {
      apex_ = other.posts().front();
      path_.push_back(apex_);
      other.pop_front();
    }
  }

  Vec2 apex_;
  RouteChain left_, right_;
  Path<Vec2> path_;
};

}  // namespace

Path<Vec2> path_through_middles(Vec2 start, Vec2 goal, std::span<const std::uint32_t> doors, const DoorPoints& points) {
  Path<Vec2> path{start};
  for (std::size_t i = 0; i < doors.size(); ++i) {
    if (i > 0) {
      if (const auto bend = points.bend(doors[i - 1], doors[i])) path.push_back(*bend);
    }
    path.push_back(points.middle(doors[i]));
  }
  path.push_back(goal);
  return path;
}

Path<Vec2> shortest_path_through(const CellRoute& route, const CellDecomposition& cells) {
  const auto is_rightwards = [&](std::size_t i) { return cells.doors[route.doors[i]].left == route.cells[i]; };
  Funnel funnel(route.start);
  for (std::size_t i = 0; i < route.doors.size(); ++i) {
    const Door& door = cells.doors[route.doors[i]];
    const Vec2 corner = cells.corners[door.corner];
    const bool turns_back = i + 1 < route.doors.size() && is_rightwards(i) != is_rightwards(i + 1);
    if (turns_back) {  // the next door stands on the same corner
      funnel.tie(corner);
    } else {
      funnel.pass(corner, is_rightwards(i) != door.above);
    }
  }
  funnel.tie(route.goal);
  return funnel.take();
}

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
#include "planners/shorten/taut_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <queue>
#include <vector>

#include "core/base/rng.hpp"
#include "core/plane/geometry.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "tests/planners/visibility/plane_worlds.hpp"
#include "tests/seeds.hpp"
#include "verify/judges/verify_point.hpp"

namespace warren {
namespace {

using test::length_of;

constexpr double planning_factor = 1.0 + 1e-9;

Scene scene_of(const std::vector<Segment>& walls) {
  Scene scene;
  scene.walls = WallSet::narrowest(walls);
  return scene;
}

std::vector<Segment> walls_of(const Scene& scene) {
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) walls.push_back(scene.walls.segment(i));
  return walls;
}

/// What must hold of every result; returns it.
Path<Vec2> checked(const Scene& scene, const Path<Vec2>& path, double r) {
  const WallIndex index(scene.walls, {});
  const Path<Vec2> taut = taut_path(index, path, r * planning_factor, {});
  EXPECT_EQ(taut.front(), path.front());
  EXPECT_EQ(taut.back(), path.back());
  EXPECT_LE(length_of(taut), length_of(path) * (1.0 + 1e-15));
  VerifyOptions options;
  options.clearance = r;
  const Verification v = verify_path(scene, taut, options, {});
  EXPECT_TRUE(v.verified) << v.first_violation->obstacle << " at " << v.first_violation->distance;
  const Path<Vec2> again = taut_path(index, taut, r * planning_factor, {});
  EXPECT_NEAR(length_of(again), length_of(taut), 1e-9 * length_of(taut));
  return taut;
}

/// The way over cell centres, breadth first over a lattice of points `step` apart, edges with the clearance.
Path<Vec2> lattice_path(const WallIndex& index, Vec2 from, Vec2 to, double step, double r) {
  const Box& box = index.box();
  const auto cols = 2 * static_cast<int>(box.width() / step) + 3;
  const auto rows = 2 * static_cast<int>(box.height() / step) + 3;
  const auto point = [&](int id) {
    return Vec2{from.x + (id % cols - cols / 2) * step, from.y + (id / cols - rows / 2) * step};
  };
  std::vector<int> parent(static_cast<std::size_t>(cols) * rows, -1);
  const int start = rows / 2 * cols + cols / 2;
  std::vector<int> queue{start};
  parent[start] = start;
  for (std::size_t i = 0; i < queue.size(); ++i) {
    const int id = queue[i];
    if (distance(point(id), to) <= step && index.keeps_clearance(point(id), to, r)) {
      Path<Vec2> path{to};
      for (int at = id; at != start; at = parent[at]) path.push_back(point(at));
      path.push_back(from);
      return {path.rbegin(), path.rend()};
    }
    for (const int next : {id + 1, id - 1, id + cols, id - cols}) {
      if (next < 0 || next >= cols * rows || parent[next] >= 0 || std::abs(next % cols - id % cols) > 1) continue;
      if (!box.contains(point(next)) || !index.keeps_clearance(point(id), point(next), r)) continue;
      parent[next] = id;
      queue.push_back(next);
    }
  }
  return {};
}

Path<Vec2> maze_path(const Scene& scene, double r) {
  const WallIndex index(scene.walls, {});
  const Vec2 start{scene.start[0], scene.start[1]};
  const Vec2 goal{scene.goal[0], scene.goal[1]};
  Path<Vec2> path{start};
  const Path<Vec2> inside = lattice_path(index, {1.0, 1.0}, {goal.x - 0.5, goal.y}, 1.0, r);
  path.insert(path.end(), inside.begin(), inside.end());
  path.push_back(goal);
  return path;
}

// ---- the oracle: shortest among all tangents of all wall ends, by Dijkstra's algorithm
// ------------------------------- States are directed tangents; from one to the next the path follows the disc, which
// no wall of the disc's own end may interrupt. In a perfect maze there is one homotopy class, so this is the optimum
// that the string must reach.

struct Node {
  Vec2 center;
  double turn;  // +1: disc on the left
};
struct TangentEdge {
  std::size_t from, to;
  double length;
  double heading;
};

class TangentGraph {
 public:
  TangentGraph(const std::vector<Segment>& walls, double r, Vec2 start, Vec2 goal) : walls_(walls), r_(r) {
    nodes_ = {{start, 0.0}, {goal, 0.0}};
    std::vector<Vec2> posts;
    for (const Segment& w : walls) {
      posts.insert(posts.end(), {w.a, w.b});
      box_.include(box_of(w));
    }
    std::sort(posts.begin(), posts.end(), is_before);
    posts.erase(std::unique(posts.begin(), posts.end()), posts.end());
    for (const Vec2 p : posts) nodes_.insert(nodes_.end(), {{p, 1.0}, {p, -1.0}});
    leaving_.resize(nodes_.size());
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      for (std::size_t j = 0; j < nodes_.size(); ++j) add_edge(i, j);
    }
  }

  double shortest() const {
    std::vector<double> best(edges_.size(), std::numeric_limits<double>::infinity());
    std::priority_queue<std::pair<double, std::size_t>> queue;
    for (const std::size_t e : leaving_[0]) queue.push({-(best[e] = edges_[e].length), e});
    while (!queue.empty()) {
      const auto [minus, e] = queue.top();
      queue.pop();
      if (-minus > best[e]) continue;
      const std::size_t at = edges_[e].to;
      if (at == 1) return best[e];
      for (const std::size_t next : leaving_[at]) {
        const double arc = arc_length(at, edges_[e].heading, edges_[next].heading);
        const double length = best[e] + arc + edges_[next].length;
        if (length < best[next]) queue.push({-(best[next] = length), next});
      }
    }
    return std::numeric_limits<double>::infinity();
  }

 private:
  static double positive(double angle) {
    const double whole = 2.0 * std::numbers::pi;
    angle = std::fmod(angle, whole);
    if (angle < 0.0) angle += whole;
    return angle > whole - 1e-9 ? 0.0 : angle;
  }

  /// The tangent by trigonometry: its heading is that of the centers' line, turned by the angle that the radii ask for.
  void add_edge(std::size_t i, std::size_t j) {
    const Node& a = nodes_[i];
    const Node& b = nodes_[j];
    const Vec2 d = b.center - a.center;
    const double apart = norm(d);
    const double rise = r_ * (b.turn - a.turn);
    if (i == j || apart == 0.0 || std::abs(rise) >= apart) return;
    const double heading = std::atan2(d.y, d.x) - std::asin(rise / apart);
    const Vec2 left{-std::sin(heading), std::cos(heading)};
    const Segment s{a.center - r_ * a.turn * left, b.center - r_ * b.turn * left};
    if (!box_.contains(s.a) || !box_.contains(s.b)) return;  // around the maze instead of through it
    for (const Segment& w : walls_) {
      if (distance(s, w) < r_ * (1.0 - 1e-6)) return;
    }
    leaving_[i].push_back(edges_.size());
    edges_.push_back({i, j, norm(s.b - s.a), heading});
  }

  /// Infinite if a wall that ends in the disc's center is in the way.
  double arc_length(std::size_t node, double heading_in, double heading_out) const {
    const auto [center, turn] = nodes_[node];
    const double arc = positive(turn * (heading_out - heading_in));
    const double spoke = heading_in - turn * std::numbers::pi / 2.0;
    for (const Segment& w : walls_) {
      for (const Vec2 other : {w.a == center ? w.b : center, w.b == center ? w.a : center}) {
        if (other == center) continue;
        const Vec2 d = other - center;
        if (positive(turn * (std::atan2(d.y, d.x) - spoke)) < arc) return std::numeric_limits<double>::infinity();
      }
    }
    return r_ * arc;
  }

  std::vector<Segment> walls_;
  Box box_;
  double r_;
  std::vector<Node> nodes_;
  std::vector<TangentEdge> edges_;
  std::vector<std::vector<std::size_t>> leaving_;
};

TEST(TautPath, ReachesTheOptimumOfPerfectMazes) {
  constexpr MazeAlgorithm algorithms[] = {MazeAlgorithm::backtracker, MazeAlgorithm::kruskal, MazeAlgorithm::wilson};
  for (const std::uint64_t seed : test::seeds(21)) {
    SCOPED_TRACE(seed);
    MazeOptions options;
    options.rows = 9;
    options.cols = 7 + seed % 5;
    options.seed = seed;
    options.algorithm = algorithms[seed % 3];
    const Scene scene = maze_scene(options, seed % 2 == 0, {});
    const Path<Vec2> raw = maze_path(scene, 0.45);
    ASSERT_FALSE(raw.size() < 3);
    for (const double r : {0.0, 0.1, 0.25, 0.4}) {
      SCOPED_TRACE(r);
      const double taut = length_of(checked(scene, raw, r));
      const double radius = r > 0.0 ? r : 1e-8;  // with 0 the optimum is not attained: compare with its limit
      const double optimum = TangentGraph(walls_of(scene), radius, raw.front(), raw.back()).shortest();
      EXPECT_GE(taut / optimum, r > 0.0 ? 1.0 - 1e-9 : 1.0 - 1e-7);
      EXPECT_LE(taut / optimum, 1.005);
    }
  }
}

/// Random segments of mixed sizes, crossing and overlapping, some points, in a box.
std::vector<Segment> random_segments(std::uint64_t seed, std::size_t count) {
  std::vector<Segment> walls{{{0, 0}, {20, 0}}, {{20, 0}, {20, 20}}, {{20, 20}, {0, 20}}, {{0, 20}, {0, 0}}};
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 at{20.0 * uniform(seed, i, 0), 20.0 * uniform(seed, i, 1)};
    const double angle = i % 4 == 0 ? 0.5 * std::numbers::pi * static_cast<double>(i % 8) : 6.3 * uniform(seed, i, 2);
    const double length = i % 10 == 9 ? 0.0 : std::pow(6.0, uniform(seed, i, 3)) - 0.8;
    const Vec2 end = at + length * Vec2{std::cos(angle), std::sin(angle)};
    walls.push_back({at, {std::clamp(end.x, 0.0, 20.0), std::clamp(end.y, 0.0, 20.0)}});
    if (i % 7 == 0) walls.push_back({walls.back().a, 0.5 * (walls.back().a + walls.back().b)});
  }
  return walls;
}

/// A way through several random points, so it crosses itself.
Path<Vec2> wandering_path(const WallIndex& index, std::uint64_t seed, double r) {
  Path<Vec2> path;
  for (std::uint64_t i = 0; i < 400 && path.size() < 400; ++i) {
    const Vec2 p{20.0 * uniform(seed, i, 7), 20.0 * uniform(seed, i, 8)};
    if (index.clearance(p) < 1.01 * r || index.clearance(p) < 1e-3) continue;
    if (path.empty()) {
      path.push_back(p);
      continue;
    }
    const Path<Vec2> leg = lattice_path(index, path.back(), p, 0.25, r);
    path.insert(path.end(), leg.begin(), leg.end());
  }
  return path;
}

TEST(TautPath, HoldsItsPromisesAmongRandomSegments) {
  for (const std::uint64_t seed : test::seeds(40, 10, 0)) {
    SCOPED_TRACE(seed);
    const Scene scene = scene_of(random_segments(seed, 20 + 4 * seed));
    const WallIndex index(scene.walls, {});
    for (const double r : {0.0, 0.02, 0.2}) {
      SCOPED_TRACE(r);
      const Path<Vec2> raw = wandering_path(index, seed, r * planning_factor);
      if (raw.size() < 2) continue;
      const Path<Vec2> taut = checked(scene, raw, r);
      EXPECT_LT(length_of(taut), length_of(raw));
    }
  }
}

/// Is every bend of the taut path held by a wall end inside it? Then the path is locally shortest, so shortest.
TEST(TautPath, EveryBendIsHeldByAWallEnd) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const std::vector<Segment> walls = random_segments(seed, 20 + 4 * seed);
    const Scene scene = scene_of(walls);
    const WallIndex index(scene.walls, {});
    const double r = 0.05;
    const Path<Vec2> raw = wandering_path(index, seed, r * planning_factor);
    if (raw.size() < 2) continue;
    const Path<Vec2> taut = taut_path(index, raw, r * planning_factor, {});
    for (std::size_t i = 1; i + 1 < taut.size(); ++i) {
      const Vec2 in = (1.0 / distance(taut[i - 1], taut[i])) * (taut[i] - taut[i - 1]);
      const Vec2 out = (1.0 / distance(taut[i], taut[i + 1])) * (taut[i + 1] - taut[i]);
      const double turn = cross(in, out);
      if (std::abs(turn) < 1e-6) continue;
      const Vec2 inside = turn > 0.0 ? Vec2{-in.y, in.x} : Vec2{in.y, -in.x};
      const bool held = std::any_of(walls.begin(), walls.end(), [&](const Segment& w) {
        return std::any_of(&w.a, &w.b + 1, [&](const Vec2& end) {
          return std::abs(dot(inside, end - taut[i]) - r) < 1e-6 && distance(end, taut[i]) < 1.01 * r;
        });
      });
      EXPECT_TRUE(held) << "point " << i << " of " << taut.size() << ": " << taut[i].x << " " << taut[i].y;
    }
  }
}

TEST(TautPath, GoesOnCirclingAPillar) {
  const Scene scene = scene_of({{{-5, -5}, {5, -5}}, {{-5, 5}, {5, 5}}, {{0, 0}, {0, 0}}});
  Path<Vec2> path{{-4.0, -1.0}};
  for (int round = 0; round < 3; ++round) path.insert(path.end(), {{2, -1}, {2, 2}, {-2, 2}, {-2, -1}});
  path.insert(path.end(), {{2, -1}, {4.0, -1.0}});
  const double r = 0.5;
  const double reach = std::sqrt(17.0 - r * r);
  const double tangents = 2.0 * reach;
  // the angle between the two ends, seen from the pillar, less what the tangents cover, and three times around
  const double arc =
      6.0 * std::numbers::pi + (std::numbers::pi - 2.0 * std::atan(0.25)) - 2.0 * std::acos(r / std::sqrt(17.0));
  const double length = length_of(checked(scene, path, r));
  EXPECT_GE(length, (tangents + r * arc) * (1.0 - 1e-9));
  EXPECT_LE(length, (tangents + r * arc) * 1.003);
}

TEST(TautPath, PassesAGapThatIsJustWideEnough) {
  const double r = 0.5;
  const Scene scene = scene_of({{{0, 0}, {0, 4}}, {{0, 5.0 + 3e-9}, {0, 9}}, {{-9, 0}, {9, 0}}, {{-9, 9}, {9, 9}}});
  const Path<Vec2> path{{-3, 1}, {-3, 4.5 + 1.5e-9}, {3, 4.5 + 1.5e-9}, {3, 8}};
  const double length = length_of(checked(scene, path, r));
  EXPECT_LT(length, 11.0);
  EXPECT_GT(length, 2.0 * std::hypot(3.0, 3.5));
}

TEST(TautPath, KeepsWhatCannotBeShorter) {
  const Scene scene = scene_of({{{0, 0}, {10, 0}}, {{0, 10}, {10, 10}}});
  const WallIndex index(scene.walls, {});
  const auto taut = [&](Path<Vec2> path) { return taut_path(index, path, 0.1, {}); };
  EXPECT_EQ(taut({{1, 1}}), (Path<Vec2>{{1, 1}}));
  EXPECT_EQ(taut({{1, 1}, {1, 1}}).front(), (Vec2{1, 1}));
  EXPECT_EQ(taut({{1, 1}, {3, 2}}), (Path<Vec2>{{1, 1}, {3, 2}}));
  EXPECT_EQ(taut({{1, 1}, {5, 7}, {3, 2}}), (Path<Vec2>{{1, 1}, {3, 2}}));
  EXPECT_EQ(taut({{1, 1}, {5, 5}, {1, 1}, {3, 2}}), (Path<Vec2>{{1, 1}, {3, 2}}));
}

TEST(TautPath, MovedAndScaledMazesGiveTheSamePath) {
  MazeOptions options;
  options.rows = options.cols = 12;
  const Scene scene = maze_scene(options, false, {});
  const Path<Vec2> raw = maze_path(scene, 0.3);
  const double length = length_of(checked(scene, raw, 0.1));
  for (const double shift : {0.0, 1e6}) {
    for (const double scale : {1e-3, 1.0, 1e3}) {
      SCOPED_TRACE(testing::Message() << shift << " " << scale);
      const auto moved = [&](Vec2 p) {
        return Vec2{shift + scale * (0.8 * p.x - 0.6 * p.y), shift + scale * (0.6 * p.x + 0.8 * p.y)};
      };
      std::vector<Segment> walls;
      for (const Segment& w : walls_of(scene)) walls.push_back({moved(w.a), moved(w.b)});
      Path<Vec2> path;
      for (const Vec2 p : raw) path.push_back(moved(p));
      const WallIndex index(WallSet::narrowest(walls), {});
      const Path<Vec2> taut = taut_path(index, path, 0.1 * scale, {});
      EXPECT_NEAR(length_of(taut) / scale, length, 1e-4 * length);
      for (std::size_t i = 1; i < taut.size(); ++i)
        EXPECT_TRUE(index.keeps_clearance(taut[i - 1], taut[i], 0.1 * scale));
    }
  }
}

TEST(TautPath, ThreadsDoNotChangeThePath) {
  MazeOptions options;
  options.rows = options.cols = 60;
  const Scene scene = maze_scene(options, false, {});
  const Path<Vec2> raw = maze_path(scene, 0.3);
  const WallIndex index(scene.walls, {});
  Execution execution;
  execution.threads = 1;
  const Path<Vec2> one = taut_path(index, raw, 0.2, execution);
  for (const unsigned threads : {2U, 3U, 8U}) {
    execution.threads = threads;
    EXPECT_EQ(taut_path(index, raw, 0.2, execution), one);
  }
}

TEST(TautPath, StopsAtTheDeadline) {
  const Scene scene = scene_of({{{0, 0}, {10, 0}}, {{0, 10}, {10, 10}}});
  const WallIndex index(scene.walls, {});
  const Deadline over(0.0);
  Execution execution;
  execution.deadline = &over;
  EXPECT_THROW(taut_path(index, std::vector<Vec2>{{1, 1}, {5, 5}, {3, 2}}, 0.1, execution), Stopped);
}

}  // namespace
}  // namespace warren

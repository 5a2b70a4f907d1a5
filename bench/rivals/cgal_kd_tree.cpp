// SPDX-License-Identifier: BSD-3-Clause
// warren's neighbour indices beside CGAL's k-d tree: build, k nearest and radius, in the plane, points uniform in tile
// order, uniform in random order, and clustered over three decades. One thread; the contestants take turns; the least
// CPU time of each counts. Each query's distances are compared, all of them, outside of the clock.
//   rival_cgal_kd_tree [POINTS [REPEATS]]
#include <CGAL/Fuzzy_sphere.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_2.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/rivals/stopwatch.hpp"
#include "core/base/rng.hpp"
#include "spatial/points/kd_tree.hpp"
#include "spatial/points/point_grid.hpp"

namespace warren {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using NumberedPoint = std::pair<Kernel::Point_2, VertexId>;
using CgalTraits = CGAL::Search_traits_adapter<NumberedPoint, CGAL::First_of_pair_property_map<NumberedPoint>,
                                               CGAL::Search_traits_2<Kernel>>;
using CgalSearch = CGAL::Orthogonal_k_neighbor_search<CgalTraits>;
using CgalSphere = CGAL::Fuzzy_sphere<CgalTraits>;
using CgalTree = CgalSearch::Tree;

constexpr std::size_t queries = 100'000;
const Execution one_thread{.threads = 1};

enum class Kind : std::uint8_t { sorted, random, clustered };

std::vector<Vec2> points_of(Kind kind, std::size_t count) {
  const double width = std::sqrt(static_cast<double>(count));
  std::vector<Vec2> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec2 u{uniform(1, i, 0), uniform(1, i, 1)};
    points[i] = width * u;
    if (kind != Kind::clustered) continue;
    const double spread = std::pow(10.0, -3.0 * uniform(1, i, 2));
    const Vec2 centre{uniform(1, i % 200, 3), uniform(1, i % 200, 4)};
    points[i] = width * (centre + spread * (u - Vec2{0.5, 0.5}));
  }
  if (kind == Kind::random) return points;
  std::vector<Vec2> sorted;
  const RawVector<std::uint32_t> order = tile_order(points, one_thread);
  for (const std::uint32_t i : order) sorted.push_back(points[i]);
  return sorted;
}

/// Distances of each query's answer, ascending, one after the other.
using Distances = std::vector<double>;

template <class Index>
class WarrenSide {
 public:
  explicit WarrenSide(const std::vector<Vec2>& points) : points_(points) {}
  void build() { index_ = std::make_unique<Index>(points_, one_thread); }
  std::size_t nearest(VertexId i, std::size_t k) {
    index_->nearest(points_[i], k, i, found_);
    return found_.size();
  }
  std::size_t within(VertexId i, double radius) {
    index_->within(points_[i], radius, i, found_);
    return found_.size();
  }
  void append(VertexId, Distances& out) const {
    for (const Neighbour& n : found_) out.push_back(n.distance);
  }

 private:
  const std::vector<Vec2>& points_;
  std::unique_ptr<Index> index_;
  std::vector<Neighbour> found_;
};

class CgalSide {
 public:
  explicit CgalSide(const std::vector<Vec2>& points) : points_(points) {
    for (VertexId i = 0; i < points.size(); ++i) numbered_.emplace_back(Kernel::Point_2(points[i].x, points[i].y), i);
  }
  void build() {
    tree_ = std::make_unique<CgalTree>(numbered_.begin(), numbered_.end());
    tree_->build();
  }
  std::size_t nearest(VertexId i, std::size_t k) {
    found_.clear();
    CgalSearch search(*tree_, numbered_[i].first, static_cast<unsigned>(k + 1));
    for (const auto& [point, square] : search) {
      if (point.second != i) found_.push_back(point.second);
    }
    return found_.size();
  }
  std::size_t within(VertexId i, double radius) {
    found_.clear();
    const CgalSphere sphere(numbered_[i].first, radius);
    reached_.clear();
    tree_->search(std::back_inserter(reached_), sphere);
    for (const NumberedPoint& point : reached_) {
      if (point.second != i) found_.push_back(point.second);
    }
    return found_.size();
  }
  void append(VertexId i, Distances& out) const {
    const auto begin = static_cast<std::ptrdiff_t>(out.size());
    for (const VertexId j : found_) out.push_back(distance(points_[j], points_[i]));
    std::sort(out.begin() + begin, out.end());
  }

 private:
  const std::vector<Vec2>& points_;
  std::vector<NumberedPoint> numbered_;
  std::unique_ptr<CgalTree> tree_;
  std::vector<VertexId> found_;
  std::vector<NumberedPoint> reached_;
};

struct SideTimes {
  double build_s = 1e300;
  double nearest_s = 1e300;
  double within_s = 1e300;
};

struct Question {
  std::size_t points;
  std::size_t k = 8;
  double radius;
};

template <class Side>
void take_turn(Side& side, const Question& q, SideTimes& best) {
  const auto least = [](double& best_s, const auto& run) {
    const Stopwatch watch;
    run();
    best_s = std::min(best_s, watch.read().cpu_s);
  };
  std::size_t found = 0;
  least(best.build_s, [&] { side.build(); });
  const std::size_t count = std::min(queries, q.points);
  least(best.nearest_s, [&] {
    for (VertexId i = 0; i < count; ++i) found += side.nearest(i, q.k);
  });
  least(best.within_s, [&] {
    for (VertexId i = 0; i < count; ++i) found += side.within(i, q.radius);
  });
  if (found == 0) throw std::runtime_error("nothing was found");
}

template <class Side>
Distances answers(Side& side, const Question& q) {
  Distances all;
  const auto count = static_cast<VertexId>(std::min(queries, q.points));
  for (VertexId i = 0; i < count; ++i) {
    side.nearest(i, q.k);
    side.append(i, all);
    side.within(i, q.radius);
    side.append(i, all);
  }
  return all;
}

void print(const char* name, const SideTimes& t, const Question& q, const SideTimes& rival) {
  const double per_query = 1e9 / static_cast<double>(std::min(queries, q.points));
  std::printf("  %-12s %9.1f %9.1f %9.1f %18.2f %7.2f %7.2f\n", name, 1e9 * t.build_s / static_cast<double>(q.points),
              t.nearest_s * per_query, t.within_s * per_query, rival.build_s / t.build_s, rival.nearest_s / t.nearest_s,
              rival.within_s / t.within_s);
}

void compare(const char* name, Kind kind, std::size_t count, int repeats) {
  const std::vector<Vec2> points = points_of(kind, count);
  const Question q{.points = count, .radius = kind == Kind::clustered ? 0.1 : 1.6};
  WarrenSide<PointGrid> grid(points);
  WarrenSide<KdTree<2>> trees(points);
  CgalSide cgal(points);
  SideTimes best[3];
  for (int i = 0; i < repeats; ++i) {
    take_turn(grid, q, best[0]);
    take_turn(trees, q, best[1]);
    take_turn(cgal, q, best[2]);
  }
  const Distances expected = answers(cgal, q);
  if (answers(grid, q) != expected || answers(trees, q) != expected)
    throw std::runtime_error(std::string(name) + ": the neighbours differ");
  std::printf("%s\n", name);
  print("PointGrid", best[0], q, best[2]);
  print("KdTree<2>", best[1], q, best[2]);
  print("CGAL", best[2], q, best[2]);
}

}  // namespace
}  // namespace warren

int main(int argc, char** argv) {
  using warren::Kind;
  const std::size_t count = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1'000'000;
  const int repeats = argc > 2 ? std::atoi(argv[2]) : 3;
  if (count < 1000 || count > 100'000'000 || repeats < 1) {
    std::fprintf(stderr, "usage: rival_cgal_kd_tree [POINTS [REPEATS]], 1000 to 10^8 points\n");
    return 2;
  }
  std::printf("%-14s %9s %9s %9s %18s %7s %7s\n", "ns of CPU", "build", "8 nearest", "radius", "CGAL over: build",
              "nearest", "radius");
  try {
    warren::compare("uniform, in tile order", Kind::sorted, count, repeats);
    warren::compare("uniform, random order", Kind::random, count, repeats);
    warren::compare("clustered, in tile order", Kind::clustered, count / 10, repeats);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "rival_cgal_kd_tree: %s\n", error.what());
    return 1;
  }
  return 0;
}

// SPDX-License-Identifier: BSD-3-Clause
// nanoflann 1.4.3 works on squares and drops points that tie with the worst one it holds. The result set below
// therefore reports a worst square that is `slack` larger than the true one, and decides by (distance, id) itself;
// the slack also covers the rounding of nanoflann's lower bounds, a few units in the last place. visit_nodes() walks
// nanoflann's own nodes (root_node, node_type), which other versions may name otherwise.

#include "spatial/points/kd_tree.hpp"

#include <nanoflann.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "core/base/instruction_set.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/whole.hpp"
#include "parallel/sort.hpp"

namespace warren {
namespace {

constexpr double slack = 1.0 + 1e-12;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t tree_size = 16'384;  // points of a subtree: aimed at
constexpr std::size_t most_trees = 4096;
constexpr std::size_t samples_per_tree = 32;
constexpr std::size_t leaf_size = 16;
constexpr std::size_t tree_grain = std::size_t{1} << 14;

/// A square that is larger than the squares of all distances <= `distance`, as nanoflann computes them.
double loose_square(double distance) { return distance * distance * slack + std::numeric_limits<double>::min(); }

template <int D>
double coordinate(const PointOf<D>& p, std::size_t axis) {
  if constexpr (D == 2) {
    return axis == 0 ? p.x : p.y;
  } else {
    return p[axis];
  }
}

/// The points of one subtree as nanoflann wants to see them.
template <int D>
struct TreePoints {
  const PointOf<D>* points;
  std::size_t count;

  std::size_t kdtree_get_point_count() const { return count; }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return coordinate<D>(points[i], axis); }
  template <class BoundingBox>
  bool kdtree_get_bbox(BoundingBox&) const {
    return false;
  }
};

/// Coordinates, and the bits of a number: on how many of the first axes they or any point's are not 0. Of 16 axes a
/// robot of six joints has six.
template <int D>
using TreeQuery = std::array<double, D + 1>;

template <int D>
double squared_distance(const double* query, const PointOf<D>& p) {
  const std::size_t axes = D > 4 ? std::bit_cast<std::uint64_t>(query[D]) : D;
  double sum = 0.0;
  for (std::size_t axis = 0; axis < axes; ++axis) {
    const double d = query[axis] - coordinate<D>(p, axis);
    sum += d * d;
  }
  return sum;
}

/// nanoflann's L2_Simple_Adaptor, from a TreeQuery.
template <int D>
struct SquareOfQuery {
  using ElementType = double;
  using DistanceType = double;
  const TreePoints<D>& view;
  explicit SquareOfQuery(const TreePoints<D>& of) : view(of) {}
  double evalMetric(const double* query, std::uint32_t i, std::size_t) const {  // NOLINT(readability-identifier-naming)
    return squared_distance<D>(query, view.points[i]);
  }
  double accum_dist(double a, double b, std::size_t) const { return (a - b) * (a - b); }
};

template <int D>
using FlannTree = nanoflann::KDTreeSingleIndexAdaptor<SquareOfQuery<D>, TreePoints<D>, D, std::uint32_t>;

template <int D>
struct Tree {
  Tree(const PointOf<D>* points, std::size_t count)
      : view{points, count},
        index(D, view,
              nanoflann::KDTreeSingleIndexAdaptorParams(
                  leaf_size, nanoflann::KDTreeSingleIndexAdaptorFlags::SkipInitialBuildIndex)) {}
  TreePoints<D> view;
  FlannTree<D> index;
};

/// Cuts of a complete binary tree: node 1 is the root, node i has children 2 i (below the cut) and 2 i + 1.
template <int D>
struct TopTree {
  struct Cut {
    std::size_t axis;
    double value;
  };
  std::size_t leaves = 1;  // a power of two
  std::vector<Cut> cuts;

  explicit TopTree(std::span<const PointOf<D>> points) {
    while (leaves < most_trees && leaves * tree_size < points.size()) leaves *= 2;
    cuts.resize(leaves);
    if (leaves == 1) return;
    const std::size_t count = leaves * samples_per_tree;
    std::vector<PointOf<D>> sample(count);
    for (std::size_t i = 0; i < count; ++i) sample[i] = points[i * points.size() / count];
    cut(1, sample);
  }
  void cut(std::size_t node, std::span<PointOf<D>> sample) {
    if (node >= leaves) return;
    const auto at = [](const PointOf<D>& p, std::size_t on) { return coordinate<D>(p, on); };
    const std::size_t axis = widest_axis<D>(sample, at);
    const std::size_t half = sample.size() / 2;
    const auto less = [&](const auto& a, const auto& b) { return at(a, axis) < at(b, axis); };
    std::nth_element(sample.begin(), sample.begin() + as_whole<std::ptrdiff_t>(half), sample.end(), less);
    cuts[node] = {axis, coordinate<D>(sample[half], axis)};
    cut(2 * node, sample.first(half));
    cut(2 * node + 1, sample.subspan(half));
  }
  std::uint32_t leaf_of(const PointOf<D>& p) const {
    std::size_t node = 1;
    while (node < leaves) node = 2 * node + (coordinate<D>(p, cuts[node].axis) >= cuts[node].value ? 1 : 0);
    return as_whole<std::uint32_t>(node - leaves);
  }
};

/// The k best so far: sorted if k is small, else a heap with the worst on top.
class NearestSet {
 public:
  NearestSet(std::size_t k, VertexId except, std::vector<Neighbour>& out) : k_(k), except_(except), out_(out) {}

  double worstDist() const { return worst_; }  // NOLINT(readability-identifier-naming): nanoflann's names
  bool full() const { return true; }
  bool addPoint(double square, std::uint32_t place) {  // NOLINT(readability-identifier-naming)
    if (square > worst_ || ids[place] == except_) return true;
    const Neighbour found{ids[place], std::sqrt(square)};
    k_ <= most_sorted ? insert(found) : push(found);
    return true;
  }
  /// Puts the answer in order.
  void finish() {
    if (k_ > most_sorted) std::sort_heap(out_.begin(), out_.end());
  }

  const VertexId* ids = nullptr;  ///< of the places of the tree that is searched

 private:
  static constexpr std::size_t most_sorted = 48;

  void insert(const Neighbour& found) {
    if (out_.size() < k_) {
      out_.push_back(found);
    } else if (!(found < out_.back())) {
      return;
    }
    std::size_t to = out_.size() - 1;
    for (; to > 0 && found < out_[to - 1]; --to) out_[to] = out_[to - 1];
    out_[to] = found;
    if (out_.size() == k_) worst_ = loose_square(out_.back().distance);
  }
  void push(const Neighbour& found) {
    if (out_.size() == k_) {
      if (!(found < out_.front())) return;
      std::pop_heap(out_.begin(), out_.end());
      out_.pop_back();
    }
    out_.push_back(found);
    std::push_heap(out_.begin(), out_.end());
    if (out_.size() == k_) worst_ = loose_square(out_.front().distance);
  }

  std::size_t k_;
  VertexId except_;
  std::vector<Neighbour>& out_;
  double worst_ = infinity;
};

constexpr double largest_in_floats = 1e18;  // so that squares are numbers, too

using Lanes4 = float __attribute__((vector_size(16)));
using Lanes8 = float __attribute__((vector_size(32)));
template <int D>
using Blocks = std::span<const std::array<std::array<float, 8>, D>>;

constexpr std::size_t blocks_of_group = 8;

/// The squared distances of points, eight a block, from one whose coordinates are these on the first axes, and whose
/// square on the others is `beyond`. For each group of blocks, the least of the first of each block, of the second ...
/// Gives the least of all.
template <class Lanes, int D>
[[gnu::always_inline]] inline float measure_by_lanes(Blocks<D> blocks, std::span<const float> from, float beyond,
                                                     float* squares, float* least_of_group) {
  constexpr std::size_t width = sizeof(Lanes) / sizeof(float);
  Lanes least_of_all = Lanes{} + std::numeric_limits<float>::infinity();
  for (; !blocks.empty(); least_of_group += 8) {
    const auto group = blocks.first(std::min(blocks.size(), blocks_of_group));
    blocks = blocks.subspan(group.size());
    std::array<Lanes, 8 / width> least;
    least.fill(Lanes{} + std::numeric_limits<float>::infinity());
    for (const auto& block : group) {
      for (std::size_t part = 0; part < least.size(); ++part) {
        Lanes sum = Lanes{} + beyond;
        for (std::size_t axis = 0; axis < from.size(); ++axis) {
          Lanes d;
          std::memcpy(&d, &block[axis][part * width], sizeof d);
          d -= from[axis];
          sum += d * d;
        }
        std::memcpy(squares + part * width, &sum, sizeof sum);
        least[part] = sum < least[part] ? sum : least[part];
      }
      squares += 8;
    }
    std::memcpy(least_of_group, least.data(), sizeof least);
    for (const Lanes& part : least) least_of_all = part < least_of_all ? part : least_of_all;
  }
  std::array<float, width> all;
  std::memcpy(all.data(), &least_of_all, sizeof least_of_all);
  return *std::min_element(all.begin(), all.end());
}

}  // namespace

template <int D>
struct KdTree<D>::Forest {
  TopTree<D> top;
  RawVector<Point> points;                      // subtree by subtree, in the order of the leaves
  RawVector<VertexId> ids;                      // of the places
  RawVector<std::uint32_t> place_of;            // of the ids
  RawVector<std::uint32_t> first;               // place of each subtree's first point
  std::vector<std::unique_ptr<Tree<D>>> trees;  // null where there is no point
  std::size_t axes = D;                         // all points are 0 on those behind

  Forest(std::span<const Point> input, const Execution& execution) : top(input) {
    const Execution quiet = execution.quiet();
    quiet.reserve(input.size() * (sizeof(Point) + 16 + 12));
    ItemsByKey order =
        counting_sort(input.size(), top.leaves, quiet, [&](std::size_t i) { return top.leaf_of(input[i]); });
    first = std::move(order.first);
    ids = std::move(order.items);
    points.resize(input.size());
    place_of.resize(input.size());
    trees.resize(top.leaves);
    if constexpr (D > 4) {
      axes = 0;
      for (const Point& p : input) axes = axes_of(p, axes);
    }
    for_chunks(top.leaves, 1, quiet, [&](Range range) { plant(range.first, input); });
    for_each_index(input.size(), tree_grain, quiet,
                   [&](std::size_t i) { place_of[ids[i]] = as_whole<std::uint32_t>(i); });
  }

  /// Builds a subtree, then puts its points in the order of its leaves, so that a leaf is one run of memory.
  void plant(std::size_t leaf, std::span<const Point> input) {
    const std::size_t begin = first[leaf];
    const std::size_t count = first[leaf + 1] - begin;
    if (count == 0) return;
    for (std::size_t i = begin; i < begin + count; ++i) points[i] = input[ids[i]];
    trees[leaf] = std::make_unique<Tree<D>>(points.data() + begin, count);
    auto& index = trees[leaf]->index;
    index.buildIndex();
    const std::vector<VertexId> unsorted(ids.begin() + as_whole<std::ptrdiff_t>(begin),
                                         ids.begin() + as_whole<std::ptrdiff_t>(begin + count));
    for (std::size_t i = 0; i < count; ++i) {
      ids[begin + i] = unsorted[index.vAcc[i]];
      points[begin + i] = input[ids[begin + i]];
    }
    std::iota(index.vAcc.begin(), index.vAcc.end(), 0U);
  }

  /// At least `least`; of the first axes, as many as p isn't 0 on.
  static std::size_t axes_of(const Point& p, std::size_t least) {
    std::size_t axes = D;
    while (axes > least && coordinate<D>(p, axes - 1) == 0.0) --axes;
    return axes;
  }
  TreeQuery<D> query_at(const Point& p) const {
    TreeQuery<D> query;
    for (std::size_t axis = 0; axis < D; ++axis) query[axis] = coordinate<D>(p, axis);
    query[D] = std::bit_cast<double>(std::uint64_t{axes_of(p, axes)});
    return query;
  }

  /// Shows the result set all points that may be nearer than its worst one, the likeliest subtrees first.
  template <class Results>
  void search(const TreeQuery<D>& query, Results& results, std::size_t node = 1) const {
    if (node >= top.leaves) return search_tree(query, results, node - top.leaves);
    const double ahead = query[top.cuts[node].axis] - top.cuts[node].value;
    const std::size_t near = 2 * node + (ahead >= 0.0 ? 1 : 0);
    search(query, results, near);
    if (ahead * ahead <= results.worstDist()) search(query, results, near ^ 1);
  }
  template <class Results>
  void search_tree(const TreeQuery<D>& query, Results& results, std::size_t leaf) const {
    if (trees[leaf] == nullptr) return;
    const auto& index = trees[leaf]->index;
    double gap_sq = 0.0;  // to the box of the subtree's points
    for (std::size_t axis = 0; axis < D; ++axis) {
      const double nearest = std::clamp(query[axis], index.root_bbox[axis].low, index.root_bbox[axis].high);
      gap_sq += (query[axis] - nearest) * (query[axis] - nearest);
    }
    if (gap_sq > results.worstDist()) return;
    results.ids = ids.data() + first[leaf];
    index.findNeighbors(results, query.data(), nanoflann::SearchParams());
  }

  /// Shows take(id, distance) all points within the radius. The cuts alone say where they may lie, and a leaf is one
  /// run of memory; nanoflann's own search keeps the distance to each box. reach: a radius, a little longer.
  template <class Take>
  void visit_within(const TreeQuery<D>& query, double square, double reach, const Take& take,
                    std::size_t node = 1) const {
    if (node >= top.leaves) {
      const auto& tree = trees[node - top.leaves];
      if (tree != nullptr) visit_nodes(query, square, reach, first[node - top.leaves], tree->index.root_node, take);
      return;
    }
    const double ahead = query[top.cuts[node].axis] - top.cuts[node].value;
    if (ahead <= reach) visit_within(query, square, reach, take, 2 * node);
    if (-ahead <= reach) visit_within(query, square, reach, take, 2 * node + 1);
  }
  template <class Take>
  void visit_nodes(const TreeQuery<D>& query, double square, double reach, std::size_t begin,
                   const typename FlannTree<D>::Node* node, const Take& take) const {
    while (node->child1 != nullptr) {
      const auto& cut = node->node_type.sub;
      const double at = query[as_whole<std::size_t>(cut.divfeat)];
      const bool low = at - cut.divlow <= reach;
      const bool high = cut.divhigh - at <= reach;
      if (!low && !high) return;
      if (low && high) visit_nodes(query, square, reach, begin, node->child1, take);
      node = high ? node->child2 : node->child1;
    }
    for (std::size_t i = begin + node->node_type.lr.left; i < begin + node->node_type.lr.right; ++i) {
      const double sum = squared_distance<D>(query.data(), points[i]);
      if (sum <= square) take(ids[i], std::sqrt(sum));
    }
  }
};

template <int D>
void KdTree<D>::Fell::operator()(const Forest* forest) const noexcept {
  delete forest;
}

template <int D>
KdTree<D>::KdTree(std::span<const Point> points, const Execution& execution) {
  execution.check();
  if (!points.empty()) forest_.reset(new Forest(points, execution));
}

template <int D>
std::size_t KdTree<D>::size() const {
  return forest_ == nullptr ? 0 : forest_->points.size();
}

template <int D>
const PointOf<D>& KdTree<D>::point(VertexId id) const {
  return forest_->points[forest_->place_of[id]];
}

template <int D>
void KdTree<D>::nearest(const Point& p, std::size_t k, VertexId except, std::vector<Neighbour>& out) const {
  out.clear();
  if (k == 0 || forest_ == nullptr) return;
  NearestSet results(k, except, out);
  forest_->search(forest_->query_at(p), results);
  results.finish();
}

template <int D>
void KdTree<D>::for_each_within(const Point& p, const SearchRadius& radius,
                                FunctionRef<void(VertexId, double)> visit) const {
  if (forest_ == nullptr || radius.square() < 0.0) return;
  const double reach = std::sqrt(loose_square(radius.length()));
  forest_->visit_within(forest_->query_at(p), radius.square(), reach, visit);
}

template class KdTree<2>;
template class KdTree<3>;
template class KdTree<4>;
template class KdTree<16>;

template <int D>
void GrowingTree<D>::insert(const Point& p) {
  if constexpr (is_wide) {
    const std::size_t place = (points_.size() - filed_) % 8;
    if (place == 0) newest_.emplace_back()[0].fill(std::numeric_limits<float>::infinity());
    newest_.back()[0][place] = 0.0F;
    axes_ = std::max<std::size_t>(axes_, 1);
    for (std::size_t axis = 0; axis < D; ++axis) {
      if (p[axis] == 0.0) continue;
      axes_ = std::max(axes_, axis + 1);
      largest_ = std::max(largest_, std::abs(p[axis]));
      newest_.back()[axis][place] = static_cast<float>(std::clamp(p[axis], -largest_in_floats, largest_in_floats));
    }
  }
  points_.push_back(p);
  if (points_.size() - filed_ == smallest_tree) rebuild();
}

/// The newest points and all trees not larger than what they make together become one tree.
template <int D>
void GrowingTree<D>::rebuild() {
  std::size_t first = filed_;
  while (!levels_.empty() && levels_.back().tree.size() <= points_.size() - first) {
    first = levels_.back().first;
    levels_.pop_back();
  }
  const Execution alone{.threads = 1};
  levels_.push_back({first, KdTree<D>(std::span<const Point>(points_).subspan(first), alone)});
  filed_ = points_.size();
  newest_.clear();
  axes_ = 0;
  largest_ = 0.0;
}

template <int D>
template <class Take>
void GrowingTree<D>::look_at_newest(const Point& p, double most, bool only_nearest, const Take& take) {
  const auto look_at = [&](std::size_t id) { take(as_whole<VertexId>(id), distance_between<D>(points_[id], p)); };
  double largest = infinity;
  if constexpr (is_wide) {
    largest = largest_;
    for (const double x : p) largest = std::max(largest, std::abs(x));
  }
  if (!(largest <= largest_in_floats)) {
    for (std::size_t id = filed_; id < points_.size(); ++id) look_at(id);
    return;
  }
  if constexpr (is_wide) {
    using Fours = detail::VersionsOf<&measure_by_lanes<Lanes4, D>>;
    using Eights = detail::VersionsOf<&measure_by_lanes<Lanes8, D>>;
    const bool by_fours = detail::best_instruction_set() == detail::InstructionSet::baseline;
    const auto measure = by_fours ? &Fours::baseline : &Eights::avx2;
    std::array<float, D> from;
    double beyond = 0.0;  // on axes that all others have 0 on
    for (std::size_t axis = 0; axis < D; ++axis) {
      from[axis] = static_cast<float>(p[axis]);
      if (axis >= axes_) beyond += p[axis] * p[axis];
    }
    squares_.resize(8 * newest_.size());
    leasts_.resize(8 * ((newest_.size() + blocks_of_group - 1) / blocks_of_group));
    const float least =
        measure(newest_, {from.data(), axes_}, static_cast<float>(beyond), squares_.data(), leasts_.data());
    // A difference is wrong by two roundings of its numbers and one of its own, their squares' sum by one a term, and
    // squares of the least numbers are lost.
    const double wrong = 0x1p-22 * D * largest + 1e-18;
    const auto farther = [&](double distance) { return (distance + wrong) * (1.0 + 1e-5); };
    if (only_nearest) most = std::min(most, farther(std::sqrt(double{least})));
    const double far = std::min(farther(most), 16.0 * largest_in_floats);
    const auto limit = static_cast<float>(far * far);
    for (std::size_t i = 0; i < leasts_.size(); ++i) {
      if (!(leasts_[i] <= limit)) continue;
      const std::size_t group = i / 8 * 8 * blocks_of_group;
      const std::size_t end = std::min(group + 8 * blocks_of_group, squares_.size());
      for (std::size_t k = group + i % 8; k < end; k += 8) {
        if (squares_[k] <= limit) look_at(filed_ + k);
      }
    }
  }
}

template <int D>
Neighbour GrowingTree<D>::nearest(const Point& p) {
  Neighbour best{no_vertex, std::numeric_limits<double>::infinity()};
  for (const Level& level : levels_) {
    const auto consider = [&](VertexId place, double distance) {
      best = std::min(best, Neighbour{as_whole<VertexId>(level.first + place), distance});
    };
    if (best.id != no_vertex) {
      level.tree.for_each_within(p, best.distance, consider);
      continue;
    }
    level.tree.nearest(p, 1, no_vertex, found_);
    consider(found_.front().id, found_.front().distance);
  }
  look_at_newest(p, best.distance, true, [&](VertexId id, double distance) {
    best = std::min(best, Neighbour{id, distance});
  });
  return best;
}

/// The k of the largest tree, and of the others what is not farther than these.
template <int D>
void GrowingTree<D>::nearest(const Point& p, std::size_t k, std::vector<Neighbour>& out) {
  out.clear();
  if (k == 0) return;
  const auto keep = [&out, k] {
    if (out.size() <= k) return;
    std::nth_element(out.begin(), out.begin() + as_whole<std::ptrdiff_t>(k), out.end());
    out.resize(k);
  };
  const auto reach = [&out, k] {
    return out.size() < k ? infinity : std::max_element(out.begin(), out.end())->distance;
  };
  for (const Level& level : levels_) {
    const auto take = [&](VertexId place, double distance) {
      out.push_back({as_whole<VertexId>(level.first + place), distance});
    };
    if (const double most = reach(); most < infinity) {
      level.tree.for_each_within(p, most, take);
    } else {
      level.tree.nearest(p, k, no_vertex, found_);
      for (const Neighbour& found : found_) take(found.id, found.distance);
    }
    keep();
  }
  const double most = reach();
  look_at_newest(p, most, false, [&](VertexId id, double distance) {
    if (distance <= most) out.push_back({id, distance});
  });
  keep();
  std::sort(out.begin(), out.end());
}

template class GrowingTree<2>;
template class GrowingTree<3>;
template class GrowingTree<4>;
template class GrowingTree<16>;

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/points/point_grid.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <numbers>

#include "core/plane/polygon.hpp"
#include "parallel/sort.hpp"

namespace warren {
namespace detail {
namespace {

using Lanes4 = std::int32_t __attribute__((vector_size(16)));
using Lanes8 = std::int32_t __attribute__((vector_size(32)));

/// rank[i] = how many keys are smaller than key[i]: two vectors of keys at a time against each key.
template <class Lanes>
[[gnu::always_inline]] inline void count_smaller(const std::int32_t* key, std::size_t count, std::int32_t* rank) {
  constexpr std::size_t width = sizeof(Lanes) / sizeof(std::int32_t);
  for (std::size_t first = 0; first < count; first += 2 * width) {
    Lanes low;
    Lanes high;
    std::memcpy(&low, key + first, sizeof low);
    std::memcpy(&high, key + first + width, sizeof high);
    Lanes below_low{};
    Lanes below_high{};
    for (std::size_t j = 0; j < count; ++j) {
      const Lanes other = Lanes{} + key[j];
      below_low -= other < low;
      below_high -= other < high;
    }
    std::memcpy(rank + first, &below_low, sizeof below_low);
    std::memcpy(rank + first + width, &below_high, sizeof below_high);
  }
}

}  // namespace

std::size_t DiscPoints::sort_roughly(std::size_t k, double scale, InstructionSet set) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(square[i] * scale));
    key[i] = as_whole<std::int32_t>((bits & ~index_mask) | as_whole<std::uint32_t>(i));
  }
  for (std::size_t i = count; i < count + padding; ++i) key[i] = std::numeric_limits<std::int32_t>::max();
  const auto count_all = set == InstructionSet::baseline ? &VersionsOf<&count_smaller<Lanes4>>::baseline
                                                         : &VersionsOf<&count_smaller<Lanes8>>::avx2;
  count_all(key, count, rank);
  for (std::size_t i = 0; i < count; ++i) by_rank[rank[i]] = as_whole<std::uint32_t>(i);
  const std::int32_t limit = (key[by_rank[k - 1]] | as_whole<std::int32_t>(index_mask)) + std::int32_t{capacity};
  while (k < count && key[by_rank[k]] <= limit) ++k;
  return k;
}

}  // namespace detail
namespace {
constexpr std::size_t grid_grain = std::size_t{1} << 15;
}  // namespace

CellFrame::CellFrame(const Box& box, std::size_t count) {
  if (count == 0 || box.empty()) return;
  const double width = box.width();
  const double height = box.height();
  const double share = usual_load / static_cast<double>(count);  // of the box, for one cell
  // The second term keeps a thin box from being cut into more columns than there are points.
  const double size =
      std::max(std::sqrt(width) * std::sqrt(height) * std::sqrt(share), std::max(width, height) * share);
  origin_ = box.min;
  cell_size_ = size > 0.0 ? size : 1.0;
  scale_ = 1.0 / cell_size_;
  columns_ = bounded_whole<std::uint32_t>(std::floor(width * scale_)) + 1;
  rows_ = bounded_whole<std::uint32_t>(std::floor(height * scale_)) + 1;
}

Box bounding_box(std::span<const Vec2> positions, const Execution& execution) {
  const std::vector<Box> boxes = parts_of_chunks(positions.size(), grid_grain, execution.quiet(), [&](Range range) {
    return box_around(positions.subspan(range.first, range.size()));
  });
  Box all;
  for (const Box& box : boxes) all.include(box);
  return all;
}

RawVector<std::uint32_t> tile_order(std::span<const Vec2> positions, const Execution& execution) {
  const CellFrame frame(bounding_box(positions, execution), positions.size());
  return counting_sort(positions.size(), frame.cell_count(), execution,
                       [&](std::size_t i) { return frame.cell_of(positions[i]); })
      .items;
}

PointGrid::PointGrid(std::span<const Vec2> points, const Execution& execution) {
  if (points.empty()) return;
  execution.reserve(points.size() * 2);
  frame_ = CellFrame(bounding_box(points, execution), points.size());
  if (in_order(points, execution)) {
    points_ = points;
    file_points(execution);
  } else {
    sort_points(points, execution);
  }
  for (std::size_t k = 0; k < first_reach_.size(); ++k) first_reach_[k] = first_reach(k);
  const std::uint64_t sum = sum_of_chunks(frame_.cell_count(), grid_grain, execution.quiet(), [&](Range range) {
    std::uint64_t squares = 0;  // below 2^64, for n is below 2^32
    for (std::size_t cell = range.first; cell < range.last; ++cell) {
      const std::uint64_t count = begin_[cell + 1] - begin_[cell];
      squares += count * count;
    }
    return squares;
  });
  crowding_ = static_cast<double>(sum) / static_cast<double>(size());
}

/// Are the points in tile order? A pass of its own: filed out of order, two chunks would write the same cell.
bool PointGrid::in_order(std::span<const Vec2> points, const Execution& execution) const {
  const std::size_t first_too_late = first_in_chunks(points.size(), grid_grain, execution.quiet(), [&](Range range) {
    std::size_t before = frame_.cell_of(points[range.first == 0 ? 0 : range.first - 1]);
    for (std::size_t i = range.first; i < range.last; ++i) {
      const std::size_t cell = frame_.cell_of(points[i]);
      if (cell < before) return i;
      before = cell;
    }
    return range.last;
  });
  return first_too_late == points.size();
}

/// Files points that are in tile order.
void PointGrid::file_points(const Execution& execution) {
  const std::size_t n = points_.size();
  begin_.resize(frame_.cell_count() + 1);
  for_chunks(n, grid_grain, execution.quiet(), [&](Range range) {
    std::size_t next = range.first == 0 ? 0 : std::size_t{frame_.cell_of(points_[range.first - 1])} + 1;  // not filed
    for (std::size_t i = range.first; i < range.last; ++i) {
      const std::size_t cell = frame_.cell_of(points_[i]);
      for (; next <= cell; ++next) begin_[next] = as_whole<std::uint32_t>(i);
    }
  });
  const std::size_t last = frame_.cell_of(points_.back());
  std::fill(begin_.begin() + as_whole<std::ptrdiff_t>(last) + 1, begin_.end(), as_whole<std::uint32_t>(n));
}

void PointGrid::sort_points(std::span<const Vec2> points, const Execution& execution) {
  execution.reserve(points.size() * 24);
  ItemsByKey order = counting_sort(points.size(), frame_.cell_count(), execution,
                                   [&](std::size_t i) { return frame_.cell_of(points[i]); });
  begin_ = std::move(order.first);
  id_ = std::move(order.items);
  place_of_.resize(points.size());
  sorted_.resize(points.size());
  for_each_index(points.size(), grid_grain, execution.quiet(), [&](std::size_t place) {
    sorted_[place] = points[id_[place]];
    place_of_[id_[place]] = as_whole<std::uint32_t>(place);
  });
  points_ = sorted_;
}

/// The k nearest points of the window among those with squared distance <= square (fewer if there are not so many). For
/// any k and any crowding; O(points of the window).
void PointGrid::nearest_in_window(Vec2 p, const Window& w, double square, std::size_t k, VertexId except,
                                  std::vector<Neighbour>& out) const {
  out.clear();
  const auto keep_best = [&] {
    std::nth_element(out.begin(), out.begin() + as_whole<std::ptrdiff_t>(k) - 1, out.end());
    out.resize(k);
    square = SearchRadius(out.back().distance).square();
  };
  for_each_run(w, [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t place = first; place < last; ++place) {
      const Vec2 along = points_[place] - p;
      const double sum = along.x * along.x + along.y * along.y;
      if (sum > square || id_at(place) == except) continue;
      out.push_back({id_at(place), std::sqrt(sum)});
      if (out.size() == 4 * k + 64) keep_best();
    }
  });
  if (out.size() > k) keep_best();
  std::sort(out.begin(), out.end());
}

/// The fast way for small k: how many points the disc holds if they are fewer than k, no_vertex if they are too many
/// for it (`out` is anything then), and k if it holds the k nearest, which `out` then is.
std::size_t PointGrid::nearest_in_disc(Vec2 p, const Window& w, double square, std::size_t k, VertexId except,
                                       std::vector<Neighbour>& out) const {
  detail::DiscPoints disc;
  const std::uint32_t skip = except < size() ? (place_of_.empty() ? except : place_of_[except]) : no_vertex;
  bool fits = true;
  for_each_run(w, [&](std::uint32_t first, std::uint32_t last) {
    fits = fits && disc.count + (last - first) <= detail::DiscPoints::capacity;
    if (fits) disc.add_run(p, square, points_, first, last, skip);
  });
  if (!fits) return no_vertex;
  if (disc.count < k) return disc.count;
  const std::size_t candidates = disc.sort_roughly(k, 1.0 / square);
  out.resize(candidates);
  bool sorted = true;  // nearly always: the loop above it has no branch to mispredict
  for (std::size_t i = 0; i < candidates; ++i) {
    const std::uint32_t from = disc.by_rank[i];
    out[i] = {id_at(disc.place[from]), std::sqrt(disc.square[from])};
    sorted &= i == 0 || !(out[i] < out[i - 1]);
  }
  if (!sorted) std::sort(out.begin(), out.end());
  out.resize(k);
  return k;
}

/// Radius of a disc that holds k points, its own and a margin where points are spread evenly: 19 of 20 suffice.
double PointGrid::first_reach(std::size_t k) const {
  const double expected = static_cast<double>(k) + 1.0 + 1.7 * std::sqrt(static_cast<double>(k) + 1.0);
  return frame_.cell_size() * std::sqrt(expected / (std::numbers::pi * CellFrame::usual_load));
}

void PointGrid::nearest(Vec2 p, std::size_t k, VertexId except, std::vector<Neighbour>& out) const {
  out.clear();
  k = std::min(k, size());
  if (k == 0) return;
  bool small = k < first_reach_.size();
  bool grown = false;
  double reach = small ? first_reach_[k] : first_reach(k);
  for (;;) {
    const double square = reach * reach;  // of points in the window, whatever the rounding: it reaches a little further
    const Window w = window(p, reach * (1.0 + 1e-15));
    const bool all = w == whole();
    std::size_t found = small ? nearest_in_disc(p, w, square, k, except, out) : no_vertex;
    if (found == no_vertex && small && !grown && reach > 0.5 * frame_.cell_size()) {
      reach *= 0.6;  // points crowd here: a smaller disc is quicker than the slow way
      continue;
    }
    if (found == no_vertex || (all && found < k)) {
      small = false;
      nearest_in_window(p, w, all ? std::numeric_limits<double>::infinity() : square, k, except, out);
      found = out.size();
    }
    if (all || found == k) return;
    reach *= found * 4 < k ? 2.0 : 1.3;
    grown = true;
  }
}

}  // namespace warren

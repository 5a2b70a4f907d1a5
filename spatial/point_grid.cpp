// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/point_grid.hpp"

#include <algorithm>
#include <numeric>

#include "parallel/sort.hpp"

namespace warren {
namespace {
constexpr std::size_t grain = std::size_t{1} << 15;
}  // namespace

PointGrid::PointGrid(std::span<const Vec2> points, const Execution& execution) {
  if (points.empty()) return;
  execution.reserve(points.size() * 18);
  frame_ = CellFrame(bounding_box({&points.front().x, 2, points.size()}, execution), points.size());
  x_.resize(points.size());
  y_.resize(points.size());
  if (!take_points(points, execution)) sort_points(points, execution);
  count_crowding(execution);
}

void PointGrid::count_crowding(const Execution& execution) {
  const std::size_t cells = frame_.cell_count();
  std::vector<std::uint64_t> sums(chunk_count(cells, grain), 0);  // of squares: below 2^64, n is below 2^32
  for_chunks(cells, grain, detail::quiet(execution), [&](Range range) {
    std::uint64_t sum = 0;
    for (std::size_t cell = range.first; cell < range.last; ++cell) {
      const std::uint64_t count = begin_[cell + 1] - begin_[cell];
      sum += count * count;
    }
    sums[range.first / grain] = sum;
  });
  const std::uint64_t sum = std::accumulate(sums.begin(), sums.end(), std::uint64_t{0});
  crowding_ = static_cast<double>(sum) / static_cast<double>(size());
}

std::size_t PointGrid::bytes() const {
  return (x_.size() + y_.size()) * sizeof(double) + (begin_.size() + id_.size() + place_of_.size()) * sizeof(VertexId);
}

/// Copies points that are in tile order, and files them; false if they turn out not to be.
bool PointGrid::take_points(std::span<const Vec2> points, const Execution& execution) {
  const std::size_t n = points.size();
  begin_.resize(frame_.cell_count() + 1);
  std::vector<std::uint8_t> sorted(chunk_count(n, grain), 0);
  for_chunks(n, grain, detail::quiet(execution), [&](Range range) {
    std::size_t next = range.first == 0 ? 0 : std::size_t{frame_.cell_of(points[range.first - 1])} + 1;  // unfiled cell
    for (std::size_t i = range.first; i < range.last; ++i) {
      const std::size_t cell = frame_.cell_of(points[i]);
      if (cell + 1 < next) return;
      for (; next <= cell; ++next) begin_[next] = static_cast<std::uint32_t>(i);
      x_[i] = points[i].x;
      y_[i] = points[i].y;
    }
    sorted[range.first / grain] = 1;
  });
  if (std::find(sorted.begin(), sorted.end(), 0) != sorted.end()) return false;
  const std::size_t last = frame_.cell_of(points.back());
  std::fill(begin_.begin() + static_cast<std::ptrdiff_t>(last) + 1, begin_.end(), static_cast<std::uint32_t>(n));
  return true;
}

void PointGrid::sort_points(std::span<const Vec2> points, const Execution& execution) {
  KeyOrder order = counting_sort(points.size(), frame_.cell_count(), execution,
                                 [&](std::size_t i) { return frame_.cell_of(points[i]); });
  begin_ = std::move(order.first);
  id_ = std::move(order.item);
  place_of_.resize(points.size());
  for_chunks(points.size(), grain, detail::quiet(execution), [&](Range range) {
    for (std::size_t place = range.first; place < range.last; ++place) {
      x_[place] = points[id_[place]].x;
      y_[place] = points[id_[place]].y;
      place_of_[id_[place]] = static_cast<std::uint32_t>(place);
    }
  });
}

void PointGrid::within(Vec2 p, const SearchRadius& radius, VertexId except, std::vector<Neighbour>& out) const {
  out.clear();
  for_each_within(p, radius, [&](VertexId id, double distance) {
    if (id != except) out.push_back({id, distance});
  });
  std::sort(out.begin(), out.end());
}

/// The k nearest points of the window among those with squared distance <= square, unsorted.
void PointGrid::collect(Vec2 p, const Window& w, std::size_t k, VertexId except, double square,
                        std::vector<Neighbour>& out) const {
  out.clear();
  const std::size_t most = 4 * k + 64;
  for_each_run(w, [&](std::uint32_t first, std::uint32_t last) {
    for (std::uint32_t place = first; place < last; ++place) {
      const double dx = x_[place] - p.x;
      const double dy = y_[place] - p.y;
      const double sum = dx * dx + dy * dy;
      if (sum > square || id_at(place) == except) continue;
      out.push_back({id_at(place), std::sqrt(sum)});
      if (out.size() < most) continue;
      std::nth_element(out.begin(), out.begin() + static_cast<std::ptrdiff_t>(k) - 1, out.end());
      out.resize(k);
      square = SearchRadius(out.back().distance).square();
    }
  });
}

void PointGrid::nearest(Vec2 p, std::size_t k, VertexId except, std::vector<Neighbour>& out) const {
  out.clear();
  k = std::min(k, size());
  if (k == 0) return;
  // A disc that holds about 1.5 k + 1 points where the points are spread evenly; doubled until it holds k.
  double reach = frame_.cell_size() * std::sqrt((1.5 * static_cast<double>(k) + 1.0) / 6.28);
  for (;;) {
    const SearchRadius radius(reach);
    const Window w = window(p, radius.reach());
    const bool all = w == whole();
    collect(p, w, k, except, all ? std::numeric_limits<double>::infinity() : radius.square(), out);
    if (all || out.size() >= k) break;
    reach *= out.size() * 4 < k ? 2.0 : 1.4;
  }
  std::sort(out.begin(), out.end());
  if (out.size() > k) out.resize(k);
}

}  // namespace warren

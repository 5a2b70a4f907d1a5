// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/obstacles/segment_grid.hpp"

#include <cmath>

namespace warren {
namespace {

constexpr std::size_t segments_per_poll = 1 << 16;
constexpr std::uint32_t most_lines = 8192;     // an axis
constexpr std::size_t most_listings_each = 8;  // a segment on average, else the cells grow

}  // namespace

void SegmentGrid::lay_out(const Box& around, std::size_t segments, double scale) {
  const Box box = around.empty() ? Box{{}, {}} : around;
  const double w = box.width();
  const double h = box.height();
  const double longer = std::max(w, h);
  const double magnitude =
      std::max({std::abs(box.min.x), std::abs(box.min.y), std::abs(box.max.x), std::abs(box.max.y)});
  const double n = static_cast<double>(std::max<std::size_t>(segments, 1));
  cell_ =
      scale * std::max({std::sqrt(w / n) * std::sqrt(h), longer / std::min(n, double{most_lines}), magnitude * 1e-14});
  if (!(cell_ > 0.0)) cell_ = 1.0;
  slack_ = 1e-6 * cell_ + 1e-15 * magnitude;
  origin_ = {box.min.x - 0.5 * cell_, box.min.y - 0.5 * cell_};
  cols_ = bounded_whole<std::uint32_t>(w / cell_) + 2;
  rows_ = bounded_whole<std::uint32_t>(h / cell_) + 2;
}

SegmentGrid::Cell SegmentGrid::cell_of(Vec2 p) const {
  const auto settle = [](std::uint32_t i, std::uint32_t count, double c, const auto& line) {
    while (i > 0 && line(i) > c) --i;
    while (i + 1 < count && line(i + 1) <= c) ++i;
    return i;
  };
  return {settle(col_at(p.x), cols_, p.x, [&](std::uint32_t i) { return x_line(i); }),
          settle(row_at(p.y), rows_, p.y, [&](std::uint32_t i) { return y_line(i); })};
}

SegmentGrid::SegmentGrid(std::span<const Segment> segments, const Execution& execution) {
  Box box;
  for (const Segment& s : segments) box.include(box_of(s));
  for (double scale = 1.0;; scale *= 2.0) {
    lay_out(box, segments.size(), scale);
    execution.reserve((cell_count() + 1) * sizeof(std::uint64_t));
    assign_polled(offsets_, cell_count() + 1, std::uint64_t{0}, [&] { execution.check(); });
    const std::uint64_t most_listings = most_listings_each * segments.size() + 4 * std::uint64_t{most_lines};
    std::uint64_t listings = 0;
    for (std::size_t i = 0; i < segments.size() && (listings <= most_listings || cell_count() <= 64); ++i) {
      if (i % segments_per_poll == 0) execution.check();
      for_each_cell_near(segments[i], slack_, [&](Cell cell) {
        ++offsets_[index(cell)];
        ++listings;
        return true;
      });
    }
    if (listings <= most_listings || cell_count() <= 64) break;
  }
  std::uint64_t sum = 0;
  for (std::uint64_t& offset : offsets_) sum += offset, offset = sum;
  execution.reserve(sum * sizeof(std::uint32_t));
  segments_.resize(sum);
  for (std::size_t i = segments.size(); i-- > 0;) {  // from the last, so that each cell's list ascends
    if (i % segments_per_poll == 0) execution.check();
    for_each_cell_near(segments[i], slack_, [&](Cell cell) {
      segments_[--offsets_[index(cell)]] = as_whole<std::uint32_t>(i);
      return true;
    });
  }
}

}  // namespace warren

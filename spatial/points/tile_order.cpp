// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/points/tile_order.hpp"

#include <cmath>
#include <vector>

#include "core/plane/polygon.hpp"
#include "parallel/sort.hpp"

namespace warren {
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
  constexpr std::size_t grain = std::size_t{1} << 15;
  const std::vector<Box> boxes = parts_of_chunks(positions.size(), grain, execution.quiet(), [&](Range range) {
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

}  // namespace warren

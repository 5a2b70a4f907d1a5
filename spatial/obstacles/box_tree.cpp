// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/obstacles/box_tree.hpp"

#include <numeric>

#include "core/base/whole.hpp"
#include "spatial/points/neighbour.hpp"

namespace warren {
namespace {

constexpr std::uint32_t box_leaf_size = 4;
constexpr std::uint32_t polled_boxes = 1U << 12U;  // or comparisons of them

template <int D>
BoxOf<D> joined(const BoxOf<D>& a, const BoxOf<D>& b) {
  BoxOf<D> box;
  for (std::size_t axis = 0; axis < D; ++axis) {
    box.low[axis] = std::min(a.low[axis], b.low[axis]);
    box.high[axis] = std::max(a.high[axis], b.high[axis]);
  }
  return box;
}

}  // namespace

template <int D>
struct BoxTree<D>::Building {
  std::span<const BoxOf<D>> boxes;
  const Execution& execution;
  std::vector<std::uint32_t> room;  // of ids
};

template <int D>
BoxTree<D>::BoxTree(std::span<const BoxOf<D>> boxes, const Execution& execution) {
  if (boxes.empty()) return;
  execution.reserve(boxes.size() * (sizeof(Node) + sizeof(BoxOf<D>) + 2 * sizeof(std::uint32_t)));
  order_.resize(boxes.size());
  std::iota(order_.begin(), order_.end(), 0U);
  nodes_.reserve(boxes.size());
  Building building{boxes, execution, std::vector<std::uint32_t>(boxes.size())};
  build(0, as_whole<std::uint32_t>(boxes.size()), building);
  boxes_.reserve(boxes.size());
  for (const std::uint32_t id : order_) {
    execution.poll(boxes_.size());
    boxes_.push_back(boxes[id]);
  }
}

/// Depth of the tree: the halves differ by one, so at most 31 for 2^31 boxes. Ids are in order, and stay so in both
/// halves: nth_element leaves one that libraries differ in.
template <int D>
void BoxTree<D>::build(std::uint32_t first, std::uint32_t last, Building& building) {
  if (last - first >= polled_boxes) building.execution.check();
  const std::span<const BoxOf<D>> boxes = building.boxes;
  const std::span<std::uint32_t> ids(order_.data() + first, last - first);
  BoxOf<D> box = boxes[ids.front()];
  for (const std::uint32_t id : ids) {
    building.execution.poll(id);
    box = joined(box, boxes[id]);
  }
  const auto node = as_whole<std::uint32_t>(nodes_.size());
  nodes_.push_back({box, first, last - first});
  if (ids.size() <= box_leaf_size) return;
  const auto doubled_centre = [&](std::uint32_t id, std::size_t on) { return boxes[id].low[on] + boxes[id].high[on]; };
  const std::size_t axis = widest_axis<D>(ids, doubled_centre);
  std::uint32_t comparisons = 0;
  const auto less = [&](std::uint32_t a, std::uint32_t b) {
    if (++comparisons % polled_boxes == 0) building.execution.check();
    const double left = doubled_centre(a, axis);
    const double right = doubled_centre(b, axis);
    return left != right ? left < right : a < b;
  };
  const std::uint32_t middle = first + (last - first) / 2;
  const std::span<std::uint32_t> room(building.room.data(), ids.size());
  std::ranges::copy(ids, room.begin());
  std::nth_element(room.begin(), room.begin() + (middle - first), room.end(), less);
  const std::uint32_t median = room[middle - first];
  std::size_t before = 0;
  std::size_t behind = 0;
  for (const std::uint32_t id : ids) (less(id, median) ? ids[before++] : room[behind++]) = id;
  std::ranges::copy(room.first(behind), ids.begin() + (middle - first));
  build(first, middle, building);
  nodes_[node].first = as_whole<std::uint32_t>(nodes_.size());
  nodes_[node].count = 0;
  build(middle, last, building);
}

template class BoxTree<2>;
template class BoxTree<3>;

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/solid_index.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "core/error.hpp"

namespace warren {
namespace {

bool is_coordinate(double x) { return std::abs(x) <= largest_coordinate; }

void check(const Sphere& s, std::size_t number) {
  if (is_coordinate(s.x) && is_coordinate(s.y) && is_coordinate(s.z) && s.radius >= 0.0 && is_coordinate(s.radius))
    return;
  throw InputError("sphere " + std::to_string(number), "must be numbers of at most 1e60, the radius 0 at least");
}

void check(const SolidBox& box, std::size_t number) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (is_coordinate(box.low[axis]) && is_coordinate(box.high[axis]) && box.low[axis] <= box.high[axis]) continue;
    throw InputError("box " + std::to_string(number), "must be numbers of at most 1e60, the lower corner first");
  }
}

BoxOf<3> bounds_of(const Sphere& s) {
  return {{s.x - s.radius, s.y - s.radius, s.z - s.radius}, {s.x + s.radius, s.y + s.radius, s.z + s.radius}};
}

BoxOf<3> bounds_of(const Spine& spine) {
  const Vec3 b = spine.a + spine.way;
  const Vec3 low = spine.a.cwiseMin(b);
  const Vec3 high = spine.a.cwiseMax(b);
  return {{low.x(), low.y(), low.z()}, {high.x(), high.y(), high.z()}};
}

}  // namespace

SolidIndex::SolidIndex(std::span<const Sphere> spheres, std::span<const SolidBox> boxes)
    : boxes_(boxes.begin(), boxes.end()) {
  std::vector<Solid> solids;
  std::vector<BoxOf<3>> bounds;
  for (const Sphere& s : spheres) {
    check(s, solids.size());
    solids.push_back({{s.x, s.y, s.z}, s.radius, no_box});
    bounds.push_back(bounds_of(s));
  }
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    check(boxes[i], i);
    solids.push_back({Vec3::Zero(), 0.0, static_cast<std::int32_t>(i)});
    bounds.push_back({boxes[i].low, boxes[i].high});
  }
  for (const BoxOf<3>& b : bounds) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      extent_ = std::max({extent_, std::abs(b.low[axis]), std::abs(b.high[axis])});
    }
  }
  tree_ = BoxTree<3>(bounds);
  for (const std::uint32_t i : tree_.order()) solids_.push_back(solids[i]);
}

double SolidIndex::distance(const Spine& spine, double enough) const {
  double nearest = std::numeric_limits<double>::infinity();
  tree_.search(bounds_of(spine), enough, [&](std::uint32_t place) {
    const Solid& solid = solids_[place];
    const double square = solid.box == no_box ? distance_square(spine, solid.centre)
                                              : distance_square(spine, boxes_[static_cast<std::size_t>(solid.box)]);
    nearest = std::min(nearest, std::max(0.0, std::sqrt(square) - solid.radius));
    return std::min(enough, nearest);
  });
  return nearest;
}

Room SolidIndex::room(const Spine& spine, double touch, double enough) const {
  constexpr double end = -1.0;
  Room room = Room::clear;
  tree_.search(bounds_of(spine), enough, [&](std::uint32_t place) {
    const Solid& solid = solids_[place];
    if (room == Room::clear && is_within(spine, solid, enough)) room = Room::narrow;
    if (room == Room::clear || !is_within(spine, solid, touch)) return room == Room::clear ? enough : touch;
    room = Room::blocked;
    return end;
  });
  return room;
}

}  // namespace warren

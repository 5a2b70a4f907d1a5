// SPDX-License-Identifier: BSD-3-Clause
#include "planners/shorten/certain_clearance.hpp"

#include <algorithm>

namespace warren {
namespace {

constexpr double margin = 1.0 + 1e-12;

/// Is high - low >= r? Exact: the rounding error of the difference decides where it rounds to r.
bool is_apart(double low, double high, double r) noexcept {
  const double difference = high - low;
  if (difference != r) return difference > r;
  const double taken = high - difference;
  const double error = (high - (difference + taken)) + (taken - low);
  return error >= 0.0;
}

bool boxes_are_apart(const Box& a, const Box& b, double r) noexcept {
  return is_apart(a.max.x, b.min.x, r) || is_apart(b.max.x, a.min.x, r) || is_apart(a.max.y, b.min.y, r) ||
         is_apart(b.max.y, a.min.y, r);
}

}  // namespace

bool certainly_keeps_clearance(const WallIndex& walls, const Segment& leg, double r) noexcept {
  if (r == 0.0) return !walls.blocks(leg.a, leg.b);
  if (walls.keeps_clearance(leg.a, leg.b, r * margin)) return true;
  const Box box = box_of(leg);
  bool keeps = true;
  walls.for_each_near(box.grown(r * margin), [&](const Segment& wall) {
    keeps = boxes_are_apart(box, box_of(wall), r) || segments_keep_distance(leg, wall, r * margin);
    return keeps;
  });
  return keeps;
}

}  // namespace warren

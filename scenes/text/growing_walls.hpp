// SPDX-License-Identifier: BSD-3-Clause
// Collects walls one by one when their number is not known: as floats until the first that no float holds, as doubles
// from then on. Growing asks for memory first.
#pragma once

#include <cmath>
#include <limits>

#include "core/plane/wall_set.hpp"
#include "parallel/execution.hpp"

namespace warren {

class WallCollector {
 public:
  explicit WallCollector(const Execution& execution) : execution_(execution) {}

  void add(double x1, double y1, double x2, double y2) {
    if (!doubles_used_ && (!fits(x1) || !fits(y1) || !fits(x2) || !fits(y2))) widen();
    if (doubles_used_) {
      push(doubles_, {x1, y1, x2, y2});
    } else {
      push(floats_, {static_cast<float>(x1), static_cast<float>(y1), static_cast<float>(x2), static_cast<float>(y2)});
    }
  }
  std::size_t size() const { return doubles_used_ ? doubles_.size() : floats_.size(); }
  WallSet take() { return doubles_used_ ? WallSet(std::move(doubles_)) : WallSet(std::move(floats_)); }

 private:
  static bool fits(double x) {
    return std::abs(x) <= std::numeric_limits<float>::max() && static_cast<double>(static_cast<float>(x)) == x;
  }
  template <class Wall>
  void push(RawVector<Wall>& walls, const Wall& wall) {
    if (walls.size() == walls.capacity()) execution_.reserve(2 * walls.capacity() * sizeof(Wall));
    walls.push_back(wall);
  }
  void widen() {
    execution_.reserve(floats_.size() * sizeof(DoubleWall));
    doubles_.reserve(floats_.size());
    for (const FloatWall& w : floats_) doubles_.push_back({w.x1, w.y1, w.x2, w.y2});
    floats_ = {};
    doubles_used_ = true;
  }

  const Execution& execution_;
  RawVector<FloatWall> floats_;
  RawVector<DoubleWall> doubles_;
  bool doubles_used_ = false;
};

}  // namespace warren

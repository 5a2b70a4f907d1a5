// SPDX-License-Identifier: BSD-3-Clause
// Collects walls one by one when their number is not known: packed until the first that doesn't fit, as floats until
// the first that no float holds, as doubles from then on. Growing asks for memory first.
#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>
#include <variant>

#include "core/plane/wall_set.hpp"
#include "parallel/execution.hpp"

namespace warren {

class WallCollector {
 public:
  explicit WallCollector(const Execution& execution) : execution_(execution) {}

  void add(double x1, double y1, double x2, double y2) {
    if (auto* packed = std::get_if<RawVector<PackedWall>>(&walls_)) {
      if (PackedWall::fits(x1, y1, x2, y2)) return push(*packed, PackedWall::of(x1, y1, x2, y2));
      widen<float>(*packed);
    }
    if (auto* floats = std::get_if<RawVector<FloatWall>>(&walls_)) {
      if (fit_floats(x1, y1, x2, y2)) return push(*floats, wall<float>(x1, y1, x2, y2));
      widen<double>(*floats);
    }
    push(std::get<RawVector<DoubleWall>>(walls_), {x1, y1, x2, y2});
  }
  std::size_t size() const {
    return std::visit([](const auto& walls) { return walls.size(); }, walls_);
  }
  WallSet take() {
    return std::visit([](auto& walls) { return WallSet(std::move(walls)); }, walls_);
  }

 private:
  template <class... Numbers>
  static bool fit_floats(Numbers... xs) {
    const auto fits = [](double x) {
      return std::abs(x) <= std::numeric_limits<float>::max() && static_cast<double>(static_cast<float>(x)) == x;
    };
    return (fits(xs) && ...);
  }
  template <class T, class... Numbers>
  static WallOf<T> wall(Numbers... xs) {
    return {static_cast<T>(xs)...};
  }
  template <class Wall>
  void push(RawVector<Wall>& walls, const Wall& wall) {
    if (walls.size() == walls.capacity()) execution_.reserve(2 * walls.capacity() * sizeof(Wall));
    walls.push_back(wall);
  }
  /// `narrow` ends with the call.
  template <class T, class Wall>
  void widen(const RawVector<Wall>& narrow) {
    execution_.reserve(narrow.size() * sizeof(WallOf<T>));
    RawVector<WallOf<T>> wide;
    wide.reserve(narrow.size());
    std::transform(narrow.begin(), narrow.end(), std::back_inserter(wide), [](const Wall& packed) {
      const auto [x1, y1, x2, y2] = unpacked(packed);
      return wall<T>(x1, y1, x2, y2);
    });
    walls_ = std::move(wide);
  }

  const Execution& execution_;
  std::variant<RawVector<PackedWall>, RawVector<FloatWall>, RawVector<DoubleWall>> walls_;
};

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// The states of a path, whatever the body: so many numbers each, one after the other.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/plane/se2.hpp"

namespace warren {

/// States of any body, one after the other.
struct StateList {
  std::size_t width = 2;        ///< numbers a state: 2, 3 or 6
  std::vector<double> numbers;  ///< width * size() of them

  /// States.
  std::size_t size() const { return numbers.size() / width; }
  /// Are there none?
  bool empty() const { return numbers.empty(); }
  /// The numbers of state i; i < size().
  std::span<const double> operator[](std::size_t i) const { return std::span(numbers).subspan(i * width, width); }
  /// state has `width` numbers.
  void add(std::span<const double> state) { numbers.insert(numbers.end(), state.begin(), state.end()); }
};

/// Of states of three numbers.
inline std::vector<Se2> poses_of(const StateList& states) {
  std::vector<Se2> poses;
  for (std::size_t i = 0; i < states.size(); ++i) poses.push_back({states[i][0], states[i][1], states[i][2]});
  return poses;
}

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// A figure of an answer, and its name: what a planner tells of its work beyond what all planners do.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace warren {

/// An edge of a sampled visibility graph that passes through an obstacle.
struct WrongEdge {
  std::uint32_t from;  ///< number of a corner
  std::uint32_t to;    ///< number of a corner
  double depth;        ///< how far inside, world units
};

/// What a planner tells beside what all tell.
using Figure =
    std::variant<bool, std::uint64_t, double, std::string, std::vector<std::uint64_t>, std::vector<WrongEdge>>;

/// A figure with its key in JSON.
struct NamedFigure {
  std::string name;  ///< the key
  Figure value;      ///< of the unit that the key says
};

/// The figure of that name, or nullptr.
inline const Figure* figure_named(const std::vector<NamedFigure>& figures, std::string_view name) {
  for (const NamedFigure& figure : figures) {
    if (figure.name == name) return &figure.value;
  }
  return nullptr;
}

}  // namespace warren

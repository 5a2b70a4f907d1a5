// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/model/marks.hpp"

#include <cstddef>
#include <numbers>

#include "core/base/trigonometry.hpp"

namespace warren {

std::vector<Vec2> mark_outline(MarkShape shape, double radius) {
  if (shape == MarkShape::front) return {{radius, 0.0}, {-0.7 * radius, radius}, {-0.7 * radius, -radius}};
  const bool is_star = shape == MarkShape::star;
  const std::size_t corners = is_star ? 10 : 32;
  constexpr double star_reach = 1.35;
  constexpr double star_waist = 0.58;
  std::vector<Vec2> outline;
  for (std::size_t i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * (static_cast<double>(i) / static_cast<double>(corners) + 0.25);
    const double r = radius * (!is_star ? 1.0 : i % 2 == 0 ? star_reach : star_waist);
    outline.push_back({r * portable::cos(angle), r * portable::sin(angle)});
  }
  return outline;
}

}  // namespace warren

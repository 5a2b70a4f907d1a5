// SPDX-License-Identifier: BSD-3-Clause
// A body that moves along the path of an SVG picture: SMIL, no script, nothing from elsewhere. It follows the path's
// own line (arcs stay arcs) and turns as its poses say; where it turns on the spot, time goes on. A renderer without
// animation shows none.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "pictures/model/picture.hpp"

namespace warren {

/// The moment, in 0 .. 1, at which each pose is reached, and the share of the way that is behind then. Time goes with
/// the way of the body's farthest point.
struct Timetable {
  std::vector<double> moments;
  std::vector<double> shares;
};
Timetable timetable_of(const MovingBody& body);

/// The group "body". path_id: of the line that it follows; scale: picture units a world unit. Empty where the body
/// stands still.
std::string svg_moving_body(const MovingBody& body, std::string_view path_id, double scale, double line_width);

/// The group "arm": in each of its projections a line of that width. `at`: from the picture's world to where it is
/// written. Empty where it stands still.
std::string svg_moving_arm(const MovingArm& arm, double width, const std::function<Vec2(Vec2)>& at);

}  // namespace warren

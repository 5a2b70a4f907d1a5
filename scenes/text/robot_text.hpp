// SPDX-License-Identifier: BSD-3-Clause
// The body of a `robot` line, read: the same words in a scene, on a command line and in an answer.
#pragma once

#include <string>
#include <string_view>

#include "parallel/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {

inline constexpr std::string_view robot_usage =
    "robot point|disc R|polygon X Y X Y X Y ...|car radius R turning RHO|"
    "puma560 radius R [tool T] [limits classic|symmetric] [self-collision]|arm FILE radius R [tool T] [self-collision]";
inline constexpr std::string_view car_usage =
    "robot car radius R|polygon X Y X Y X Y ... turning RHO [steering dubins|reeds-shepp]";

/// The same as options take it.
inline constexpr std::string_view robot_option =
    "point, disc R, [[X, Y], [X, Y], [X, Y], ...], polygon X Y X Y X Y ..., car radius R turning RHO, "
    "car polygon X Y X Y X Y ... turning RHO, puma560 radius R or arm FILE radius R";

/// What a puma560's or arm's line says behind its tool: empty for the defaults, else with a blank before each word.
std::string arm_words(const RobotSpec& robot);

/// Reads what follows the word `robot`, to the line's end. Throws InputError naming the fields' place, Stopped.
RobotSpec read_robot(scene_text::Fields& fields, const Execution& execution);

}  // namespace warren

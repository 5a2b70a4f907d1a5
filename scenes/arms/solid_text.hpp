// SPDX-License-Identifier: BSD-3-Clause
// Solids as lines of a scene say them: a word and numbers. The same words in scenes, behind `attach`, in Python; what
// other formats say of solids becomes these numbers first, so that it is written and read again without a change.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {

/// What a line of a solid begins with.
struct SolidWord {
  std::string_view name;
  std::string_view usage;
  std::size_t numbers;  ///< behind it; 0: any number of threes
};

inline constexpr std::array<SolidWord, 6> solid_words = {{
    {"sphere", "sphere X Y Z R", 4},
    {"box", "box X1 Y1 Z1 X2 Y2 Z2", 6},
    {"obox", "obox X Y Z QX QY QZ QW HX HY HZ", 10},
    {"cylinder", "cylinder X1 Y1 Z1 X2 Y2 Z2 R", 7},
    {"capsule", "capsule X1 Y1 Z1 X2 Y2 Z2 R", 7},
    {"hull", "hull X Y Z X Y Z ...", 0},
}};

/// nullptr: no such word.
const SolidWord* solid_word_named(std::string_view name);

/// The solid of these numbers, whose count is right. Throws InputError naming the place: a negative size, a cylinder
/// without length, a quaternion of zeros, a hull as convex_hull() says. Throws Stopped.
Solid solid_of_numbers(const SolidWord& word, std::span<const double> numbers, const scene_text::Place& place,
                       const Execution& execution);

/// Reads the numbers behind the word, to the line's end or, where it may have a name, to an `as`. Throws InputError,
/// Stopped.
Solid read_solid(const SolidWord& word, scene_text::Fields& fields, const Execution& execution,
                 bool may_have_name = false);

/// Its line, which reads back as the same solid where it was read; else to the last digits.
std::string solid_text(const Solid& solid);

/// The turn of a quaternion that is not zero; it need not be of length 1.
Eigen::Matrix3d turn_of_quaternion(double x, double y, double z, double w);
/// Of seven numbers: x, y, z, and a quaternion that is not zero.
Eigen::Isometry3d pose_of_numbers(std::span<const double> numbers);
/// x, y, z, w of a turn.
std::array<double, 4> quaternion_of_turn(const Eigen::Matrix3d& turn);

}  // namespace warren

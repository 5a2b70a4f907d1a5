// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/question_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "tools/words/option_values.hpp"

namespace warren::tools {
namespace {

constexpr OptionSpec picture_specs[] = {
    {"--show", "LIST",
     "what a picture shows, separated by commas: world, roadmap, search, path, body, axes, legend (default: all)"},
    {"--heading", "ANGLE",
     "for a body that turns, in radians or as 45deg: shade where it has no room at this heading, and draw milestones "
     "as arrows"},
    {"--size", "WxH", "size of a picture in pixels, or in millimetres as 180x120mm (default: by the world)"},
    {"--dpi", "N", "pixels an inch of a picture, 10 to 2400 (default: 96; of a .png as many as its cells need)"},
    {"--title", "TEXT", "title of a picture; an empty one leaves it out (default: the world and how it was solved)"},
};

PageSize page_size_value(std::string_view option, std::string_view text) {
  PageSize size;
  std::string_view numbers = text;
  if (numbers.ends_with("mm")) size.unit = LengthUnit::mm;
  if (numbers.ends_with("mm") || numbers.ends_with("px")) numbers.remove_suffix(2);
  const std::size_t cross = numbers.find('x');
  const auto width = number_in(numbers.substr(0, cross));
  const auto height = cross < numbers.size() ? number_in(numbers.substr(cross + 1)) : std::nullopt;
  if (!width || !height) {
    throw UsageError(fmt::format("{}: expected WxH in pixels or WxHmm (found: '{}')", option, text));
  }
  size.width = *width;
  size.height = *height;
  return size;
}

constexpr OptionSpec path_specs[] = {
    {"--path", "FILE", "write the path: .csv, .yaml (ROS nav_msgs/Path), .geojson or .npy by ending"},
    {"--every", "D|TIME",
     "with --path: add places, so that no two are more than D apart; or, with --speed, give a place every 100ms, say "
     "(default: the path's own places, and on a car's arcs one each 5 degrees)"},
    {"--speed", "V",
     "with --path: add times, for driving at most so fast (units of length a second) and stopping at corners"},
    {"--acceleration", "A", "with --speed: how hard to speed up and brake (default: at once)"},
    {"--lateral-acceleration", "A",
     "with --speed: how hard a car may corner, which makes it slow on tight arcs (default: any)"},
    {"--joint-speed", "W[,...]",
     "with --path, for arms: add times, for turning at most so fast (rad/s): one number for all joints, or "
     "one each, or 'file': as the URDF has them"},
    {"--joint-acceleration", "A[,...]",
     "with --joint-speed: how hard joints speed up and brake (rad/s^2), one number or one a joint (default: at once)"},
    {"--frame", "NAME", "with --path: name of the coordinate frame in .yaml and .geojson (default: map)"},
};

std::vector<double> joint_values(std::string_view option, std::string_view text) {
  if (option == "--joint-speed" && text == "file") return {speed_of_file};
  if (number_in(text)) return {positive_value(option, text)};
  std::vector<double> values = state_value(option, text);
  if (std::ranges::all_of(values, [](double x) { return x > 0.0; })) return values;
  throw UsageError(
      fmt::format("{}: expected one number above 0, or one a joint, separated by commas (found: '{}')", option, text));
}

}  // namespace

std::span<const OptionSpec> picture_option_specs() { return picture_specs; }

PictureOptions picture_words(const Arguments& arguments, bool is_drawn, std::string_view draws, std::string_view file) {
  PictureOptions options;
  if (!is_drawn) {
    arguments.refuse(picture_specs, fmt::format("goes with {}", draws));
    return options;
  }
  if (file.ends_with(".html")) arguments.refuse({"--size", "--dpi"}, "a page fills its window; say .svg, .png or .pdf");
  if (arguments.has("--show")) {
    options.parts = {};
    for (const Part part : given_values(arguments, "--show", "--show", choice_value<Part>)) {
      options.parts = options.parts | Parts{part};
    }
  }
  constexpr double least_dpi = 10.0;
  constexpr double most_dpi = 2400.0;
  options.size = given_value(arguments, "--size", page_size_value);
  options.dpi = given_value(arguments, "--dpi", number_value, least_dpi, most_dpi);
  options.heading = given_value(arguments, "--heading", angle_value);
  options.title = arguments.value("--title");
  options.validate();
  return options;
}

std::span<const OptionSpec> path_option_specs() { return path_specs; }

PathFileOptions path_words(const Arguments& arguments) {
  if (!arguments.has("--path")) {
    arguments.refuse(path_specs, "goes with --path FILE");
    return {};
  }
  path_format(std::string(*arguments.value("--path")));
  PathFileOptions options;
  if (const auto every = arguments.value("--every")) {
    const bool is_time = !number_in(*every);
    (is_time ? options.every_s : options.every) =
        is_time ? duration_value("--every", *every) : positive_value("--every", *every);
  }
  options.frame = arguments.value("--frame").value_or("map");
  TravelLimits limits;
  const auto speed = given_value(arguments, "--speed", positive_value);
  if (speed) limits.speed = *speed;
  const auto set = [&](double& limit, std::string_view option) {
    if (const auto given = given_value(arguments, option, positive_value)) limit = *given;
    if (arguments.has(option) && !speed) throw UsageError(fmt::format("{}: goes with --speed", option));
  };
  set(limits.acceleration, "--acceleration");
  set(limits.lateral_acceleration, "--lateral-acceleration");
  limits.joint_speed = given_value(arguments, "--joint-speed", joint_values).value_or(std::vector<double>{});
  limits.joint_acceleration =
      given_value(arguments, "--joint-acceleration", joint_values).value_or(std::vector<double>{});
  if (!limits.joint_acceleration.empty() && limits.joint_speed.empty()) {
    throw UsageError("--joint-acceleration: goes with --joint-speed");
  }
  if (speed && !limits.joint_speed.empty()) throw UsageError("--speed: an arm has --joint-speed, other bodies --speed");
  if (speed || !limits.joint_speed.empty()) options.limits = limits;
  return options;
}

}  // namespace warren::tools

// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/robot_text.hpp"

#include <fmt/format.h>

#include <limits>
#include <vector>

namespace warren {
namespace {

using scene_text::Fields;

/// Reads one body.
class RobotReader {
 public:
  RobotReader(Fields& fields, const Execution& execution) : fields_(fields), execution_(execution) {}

  RobotSpec read() {
    RobotSpec robot;
    const std::string_view kind = fields_.word();
    if (kind == "point") {
      numbers(0, 0);
    } else if (kind == "disc") {
      robot.kind = RobotKind::disc;
      robot.radius = not_negative("R", numbers(1, 1)[0]);
    } else if (kind == "polygon") {
      robot.kind = RobotKind::polygon;
      robot.outline = corners();
    } else if (kind == "car" || kind == "puma560") {
      robot.kind = kind == "car" ? RobotKind::car : RobotKind::puma560;
      read_sizes(robot);
    } else {
      refuse_usage(kind.empty() ? "nothing" : kind);
    }
    return robot;
  }

 private:
  [[noreturn]] void refuse_usage(std::string_view found) const {
    fields_.place().fail(fmt::format("expected `{}`", robot_usage), found);
  }
  [[noreturn]] void refuse_count(std::size_t count) const {
    refuse_usage(fmt::format("{} number{}", count, count == 1 ? "" : "s"));
  }
  [[noreturn]] void refuse(std::string_view what, double value) const {
    fields_.place().fail(fmt::format("`robot`: {}", what), fmt::format("{}", value));
  }
  double not_negative(std::string_view name, double value) const {
    if (!(value >= 0.0)) refuse(fmt::format("{} must be at least 0", name), value);
    return value;
  }
  double positive(std::string_view name, double value) const {
    if (!(value > 0.0)) refuse(fmt::format("{} must be greater than 0", name), value);
    return value;
  }

  std::vector<double> numbers(std::size_t least, std::size_t most) {
    constexpr std::size_t numbers_per_look = 4096;
    std::vector<double> read;
    while (!fields_.done()) {
      read.push_back(fields_.number());
      if (read.size() % numbers_per_look == 0) execution_.check();
    }
    if (read.size() < least || read.size() > most) refuse_count(read.size());
    return read;
  }

  std::vector<Vec2> corners() {
    const std::vector<double> n = numbers(6, std::numeric_limits<std::size_t>::max());
    if (n.size() % 2 != 0) refuse_count(n.size());
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < n.size(); i += 2) points.push_back({n[i], n[i + 1]});
    return points;
  }

  /// Named numbers, `radius R` and the like: each once, in any order.
  void read_sizes(RobotSpec& robot) {
    const bool is_car = robot.kind == RobotKind::car;
    const std::string_view second = is_car ? "turning" : "tool";
    bool has_radius = false;
    bool has_second = false;
    while (!fields_.done()) {
      const std::string_view name = fields_.word();
      bool& seen = name == "radius" ? has_radius : has_second;
      if ((name != "radius" && name != second) || seen) refuse_usage(name);
      seen = true;
      const double value = fields_.number();
      if (name == "radius") robot.radius = not_negative("radius", value);
      if (name == "turning") robot.turning_radius = positive("turning", value);
      if (name == "tool") robot.tool = not_negative("tool", value);
    }
    if (!has_radius) refuse_usage("no radius");
    if (is_car && !has_second) refuse_usage("no turning radius");
  }

  Fields& fields_;
  const Execution& execution_;
};

}  // namespace

RobotSpec read_robot(Fields& fields, const Execution& execution) { return RobotReader(fields, execution).read(); }

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// The writer of scene text: shortest decimal numbers that read back the same, half-integers (mazes) by integer digits.
// Walls are formatted in parallel, a batch of chunks at a time, and written in their order.
#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "parallel/chunks.hpp"
#include "scenes/formats/scene_io.hpp"
#include "scenes/text/output_file_io.hpp"
#include "scenes/text/robot_text.hpp"

namespace warren {
namespace {

constexpr std::size_t line_grain = 8192;
constexpr std::size_t chunks_a_batch = 64;

void append_number(std::string& text, double x) {
  constexpr double largest_quick = 1e9;
  const double doubled = 2.0 * x;
  if (std::abs(x) < largest_quick && doubled == static_cast<double>(static_cast<std::int64_t>(doubled)) &&
      doubled > 0.0) {
    const auto halves = static_cast<std::int64_t>(doubled);
    const fmt::format_int digits(halves / 2);
    text.append(digits.data(), digits.size());
    if (halves % 2 != 0) text.append(".5");
    return;
  }
  fmt::format_to(std::back_inserter(text), "{}", x + 0.0);  // no negative zeros
}

/// An item and its numbers, one line.
template <class... Numbers>
void append_line(std::string& text, std::string_view item, Numbers... numbers) {
  text.append(item);
  const auto append = [&](double x) {
    text.push_back(' ');
    append_number(text, x);
  };
  (append(numbers), ...);
  text.push_back('\n');
}

void append_points(std::string& text, std::string_view item, const std::vector<Vec2>& points,
                   const Execution& execution) {
  constexpr std::size_t points_per_poll = 4096;
  text.append(item);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (i % points_per_poll == points_per_poll - 1) execution.check();
    for (const double x : {points[i].x, points[i].y}) {
      text.push_back(' ');
      append_number(text, x);
    }
  }
  text.push_back('\n');
}

void append_state(std::string& text, std::string_view item, const std::vector<double>& state) {
  if (state.empty()) return;
  text.append(item);
  for (const double x : state) {
    text.push_back(' ');
    append_number(text, x);
  }
  text.push_back('\n');
}

std::string number(double x) {
  std::string digits;
  append_number(digits, x);
  return digits;
}

/// The steering only where it is not the usual one.
void append_car(std::string& text, const RobotSpec& robot) {
  if (robot.outline.empty()) {
    text += fmt::format("robot car radius {}", number(robot.radius));
  } else {
    text += "robot car polygon";
    for (const Vec2 p : robot.outline) text += fmt::format(" {} {}", number(p.x), number(p.y));
  }
  text += fmt::format(" turning {}", number(robot.turning_radius));
  if (robot.steering != SteeringKind::dubins) text += fmt::format(" steering {}", name_of(robot.steering));
  text += '\n';
}

void append_robot(std::string& text, const RobotSpec& robot) {
  switch (robot.kind) {
    case RobotKind::point:
      text.append("robot point\n");
      break;
    case RobotKind::disc:
      append_line(text, "robot disc", robot.radius);
      break;
    case RobotKind::polygon:
      append_points(text, "robot polygon", robot.outline, {});
      break;
    case RobotKind::car:
      append_car(text, robot);
      break;
    case RobotKind::puma560:
    case RobotKind::arm:
      text +=
          fmt::format("robot {} radius {} tool {}{}\n", robot.kind == RobotKind::arm ? "arm " + robot.table : "puma560",
                      number(robot.radius), number(robot.tool), arm_words(robot));
      break;
  }
}

std::string head_of(const Scene& scene) {
  std::string text;
  if (scene.maze) append_line(text, "maze", scene.maze->rows, scene.maze->cols);
  if (scene.bounds) {
    const Box& b = *scene.bounds;
    append_line(text, "bounds", b.min.x, b.min.y, b.max.x, b.max.y);
  }
  if (scene.clearance) append_line(text, "clearance", *scene.clearance);
  if (scene.robot) append_robot(text, *scene.robot);
  append_state(text, "start", scene.start);
  append_state(text, "goal", scene.goal);
  if (scene.grid) append_line(text, "grid", scene.grid->cell, scene.grid->angles);
  return text;
}

std::string solids_of(const Scene& scene) {
  std::string text;
  for (const Sphere& s : scene.spheres) append_line(text, "sphere", s.x, s.y, s.z, s.radius);
  for (const auto& [low, high] : scene.boxes)
    append_line(text, "box", low[0], low[1], low[2], high[0], high[1], high[2]);
  return text;
}

void append_wall(std::string& text, const Segment& s) {
  for (const double x : {s.a.x, s.a.y, s.b.x}) {
    append_number(text, x);
    text.push_back(' ');
  }
  append_number(text, s.b.y);
  text.push_back('\n');
}

/// append(text, item) writes one of `count` items' lines; a batch of chunks at a time, in their order.
template <class Append>
void write_items(std::size_t count, std::size_t chunk, const SceneTextSink& write, const Execution& execution,
                 const Append& append) {
  std::vector<std::string> parts(chunks_a_batch);
  for (std::size_t first = 0; first < count; first += chunks_a_batch * chunk) {
    const std::size_t some = std::min(chunks_a_batch * chunk, count - first);
    for_chunks(some, chunk, execution, [&](Range r) {
      std::string& text = parts[r.first / chunk];
      text.clear();
      for (std::size_t i = r.first; i < r.last; ++i) append(text, first + i);
    });
    for (std::size_t c = 0; c < chunk_count(some, chunk); ++c) write(parts[c]);
  }
}

}  // namespace

void write_scene_text(const Scene& scene, const SceneTextSink& write, const Execution& execution) {
  write(head_of(scene));
  write_items(scene.polygons.size(), line_grain / 16, write, execution, [&](std::string& text, std::size_t i) {
    append_points(text, "polygon", scene.polygons[i].corners, execution);
  });
  write(solids_of(scene));
  scene.walls.visit([&](auto walls) {
    write_items(walls.size(), line_grain, write, execution,
                [&](std::string& text, std::size_t i) { append_wall(text, walls[i].segment()); });
  });
}

void write_scene_text(const Scene& scene, const std::string& path, const Execution& execution) {
  if (execution.progress != nullptr) execution.progress->begin("write", scene.polygons.size() + scene.walls.size());
  OutputFile file(path, execution);
  write_scene_text(
      scene, [&](std::string_view text) { file.write(text); }, execution);
  file.commit();
}

}  // namespace warren

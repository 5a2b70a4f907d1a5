// SPDX-License-Identifier: BSD-3-Clause
#include "pictures/formats/svg_animation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <numbers>
#include <numeric>

namespace warren {
namespace {

constexpr std::string_view duration = "dur=\"8s\" repeatCount=\"indefinite\"";

double size_of(const MovingBody& body) {
  double size = body.outline.empty() ? body.radius : 0.0;
  for (const Vec2 p : body.outline) size = std::max(size, norm(p));
  return size;
}

std::string joined(const std::vector<double>& values, int decimals) {
  std::string text;
  for (const double value : values) {
    if (!text.empty()) text += ';';
    fmt::format_to(std::back_inserter(text), "{:.{}f}", value, decimals);
  }
  return text;
}

/// In degrees, without jumps.
std::vector<double> angles_of(const std::vector<Se2>& poses) {
  std::vector<double> angles;
  double theta = poses.front().theta;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    if (i > 0) theta += turn_between(poses[i - 1].theta, poses[i].theta);
    angles.push_back(theta * 180.0 / std::numbers::pi);
  }
  return angles;
}

std::string shape_of(const MovingBody& body, double scale, double line_width) {
  const std::string style = fmt::format(
      R"(fill="#e11d48" fill-opacity="0.35" stroke="#9f1239" stroke-width="{:.3f}" stroke-linejoin="round")",
      line_width);
  std::string shape;
  if (body.outline.empty()) {
    shape = fmt::format(R"(<circle r="{:.3f}" {}/>)", scale * body.radius, style);
    if (body.heads) {
      shape += fmt::format(R"(<path d="M0 0L{:.3f} 0" stroke="#9f1239" stroke-width="{:.3f}"/>)", scale * body.radius,
                           line_width);
    }
    return shape;
  }
  std::string d;
  for (const Vec2 p : body.outline) {
    fmt::format_to(std::back_inserter(d), "{}{:.3f} {:.3f}", d.empty() ? 'M' : 'L', scale * p.x, scale * p.y);
  }
  return fmt::format(R"(<path d="{}Z" {}/>)", d, style);
}

}  // namespace

Timetable timetable_of(const MovingBody& body) {
  const double size = size_of(body);
  Timetable table;
  double travel = 0.0;
  double way = 0.0;
  for (std::size_t i = 0; i < body.poses.size(); ++i) {
    const double turn = i == 0 ? 0.0 : turn_between(body.poses[i - 1].theta, body.poses[i].theta);
    way += body.lengths[i];
    travel += body.lengths[i] + size * std::abs(turn);
    table.moments.push_back(travel);
    table.shares.push_back(way);
  }
  for (double& moment : table.moments) moment = travel > 0.0 ? moment / travel : 0.0;
  for (double& share : table.shares) share = way > 0.0 ? share / way : 0.0;
  return table;
}

std::string svg_moving_body(const MovingBody& body, std::string_view path_id, double scale, double line_width) {
  const Timetable table = timetable_of(body);
  if (!(table.moments.back() > 0.0)) return {};
  constexpr int fine = 6;
  constexpr int coarse = 3;
  const std::string moments = joined(table.moments, fine);
  const std::string motion = fmt::format(
      R"(<animateMotion {} calcMode="linear" keyTimes="{}" keyPoints="{}"><mpath href="#{}"/></animateMotion>)",
      duration, moments, joined(table.shares, fine), path_id);
  const std::string turning = fmt::format(
      R"(<animateTransform attributeName="transform" type="rotate" {} calcMode="linear" keyTimes="{}" values="{}"/>)",
      duration, moments, joined(angles_of(body.poses), coarse));
  return fmt::format(
      "<g id=\"body\" visibility=\"hidden\"><set attributeName=\"visibility\" "
      "to=\"visible\"/>\n{}\n<g>{}\n{}</g></g>\n",
      motion, turning, shape_of(body, scale, line_width));
}

std::string svg_moving_arm(const MovingArm& arm, double width, const std::function<Vec2(Vec2)>& at) {
  if (arm.moments.size() < 2) return {};
  constexpr int fine = 6;
  const std::string moments = joined(arm.moments, fine);
  std::string group = "<g id=\"arm\" visibility=\"hidden\"><set attributeName=\"visibility\" to=\"visible\"/>\n";
  for (const Projection& view : arm.views) {
    std::string places;
    std::string first;
    for (const std::vector<Vec3>& spine : arm.spines) {
      std::string points;
      for (const Vec3& end : spine) {
        const Vec2 p = at(view.at(end));
        fmt::format_to(std::back_inserter(points), "{}{:.3f},{:.3f}", points.empty() ? "" : " ", p.x, p.y);
      }
      places += (places.empty() ? "" : ";") + points;
      if (first.empty()) first = points;
    }
    fmt::format_to(std::back_inserter(group),
                   "<polyline points=\"{}\" fill=\"none\" stroke=\"#e11d48\" stroke-opacity=\"0.55\" "
                   "stroke-width=\"{:.3f}\" stroke-linecap=\"round\" stroke-linejoin=\"round\"><animate "
                   "attributeName=\"points\" {} calcMode=\"linear\" keyTimes=\"{}\" values=\"{}\"/></polyline>\n",
                   first, width, duration, moments, places);
  }
  return group + "</g>\n";
}

}  // namespace warren

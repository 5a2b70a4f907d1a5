// SPDX-License-Identifier: BSD-3-Clause
#include "serve/changes/scene_change_io.hpp"

#include <fmt/format.h>

#include <array>

#include "scenes/text/json_text.hpp"
#include "serve/graphs/json_body_io.hpp"
#include "serve/http/json_nesting.hpp"

namespace warren::serve {
namespace {

constexpr std::size_t most_corners = 10'000;

template <std::size_t count>
std::array<double, count> numbers_of(const OrderedJson& json, const std::string& where) {
  std::array<double, count> numbers{};
  if (!json.is_array() || json.size() != count) refuse_json(where, fmt::format("{} numbers", count));
  for (std::size_t i = 0; i < count; ++i) numbers[i] = finite_number(json[i], where);
  return numbers;
}

template <class Take>
void for_each_in(const OrderedJson& json, const std::string& where, std::size_t most, const Take& take) {
  std::size_t number = 0;
  for (const OrderedJson& item : list_of(json, where, most)) take(item, fmt::format("{}[{}]", where, number++));
}

DrawnShapes shapes_of(const OrderedJson& json, const std::string& where) {
  if (!json.is_object()) refuse_json(where, "an object with walls and polygons");
  DrawnShapes shapes;
  for (const auto& [key, value] : json.items()) {
    if (key == "walls") {
      for_each_in(value, where + ".walls", most_changed_shapes, [&](const OrderedJson& item, const std::string& place) {
        const auto [ax, ay, bx, by] = numbers_of<4>(item, place);
        shapes.walls.push_back({{ax, ay}, {bx, by}});
      });
    } else if (key == "polygons") {
      for_each_in(value, where + ".polygons", most_changed_shapes,
                  [&](const OrderedJson& ring, const std::string& place) {
                    std::vector<Vec2>& corners = shapes.polygons.emplace_back();
                    for_each_in(ring, place, most_corners, [&](const OrderedJson& corner, const std::string& at) {
                      const auto [x, y] = numbers_of<2>(corner, at);
                      corners.push_back({x, y});
                    });
                    if (corners.size() < 3) refuse_json(place, "three corners or more");
                  });
    } else {
      refuse_json(where, "the keys walls, polygons");
    }
  }
  return shapes;
}

}  // namespace

SceneChange read_scene_change(std::string_view text, const Execution& execution) {
  SceneChange change;
  const OrderedJson json = json_object_of(text, deepest_json, execution);
  for (const auto& [key, value] : json.items()) {
    if (key == "add") {
      change.add = shapes_of(value, "add");
    } else if (key == "remove") {
      change.remove = shapes_of(value, "remove");
    } else if (key == "erase") {
      for_each_in(value, "erase", most_changed_shapes, [&](const OrderedJson& item, const std::string& place) {
        const auto [x, y, reach] = numbers_of<3>(item, place);
        if (reach < 0.0) refuse_json(place, "x, y and a reach of 0 or more");
        change.erase.push_back({{x, y}, reach});
      });
    } else {
      refuse_json("body", "the keys add, remove, erase");
    }
  }
  return change;
}

std::string shapes_json(const DrawnShapes& shapes) {
  std::string walls = "[";
  for (const Segment& wall : shapes.walls) {
    if (walls.size() > 1) walls += ',';
    append_json_list(walls, std::array{wall.a.x, wall.a.y, wall.b.x, wall.b.y});
  }
  std::string polygons = "[";
  for (const std::vector<Vec2>& corners : shapes.polygons) {
    polygons += polygons.size() > 1 ? ",[" : "[";
    for (const Vec2 corner : corners) {
      if (polygons.back() == ']') polygons += ',';
      append_json_list(polygons, std::array{corner.x, corner.y});
    }
    polygons += ']';
  }
  JsonObject json;
  json.add_json("walls", walls + "]");
  json.add_json("polygons", polygons + "]");
  return json.closed();
}

}  // namespace warren::serve

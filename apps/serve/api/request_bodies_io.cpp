// SPDX-License-Identifier: BSD-3-Clause
#include "apps/serve/api/request_bodies_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <tuple>

#include "apps/serve/graphs/json_body_io.hpp"
#include "apps/serve/http/http_message.hpp"
#include "core/base/bitmap.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"
#include "parallel/asked_memory.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "scenes/text/human_units.hpp"
#include "scenes/text/scene_text.hpp"

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

Vec2 corner_of(const OrderedJson& json, const std::string& where) {
  const auto [x, y] = numbers_of<2>(json, where);
  return {x, y};
}

Segment wall_of(const OrderedJson& json, const std::string& where) {
  const auto [ax, ay, bx, by] = numbers_of<4>(json, where);
  return {{ax, ay}, {bx, by}};
}

DrawnShapes shapes_of(const OrderedJson& json, const std::string& where) {
  if (!json.is_object()) refuse_json(where, "an object with walls and polygons");
  DrawnShapes shapes;
  const auto ring_of = [](const OrderedJson& ring, const std::string& place) {
    std::vector<Vec2> corners = items_of(ring, place, most_corners, corner_of);
    if (corners.size() < 3) refuse_json(place, "three corners or more");
    return corners;
  };
  const auto each = [&](const auto& read) {
    return [&](const OrderedJson& list, const std::string& key) {
      return items_of(list, where + "." + key, most_changed_shapes, read);
    };
  };
  take_keys(json, where,
            {{"walls", into(shapes.walls, each(wall_of))}, {"polygons", into(shapes.polygons, each(ring_of))}});
  return shapes;
}

std::vector<Box> boxes_of(const OrderedJson& json, const std::string& where) {
  return items_of(json, where, most_changed_shapes,
                  [](const OrderedJson& item, const std::string& place) { return box_of(wall_of(item, place)); });
}

std::vector<CellChange> cells_of(const OrderedJson& json, const std::string& where) {
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
  return items_of(json, where, most_changed_shapes, [](const OrderedJson& item, const std::string& place) {
    if (!item.is_array() || item.size() != 3 || !item[2].is_boolean()) refuse_json(place, "column, row, true or false");
    const auto number = [&](std::size_t i) { return static_cast<std::uint32_t>(whole_number(item[i], place, most)); };
    return CellChange{{number(0), number(1)}, item[2].get<bool>()};
  });
}

// Polygons are few beside walls and are looked through; walls to remove stand in a tree, so a change costs O(n log k)
// for n walls and k shapes.

double distance_to(const std::vector<Vec2>& polygon, Vec2 p, const Execution& execution) {
  if (contains(polygon, p)) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  std::size_t sides = 0;
  for_each_side(polygon, [&](Vec2 a, Vec2 b) {
    execution.poll(++sides);
    least = std::min(least, distance(p, {a, b}));
  });
  return least;
}

[[noreturn]] void refuse_missing(std::string_view what) {
  throw HttpError(400, "not_there", "remove", fmt::format("a {} that shall be removed is not in the world", what));
}

/// What is erased becomes what is removed.
void erase(const Scene& scene, const ErasedPlace& place, DrawnShapes& removed, const Execution& execution) {
  double least = place.reach;
  std::size_t wall = scene.walls.size();
  std::size_t polygon = scene.polygons.size();
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    execution.poll(i);
    const double away = distance(place.at, scene.walls.segment(i));
    if (away <= least) std::tie(least, wall) = std::pair(away, i);
  }
  for (std::size_t i = 0; i < scene.polygons.size(); ++i) {
    execution.poll(i);
    const double away = distance_to(scene.polygons[i].corners, place.at, execution);
    if (away < least || (away <= least && wall == scene.walls.size())) std::tie(least, polygon) = std::pair(away, i);
  }
  if (polygon < scene.polygons.size()) {
    removed.polygons.push_back(scene.polygons[polygon].corners);
  } else if (wall < scene.walls.size()) {
    removed.walls.push_back(scene.walls.segment(wall));
  }
}

/// Each that is removed takes one.
std::vector<ScenePolygon> polygons_left(const Scene& scene, const DrawnShapes& removed, const Execution& execution) {
  std::vector<bool> is_gone(scene.polygons.size(), false);
  for (const std::vector<Vec2>& polygon : removed.polygons) {
    execution.check();
    std::size_t i = 0;
    while (i < is_gone.size() && (is_gone[i] || scene.polygons[i].corners != polygon)) execution.poll(++i);
    if (i == is_gone.size()) refuse_missing("polygon");
    is_gone[i] = true;
  }
  std::size_t corners = 0;
  for (const ScenePolygon& polygon : scene.polygons) corners += polygon.corners.size();
  execution.reserve(corners * sizeof(Vec2));
  std::vector<ScenePolygon> left;
  for (std::size_t i = 0; i < is_gone.size(); ++i) {
    execution.poll(i);
    if (!is_gone[i]) push_asked(left, scene.polygons[i], execution);
  }
  return left;
}

/// The same.
std::vector<Segment> walls_left(const Scene& scene, const DrawnShapes& removed, const Execution& execution) {
  std::multiset<std::array<double, 4>> gone;  // ends of those that are not found yet
  for (const Segment& wall : removed.walls) gone.insert(ordered_ends(wall.a, wall.b));
  execution.reserve(scene.walls.size() * sizeof(Segment));
  std::vector<Segment> left;
  left.reserve(scene.walls.size());
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    execution.poll(i);
    const Segment wall = scene.walls.segment(i);
    const auto found = gone.find(ordered_ends(wall.a, wall.b));
    if (found == gone.end()) {
      left.push_back(wall);
    } else {
      gone.erase(found);
    }
  }
  if (!gone.empty()) refuse_missing("wall");
  return left;
}

void check(const Scene& scene, const SceneChange& change) {
  if (scene.map && change.of_shapes() > 0) {
    throw UsageError(
        "this world is the cells of a map, which an image editor draws; walls and polygons are for scenes");
  }
  if (!scene.map && change.of_cells() > 0) {
    throw UsageError(
        "block, free and cells change the cells of a map, and this world is none; add, remove and erase "
        "change its walls and polygons");
  }
  if (change.of_shapes() + change.of_cells() > most_changed_shapes) {
    throw HttpError(413, "change_too_large", "body",
                    fmt::format("a change has at most {} {}", grouped(most_changed_shapes),
                                scene.map ? "boxes and cells" : "walls and polygons"));
  }
  for (const Segment& wall : change.add.walls) {
    if (wall.a == wall.b) throw InputError("add.walls", "a wall has two different ends");
  }
}

ChangedScene changed_map(const Scene& scene, const SceneChange& change, const Execution& execution) {
  const OccupancyMap& before = *scene.map;
  execution.reserve(before.blocked.bytes() + before.unknown.bytes() + before.water.bytes());
  ChangedScene result{.scene = scene, .made = {}};
  const OccupancyMap& now = *result.scene.map;
  CellCounts& counts = result.cells.emplace();
  for (const Box& box : change.block) change_cells(result.scene, box, true, execution);
  for (const Box& box : change.free) change_cells(result.scene, box, false, execution);
  change_cells(result.scene, change.cells);
  const auto poll = [&] { execution.check(); };
  for_each_differing(before.blocked, now.blocked, poll, [&](Cell c) {
    const bool is_blocked = now.blocked.test(c.x, c.y);
    ++(is_blocked ? counts.blocked : counts.freed);
    if (result.made.cells.size() < most_changed_shapes) result.made.cells.push_back({c, is_blocked});
  });
  for (const auto lost : {&OccupancyMap::unknown, &OccupancyMap::water})
    for_each_differing(before.*lost, now.*lost, poll, [&](Cell) { ++counts.known; });
  return result;
}

std::string shapes_json(const DrawnShapes& shapes) {
  const auto wall_json = [](const Segment& wall) {
    return json_list(std::span<const double>(std::array{wall.a.x, wall.a.y, wall.b.x, wall.b.y}));
  };
  return json_object("walls", JsonText{json_list_of(shapes.walls, ",", wall_json)}, "polygons",
                     JsonText{json_chains(shapes.polygons, Execution())});
}

std::string cells_json(std::vector<CellChange> cells, bool blocked) {
  std::erase_if(cells, [&](const CellChange& to) { return to.blocked != blocked; });
  return json_list_of(cells, ",", [](const CellChange& to) { return fmt::format("[{},{}]", to.cell.x, to.cell.y); });
}

[[noreturn]] void refuse_word(std::string_view where, std::string_view expected) {
  throw HttpError(400, "bad_request", where, fmt::format("{}: expected {}", where, expected));
}

std::vector<double> state_of(const OrderedJson& json, std::string_view key) {
  constexpr std::size_t most = most_joints;
  std::vector<double> state;
  if (!json.is_array() || json.size() > most) refuse_word(key, fmt::format("a list of at most {} numbers", most));
  for (const OrderedJson& number : json) {
    if (!number.is_number()) refuse_word(key, "a list of numbers");
    state.push_back(number.get<double>());
  }
  return state;
}

bool flag_of(const OrderedJson& json, std::string_view key) {
  if (!json.is_boolean()) refuse_word(key, "true or false");
  return json.get<bool>();
}

double number_of(const OrderedJson& json, std::string_view key) {
  if (!json.is_number()) refuse_word(key, "a number");
  return json.get<double>();
}

std::vector<std::vector<double>> states_of(const OrderedJson& json, const std::string& key) {
  return items_of(json, key, most_corners, state_of);
}

/// Lines as answers have them. Files are not for whoever asks to choose.
Prices prices_of(const OrderedJson& json, const std::string& key) {
  Prices prices;
  std::size_t number = 0;
  for (const OrderedJson& line : list_of(json, key, most_corners)) {
    const std::string place = fmt::format("{}[{}]", key, number++);
    if (!line.is_string()) refuse_word(place, "a line, such as 'clearance-price 3 0.5'");
    read_price_line(line.get<std::string>(), place, prices, Execution());
  }
  if (!prices.masks.empty()) refuse_word(key, "no masks: --areas, --speed-zones, --keep-out give the service's own");
  return prices;
}

double tolerance_of(const OrderedJson& json, std::string_view key) {
  return json == "inf" ? std::numeric_limits<double>::infinity() : number_of(json, key);
}

std::uint32_t alternatives_of(const OrderedJson& json, std::string_view key) {
  const double count = number_of(json, key);
  if (!(count >= 1.0 && count <= most_alternatives) || count != std::floor(count))
    refuse_word(key, fmt::format("1 to {}", most_alternatives));
  return static_cast<std::uint32_t>(count);
}

double budget_of(const OrderedJson& json, std::string_view key) {
  constexpr double a_ms = 1e-3;
  if (!json.is_number() || !(json.get<double>() > 0.0)) refuse_word(key, "a number above 0");
  return a_ms * json.get<double>();
}

RobotSpec robot_of(const OrderedJson& json, const std::string& key) {
  if (!json.is_string()) refuse_word(key, "what --robot takes");
  return robot_value(key, json.get<std::string>());
}

PlannerKind planner_of(const OrderedJson& json, std::string_view key) {
  const auto planner = json.is_string() ? enum_named<PlannerKind>(json.get<std::string>()) : std::nullopt;
  if (!planner) refuse_word(key, "the name of a planner");
  return *planner;
}

std::string watch_of(const OrderedJson& json, std::string_view key) {
  constexpr std::size_t longest = 64;
  const std::string name = json.is_string() ? json.get<std::string>() : "";
  constexpr std::string_view known = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_";
  if (name.empty() || name.size() > longest || name.find_first_not_of(known) != std::string::npos) {
    refuse_word(key, "1 to 64 letters, digits, - and _");
  }
  return name;
}

std::vector<ErasedPlace> erased_of(const OrderedJson& json, const std::string& key) {
  return items_of(json, key, most_changed_shapes, [](const OrderedJson& item, const std::string& place) {
    const auto [x, y, reach] = numbers_of<3>(item, place);
    if (reach < 0.0) refuse_json(place, "x, y and a reach of 0 or more");
    return ErasedPlace{{x, y}, reach};
  });
}

}  // namespace

QueryBody read_query_body(std::string_view text) {
  QueryBody body;
  ServedQuestion& question = body.question;
  GoalRule& rule = question.rule;
  RouteRule& route = question.route;
  std::vector<std::vector<double>> goals;
  const auto take_goals = [&](const OrderedJson& value, const std::string& key) {
    goals = states_of(value, key);
    if (goals.empty()) refuse_word(key, "one or more");
  };
  take_keys(json_object_of(text, deepest_json, {}), "body",
            {{"start", into(question.start, state_of)},
             {"goal", into(question.goal, state_of)},
             {"robot", into(question.robot, robot_of)},
             {"clearance", into(question.clearance, number_of)},
             {"optimise", into(question.optimise, flag_of)},
             {"planner", into(question.planner, planner_of)},
             {"budget_ms", into(question.budget_s, budget_of)},
             {"explain", into(question.explains, flag_of)},
             {"path", into(body.tells_path, flag_of)},
             {"watch", into(body.watch, watch_of)},
             {"prices", into(question.prices, prices_of)},
             {"goals", take_goals},
             {"goal_tolerance", into(rule.tolerance, tolerance_of)},
             {"goal_region", into(rule.region, number_of)},
             {"goal_heading_rad", into(rule.heading_rad, number_of)},
             {"visit", into(rule.visit, states_of)},
             {"return", into(rule.back, flag_of)},
             {"alternatives", into(route.alternatives, alternatives_of)},
             {"hole", into(route.hole, number_of)},
             {"stretch", into(route.stretch, number_of)},
             {"keep_to", into(route.keep_to, states_of)},
             {"unless_gain", into(route.unless_gain, number_of)}});
  if (!goals.empty()) {
    if (!question.goal.empty()) refuse_word("goals", "one of goal and goals");
    question.goal = goals.front();
    rule.others.assign(goals.begin() + 1, goals.end());
  }
  if (rule.back && !question.goal.empty()) refuse_word("return", "no goal beside it: it ends at the start");
  return body;
}

SceneChange read_scene_change(std::string_view text, const Execution& execution) {
  SceneChange change;
  take_keys(json_object_of(text, deepest_json, execution), "body",
            {{"add", into(change.add, shapes_of)},
             {"remove", into(change.remove, shapes_of)},
             {"erase", into(change.erase, erased_of)},
             {"block", into(change.block, boxes_of)},
             {"free", into(change.free, boxes_of)},
             {"cells", into(change.cells, cells_of)}},
            "add, remove, erase, or of a map block, free, cells");
  return change;
}

std::string json_chains(const std::vector<std::vector<Vec2>>& chains, const Execution& execution) {
  std::string text = "[";
  for (const std::vector<Vec2>& chain : chains) {
    execution.check();
    text += text.size() > 1 ? ",[" : "[";
    for (const Vec2 p : chain) {
      if (text.back() == ']') text += ',';
      append_json_list(text, std::array{p.x, p.y});
    }
    text += ']';
  }
  return text + "]";
}

void tell_change(JsonObject& json, const ChangedScene& change) {
  if (!change.cells) {
    json.add("added", JsonText{shapes_json(change.made.add)}, "removed", JsonText{shapes_json(change.made.remove)});
    return;
  }
  const CellCounts& counts = *change.cells;
  const bool is_listed = counts.blocked + counts.freed <= most_changed_shapes;
  json.add("blocked_cells", counts.blocked, "freed_cells", counts.freed, "known_cells", counts.known,
           "can_be_taken_back", is_listed && counts.known == 0);
  if (!is_listed) return;
  json.add("blocked", JsonText{cells_json(change.made.cells, true)}, "freed",
           JsonText{cells_json(change.made.cells, false)});
}

ChangedScene changed(const Scene& scene, const SceneChange& change, const std::optional<MazeHint>& maze,
                     const Execution& execution) {
  check(scene, change);
  if (scene.map) return changed_map(scene, change, execution);
  ChangedScene result{.scene = without_arrays(scene), .made = {.add = change.add, .remove = change.remove}};
  DrawnShapes& removed = result.made.remove;
  for (const ErasedPlace& place : change.erase) erase(scene, place, removed, execution);
  std::vector<ScenePolygon> polygons = polygons_left(scene, removed, execution);
  for (const std::vector<Vec2>& corners : change.add.polygons) polygons.push_back({corners});
  std::vector<Segment> walls = walls_left(scene, removed, execution);
  execution.reserve(2 * walls.size() * sizeof(Segment) + scene.seams.size() * sizeof(Segment));
  walls.insert(walls.end(), change.add.walls.begin(), change.add.walls.end());
  Scene& now = result.scene;
  for (const PriceMask& mask : scene.prices.masks) execution.reserve(mask.read ? mask.read->values.size() : 0);
  now.prices = scene.prices;
  now.polygons = std::move(polygons);
  now.walls = WallSet::narrowest(walls);
  now.seams = scene.seams;
  now.maze.reset();
  if (maze && !first_wall_off_grid(now.walls, *maze, execution)) now.maze = maze;
  check_polygons(now, execution);
  return result;
}

}  // namespace warren::serve

// SPDX-License-Identifier: BSD-3-Clause
#include "solve/explain/blocked_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"
#include "core/plane/se2.hpp"
#include "parallel/asked_memory.hpp"
#include "scenes/text/human_units.hpp"
#include "scenes/text/scene_text.hpp"
#include "solve/explain/nearest_free.hpp"
#include "solve/kinds/kind_of_problem.hpp"
#include "solve/kinds/question_of_pose.hpp"
#include "solve/kinds/solve_steps.hpp"
#include "solve/question/question_of_arm.hpp"
#include "spatial/maps/distance_field.hpp"
#include "verify/near/obstacle_index.hpp"
#include "worlds/arms/arm_kinematics.hpp"
#include "worlds/arms/convex_motion.hpp"
#include "worlds/arms/serial_chain.hpp"

namespace warren {
namespace {

/// The 17 of "wall 17: ...", what a judge calls an obstacle, after the word "wall ".
std::optional<std::size_t> number_after(std::string_view name, std::string_view word) {
  if (!name.starts_with(word)) return std::nullopt;
  const std::string_view rest = name.substr(word.size());
  return scene_text::number_in_full<std::size_t>(rest.substr(0, rest.find_first_not_of("0123456789")));
}

bool has_side(const ScenePolygon& polygon, const Segment& side, const Execution& execution) {
  execution.check();
  for (std::size_t i = 0; i < polygon.corners.size(); ++i) {
    const Segment own = polygon_side(polygon.corners, i);
    if (own == side || (own.a == side.b && own.b == side.a)) return true;
  }
  return false;
}

/// The polygon and those that seams part from it or from one another.
std::vector<ScenePolygon> pieces_with(const Scene& scene, std::size_t first, const Execution& execution) {
  std::vector<std::size_t> pieces{first};
  std::vector<bool> taken(scene.polygons.size(), false);
  taken[first] = true;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    for (const Segment& seam : scene.seams) {
      if (!has_side(scene.polygons[pieces[i]], seam, execution)) continue;
      for (std::size_t k = 0; k < taken.size(); ++k) {
        if (taken[k] || !has_side(scene.polygons[k], seam, execution)) continue;
        taken[k] = true;
        pieces.push_back(k);
      }
    }
  }
  std::vector<ScenePolygon> polygons;
  for (const std::size_t i : pieces) polygons.push_back(scene.polygons[i]);
  return polygons;
}

/// One obstacle of a scene of the plane, with nothing else around: how deep a body stands in it is asked there. name:
/// as Violation::obstacle. A wall, or a polygon with all that were cut from the same one, within bounds that leave
/// `room` around it; the bounds without what lies in them; of a cell the whole map. None for all others, such as what
/// is outside. Throws Stopped.
std::optional<Scene> obstacle_alone(const Scene& scene, std::string_view name, double room,
                                    const Execution& execution) {
  if (name.starts_with("cell ")) return scene;
  Scene alone;
  if (name.starts_with("bounds: ") && scene.bounds) {
    alone.bounds = scene.bounds;
    return alone;
  }
  Box box;
  if (const auto wall = number_after(name, "wall "); wall && *wall < scene.walls.size()) {
    const Segment segment = scene.walls.segment(*wall);
    alone.walls = WallSet::narrowest(std::vector{segment});
    box = box_of(segment);
  } else if (const auto polygon = number_after(name, "polygon "); polygon && *polygon < scene.polygons.size()) {
    alone.polygons = pieces_with(scene, *polygon, execution);
    for (const ScenePolygon& piece : alone.polygons) box.include(box_around(piece.corners));
  } else {
    return std::nullopt;
  }
  alone.bounds = box.grown(box.width() + box.height() + room);
  return alone;
}

/// Evenly all around, both ways along each axis first.
std::vector<Numbers<2>> directions_in_the_plane() {
  constexpr int quarter = 12;
  std::vector<Numbers<2>> directions;
  for (int first = 0; first < quarter; ++first) {
    for (int k = 0; k < 4; ++k) {
      const double angle = 0.5 * std::numbers::pi * (k + static_cast<double>(first) / quarter);
      const auto [sine, cosine] = portable::sin_and_cos(angle);
      directions.push_back({cosine, sine});
    }
  }
  return directions;
}

class BlockedEndSearch {
 public:
  BlockedEndSearch(const Scene& scene, const Problem& problem, std::vector<double> state, const Execution& execution)
      : scene_(scene),
        problem_(problem),
        kind_(verifying_kind(scene, question_at(state))),
        state_(std::move(state)),
        execution_(execution),
        middle_(at()) {
    reach_ = problem.clearance + extent_of(problem.robot);
    margin_ = end_margin(scene, problem.robot, problem.clearance, extent_of(problem.robot), execution);
  }

  /// What the judge meets there with so much more room than is asked for; nothing where the body fits after all.
  std::optional<Violation> met(double more) const { return judged(scene_, state_, more).first_violation; }
  /// What ends have beyond the clearance.
  double margin() const { return margin_; }

  /// Where the reference point may be at all; of obstacles without bounds, the box that they fill.
  Box room() const { return room_of(scene_, execution_); }

  /// The nearest free place with the same heading, from the room's rim where the end lies outside.
  std::optional<std::vector<double>> free_place() {
    const Box box = room();
    if (box.empty()) return std::nullopt;
    const double margin = std::min({reach_ * 1.01, 0.5 * box.width(), 0.5 * box.height()});
    middle_ = {std::clamp(at().x, box.min.x + margin, box.max.x - margin),
               std::clamp(at().y, box.min.y + margin, box.max.y - margin)};
    if (box.contains(at())) middle_ = at();
    const double farthest = portable::hypot(box.width(), box.height());
    const FreeSearchRange range{1e-4 * farthest, farthest, 1e-3 * norm(middle_ - at())};
    auto place = place_near_middle(range);
    if (!place) {
      const auto somewhere = free_somewhere(box);
      if (!somewhere) return std::nullopt;
      middle_ = *somewhere;
      near_reach_ = 0.0;
      place = place_near_middle({range.first, range.farthest, 1e-3 * norm(middle_ - at())});
      if (!place) place = rounded(*somewhere);
    }
    std::vector<double> state = state_;
    std::copy(place->begin(), place->end(), state.begin());
    return state;
  }

  /// How far the body must go to be out of what is named, if there were nothing else; none where it only touches it or
  /// comes too near.
  std::optional<double> depth_in(const std::string& name) const {
    const auto alone = obstacle_alone(scene_, name, 4.0 * reach_, execution_);
    if (!alone) return std::nullopt;
    Problem bare = problem_;
    bare.clearance = 0.0;
    BlockedEndSearch there(*alone, bare, state_, execution_);
    if (!there.met(0.0)) return std::nullopt;
    const Box box = there.room();
    const double farthest = portable::hypot(box.width(), box.height());
    const double touching = 1e-6 * farthest;
    const auto is_out = [&](const Numbers<2>& p) { return there.is_free({p[0], p[1]}, 0.0); };
    const auto found = nearest_free<2>({at().x, at().y}, directions_, {touching, farthest}, is_out);
    return found && found->distance > touching ? std::optional(found->distance) : std::nullopt;
  }

  /// With so much more room than is asked for.
  bool is_free(Vec2 place, double more) {
    execution_.check();
    const double distance = norm(place - middle_);
    if (!scene_.map && distance + reach_ > near_reach_) {
      near_reach_ = 2.0 * (distance + reach_);
      near_ = obstacles_near(scene_, std::array{middle_}, near_reach_, execution_);
    }
    std::vector<double> state = state_;
    state[0] = place.x;
    state[1] = place.y;
    return judged(scene_.map ? scene_ : near_, state, more).verified;
  }
  Vec2 at() const { return {state_[0], state_[1]}; }

 private:
  Question question_at(const std::vector<double>& state, double more = 0.0) const {
    Question question = problem_.question();
    question.start = question.goal = state;
    if (more > 0.0) {
      question.clearance = problem_.clearance + more;
      question.contact = Contact::blocked;
    }
    return question;
  }
  /// What room is measured by: the body, a cell, and for a point else the world.
  double size() const {
    if (reach_ > 0.0) return reach_;
    return scene_.map ? scene_.map->cell : 1e-2 * portable::hypot(room().width(), room().height());
  }
  Verdict judged(const Scene& scene, const std::vector<double>& state, double more) const {
    return kind_.verify(scene, question_at(state, more), recorded(std::span(&state, 1)), execution_);
  }
  std::optional<Numbers<2>> place_near_middle(const FreeSearchRange& range) {
    return nearest_free_in_few_digits(Numbers<2>{middle_.x, middle_.y}, std::span<const Numbers<2>>(directions_), range,
                                      size(), [this](const Numbers<2>& p, double spare) {
                                        return is_free({p[0], p[1]}, margin_ + spare);
                                      });
  }
  /// A free place, to few digits where it is free there, too.
  Numbers<2> rounded(Vec2 place) {
    const double size = this->size();
    for (double scale = size; scale > least_spare * size; scale *= 0.1) {
      const Vec2 near{in_few_digits(place.x, scale), in_few_digits(place.y, scale)};
      if (is_free(near, margin_ + 0.5 * least_spare * size)) return {near.x, near.y};
    }
    return {place.x, place.y};
  }
  /// Where all directions miss what is free: the nearest of places all over; of a map first of those at the middles of
  /// its cells. At most 20,000.
  std::optional<Vec2> free_somewhere(const Box& box) {
    const double spare = margin_ + least_spare * size();
    const auto first_free = [&](const std::vector<Vec2>& places) {
      const auto found = std::ranges::find_if(places, [&](Vec2 p) { return is_free(p, spare); });
      return found != places.end() ? std::optional(*found) : std::nullopt;
    };
    if (scene_.map) {
      if (const auto found = first_free(places_over_cells(*scene_.map, spare))) return found;
    }
    return first_free(places_all_over(box));
  }
  /// Where a disc in its middle, or else the first corner of the body, is at the middle of a cell and has its room
  /// there: the nearest. One pass over the cells.
  std::vector<Vec2> places_over_cells(const OccupancyMap& map, double spare) const {
    constexpr std::size_t most = 3000;
    const RobotSpec& robot = problem_.robot;
    const bool is_disc = robot.outline.empty();
    const Vec2 corner = is_disc ? Vec2{} : Rotation(state_[2])(robot.outline.front());
    const double radius = problem_.clearance + spare + (is_disc ? robot.radius : 0.0);
    const Bitmap blocked = blocked_for_disc(map.blocked, radius / map.cell, execution_);
    const auto place_over = [&](std::uint64_t cell) {
      return cell_centre(map, {static_cast<std::uint32_t>(cell % map.width()),
                               static_cast<std::uint32_t>(cell / map.width())}) -
             corner;
    };
    std::vector<std::pair<double, std::uint64_t>> nearest;  // distances and cells
    for (std::uint32_t y = 0; y < map.height(); ++y) {
      execution_.check();
      for (std::uint32_t x = 0; x < map.width(); ++x) {
        if (blocked.test(x, y)) continue;
        const std::uint64_t cell = std::uint64_t{y} * map.width() + x;
        nearest.emplace_back(norm(place_over(cell) - middle_), cell);
        if (nearest.size() < 2 * most) continue;
        std::nth_element(nearest.begin(), nearest.begin() + most, nearest.end());
        nearest.resize(most);
      }
    }
    std::sort(nearest.begin(), nearest.end());
    nearest.resize(std::min(nearest.size(), most));
    std::vector<Vec2> places;
    for (const auto& [distance, cell] : nearest) places.push_back(place_over(cell));
    return places;
  }
  /// Evenly over the room, the nearest first: of a map of at most 64 cells a side its half cells; among many obstacles
  /// fewer, for each is looked at from each place.
  std::vector<Vec2> places_all_over(const Box& box) const {
    constexpr std::uint32_t most = 128;
    constexpr double most_looks = 2e7;
    double obstacles = 1.0 + static_cast<double>(scene_.walls.size());
    for (const ScenePolygon& polygon : scene_.polygons) obstacles += static_cast<double>(polygon.corners.size());
    const double a_side = std::clamp(std::sqrt(most_looks / obstacles) - 1.0, 1.0, 0.5 * most);
    const std::optional<OccupancyMap>& map = scene_.map;
    const auto few = static_cast<std::uint32_t>(a_side);
    const std::uint32_t columns = map ? std::min(2 * map->width(), most) : few;
    const std::uint32_t rows = map ? std::min(2 * map->height(), most) : few;
    std::vector<Vec2> places;
    for (std::uint32_t y = 0; y <= rows; ++y) {
      for (std::uint32_t x = 0; x <= columns; ++x) {
        const Vec2 share{static_cast<double>(x) / columns, static_cast<double>(y) / rows};
        places.push_back(map ? world_point(*map, {share.x * map->width(), share.y * map->height()})
                             : box.min + Vec2{share.x * box.width(), share.y * box.height()});
      }
    }
    std::ranges::stable_sort(places, [this](Vec2 a, Vec2 b) { return norm(a - middle_) < norm(b - middle_); });
    return places;
  }

  const Scene& scene_;
  const Problem& problem_;
  const SolveKind& kind_;
  std::vector<double> state_;
  const Execution& execution_;
  double reach_ = 0.0;  // of the body, around its reference point
  double margin_ = 0.0;
  Vec2 middle_;  // around which places are looked at
  std::vector<Numbers<2>> directions_ = directions_in_the_plane();
  Scene near_;  // what is within near_reach_ of it
  double near_reach_ = 0.0;
};

/// Of a map of metres, where the cell is, and whether anything is known of it; of all maps, that it is none of theirs.
std::string cell_in_words(const Scene& scene, const std::string& name, const OccupancyMap* own) {
  if (!scene.map || !name.starts_with("cell ")) return {};
  const OccupancyMap& map = *scene.map;
  const auto x = number_after(name, "cell ");  // none below 0
  const auto y = number_after(std::string_view(name).substr(name.rfind(' ')), " ");
  if (!x || !y || *x >= map.blocked.width() || *y >= map.blocked.height()) return "the cell is outside of the map";
  const Cell cell{static_cast<std::uint32_t>(*x), static_cast<std::uint32_t>(*y)};
  if (own != nullptr && !own->blocked.test(cell.x, cell.y))
    return "the map has the cell free: an area or mask to keep out of closes it";
  if (map.format != MapFormat::ros) return {};
  const Vec2 middle = cell_centre(map, cell);
  const bool is_unknown = map.unknown_count > 0 && map.unknown.test(cell.x, cell.y);
  return fmt::format("the cell is {}at {}, {} m", is_unknown ? "unknown, " : "", human_number(middle.x),
                     human_number(middle.y));
}

std::string outside_of(const Scene& scene, const Box& room) {
  return fmt::format("outside of the {} {} {} {} {}",
                     scene.map      ? "map"
                     : scene.bounds ? "bounds"
                                    : "box of the obstacles",
                     human_number(room.min.x), human_number(room.min.y), human_number(room.max.x),
                     human_number(room.max.y));
}

/// The nearest place of the nearest cell, of the lines from 1 to `count`, with a hundredth of the room to spare.
double free_beside(double x, std::uint32_t count, double reach) {
  constexpr double digits = 1000.0;
  const double middle = std::clamp(std::round(x), 1.0, static_cast<double>(count));
  const double room = std::max(0.0, std::floor(0.99 * (0.5 - reach) * digits));
  if (std::abs(x - middle) * digits <= room) return x;
  return (middle * digits + std::copysign(room, x - middle)) / digits;
}

// The same of an arm: the limit, solid or link in the way by the judge's word, how deep a link stands in it, and a free
// posture nearby; of a place of the tool, a place nearby that some posture reaches. Some ten thousand postures, each
// judged by itself.

double norm_between(std::span<const double> a, std::span<const double> b) {
  double square = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) square += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(square);
}

/// Of a segment.
double distance_from_box(const Vec3& a, const Vec3& b, const SolidBox& box) {
  const Vec3 low(box.low[0], box.low[1], box.low[2]);
  const Vec3 high(box.high[0], box.high[1], box.high[2]);
  const ConvexBody spine({SolidKind::hull, Eigen::Isometry3d::Identity(), Vec3::Zero(), {a, b}});
  const ConvexBody body(
      {SolidKind::box, Eigen::Isometry3d(Eigen::Translation3d(0.5 * (low + high))), 0.5 * (high - low)});
  return std::max(0.0, plane_between(spine, {}, body, {}, std::numeric_limits<double>::infinity()).below);
}

/// Unit vectors: both ways along each joint first, then others of even density, of six joints at a time.
std::vector<JointState> joint_directions(std::size_t width) {
  constexpr std::size_t at_once = 6;
  constexpr std::size_t random_directions = 180;
  static const std::vector<Numbers<at_once>> directions = directions_around<at_once>(random_directions);
  std::vector<JointState> spread;
  for (std::size_t k = at_once; k < width; ++k) {
    for (const double sign : {1.0, -1.0}) spread.emplace_back()[k] = sign;
  }
  for (std::size_t i = 0; i < directions.size(); ++i) {
    const std::size_t first = i < 2 * at_once || width <= at_once ? 0 : i % width;
    JointState& direction = spread.emplace_back();
    for (std::size_t k = 0; k < at_once; ++k) direction[(first + k) % std::max(width, at_once)] = directions[i][k];
  }
  return spread;
}

class BlockedArm {
 public:
  BlockedArm(const Scene& scene, const Problem& problem, const Execution& execution)
      : scene_(scene), execution_(execution), kinematics_(arm_model_of(problem.robot, problem.clearance, execution)) {
    problem_.robot = problem.robot;
    if (!problem.robot.files) problem_.table = table_of(problem.robot, execution);
    problem_.model = kinematics_.model();
    problem_.start = joint_state(problem.start);
    problem_.goal = problem.goal;
    problem_.clearance = problem.clearance;
    reach_ = reach_of(problem_);
    margin_ = end_margin(scene, problem.robot, problem.clearance, reach_, execution);
  }

  const ArmProblem& problem() const { return problem_; }
  /// What ends have beyond the clearance.
  double margin() const { return margin_; }
  /// With so much more room than is asked for.
  std::optional<Violation> met(const JointState& q, double more) const {
    execution_.check();
    const ArmVerifyOptions options{.clearance = problem_.clearance + more};
    return verify_arm(scene_, kinematics_.model(), std::span(&q, 1), options, execution_).first_violation;
  }
  /// Of the deepest link in the solid that is named, or of two links in one another. Nobody knows it of arms of files.
  std::optional<double> depth_in(const Violation& violation, const JointState& q) const {
    if (!problem_.table) return std::nullopt;
    const std::string_view name = violation.obstacle;
    const auto numbered = [&](std::string_view word, std::size_t count) {
      const auto number = number_after(name, word);
      return number && *number < count ? number : std::nullopt;
    };
    double depth = 0.0;
    if (const auto i = numbered("sphere ", scene_.spheres.size())) {
      const Sphere& s = scene_.spheres[*i];
      depth = deepest(q, [&](const Vec3& a, const Vec3& b) {
        const Vec3 way = b - a;
        const Vec3 to = Vec3(s.x, s.y, s.z) - a;
        return s.radius - (to - std::clamp(to.dot(way) / way.squaredNorm(), 0.0, 1.0) * way).norm();
      });
    } else if (const auto k = numbered("box ", scene_.boxes.size())) {
      const SolidBox& box = scene_.boxes[*k];
      depth = deepest(q, [&](const Vec3& a, const Vec3& b) {
        const double inside = depth_in_box(a, b, box);
        return inside > 0.0 ? inside : -distance_from_box(a, b, box);
      });
    } else if (name.starts_with("link ")) {
      depth = -violation.distance;
    }
    return depth > 0.0 ? std::optional(depth) : std::nullopt;
  }
  std::optional<JointState> free_posture(const JointState& q) const {
    const std::vector<JointState> directions = joint_directions(problem_.width());
    constexpr double digits = 1e3;
    JointState within = q;
    for (std::size_t k = 0; k < problem_.width(); ++k) {
      const ArmVariable& variable = kinematics_.model().variables[k];
      const double low = std::ceil(variable.low * digits) / digits;
      const double high = std::floor(variable.high * digits) / digits;
      if (variable.continuous || low > high) continue;
      if (q[k] < variable.low || q[k] > variable.high) within[k] = std::clamp(q[k], low, high);
    }
    const auto is_free = [this](const JointState& state, double spare) {
      return kinematics_.variable_outside_limits(state) == most_joints && !met(state, margin_ + spare);
    };
    const double size = std::max(problem_.robot.radius, 0.1 * reach_);
    if (is_free(within, 1e-2 * size)) return within;
    const FreeSearchRange range{1e-3, 2.0 * std::numbers::pi, 1e-3 * norm_between(q, within)};
    return nearest_free_in_few_digits<most_joints>(within, directions, range, size, is_free);
  }
  /// Postures with the tool there; empty: out of reach.
  std::vector<JointState> postures(const Vec3& place) const {
    ArmProblem there = problem_;
    there.goal = {place.x(), place.y(), place.z()};
    return goal_states(there, execution_);
  }
  /// One of them, sought where the quickly found ones are none.
  std::optional<JointState> posture(const Vec3& place) const {
    std::vector<JointState> states = postures(place);
    if (states.empty() && problem_.table && has_puma560_shape(SerialChain(*problem_.table))) {
      states = tool_postures(SerialChain(*problem_.table), place, problem_.start[5], 1, execution_).states;
    }
    return states.empty() ? std::nullopt : std::optional(states.front());
  }
  /// Which some posture reaches that is free.
  std::optional<Numbers<3>> free_tool_place(const Vec3& place) const {
    static const std::vector<Numbers<3>> directions = directions_around<3>(60);
    const auto is_free = [this](const Numbers<3>& p, double spare) {
      const std::vector<JointState> states = postures({p[0], p[1], p[2]});
      return std::ranges::any_of(states, [&](const JointState& q) { return !met(q, margin_ + spare); });
    };
    const FreeSearchRange range{1e-3 * reach_, reach_};
    return nearest_free_in_few_digits<3>({place.x(), place.y(), place.z()}, directions, range, 0.1 * reach_, is_free);
  }

 private:
  template <class DepthOfLink>
  double deepest(const JointState& q, const DepthOfLink& depth_of) const {
    double most = -std::numeric_limits<double>::infinity();
    ArmPosture posture;
    kinematics_.place(q, posture);
    for (const ArmLink& link : kinematics_.model().links) {
      const MovingFrame& frame = ArmKinematics::frame(posture, link.frame);
      for (const Solid& capsule : link.solids) {
        const Vec3 middle = frame.at + frame.turn * capsule.pose.translation();
        const Vec3 half = frame.turn * (capsule.pose.linear() * Vec3(0.0, 0.0, capsule.half.z()));
        most = std::max(most, depth_of(middle - half, middle + half) + capsule.half.x());
      }
    }
    return most;
  }

  const Scene& scene_;
  const Execution& execution_;
  ArmKinematics kinematics_;
  ArmProblem problem_;
  double reach_ = 0.0;
  double margin_ = 0.0;
};

/// Of a place that no posture brings the tool to: how far it is from the base, and how far all links would reach in a
/// line.
void explain_reach(Answer& answer, const Vec3& place, const ArmProblem& problem) {
  double reach = problem.table ? problem.table->tool.translation().norm() : reach_of(problem);
  const double away = (place - problem.model.base).norm();
  if (problem.table) {
    for (const DhJoint& joint : problem.table->joints) reach += portable::hypot(joint.a, joint.d);
  }
  if ((!problem.table || problem.goal_pose) && !(away > reach)) return;  // what others might reach
  answer.blocked = BlockedEnd{.is_start = false, .by = "outside of what the tool reaches within the joints' limits"};
  answer.blocked->hint =
      fmt::format("it is {} from the base, and {} {}", human_number(away),
                  problem.table ? "all links in a line are as long as" : "no point of the arm gets farther than",
                  human_number(reach));
}

std::string degrees_hint(std::span<const double> values, std::span<const ArmVariable> joints) {
  constexpr double a_turn_and_a_bit = 6.3;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!joints[i].slides && std::abs(values[i]) > a_turn_and_a_bit)
      return fmt::format("angles are in radians: {0} degrees are {0}deg", values[i]);
  }
  return "";
}

void tell(Answer& answer, bool is_start, const Violation& met, const BlockedArm& arm, const JointState& q) {
  answer.blocked = BlockedEnd{.is_start = is_start,
                              .by = met.obstacle,
                              .room = met.distance,
                              .needed = answer.problem.clearance,
                              .depth = arm.depth_in(met, q)};
}

/// Of all postures there, the one that the tool's place is asked about is as good as any: the first.
void explain_tool_place(Answer& answer, const BlockedArm& arm, const Vec3& place) {
  const std::optional<JointState> posture = arm.posture(place);
  if (!posture) return explain_reach(answer, place, arm.problem());
  const auto met = arm.met(*posture, arm.margin());
  if (!met) return;
  tell(answer, false, *met, arm, *posture);
  const std::optional<Numbers<3>> free = arm.free_tool_place(place);
  if (!free) return;
  answer.blocked->free_place.assign(free->begin(), free->end());
  answer.blocked->distance = norm_between(*free, answer.problem.goal);
}

void explain_blocked_arm(const Scene& scene, Answer& answer, const Execution& execution) {
  const bool is_start = answer.outcome == Outcome::start_blocked;
  const std::vector<double>& asked = is_start ? answer.problem.start : answer.problem.goal;
  const BlockedArm arm(scene, answer.problem, execution);
  if (!is_start && asked.empty()) return explain_reach(answer, answer.problem.goal_pose->translation(), arm.problem());
  if (arm.problem().any_posture() && !is_start) return explain_tool_place(answer, arm, {asked[0], asked[1], asked[2]});
  const JointState q = joint_state(asked);
  auto met = arm.met(q, 0.0);
  const bool only_touches = !met;
  if (only_touches) met = arm.met(q, arm.margin());
  if (!met) return;
  tell(answer, is_start, *met, arm, q);
  answer.blocked->hint = only_touches ? std::string(touching_hint) : degrees_hint(asked, arm.problem().model.variables);
  std::optional<JointState> free = arm.free_posture(q);
  if (!free) return;
  answer.blocked->free_place.assign(free->begin(), free->begin() + as_whole<std::ptrdiff_t>(asked.size()));
  answer.blocked->distance = norm_between(*free, q);
}

}  // namespace

double depth_in_box(const Vec3& a, const Vec3& b, const SolidBox& box) {
  // A box and a segment are apart along one of six directions, or not at all: the box's axes, and what is square to one
  // of them and the segment.
  const Vec3 low(box.low[0], box.low[1], box.low[2]);
  const Vec3 half = 0.5 * (Vec3(box.high[0], box.high[1], box.high[2]) - low);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = Vec3::Unit(k);
    for (const Vec3& square : {axis, Vec3(axis.cross(b - a))}) {
      const double size = square.norm();
      if (!(size > 1e-12 * (b - a).norm())) continue;
      const Vec3 normal = square / size;
      const double from = normal.dot(a - low - half);
      const double to = normal.dot(b - low - half);
      const double reach = half.dot(normal.cwiseAbs());
      least = std::min({least, std::max(from, to) + reach, reach - std::min(from, to)});
    }
  }
  return least;
}

void explain_blocked_end(const Scene& scene, Answer& answer, const Execution& execution, const OccupancyMap* own) {
  if (!is_blocked(answer.outcome) || is_unmade(scene)) return;
  const bool is_start = answer.outcome == Outcome::start_blocked;
  std::vector<double> state = is_start ? answer.problem.start : answer.problem.goal;
  const std::size_t width = state_size(answer.problem.robot);
  const bool any_heading = state.size() == 2 && width == 3;
  if (any_heading) state.push_back(0.0);  // one of them tells enough
  try {
    if (is_arm(answer.problem.robot)) return explain_blocked_arm(scene, answer, execution);
    if (state.size() != width) return;
    BlockedEndSearch search(scene, answer.problem, state, execution);
    auto met = search.met(0.0);
    const bool only_touches = !met;
    if (only_touches) met = search.met(search.margin());
    if (!met) return;
    const Box room = search.room();
    const bool is_outside = !room.contains(search.at());
    answer.blocked = BlockedEnd{.is_start = is_start, .by = is_outside ? outside_of(scene, room) : met->obstacle};
    if (only_touches) {
      answer.blocked->hint = touching_hint;
    } else if (is_outside && search.is_free({state[1], state[0]}, search.margin())) {
      answer.blocked->hint = fmt::format("x comes before y: {},{} is free", state[1], state[0]);
    }
    if (any_heading && answer.blocked->hint.empty()) answer.blocked->hint = "it fits at no heading: all are looked at";
    answer.blocked->room = met->distance;
    answer.blocked->needed = answer.problem.clearance + answer.problem.robot.radius;
    answer.blocked->depth = search.depth_in(answer.blocked->by);
    if (answer.blocked->hint.empty() && !answer.blocked->depth && !is_outside && answer.blocked->needed == 0.0) {
      answer.blocked->hint = "it only touches it there, and with contact blocked what touches is not free";
    }
    if (answer.blocked->hint.empty()) answer.blocked->hint = cell_in_words(scene, answer.blocked->by, own);
    if (auto place = search.free_place()) {
      answer.blocked->distance = norm(Vec2{(*place)[0], (*place)[1]} - search.at());
      answer.blocked->free_place = std::move(*place);
    }
  } catch (const Stopped&) {
  } catch (const InputError&) {  // a goal of another kind, which the judge does not take as a state
  }
}

void explain_blocked_cell(const WallProblem& problem, MazeHint maze, Answer& answer, const MetAt& met_at) {
  if (!is_blocked(answer.outcome)) return;
  const bool is_start = answer.outcome == Outcome::start_blocked;
  const Vec2 at = is_start ? problem.start : problem.goal;
  const auto met = met_at(at);
  if (!met) return;
  const Vec2 place{free_beside(at.x, maze.cols, problem.reach()), free_beside(at.y, maze.rows, problem.reach())};
  const bool is_outside = met->obstacle.starts_with("box: ");
  answer.blocked = BlockedEnd{.is_start = is_start,
                              .by = is_outside ? "outside of the bounds " + met->obstacle.substr(5) : met->obstacle,
                              .room = met->distance,
                              .needed = problem.reach()};
  if (!met_at(place)) {
    answer.blocked->free_place = {place.x, place.y};
    answer.blocked->distance = norm(place - at);
  }
  if (is_outside) {
    if (!met_at({at.y, at.x})) answer.blocked->hint = fmt::format("x comes before y: {},{} is free", at.y, at.x);
  } else if (met->distance >= problem.reach()) {
    answer.blocked->hint = touching_hint;
  } else if (const double depth = problem.robot.radius - met->distance; depth > 0.0) {
    answer.blocked->depth = depth;
  }
}

Scene obstacles_near(const Scene& scene, std::span<const Vec2> path, double reach, const Execution& execution) {
  if (scene.map || is_unmade(scene)) return scene;
  const Vec2 twice[] = {path.front(), path.front()};
  const Box all = obstacle_box(scene, execution);
  const LegBoxes legs(path.size() > 1 ? path : std::span<const Vec2>(twice), execution);
  const auto keeps = [&](const Box& box) {
    if (box.min.x == all.min.x || box.min.y == all.min.y || box.max.x == all.max.x || box.max.y == all.max.y) {
      return true;
    }
    const Box around = box.grown(reach);
    bool is_near = false;
    const auto look = [&](std::size_t leg) { is_near = is_near || around.meets(box_of(legs.leg(leg))); };
    legs.for_each_block([&](const Box& some) { return is_near || !some.meets(around); },
                        [&](std::size_t block) { legs.for_each_in(block, look); });
    return is_near;
  };
  Scene near = without_arrays(scene);
  std::vector<Segment> walls;
  for (std::size_t i = 0; i < scene.walls.size(); ++i) {
    execution.poll(i);
    const Segment wall = scene.walls.segment(i);
    if (keeps(box_of(wall))) push_asked(walls, wall, execution);
  }
  near.walls = WallSet::narrowest(walls);
  std::erase_if(near.polygons, [&](const ScenePolygon& polygon) {
    execution.check();
    return !keeps(box_around(polygon.corners));
  });
  return near;
}

}  // namespace warren

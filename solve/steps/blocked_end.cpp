// SPDX-License-Identifier: BSD-3-Clause
#include "solve/steps/blocked_end.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "core/plane/geometry.hpp"
#include "scenes/text/human_units.hpp"
#include "solve/question/question_of_arm.hpp"
#include "solve/steps/kind_of_problem.hpp"
#include "solve/steps/obstacles_near.hpp"

namespace warren {
namespace {

/// A power of ten between a hundredth and a tenth of x > 0.
double rounding_unit(double x) {
  double unit = 1.0;
  while (unit > 0.1 * x) unit /= 10.0;
  while (unit * 100.0 <= x) unit *= 10.0;
  return unit;
}

/// To a multiple of a power of ten, in as few digits as say it.
double rounded(double x, double unit) {
  return unit < 1.0 ? std::round(x / unit) / std::round(1.0 / unit) : std::round(x / unit) * unit;
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
    reach_ = problem.clearance + problem.robot.radius;
    for (const Vec2 corner : problem.robot.outline) reach_ = std::max(reach_, problem.clearance + norm(corner));
  }

  /// What the judge meets there; nothing where the body fits after all.
  std::optional<Violation> met() const { return judged(scene_, state_).first_violation; }

  /// Where the reference point may be at all; of obstacles without bounds, the box that they fill.
  Box room() const { return room_of(scene_, execution_); }

  /// The nearest free place with the same heading that rings of places around find, from the room's rim where the end
  /// lies outside.
  std::optional<std::vector<double>> free_place() {
    if (state_.size() > 3) return std::nullopt;
    constexpr double growth = 1.25;
    const Box box = room();
    if (box.empty()) return std::nullopt;
    const double margin = std::min({reach_ * 1.01, 0.5 * box.width(), 0.5 * box.height()});
    middle_ = {std::clamp(at().x, box.min.x + margin, box.max.x - margin),
               std::clamp(at().y, box.min.y + margin, box.max.y - margin)};
    if (box.contains(at())) middle_ = at();
    const double farthest = portable::hypot(box.width(), box.height());
    double before = 0.0;
    for (double ring = 1e-4 * farthest; ring <= farthest; ring *= growth) {
      if (auto place = on_ring(before, ring)) return place;
      before = ring;
    }
    return std::nullopt;
  }

  bool is_free(Vec2 place) {
    execution_.check();
    const double distance = norm(place - middle_);
    if (!scene_.map && distance + reach_ > near_reach_) {
      near_reach_ = 2.0 * (distance + reach_);
      near_ = obstacles_near(scene_, std::array{middle_}, near_reach_, execution_);
    }
    std::vector<double> state = state_;
    state[0] = place.x;
    state[1] = place.y;
    return judged(scene_.map ? scene_ : near_, state).verified;
  }
  Vec2 at() const { return {state_[0], state_[1]}; }

 private:
  static constexpr int directions = 48;

  Question question_at(const std::vector<double>& state) const {
    Question question = problem_.question();
    question.start = question.goal = state;
    return question;
  }
  Verdict judged(const Scene& scene, const std::vector<double>& state) const {
    RecordedAnswer stay;
    stay.file = "answer";
    if (state.size() == 2) {
      stay.path.push_back({state[0], state[1]});
    } else {
      stay.states.width = state.size();
      stay.states.add(state);
    }
    return kind_.verify(scene, question_at(state), stay, execution_);
  }
  Vec2 place(double angle, double distance) const {
    const auto [sine, cosine] = portable::sin_and_cos(angle);
    return middle_ + distance * Vec2{cosine, sine};
  }
  /// A free place between two rings, as near as bisection finds it, in as few digits as say it.
  std::optional<std::vector<double>> on_ring(double before, double ring) {
    double nearest = ring;
    double towards = 0.0;
    bool found = false;
    const double near_enough = 1e-3 * std::max(ring, norm(middle_ - at()));
    for (int i = 0; i < directions && (!found || nearest > near_enough); ++i) {
      const double angle = 2.0 * std::numbers::pi * i / directions;
      if (!is_free(place(angle, nearest))) continue;
      double blocked = before;
      for (int k = 0; k < 8; ++k) {
        const double middle = 0.5 * (blocked + nearest);
        (is_free(place(angle, middle)) ? nearest : blocked) = middle;
      }
      towards = angle;
      found = true;
    }
    if (!found) return std::nullopt;
    std::vector<double> state = state_;
    for (double distance = nearest; distance < 1.1 * nearest; distance += 0.02 * nearest) {
      const double unit = rounding_unit(distance);
      const Vec2 exact = place(towards, distance);
      state[0] = rounded(exact.x, unit);
      state[1] = rounded(exact.y, unit);
      if (is_free({state[0], state[1]})) return state;
    }
    const Vec2 exact = place(towards, nearest);
    state[0] = exact.x;
    state[1] = exact.y;
    return state;
  }

  const Scene& scene_;
  const Problem& problem_;
  const SolveKind& kind_;
  std::vector<double> state_;
  const Execution& execution_;
  double reach_ = 0.0;  // of the body, around its reference point
  Vec2 middle_;         // of the rings
  Scene near_;          // what is within near_reach_ of it
  double near_reach_ = 0.0;
};

std::string numbers(const Box& box) {
  return fmt::format("{} {} {} {}", human_number(box.min.x), human_number(box.min.y), human_number(box.max.x),
                     human_number(box.max.y));
}

/// Of an arm whose tool no posture brings to the goal's place: how far that is from its base, and how far all links
/// would reach in a line.
void explain_reach(Answer& answer, const Execution& execution) {
  const Figure* cause = figure_named(answer.figures, "cause");
  const auto* word = cause == nullptr ? nullptr : std::get_if<std::string>(cause);
  if (word == nullptr || *word != "goal_out_of_reach") return;
  const RobotSpec& robot = answer.problem.robot;
  const DhTable table = table_of(robot, execution);
  double reach = robot.tool + table.tool.translation().norm();
  for (const DhJoint& joint : table.joints) reach += portable::hypot(joint.a, joint.d);
  const auto& goal = answer.problem.goal;
  const double away = portable::hypot(portable::hypot(goal[0], goal[1]), goal[2]);
  answer.blocked = BlockedEnd{.is_start = false, .by = "outside of what the tool reaches within the joints' limits"};
  answer.blocked->hint = fmt::format("it is {} from the base, and all links in a line are {} long", human_number(away),
                                     human_number(reach));
}

/// Outside of all that there is, or what the judge met.
std::string in_the_way(const Scene& scene, const std::vector<double>& state, const Violation& met,
                       const BlockedEndSearch& search) {
  const bool is_outside = state.size() <= 3 && !search.room().contains(search.at());
  if (!is_outside) return met.obstacle;
  return fmt::format("outside of the {} {}",
                     scene.map      ? "map"
                     : scene.bounds ? "bounds"
                                    : "box of the obstacles",
                     numbers(search.room()));
}

/// What may have been meant.
std::string hint_of(const std::vector<double>& state, BlockedEndSearch& search) {
  constexpr double a_turn_and_a_bit = 6.3;
  if (state.size() == 6) {
    for (const double angle : state) {
      if (std::abs(angle) > a_turn_and_a_bit)
        return fmt::format("angles are in radians: {0} degrees are {0}deg", angle);
    }
  } else if (!search.room().contains(search.at()) && search.is_free({state[1], state[0]})) {
    return fmt::format("x comes before y: {},{} is free", state[1], state[0]);
  }
  return {};
}

}  // namespace

Box room_of(const Scene& scene, const Execution& execution) {
  if (!scene.map) return scene.bounds ? *scene.bounds : obstacle_box(scene, execution);
  const Box cells{{0.0, 0.0}, {static_cast<double>(scene.map->width()), static_cast<double>(scene.map->height())}};
  Box box;
  for (const double x : {cells.min.x, cells.max.x}) {
    for (const double y : {cells.min.y, cells.max.y}) box.include(world_point(*scene.map, {x, y}));
  }
  return box;
}

void explain_blocked_end(const Scene& scene, Answer& answer, const Execution& execution) {
  if (!is_blocked(answer.outcome) || is_unmade(scene)) return;
  const bool is_start = answer.outcome == Outcome::start_blocked;
  std::vector<double> state = is_start ? answer.problem.start : answer.problem.goal;
  const std::size_t width = state_size(answer.problem.robot);
  if (state.size() == 2 && width == 3) state.push_back(0.0);  // any heading: one of them tells enough
  try {
    if (state.size() == 3 && width == 6) return explain_reach(answer, execution);
    if (state.size() != width) return;
    BlockedEndSearch search(scene, answer.problem, state, execution);
    const auto met = search.met();
    if (!met) return;
    answer.blocked = BlockedEnd{.is_start = is_start, .by = in_the_way(scene, state, *met, search)};
    answer.blocked->hint = hint_of(state, search);
    answer.blocked->room = met->distance;
    answer.blocked->needed = answer.problem.clearance + answer.problem.robot.radius;
    if (auto place = search.free_place()) {
      answer.blocked->distance = norm(Vec2{(*place)[0], (*place)[1]} - search.at());
      answer.blocked->free_place = std::move(*place);
    }
  } catch (const Stopped&) {
  } catch (const InputError&) {  // a goal of another kind, which the judge does not take as a state
  }
}

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_arm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/types.hpp"
#include "core/base/whole.hpp"
#include "verify/judges/judged_arm.hpp"
#include "verify/judges/leg_reports.hpp"

namespace warren {
namespace {

/// "link 2", also where that is its name already.
std::string with_word(std::string_view word, std::string_view name) {
  return name.starts_with(fmt::format("{} ", word)) ? std::string(name) : fmt::format("{} {}", word, name);
}

class ArmVerifier {
 public:
  ArmVerifier(const Scene& of, const ArmModel& with, std::span<const JointState> path, const ArmVerifyOptions& asked,
              const Execution& by)
      : scene(of), model(with), options(asked), execution(by), arm(with, by) {
    measure(path);
    add_obstacles();
  }

  std::optional<Violation> outside_limits(const JointState& q, std::size_t number) const {
    for (std::size_t j = 0; j < q.size(); ++j) {
      const ArmVariable variable = j < model.variables.size() ? model.variables[j] : ArmVariable{};
      if (variable.continuous) continue;
      const double beyond = std::max(variable.low - q[j], q[j] - variable.high);
      if (beyond <= options.tolerance) continue;
      const std::string joint = with_word("joint", variable.name.empty() ? fmt::format("{}", j + 1) : variable.name);
      std::string text =
          fmt::format("limits: {} at {:.9g}, which has {:.9g} to {:.9g}", joint, q[j], variable.low, variable.high);
      constexpr double degree = std::numbers::pi / 180.0;
      text += variable.slides
                  ? " m"
                  : fmt::format(" ({:.6g} to {:.6g} degrees)", variable.low / degree, variable.high / degree);
      return Violation{number, 0.0, text, ViolationKind::motion};
    }
    return std::nullopt;
  }
  std::optional<Violation> wrong_state(std::string_view which, const std::optional<JointState>& wanted,
                                       const JointState& q, std::size_t leg) const {
    double off = 0.0;  // the largest difference of a joint, in radians or metres
    for (const double by : way(q, wanted.value_or(q))) off = std::max(off, std::abs(by));
    if (off <= options.tolerance) return std::nullopt;
    return elsewhere(which, std::span(*wanted).first(model.variables.size()), off, leg);
  }
  std::optional<Violation> wrong_goal(std::span<const JointState> path) const {
    const std::size_t last = legs_of(path.size()) - 1;
    if (auto wrong = wrong_state("goal", options.goal, path.back(), last)) return wrong;
    if (!options.goal_place && !options.goal_pose) return std::nullopt;
    const SolidFrame tool = arm.tool_at(path.back());
    double off = 0.0;
    Vec3 place = tool.at;
    if (options.goal_place) {
      place = *options.goal_place;
      off = (tool.at - place).norm();
    }
    if (options.goal_pose && off <= options.tolerance) {
      const SolidFrame wanted = rigid_frame(*options.goal_pose, "goal");
      place = wanted.at;
      double turn_sq = 0.0;  // twice that of the angle between the two, where that is small
      for (std::size_t k = 0; k < 3; ++k) turn_sq += (tool.axes[k] - wanted.axes[k]).squaredNorm();
      off = std::max((tool.at - wanted.at).norm(), std::sqrt(0.5 * turn_sq));
    }
    if (off <= options.tolerance) return std::nullopt;
    return elsewhere("goal", std::array{place.x(), place.y(), place.z()}, off, last);
  }
  double length(std::span<const JointState> path) const {
    double sum = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i) {
      double square = 0.0;
      for (const double by : way(path[i - 1], path[i])) square += by * by;
      sum += std::sqrt(square);
    }
    return sum;
  }
  JointState way(const JointState& a, const JointState& b) const {
    JointState way{};
    for (std::size_t i = 0; i < way.size(); ++i) {
      way[i] = i < model.variables.size() ? variable_way(model.variables[i], a[i], b[i]) : b[i] - a[i];
    }
    return way;
  }
  std::string name_of(const JudgedBody& body, const JudgedBody& other, bool of_arm) const {
    const std::string own = with_word("link", model.links[body.owner].name);
    if (of_arm) return fmt::format("{}: touches {}", own, with_word("link", model.links[other.owner].name));
    std::size_t i = other.owner;
    if (i < scene.spheres.size()) {
      const Sphere& s = scene.spheres[i];
      return fmt::format("sphere {}: {} {} {} {}", i, s.x, s.y, s.z, s.radius);
    }
    i -= scene.spheres.size();
    if (i < scene.boxes.size()) {
      const auto& [low, high] = scene.boxes[i];
      return fmt::format("box {}: {} {}", i, fmt::join(low, " "), fmt::join(high, " "));
    }
    i -= scene.boxes.size();
    const Solid& solid = scene.solids[i];
    const Vec3 at = solid.pose.translation();
    const std::string name = solid.name.empty() ? "" : " " + solid.name;
    return fmt::format("{} {}{}: at {} {} {}, touches {}", warren::name_of(solid.kind), i, name, at.x(), at.y(), at.z(),
                       own);
  }

  const Scene& scene;
  const ArmModel& model;
  const ArmVerifyOptions& options;
  const Execution& execution;
  JudgedArm arm;
  std::vector<JudgedBody> obstacles;  // spheres, boxes, solids: owner counts through all of them
  double reach = 0.0;                 // no point of the arm is farther from the base
  double finest = 0.0;                // pieces on which bodies go less are not halved
  double close = 0.0;                 // how sharp the least clearance shall be

 private:
  void measure(std::span<const JointState> path) {
    const std::size_t joints = model.joints.size();
    std::vector<double> values(joints);
    for (std::size_t j = 0; j < joints; ++j) {
      const ArmJoint& joint = model.joints[j];
      const ArmVariable& variable = model.variables[joint.variable];
      double most = 0.0;
      for (const JointState& q : path) most = std::max(most, std::abs(q[joint.variable]));
      const double limit = std::max(std::abs(variable.low), std::abs(variable.high)) + options.tolerance;
      if (!variable.continuous) most = std::min(most, limit);
      values[j] = std::abs(joint.multiplier) * most + std::abs(joint.offset);
    }
    const std::vector<Sway> sways = arm.sways(std::vector<double>(joints), values);
    double radius = 0.0;
    for (const JudgedBody& body : arm.bodies()) {
      const double far = body.core.radius + sways[body.owner * (joints + 1)].reach;
      reach = std::max(reach, far);
      const bool is_round = body.core.kind == SolidKind::sphere || body.core.kind == SolidKind::capsule;
      if (body.parts == 0 && is_round) radius = std::max(radius, body.core.radius);
    }
    finest = 1e-9 * reach;
    close = std::max(1e-2 * radius, 1e-4 * reach);
  }
  void add_obstacles() {
    std::size_t corners = 0;
    for (const Solid& solid : scene.solids) corners += solid.corners.size();
    const std::size_t count = scene.spheres.size() + scene.boxes.size() + scene.solids.size();
    execution.reserve(count * sizeof(JudgedBody) + corners * sizeof(Vec3));
    obstacles.reserve(count);
    for (const Sphere& s : scene.spheres) {
      obstacles.push_back({.core = {.radius = s.radius}, .frame = {.at = {s.x, s.y, s.z}}, .owner = obstacles.size()});
    }
    for (const auto& [low, high] : scene.boxes) {
      add_box(obstacles.size(), {}, {low[0], low[1], low[2]}, {high[0], high[1], high[2]});
    }
    for (std::size_t i = 0; i < scene.solids.size(); ++i) {
      JudgedBody body;
      body.core = checked_core(scene.solids[i], body.frame, fmt::format("solid {}", i));
      body.owner = obstacles.size();
      if (body.core.kind == SolidKind::box) {
        add_box(body.owner, body.frame, -body.core.half, body.core.half);
      } else {
        obstacles.push_back(std::move(body));
      }
    }
  }
  /// Cut down to what is nearest to the arm: a box that is larger than the arm by many sizes would be told in numbers
  /// that have no digits left for the arm. Along each axis, places within the arm's reach are as far from what is left
  /// as from the whole.
  void add_box(std::size_t number, SolidFrame frame, Vec3 low, Vec3 high) {
    const Vec3 base = frame.seen(model.base - frame.at);
    for (int k = 0; k < 3; ++k) {
      const double near = std::clamp(base[k] - 2.0 * reach, low[k], high[k]);
      high[k] = std::clamp(base[k] + 2.0 * reach, low[k], high[k]);
      low[k] = near;
    }
    const Vec3 half = 0.5 * (high - low);
    frame.at = frame.point(low + half);
    obstacles.push_back(
        {.core = {.kind = SolidKind::box, .half = half, .far = half.norm()}, .frame = frame, .owner = number});
  }
};

/// One leg.
class ArmLeg {
 public:
  ArmLeg(const ArmVerifier& judge, const JointState& a, const JointState& b, std::size_t number)
      : judge_(judge),
        bodies_(judge.arm.bodies()),
        from_(a),
        way_(judge.way(a, b)),
        number_(number),
        row_(judge.model.joints.size() + 1),
        placed_(bodies_.size()),
        placed_in_(bodies_.size()) {
    std::vector<double> turns;
    std::vector<double> values;
    rounding_ = 1e-14 + 1.5e-15 * static_cast<double>(row_);
    for (const ArmJoint& joint : judge.model.joints) {
      const double turn = std::abs(joint.multiplier * way_[joint.variable]);
      const double value = std::abs(joint.multiplier * a[joint.variable]) + turn + std::abs(joint.offset);
      turns.push_back(turn);
      values.push_back(value);
      if (joint.slides) continue;
      turns_ += turn;
      rounding_ += 4e-16 * value;
    }
    sways_ = judge.arm.sways(turns, values);
  }
  /// The middle alone first: how near the arm comes to anything there tells which bodies need no closer look.
  LegReport check() {
    move_to(0.5, 0.0);
    look_at_all();
    if (report_.violation) return report_;
    move_to(0.5, 0.5);
    look_at_all();
    if (!report_.violation && !open_.empty()) {
      const std::size_t last = open_.size();
      check_piece(0.25, 0.25, 0, last);
      if (!report_.violation) check_piece(0.75, 0.25, 0, last);
    }
    return report_;
  }

 private:
  /// Two bodies that might meet: bodies of the arm; or of the arm and an obstacle.
  struct Pair {
    std::uint32_t body;
    std::uint32_t other;
    bool of_arm;
  };
  /// What is known of a pair on a piece.
  struct Known {
    double proved;    ///< they are so far apart all along, at least
    double met;       ///< the distance in the middle, at most
    double way;       ///< how far they go to either side, against each other
    double rounding;  ///< of `met`, at most
  };
  /// What is open of [first, last) is put behind, for the halves, and taken away again.
  void check_piece(double middle, double half, std::size_t first, std::size_t last) {
    const std::size_t before = open_.size();
    move_to(middle, half);
    for (std::size_t i = first; i < last && !report_.violation; ++i) look(Pair(open_[i]));
    const std::size_t after = open_.size();
    if (after > before && !report_.violation) check_piece(middle - 0.5 * half, 0.5 * half, before, after);
    if (after > before && !report_.violation) check_piece(middle + 0.5 * half, 0.5 * half, before, after);
    open_.resize(before);
  }
  void move_to(double middle, double half) {
    judge_.execution.check();
    ++report_.looks;
    half_ = half;
    ++piece_;
    judge_.arm.frames_at(from_, way_, middle, frames_);
  }
  void look_at_all() {
    const std::vector<std::size_t>& balls = judge_.arm.balls();
    for (const std::size_t ball : balls) {
      for (std::size_t i = 0; i < judge_.obstacles.size() && !report_.violation; ++i) {
        look({as_whole<std::uint32_t>(ball), as_whole<std::uint32_t>(i), false});
      }
    }
    for (const auto& [a, b] : judge_.model.pairs) {
      if (report_.violation) return;
      look({as_whole<std::uint32_t>(balls[a]), as_whole<std::uint32_t>(balls[b]), true});
    }
  }
  void look(const Pair& pair) {
    constexpr std::size_t most_looks = 2'000'000;  // some seconds
    const JudgedBody& a = bodies_[pair.body];
    const JudgedBody& b = other_of(pair);
    const Known known = known_of(pair);
    const double clearance = judge_.options.clearance;
    const bool coarse = a.parts > 0 || b.parts > 0;
    const bool finest = !coarse && !(known.way >= judge_.finest);
    if (!coarse) report_.met = std::min(report_.met, known.met);
    if (known.proved > clearance && (known.proved >= report_.met - judge_.close || finest)) {
      report_.least = std::min(report_.least, known.proved);
    } else if (coarse && known.way > std::max({a.core.radius, b.core.radius, judge_.finest})) {
      keep(pair);  // where the ball goes farther than it is wide, there is no use in parts
    } else if (coarse) {
      look_at_parts(pair);
    } else if (known.met <= known.rounding || known.met + known.rounding < clearance || finest ||
               report_.looks > most_looks) {
      report_.least = std::min(report_.least, known.met);
      report_.violation = Violation{number_, known.met, judge_.name_of(a, b, pair.of_arm)};
    } else {
      keep(pair);
    }
  }
  void look_at_parts(const Pair& pair) {
    const JudgedBody& a = bodies_[pair.body];
    const JudgedBody& whole = a.parts > 0 ? a : other_of(pair);
    for (std::size_t i = 0; i < whole.parts && !report_.violation; ++i) {
      Pair part = pair;
      (a.parts > 0 ? part.body : part.other) = as_whole<std::uint32_t>(whole.first_part + i);
      look(part);
    }
  }
  Known known_of(const Pair& pair) {
    const JudgedBody& a = bodies_[pair.body];
    const JudgedBody& b = other_of(pair);
    watch(a, b);
    const PlacedCore at_a{a.core, frame_of(pair.body)};
    const PlacedCore at_b{b.core, pair.of_arm ? frame_of(pair.other) : b.frame};
    const auto behind = as_whole<std::size_t>(judge_.arm.joint_behind(a.joint, b.joint) + 1);
    const Sway& sway_a = sways_[a.owner * row_ + behind];
    const Sway sway_b = pair.of_arm ? sways_[b.owner * row_ + behind] : Sway{};
    const double size = judge_.model.base.norm() + sways_[a.owner * row_].reach + at_b.frame.at.norm() + b.core.far +
                        a.core.radius + b.core.radius;
    const double rounding = rounding_ * (1.0 + half_ * turns_) * (size + judge_.options.clearance);
    const double way = half_ * (sway_a.speed + sway_b.speed);
    const double radii = a.core.radius + b.core.radius;
    const double first_order = radii + way + rounding;
    const double wanted = std::max(judge_.options.clearance, report_.met - judge_.close);
    constexpr double unmet = std::numeric_limits<double>::infinity();
    const double by_balls = (at_b.frame.at - at_a.frame.at).norm() - a.core.far - b.core.far - first_order;
    if (by_balls > wanted) return {by_balls, unmet, way, rounding};
    const SolidGap gap =
        gap_between(at_a, at_b, std::max(0.05 * way, rounding), (wanted + first_order) * (1.0 + 1e-14));
    Known known{gap.least - first_order, gap.most - radii, way, rounding};
    if (known.proved > wanted || !(gap.least > 0.0)) return known;
    const double apart = along_plane(at_a, a.joint, at_b, b.joint, frames_[behind], gap.towards);
    const double bend = 0.5 * half_ * half_ * (sway_a.bend + sway_b.bend);
    known.proved = std::max(known.proved, apart - radii - bend - rounding);
    return known;
  }
  /// How far the cores are apart along n all along the piece, but for their bends; as `base` sees the joints move.
  double along_plane(const PlacedCore& a, int joint_a, const PlacedCore& b, int joint_b, const JudgedFrame& base,
                     const Vec3& n) const {
    const JudgedFrame& of_a = frames_[as_whole<std::size_t>(joint_a + 1)];
    const JudgedFrame& of_b = frames_[as_whole<std::size_t>(joint_b + 1)];
    const Vec3 spin_a = of_a.spin - base.spin;
    const Vec3 spin_b = of_b.spin - base.spin;
    double least = std::numeric_limits<double>::infinity();
    for (const double t : {-half_, half_}) {
      const double drift = t * n.dot((of_b.drift - base.drift) - (of_a.drift - base.drift));
      least = std::min(least, drift - b.reach(-n - t * n.cross(spin_b)) - a.reach(n + t * n.cross(spin_a)));
    }
    return least;
  }
  /// Asks whether it is time to stop, now and then: obstacles may be many, and measuring hulls takes long.
  void watch(const JudgedBody& a, const JudgedBody& b) {
    constexpr std::size_t corners_a_look = 1 << 14;
    work_ += 64 + a.core.corners.size() + b.core.corners.size();
    if (work_ < corners_a_look) return;
    work_ = 0;
    judge_.execution.check();
  }
  const JudgedBody& other_of(const Pair& pair) const {
    return pair.of_arm ? bodies_[pair.other] : judge_.obstacles[pair.other];
  }
  const SolidFrame& frame_of(std::size_t body) {
    if (placed_in_[body] != piece_) {
      placed_in_[body] = piece_;
      placed_[body] = frames_[as_whole<std::size_t>(bodies_[body].joint + 1)].frame.frame(bodies_[body].frame);
    }
    return placed_[body];
  }
  void keep(const Pair& pair) {
    if (half_ == 0.0) return;  // the pieces are looked at later
    if (open_.size() == open_.capacity()) judge_.execution.reserve(2 * open_.size() * sizeof(Pair));
    open_.push_back(pair);
  }

  const ArmVerifier& judge_;
  const std::vector<JudgedBody>& bodies_;
  JointState from_;
  JointState way_;
  LegReport report_;
  std::size_t number_;
  std::size_t row_;                       // joints and the base
  std::vector<Sway> sways_;               // as JudgedArm::sways()
  double turns_ = 0.0;                    // of all joints
  double rounding_ = 0.0;                 // of a distance, a unit of size
  double half_ = 0.0;                     // of the piece
  std::vector<JudgedFrame> frames_;       // in its middle
  std::vector<SolidFrame> placed_;        // of bodies, there
  std::vector<std::uint32_t> placed_in_;  // the piece, by its number, for which that is true
  std::uint32_t piece_ = 0;
  std::vector<Pair> open_;  // of the pieces being looked at, coarse ones first
  std::size_t work_ = 0;
};

void check_input(std::span<const JointState> path, const ArmVerifyOptions& options) {
  if (path.empty()) throw InputError("path", "has no states");
  for (std::size_t i = 0; i < path.size(); ++i) {
    const auto fits = [](double angle) { return std::abs(angle) <= largest_coordinate; };
    if (std::all_of(path[i].begin(), path[i].end(), fits)) continue;
    throw InputError(fmt::format("path: state {}", i), "must be numbers of at most 1e60");
  }
  check_not_negative("clearance", options.clearance);
}

}  // namespace

Verification verify_arm(const Scene& scene, const ArmModel& model, std::span<const JointState> path,
                        const ArmVerifyOptions& options, const Execution& execution) {
  check_input(path, options);
  check_space_scene(scene);
  const ArmVerifier judge(scene, model, path, options, execution);
  const LegReport legs = report_legs(legs_of(path.size()), 1, execution, [&](Range r) {
    const JointState& a = path[r.first];
    const JointState& b = path[std::min(r.first + 1, path.size() - 1)];
    LegReport report;
    report.violation = judge.outside_limits(a, r.first);
    if (!report.violation) report.violation = judge.outside_limits(b, r.first);
    return report.violation ? report : ArmLeg(judge, a, b, r.first).check();
  });
  Verification result =
      verdict_on(legs, {judge.wrong_state("start", options.start, path.front(), 0), judge.wrong_goal(path)});
  result.length = judge.length(path);
  return result;
}

}  // namespace warren

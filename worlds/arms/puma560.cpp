// SPDX-License-Identifier: BSD-3-Clause
// The Unimation Puma 560: its Denavit-Hartenberg table (metres, after Corke and Armstrong-Helouvry, ICRA 1994), its
// joint limits, its inverse kinematics in closed form, and a search for postures at a place.
//
// Inverse kinematics (after Paul and Zhang, Int. J. Robotics Research 5(2), 1986) of a wrist whose angles are given:
// the tip's place gives the shoulder on two sides and for each the elbow on two: four branches, and each angle again a
// full turn further where the limits leave room for that. Where an end of the reach makes two branches one, it is told
// once.
//
// Which postures bring the tool's tip to a place, for an arm of the Puma 560's shape? Joints 4 and 5 are free, and for
// each turn of theirs the first three follow in closed form. So the two are searched: their limits are halved again and
// again, and a piece is dropped where no turn in it can do. That is proved: all turns of a piece keep the tip, seen
// from frame 3, in a ball, and the closed form, with intervals for numbers, then says between which angles joints 1, 2
// and 3 would have to be; where that is beyond a joint's limits for either shoulder and elbow, the piece can't do. The
// middles of pieces of one size are tried, so what is found is spread evenly.
#include "worlds/arms/serial_chain.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"

namespace warren {
namespace {

using Complex = std::complex<double>;
using Angles = std::array<double, 3>;

constexpr double degree = std::numbers::pi / 180.0;
constexpr double whole_turn = 2.0 * std::numbers::pi;
/// Squares so little below zero, in units of the arm's size squared, are roundings of zero.
constexpr double slack = 1e-14;

struct Row {
  double d, a, alpha_degrees;
};
constexpr std::array<Row, 6> standard_rows{
    {{0, 0, 90}, {0, 0.4318, 0}, {0.15005, 0.0203, -90}, {0.4318, 0, 90}, {0, 0, -90}, {0, 0, 0}}};

constexpr std::array<std::array<double, 2>, 6> classic_degrees{
    {{-160, 160}, {-45, 225}, {-225, 45}, {-110, 170}, {-100, 100}, {-266, 266}}};
constexpr std::array<std::array<double, 2>, 6> symmetric_degrees{
    {{-160, 160}, {-110, 110}, {-135, 135}, {-266, 266}, {-100, 100}, {-266, 266}}};

/// A root; nothing where the square is below zero by more than rounding.
std::optional<double> root_of(double square, double scale) {
  if (square < -slack * scale) return std::nullopt;
  return std::sqrt(std::max(square, 0.0));
}

double angle_of(Complex z) { return portable::atan2(z.imag(), z.real()); }
Complex turned_by(double angle) {
  const auto [sine, cosine] = portable::sin_and_cos(angle);
  return {cosine, sine};
}

/// The root and its negative; 0 once.
std::vector<double> both_signs(double x) { return x == 0.0 ? std::vector<double>{x} : std::vector<double>{x, -x}; }

/// The first three angles for which a point that is fixed in frame 3 comes to a place: two shoulders, two elbows each.
std::vector<Angles> shoulders_and_elbows(const DhTable& table, const Vec3& point, const Vec3& place) {
  const double upper_arm = table.joints[1].a;
  const Complex forearm(table.joints[2].a + point.x(), point.z());  // along x3 and z3: in the plane that both move
  const double side = table.joints[2].d - point.y();                // offset from that plane
  const double scale = place.squaredNorm() + std::norm(forearm) + upper_arm * upper_arm + side * side;
  const double twice = 2.0 * upper_arm * portable::hypot(forearm.real(), forearm.imag());
  const auto ahead = root_of(place.x() * place.x() + place.y() * place.y() - side * side, scale);
  std::vector<Angles> found;
  if (!ahead || twice == 0.0) return found;
  for (const double forward : both_signs(*ahead)) {
    const double first = portable::atan2(place.y(), place.x()) - portable::atan2(-side, forward);
    const Complex target(forward, place.z());  // in the arm's plane, ahead and up
    const double cosine = (std::norm(target) - upper_arm * upper_arm - std::norm(forearm)) / twice;
    const auto sine = root_of(1.0 - cosine * cosine, scale / twice);
    if (!sine) continue;
    for (const double bend : both_signs(portable::atan2(*sine, cosine))) {
      const double third = bend - angle_of(forearm);
      const Complex reached = upper_arm + turned_by(third) * forearm;
      found.push_back({first, angle_of(target) - angle_of(reached), third});
    }
  }
  return found;
}

/// The angle and the full turns from it that are within a joint's limits: of many the few nearest to 0, for the arm
/// stands alike in all of them, and six joints multiply.
std::vector<double> turns_within(const SerialChain& chain, std::size_t joint, double angle) {
  constexpr double rounding = 1e-12;
  constexpr double most = 3.0;
  std::vector<double> angles;
  const double first = std::ceil((chain.low(joint) - rounding - angle) / whole_turn);
  const double last = std::floor((chain.high(joint) + rounding - angle) / whole_turn);
  const double begin = std::clamp(std::round(-angle / whole_turn) - 1.0, first, std::max(first, last - most + 1.0));
  for (double k = begin; k <= last && k < begin + most; k += 1.0) {
    angles.push_back(std::clamp(angle + k * whole_turn, chain.low(joint), chain.high(joint)));
  }
  return angles;
}

void add_turns(const SerialChain& chain, const JointState& angles, std::vector<JointState>& all) {
  std::vector<JointState> states{angles};
  for (std::size_t joint = 0; joint < most_joints; ++joint) {
    std::vector<JointState> more;
    for (const double angle : turns_within(chain, joint, angles[joint])) {
      for (JointState state : states) {
        state[joint] = angle;
        more.push_back(state);
      }
    }
    states = std::move(more);
  }
  all.insert(all.end(), states.begin(), states.end());
}

Vec3 tip_in_frame_3(const SerialChain& chain, const JointState& q) {
  return chain.frame(q, 3).inverse() * chain.tool_pose(q).translation();
}

struct Interval {
  double low;
  double high;
  Interval operator-() const { return {-high, -low}; }
  Interval operator+(const Interval& r) const { return {low + r.low, high + r.high}; }
  Interval operator-(const Interval& r) const { return {low - r.high, high - r.low}; }
  double middle() const { return 0.5 * (low + high); }
  double half() const { return 0.5 * (high - low); }
};

/// Of a number that is at least 0.
Interval square_of(const Interval& r) {
  const double least = r.low > 0.0 ? r.low : r.high < 0.0 ? r.high : 0.0;
  return {least * least, std::max(r.low * r.low, r.high * r.high)};
}

Interval root_of(const Interval& r) { return {std::sqrt(std::max(0.0, r.low)), std::sqrt(std::max(0.0, r.high))}; }

/// The angles in [0, pi] whose cosine is in above / below, with below > 0; low > high: none.
Interval angles_of(const Interval& above, const Interval& below) {
  const double least = std::min(above.low / below.low, above.low / below.high);
  const double most = std::max(above.high / below.low, above.high / below.high);
  if (least > 1.0 || most < -1.0) return {1.0, 0.0};
  return {portable::acos(std::min(most, 1.0)), portable::acos(std::max(least, -1.0))};
}

/// How steep a place of that height is, so far ahead.
Interval rising(double height, const Interval& forward) {
  if (height == 0.0) return forward.low > 0.0 ? Interval{0.0, 0.0} : Interval{-std::numbers::pi, std::numbers::pi};
  const auto [low, high] = std::minmax({portable::atan2(height, forward.low), portable::atan2(height, forward.high)});
  return {low, high};
}

/// Can the first three joints bring a tip to the place that is so near this one, seen from frame 3? Never false where
/// they can.
bool can_reach(const SerialChain& chain, const Vec3& place, const Vec3& tip, double near) {
  const DhTable& table = chain.table();
  const double upper_arm = table.joints[1].a;
  const double away = portable::hypot(place.x(), place.y());  // from the axis of joint 1
  const double ahead = table.joints[2].a + tip.x();
  const double forearm = portable::hypot(ahead, tip.z());
  const double side = table.joints[2].d - tip.y();
  if (std::max(side - near, -side - near) > away) return false;
  if (!(upper_arm > 0.0) || !(forearm > 2.0 * near)) return true;
  const Interval sides{std::clamp(side - near, -away, away), std::clamp(side + near, -away, away)};
  const Interval square = square_of(sides);
  const Interval forward = root_of({away * away - square.high, away * away - square.low});
  const auto aside_of = [away](double off) {  // of the place, ahead of the first joint, as seen in the arm's plane
    return portable::atan2(-off, std::sqrt(std::max(0.0, away * away - off * off)));
  };
  const Interval aside = -Interval{aside_of(sides.high), aside_of(sides.low)};
  const Interval bent{portable::atan2(tip.z(), ahead) - portable::asin(near / forearm),
                      portable::atan2(tip.z(), ahead) + portable::asin(near / forearm)};
  const Interval far = square_of(forward) + square_of({place.z(), place.z()});
  const Interval long_arm = square_of({forearm - near, forearm + near});
  const double first = upper_arm * upper_arm;
  const Interval elbow = angles_of(far - Interval{first, first} - long_arm,
                                   {2.0 * upper_arm * (forearm - near), 2.0 * upper_arm * (forearm + near)});
  if (elbow.low > elbow.high) return false;
  Interval shoulder{0.0, std::numbers::pi};
  if (far.low > 0.0) {
    shoulder = angles_of(far + Interval{first, first} - long_arm,
                         {2.0 * upper_arm * std::sqrt(far.low), 2.0 * upper_arm * std::sqrt(far.high)});
    if (shoulder.low > shoulder.high) return false;
  }
  const double turn = portable::atan2(place.y(), place.x());
  const Interval up = rising(place.z(), forward);
  const Interval half{std::numbers::pi, std::numbers::pi};
  const auto is_within = [&](std::size_t joint, const Interval& angles) {
    constexpr double rounding = 1e-9;
    const double turns = std::ceil((chain.low(joint) - rounding - angles.high) / whole_turn);
    return angles.low + turns * whole_turn <= chain.high(joint) + rounding;
  };
  const auto fits = [&](const Interval& q1, const Interval& rise) {
    return (is_within(0, q1) || away == 0.0) && ((is_within(1, rise - shoulder) && is_within(2, elbow - bent)) ||
                                                 (is_within(1, rise + shoulder) && is_within(2, -elbow - bent)));
  };
  return fits(Interval{turn, turn} + aside, up) || fits(Interval{turn, turn} - half - aside, half - up);
}

/// Of joints 4 and 5.
struct Piece {
  Interval fourth;
  Interval fifth;
};

}  // namespace

DhTable puma560_table(double tool, PumaLimits limits) {
  const auto& range = limits == PumaLimits::classic ? classic_degrees : symmetric_degrees;
  DhTable table;
  for (std::size_t i = 0; i < standard_rows.size(); ++i) {
    const auto [d, a, alpha_degrees] = standard_rows[i];
    table.joints.push_back({d, a, alpha_degrees * degree, range[i][0] * degree, range[i][1] * degree, 0.0});
  }
  table.tool.translation() = Vec3(0.0, 0.0, tool);
  return table;
}

bool has_puma560_shape(const SerialChain& chain) {
  const DhTable& table = chain.table();
  if (table.convention != DhConvention::standard || table.joints.size() != standard_rows.size()) return false;
  constexpr std::array<bool, 6> any_d{false, false, true, true, false, false};
  constexpr std::array<bool, 6> any_a{false, true, true, false, false, false};
  for (std::size_t i = 0; i < standard_rows.size(); ++i) {
    const DhJoint& joint = table.joints[i];
    const double twist = joint.alpha_rad - standard_rows[i].alpha_degrees * degree;
    if (!(std::abs(twist) <= 1e-12) || joint.offset_rad != 0.0) return false;
    if ((!any_d[i] && joint.d != 0.0) || (!any_a[i] && joint.a != 0.0)) return false;
  }
  const Vec3 tool = table.tool.translation();
  return table.tool.linear().isIdentity(0.0) && tool.x() == 0.0 && tool.y() == 0.0;
}

std::vector<JointState> puma560_inverse_place(const SerialChain& chain, const Vec3& place,
                                              const std::array<double, 3>& wrist) {
  if (!has_puma560_shape(chain)) {
    throw InputError("arm", "only arms of the Puma 560's shape have inverse kinematics in closed form here");
  }
  const JointState bent{0.0, 0.0, 0.0, wrist[0], wrist[1], wrist[2]};
  std::vector<JointState> all;
  for (const Angles& first : shoulders_and_elbows(chain.table(), tip_in_frame_3(chain, bent), place)) {
    add_turns(chain, {first[0], first[1], first[2], wrist[0], wrist[1], wrist[2]}, all);
  }
  return all;
}

ToolPostures tool_postures(const SerialChain& chain, const Vec3& place, double sixth, std::size_t enough,
                           const Execution& execution) {
  constexpr double finest = 1e-4;
  constexpr std::size_t most_pieces = 200'000;
  const double tool = std::abs(chain.table().tool.translation().z());
  const double rounding = 1e-12 * (chain.reach() + place.norm());
  ToolPostures found;
  std::vector<Piece> pieces{{{chain.low(3), chain.high(3)}, {chain.low(4), chain.high(4)}}};
  if (tool == 0.0) pieces = {{{0.0, 0.0}, {0.0, 0.0}}};
  std::size_t looked_at = 0;
  while (!pieces.empty()) {
    std::vector<Piece> halves;
    for (const Piece& piece : pieces) {
      execution.check();
      const JointState wrist{0.0, 0.0, 0.0, piece.fourth.middle(), piece.fifth.middle(), sixth};
      const double near = tool * (piece.fourth.half() + piece.fifth.half()) + rounding;
      if (!can_reach(chain, place, tip_in_frame_3(chain, wrist), near)) continue;
      const auto states = puma560_inverse_place(chain, place, {wrist[3], wrist[4], wrist[5]});
      found.states.insert(found.states.end(), states.begin(), states.end());
      const auto longer = piece.fourth.half() > piece.fifth.half() ? &Piece::fourth : &Piece::fifth;
      Piece low = piece;
      Piece high = piece;
      (low.*longer).high = (high.*longer).low = (piece.*longer).middle();
      halves.insert(halves.end(), {low, high});
    }
    looked_at += pieces.size();
    const bool is_fine = halves.empty() || std::max(halves[0].fourth.half(), halves[0].fifth.half()) < finest;
    found.none_is_left = halves.empty() && found.states.empty();
    if (is_fine || found.states.size() >= enough || looked_at > most_pieces) break;
    pieces = std::move(halves);
  }
  return found;
}

}  // namespace warren

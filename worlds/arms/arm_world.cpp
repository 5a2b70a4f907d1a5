// SPDX-License-Identifier: BSD-3-Clause
#include "worlds/arms/arm_world.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <string>

#include "core/base/error.hpp"
#include "core/base/types.hpp"
#include "core/base/whole.hpp"

namespace warren {

namespace {

double checked_length(const char* name, double value) {
  if (value >= 0.0 && value <= largest_coordinate) return value;
  throw InputError(name, "must be a number from 0 to 1e60", std::to_string(value));
}

double checked_positive(const char* name, double value) {
  if (value > 0.0 && value <= largest_coordinate) return value;
  throw InputError(name, "must be a number above 0, up to 1e60", std::to_string(value));
}

Spine spine_of(const ChainPosture& at, const ArmLink& link) { return {at.points[link.from], at.points[link.to]}; }

/// The part of a piece that keeps a way within `room`, where the way shrinks with the part at least in proportion; 1:
/// all of the piece, 0: none of it, so where there is neither room nor way.
double part_within(double room, double way) {
  if (room > way) return 1.0;
  return way > 0.0 ? (1.0 - 1e-9) * room / way : 0.0;
}

}  // namespace

std::vector<ArmLink> links_of(const SerialChain& chain) {
  ChainPosture rest;
  chain.place({}, rest);
  // What joint i turns is frame i, and with it in a modified table not its origin, which stands on the axis.
  const std::size_t lag = chain.table().convention == DhConvention::modified ? 1 : 0;
  std::vector<ArmLink> links;
  std::size_t from = 0;
  for (std::size_t point = 1; point < chain.point_count(); ++point) {
    // Between neighbouring origins the distance is a matter of the table, whatever the angles.
    if ((rest.points[point] - rest.points[point - 1]).norm() <= 1e-12 * chain.reach()) continue;
    links.push_back({from, point, point > chain.joint_count() ? chain.joint_count() : point - lag});
    from = point;
  }
  return links;
}

ArmWorld::ArmWorld(const Scene& scene, const SerialChain& chain, const ArmOptions& options, const Execution& execution)
    : chain_(chain),
      solids_(scene.spheres, scene.boxes, execution),
      links_(links_of(chain)),
      weights_(options.weights),
      radius_(checked_length("radius", options.radius)),
      resolution_(checked_positive("resolution", options.resolution.value_or(1e-5 * chain.reach()))) {
  if (links_.empty()) throw InputError("arm", "has no link of any length");
  for (const double weight : weights_) checked_positive("weight", weight);
  const double clearance = checked_length("clearance", options.clearance);
  const double rounding = 1e-12 * (chain_.reach() + solids_.extent() + radius_ + clearance);
  touch_ = (radius_ + clearance) * (1.0 + 1e-9) + rounding;
  touch_links_ = (2.0 * radius_ + clearance) * (1.0 + 1e-9) + rounding;
  if (options.self_collision) find_pairs();
}

/// Links that what is between them keeps so near that they always touch are no use to keep apart.
void ArmWorld::find_pairs() {
  ChainPosture rest;
  chain_.place({}, rest);
  for (std::size_t far = 2; far < links_.size(); ++far) {
    double between = 0.0;
    for (std::size_t near = far - 1; near-- > 0;) {
      const ArmLink& link = links_[near + 1];
      between += (rest.points[link.to] - rest.points[link.from]).norm();
      if (between > touch_links_) pairs_.push_back({near, far});
    }
  }
}

JointState ArmWorld::at_unit(const std::array<double, dimension>& u) const {
  JointState q{};
  for (std::size_t j = 0; j < dimension; ++j) {
    const double low = chain_.low(j);
    const double high = chain_.high(j);
    q[j] = chain_.moves(j) ? std::min(high, low + u[j] * (high - low)) : std::clamp(0.0, low, high);
  }
  return q;
}

bool ArmWorld::is_free(const State& a, Query&) const {
  if (chain_.joint_outside_limits(a) != most_joints) return false;
  ChainPosture at;
  chain_.place(a, at);
  std::uint32_t parts = all_parts();
  return clear_part(at, Turns{}, 0.0, parts) >= 0.0 && parts == 0;
}

double ArmWorld::distance(const State& a, const State& b) const {
  double sum = 0.0;
  for (std::size_t j = 0; j < dimension; ++j) {
    const double turn = weights_[j] * (b[j] - a[j]);
    sum += turn * turn;
  }
  return std::sqrt(sum);
}

JointState ArmWorld::interpolate(const State& a, const State& b, double t) const {
  if (t >= 1.0) return b;
  JointState q;
  for (std::size_t j = 0; j < dimension; ++j) q[j] = a[j] + t * (b[j] - a[j]);
  return q;
}

std::array<double, 6> ArmWorld::embed(const State& a) const {
  std::array<double, dimension> point;
  for (std::size_t j = 0; j < dimension; ++j) point[j] = weights_[j] * a[j];
  return point;
}

double ArmWorld::clearance(const State& a, double enough) const {
  ChainPosture at;
  chain_.place(a, at);
  double least = std::numeric_limits<double>::infinity();
  for (const ArmLink& link : links_) {
    const double limit = std::min(least, enough);
    least = std::min(least, solids_.distance(spine_of(at, link), limit + touch_) - touch_);
    if (least <= 0.0) return least;
  }
  for (const LinkPair& pair : pairs_) {
    const Spine near = spine_of(at, links_[pair.near]);
    const Spine far = spine_of(at, links_[pair.far]);
    least = std::min(least, std::sqrt(distance_square(near, far)) - touch_links_);
  }
  return least;
}

ArmWorld::Turns ArmWorld::turns_between(const State& a, const State& b) const {
  constexpr double rounding = 1.0 + 1e-12;
  Turns turns{};
  const std::size_t n = chain_.joint_count();
  for (std::size_t j = 0; j < n; ++j) {
    turns.signed_turn[j] = b[j] - a[j];
    turns.turn[j] = rounding * std::abs(b[j] - a[j]);
  }
  for (std::size_t point = 0; point < chain_.point_count(); ++point) {
    double behind = 0.0;  // sum over the joints behind
    for (std::size_t j = n; j-- > 0;) {
      const double way = turns.turn[j] * chain_.reach(j, point);
      turns.bend[point] += turns.turn[j] * behind;
      turns.acceleration[point] += turns.turn[j] * (2.0 * behind + way);
      behind += way;
    }
    turns.most[point] = behind;
  }
  return turns;
}

/// Travel of a point by the joints first .. last - 1, when the motion's share `share` is gone to either side.
double ArmWorld::travel_of(const ChainPosture& at, const Turns& turns, std::size_t point, std::size_t first,
                           std::size_t last, double share) const {
  double speed = 0.0;
  for (std::size_t j = first; j < last; ++j) {
    if (turns.turn[j] == 0.0 || chain_.reach(j, point) == 0.0) continue;
    speed += turns.turn[j] * at.axes[j].cross(at.points[point] - at.on_axes[j]).norm();
  }
  return std::min(share * (speed + 0.5 * share * turns.bend[point]), share * turns.most[point]);
}

double ArmWorld::travel_of_link(const ChainPosture& at, const Turns& turns, const ArmLink& link, std::size_t first,
                                double share) const {
  return std::max(travel_of(at, turns, link.from, first, link.joints, share),
                  travel_of(at, turns, link.to, first, link.joints, share));
}

/// Of a point by the first so many joints, the whole motion in a unit of time.
Vec3 ArmWorld::velocity_of(const ChainPosture& at, const Turns& turns, std::size_t point, std::size_t joints) const {
  Vec3 velocity = Vec3::Zero();
  for (std::size_t j = 0; j < joints; ++j) {
    if (turns.turn[j] == 0.0 || chain_.reach(j, point) == 0.0) continue;
    velocity += turns.signed_turn[j] * at.axes[j].cross(at.points[point] - at.on_axes[j]);
  }
  return velocity;
}

ArmWorld::LinkMove ArmWorld::move_of(const ChainPosture& at, const Turns& turns, const ArmLink& link,
                                     double share) const {
  LinkMove move;
  move.travel = travel_of_link(at, turns, link, 0, share);
  move.velocity = {share * velocity_of(at, turns, link.from, link.joints),
                   share * velocity_of(at, turns, link.to, link.joints)};
  move.bend = {0.5 * share * share * turns.acceleration[link.from], 0.5 * share * share * turns.acceleration[link.to]};
  return move;
}

/// For which part of a piece does a plane stay between the link and a sphere?
double ArmWorld::part_off(const ChainPosture& at, const ArmLink& link, const LinkMove& move,
                          const Approach& near) const {
  const double least = near.radius + touch_ + resolution_;  // nearer than that a path could hardly be verified
  const auto part_before = [&](std::size_t point, const Vec3& velocity, double bend) {
    const double room = near.outward.dot(at.points[point] - near.centre) - least;
    return part_within(room, bend + std::abs(near.outward.dot(velocity)));
  };
  return std::min(part_before(link.to, move.velocity[1], move.bend[1]),
                  part_before(link.from, move.velocity[0], move.bend[0]));
}

/// For which part of a piece, to both sides of its middle, is the link clear of the obstacles? Negative where it meets
/// one, 1 for all of the piece. The bound of the travel that needs no posture says which may be met at all: fewer, the
/// smaller the part is already.
double ArmWorld::clear_part(const ChainPosture& at, const Turns& turns, const ArmLink& link, double share) const {
  const double most = share * std::max(turns.most[link.from], turns.most[link.to]);
  double part = 1.0;
  std::optional<LinkMove> move;
  solids_.for_each_within(spine_of(at, link), touch_ + most, [&](const Approach& near) {
    const double here = near.distance - touch_;
    if (here <= 0.0) return part = -1.0;
    if (here <= part * most) {
      if (!move) move = move_of(at, turns, link, share);
      const double by_travel = part_within(here, move->travel);
      if (by_travel < part) part = std::min(part, std::max(by_travel, part_off(at, link, *move, near)));
    }
    return touch_ + part * most;
  });
  return part;
}

double ArmWorld::clear_part(const ChainPosture& at, const Turns& turns, const LinkPair& pair, double share) const {
  const ArmLink& far = links_[pair.far];
  const double travel = share > 0.0 ? travel_of_link(at, turns, far, links_[pair.near].joints, share) : 0.0;
  const double distance = std::sqrt(distance_square(spine_of(at, links_[pair.near]), spine_of(at, far)));
  return distance <= touch_links_ ? -1.0 : part_within(distance - touch_links_, travel);
}

/// The least of the parts that are not clear for all of the piece, whose bits stay. From the tip to the base: what
/// moves most meets most.
double ArmWorld::clear_part(const ChainPosture& at, const Turns& turns, double share, std::uint32_t& parts) const {
  std::uint32_t narrow = 0;
  double least = 1.0;
  for (std::uint32_t left = parts; left != 0;) {
    const auto number = as_whole<std::size_t>(std::bit_width(left) - 1);
    const std::uint32_t bit = std::uint32_t{1} << number;
    left ^= bit;
    const double part = number < links_.size() ? clear_part(at, turns, links_[number], share)
                                               : clear_part(at, turns, pairs_[number - links_.size()], share);
    if (part < 0.0) return part;
    if (part < 1.0) narrow |= bit;
    least = std::min(least, part);
  }
  parts = narrow;
  return least;
}

double ArmWorld::travel(const State& a, const State& b) const {
  const Turns turns = turns_between(a, b);
  double most = 0.0;
  for (const ArmLink& link : links_) most = std::max({most, turns.most[link.from], turns.most[link.to]});
  return most;
}

/// The share of the motion on which nothing goes farther than the resolution.
double ArmWorld::resolution_share(const Turns& turns) const {
  double most = 0.0;
  for (const ArmLink& link : links_) most = std::max({most, turns.most[link.from], turns.most[link.to]});
  return most > resolution_ ? resolution_ / most : 1.0;
}

MotionVerdict ArmWorld::judge_motion(const State& a, const State& b) const {
  const Turns turns = turns_between(a, b);
  ChainPosture at;
  const auto look = [&](double middle, double half, std::uint32_t& parts) {
    chain_.place(interpolate(a, b, middle), at);
    return half * clear_part(at, turns, half, parts);
  };
  return certified_parts(all_parts(), look, resolution_share(turns));
}

bool ArmWorld::is_free_motion(const State& a, const State& b, Query& query) const {
  const MotionVerdict verdict = judge_motion(a, b);
  if (verdict == MotionVerdict::refused) ++query.refused;
  return verdict == MotionVerdict::free;
}

double ArmWorld::sampled_volume() const {
  double volume = 1.0;
  for (std::size_t j = 0; j < dimension; ++j) {
    if (chain_.moves(j)) volume *= weights_[j] * (chain_.high(j) - chain_.low(j));
  }
  return volume;
}

std::size_t ArmWorld::sampled_dimension() const {
  std::size_t count = 0;
  for (std::size_t j = 0; j < dimension; ++j) count += chain_.moves(j) ? 1 : 0;
  return count;
}

Path<JointState> with_even_idle_joints(const ArmWorld& world, Path<JointState> path) {
  if (path.size() < 2) return path;
  std::vector<double> along(path.size(), 0.0);
  for (std::size_t i = 1; i < path.size(); ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < most_joints; ++j) {
      if (world.chain().moves(j)) sum += (path[i][j] - path[i - 1][j]) * (path[i][j] - path[i - 1][j]);
    }
    along[i] = along[i - 1] + std::sqrt(sum);
  }
  const double whole = along.back();
  for (std::size_t i = 1; i + 1 < path.size() && whole > 0.0; ++i) {
    const JointState even = world.interpolate(path.front(), path.back(), along[i] / whole);
    for (std::size_t j = 0; j < most_joints; ++j) {
      if (!world.chain().moves(j)) path[i][j] = even[j];
    }
  }
  return path;
}

}  // namespace warren

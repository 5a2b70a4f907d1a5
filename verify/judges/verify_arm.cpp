// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/verify_arm.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"
#include "verify/judges/judged_input.hpp"
#include "verify/judges/leg_reports.hpp"

namespace warren {
namespace {

using Point = std::array<double, 3>;
using Matrix = std::array<std::array<double, 4>, 4>;

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix m{};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      for (std::size_t k = 0; k < 4; ++k) m[i][j] += a[i][k] * b[k][j];
    }
  }
  return m;
}

/// The four factors of a table's row, multiplied out.
Matrix step_of(const DhJoint& joint, DhConvention convention, double q) {
  const auto [s, c] = portable::sin_and_cos(q + joint.offset_rad);
  const auto [sa, ca] = portable::sin_and_cos(joint.alpha_rad);
  const Matrix turn{{{c, -s, 0, 0}, {s, c, 0, 0}, {0, 0, 1, joint.d}, {0, 0, 0, 1}}};
  const Matrix twist{{{1, 0, 0, joint.a}, {0, ca, -sa, 0}, {0, sa, ca, 0}, {0, 0, 0, 1}}};
  return convention == DhConvention::standard ? product(turn, twist) : product(twist, turn);
}

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Point plus(const Point& a, double t, const Point& b) { return {a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]}; }
double product(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point crossed(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double size_of(const Point& a) { return portable::hypot(a[0], a[1], a[2]); }

struct Segment3 {
  Point a;
  Point b;
};

double distance(const Segment3& s, const Point& p) {
  const Point way = minus(s.b, s.a);
  const double square = product(way, way);
  const double t = square > 0.0 ? std::clamp(product(minus(p, s.a), way) / square, 0.0, 1.0) : 0.0;
  return size_of(minus(p, plus(s.a, t, way)));
}

/// The distance from a box is convex along a segment: its slope's sign is halved for.
double distance(const Segment3& s, const SolidBox& box) {
  const Point way = minus(s.b, s.a);
  const auto gap_at = [&](double t) {
    Point gap = plus(s.a, t, way);
    for (std::size_t axis = 0; axis < 3; ++axis) gap[axis] -= std::clamp(gap[axis], box.low[axis], box.high[axis]);
    return gap;
  };
  constexpr int halvings = 60;
  double low = 0.0;
  double high = 1.0;
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (low + high);
    (product(gap_at(middle), way) > 0.0 ? high : low) = middle;
  }
  return std::min({size_of(gap_at(low)), size_of(gap_at(0.0)), size_of(gap_at(1.0))});
}

/// Where the lines' common perpendicular meets both segments, its length; else an end decides.
double distance(const Segment3& s, const Segment3& t) {
  double least = std::min({distance(s, t.a), distance(s, t.b), distance(t, s.a), distance(t, s.b)});
  const Point u = minus(s.b, s.a);
  const Point v = minus(t.b, t.a);
  const Point normal = crossed(u, v);
  const double square = product(normal, normal);
  if (!(square > 0.0)) return least;
  const Point apart = minus(t.a, s.a);
  const double along_s = product(crossed(apart, v), normal) / square;
  const double along_t = product(crossed(apart, u), normal) / square;
  const bool inside = along_s >= 0.0 && along_s <= 1.0 && along_t >= 0.0 && along_t <= 1.0;
  return inside ? std::min(least, std::abs(product(apart, normal)) / std::sqrt(square)) : least;
}

/// A capsule's spine: from one origin to a later one.
struct Capsule {
  std::size_t from;
  std::size_t to;
};

/// Something that a capsule might meet: sphere, box or another capsule nearer to the base, by number.
struct Pair {
  enum class Kind : std::uint8_t { sphere, box, capsule };
  std::size_t capsule;
  Kind kind;
  std::size_t other;
};

class ArmVerifier {
 public:
  ArmVerifier(const Scene& scene, const DhTable& table, const ArmVerifyOptions& options, const Execution& execution)
      : scene_(scene), table_(table), options_(options), execution_(execution) {
    measure_links();
    pair_up();
    double largest = reach_ + options.radius + options.clearance;
    for (const Sphere& s : scene.spheres) {
      largest = std::max({largest, std::abs(s.x) + s.radius, std::abs(s.y) + s.radius, std::abs(s.z) + s.radius});
    }
    for (const SolidBox& box : scene.boxes) {
      for (const double x : box.low) largest = std::max(largest, std::abs(x));
      for (const double x : box.high) largest = std::max(largest, std::abs(x));
    }
    rounding_ = 2e-14 * largest;
    finest_ = 1e-9 * reach_;
    close_ = 1e-2 * (options.radius > 0.0 ? options.radius : reach_);
  }

  LegReport check(const JointState& a, const JointState& b, std::size_t number) const {
    LegReport report;
    const Leg leg{a, b, number};
    check_piece(leg, 0.5, 0.5, pairs_, report);
    return report;
  }
  std::optional<Violation> outside_limits(const JointState& q, std::size_t number) const;
  Point tool_at(const JointState& q) const { return origins_at(q).back(); }

 private:
  struct Leg {
    JointState a;
    JointState b;
    std::size_t number;
  };
  void measure_links();
  void pair_up();
  std::vector<Point> origins_at(const JointState& q) const;
  double distance_of(const std::vector<Point>& at, const Pair& pair) const;
  double way_of(const Leg& leg, const Pair& pair, double half) const;
  std::string name_of(const Pair& pair) const;
  void check_piece(const Leg& leg, double middle, double half, const std::vector<Pair>& among, LegReport& report) const;

  const Scene& scene_;
  const DhTable& table_;
  const ArmVerifyOptions& options_;
  const Execution& execution_;
  std::vector<double> length_;  // from each origin to the next, the tool's last
  std::vector<Capsule> capsules_;
  std::vector<Pair> pairs_;
  double reach_ = 0.0;
  double rounding_ = 0.0;  // bounds the error of every distance computed here
  double finest_ = 0.0;    // pieces on which a link goes less are not halved
  double close_ = 0.0;     // how sharp the least clearance shall be
};

void ArmVerifier::measure_links() {
  for (const DhJoint& joint : table_.joints) length_.push_back(portable::hypot(joint.a, joint.d));
  length_.push_back(table_.tool.translation().norm());
  for (const double length : length_) reach_ += length;
  std::size_t from = 0;
  for (std::size_t i = 0; i < length_.size(); ++i) {
    if (length_[i] <= 1e-12 * reach_) continue;
    capsules_.push_back({from, i + 1});
    from = i + 1;
  }
}

void ArmVerifier::pair_up() {
  for (std::size_t k = 0; k < capsules_.size(); ++k) {
    for (std::size_t i = 0; i < scene_.spheres.size(); ++i) pairs_.push_back({k, Pair::Kind::sphere, i});
    for (std::size_t i = 0; i < scene_.boxes.size(); ++i) pairs_.push_back({k, Pair::Kind::box, i});
    if (!options_.self_collision) continue;
    // Capsules that the links between them can't keep apart are no pair.
    const double always_touching = (2.0 * options_.radius + options_.clearance) * (1.0 + 1e-6);
    double between = 0.0;
    for (std::size_t i = k; i-- > 0;) {
      if (between > always_touching) pairs_.push_back({k, Pair::Kind::capsule, i});
      between += length_[capsules_[i].to - 1];
    }
  }
}

std::vector<Point> ArmVerifier::origins_at(const JointState& q) const {
  Matrix frame{{{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}}};
  std::vector<Point> origins{{0.0, 0.0, 0.0}};
  for (std::size_t i = 0; i < table_.joints.size(); ++i) {
    frame = product(frame, step_of(table_.joints[i], table_.convention, q[i]));
    origins.push_back({frame[0][3], frame[1][3], frame[2][3]});
  }
  Point tool = origins.back();
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t k = 0; k < 3; ++k) tool[row] += frame[row][k] * table_.tool.translation()[as_whole<int>(k)];
  }
  origins.push_back(tool);
  return origins;
}

/// Between surfaces.
double ArmVerifier::distance_of(const std::vector<Point>& at, const Pair& pair) const {
  const Segment3 spine{at[capsules_[pair.capsule].from], at[capsules_[pair.capsule].to]};
  if (pair.kind == Pair::Kind::sphere) {
    const Sphere& s = scene_.spheres[pair.other];
    return distance(spine, Point{s.x, s.y, s.z}) - s.radius - options_.radius;
  }
  if (pair.kind == Pair::Kind::box) return distance(spine, scene_.boxes[pair.other]) - options_.radius;
  const Capsule& other = capsules_[pair.other];
  return distance(spine, Segment3{at[other.from], at[other.to]}) - 2.0 * options_.radius;
}

/// How far the capsule goes against the other, at most: each joint swings it by no more than all that is between.
double ArmVerifier::way_of(const Leg& leg, const Pair& pair, double half) const {
  const std::size_t to = capsules_[pair.capsule].to;
  const std::size_t first = pair.kind == Pair::Kind::capsule ? capsules_[pair.other].to - 1 : 0;
  double way = 0.0;
  double behind = 0.0;
  for (std::size_t i = to; i-- > first;) {
    behind += length_[i];
    if (i < table_.joints.size()) way += std::abs(leg.b[i] - leg.a[i]) * behind;
  }
  return half * way * (1.0 + 1e-12);
}

std::string ArmVerifier::name_of(const Pair& pair) const {
  if (pair.kind == Pair::Kind::capsule) return fmt::format("link {}: touches link {}", pair.other, pair.capsule);
  if (pair.kind == Pair::Kind::sphere) {
    const Sphere& s = scene_.spheres[pair.other];
    return fmt::format("sphere {}: {} {} {} {}", pair.other, s.x, s.y, s.z, s.radius);
  }
  const auto& [low, high] = scene_.boxes[pair.other];
  return fmt::format("box {}: {} {}", pair.other, fmt::join(low, " "), fmt::join(high, " "));
}

void ArmVerifier::check_piece(const Leg& leg, double middle, double half, const std::vector<Pair>& among,
                              LegReport& report) const {
  constexpr std::size_t most_looks = 2'000'000;  // some seconds
  execution_.check();
  const bool weary = ++report.looks > most_looks;
  JointState q;
  for (std::size_t j = 0; j < q.size(); ++j) q[j] = leg.a[j] + middle * (leg.b[j] - leg.a[j]);
  const std::vector<Point> at = origins_at(q);
  std::vector<Pair> open;
  for (const Pair& pair : among) {
    const double distance = distance_of(at, pair);
    const double way = way_of(leg, pair, half);
    const double proved = distance - way - rounding_;
    report.met = std::min(report.met, distance);
    const bool settled = proved >= report.met - close_ || way < finest_;
    if (proved > options_.clearance && settled) {
      report.least = std::min(report.least, proved);
      continue;
    }
    if (distance <= rounding_ || distance + rounding_ < options_.clearance || way < finest_ || weary) {
      report.least = std::min(report.least, distance);
      report.violation = Violation{leg.number, distance, name_of(pair)};
      return;
    }
    open.push_back(pair);
  }
  if (open.empty()) return;
  check_piece(leg, middle - 0.5 * half, 0.5 * half, open, report);
  if (!report.violation) check_piece(leg, middle + 0.5 * half, 0.5 * half, open, report);
}

std::optional<Violation> ArmVerifier::outside_limits(const JointState& q, std::size_t number) const {
  for (std::size_t j = 0; j < q.size(); ++j) {
    const bool exists = j < table_.joints.size();
    const double low = exists ? table_.joints[j].low_rad : 0.0;
    const double high = exists ? table_.joints[j].high_rad : 0.0;
    const double beyond = std::max(low - q[j], q[j] - high);
    if (beyond <= options_.tolerance) continue;
    constexpr double degree = std::numbers::pi / 180.0;
    return Violation{number, 0.0,
                     fmt::format("limits: joint {} at {:.9g}, which has {:.9g} to {:.9g} ({:.6g} to {:.6g} degrees)",
                                 j + 1, q[j], low, high, low / degree, high / degree)};
  }
  return std::nullopt;
}

/// The largest difference of a joint, in radians.
double difference(const JointState& a, const JointState& b) {
  double most = 0.0;
  for (std::size_t j = 0; j < a.size(); ++j) most = std::max(most, std::abs(a[j] - b[j]));
  return most;
}

void check_input(std::span<const JointState> path, const ArmVerifyOptions& options) {
  if (path.empty()) throw InputError("path", "has no states");
  for (std::size_t i = 0; i < path.size(); ++i) {
    const auto fits = [](double angle) { return std::abs(angle) <= largest_coordinate; };
    if (std::all_of(path[i].begin(), path[i].end(), fits)) continue;
    throw InputError(fmt::format("path: state {}", i), "must be numbers of at most 1e60");
  }
  check_not_negative("clearance", options.clearance);
  check_not_negative("robot: radius", options.radius);
  check_not_negative("tolerance", options.tolerance);
}

double joint_length(std::span<const JointState> path) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) {
    double square = 0.0;
    for (std::size_t j = 0; j < path[i].size(); ++j) {
      const double turn = path[i][j] - path[i - 1][j];
      square += turn * turn;
    }
    sum += std::sqrt(square);
  }
  return sum;
}

std::optional<Violation> wrong_start(std::span<const JointState> path, const ArmVerifyOptions& options) {
  if (!options.start) return std::nullopt;
  const double off = difference(path.front(), *options.start);
  if (off <= options.tolerance) return std::nullopt;
  return elsewhere("start", *options.start, off, 0);
}

std::optional<Violation> wrong_goal(std::span<const JointState> path, const ArmVerifyOptions& options,
                                    const ArmVerifier& arm) {
  const std::size_t last = legs_of(path.size()) - 1;
  if (options.goal) {
    const double off = difference(path.back(), *options.goal);
    if (!(off <= options.tolerance)) return elsewhere("goal", *options.goal, off, last);
  }
  if (!options.goal_place) return std::nullopt;
  const Point place{options.goal_place->x(), options.goal_place->y(), options.goal_place->z()};
  const double off = size_of(minus(arm.tool_at(path.back()), place));
  if (off <= options.tolerance) return std::nullopt;
  return elsewhere("goal", place, off, last);
}

}  // namespace

Verification verify_arm(const Scene& scene, const DhTable& table, std::span<const JointState> path,
                        const ArmVerifyOptions& options, const Execution& execution) {
  check_input(path, options);
  check_space_scene(scene);
  const ArmVerifier arm(scene, table, options, execution);
  const LegReport legs = report_legs(legs_of(path.size()), 1, execution, [&](Range r) {
    const JointState& a = path[r.first];
    const JointState& b = path[std::min(r.first + 1, path.size() - 1)];
    LegReport report;
    report.violation = arm.outside_limits(a, r.first);
    if (!report.violation) report.violation = arm.outside_limits(b, r.first);
    return report.violation ? report : arm.check(a, b, r.first);
  });
  Verification result = verdict_on(legs, wrong_start(path, options), wrong_goal(path, options, arm));
  result.length = joint_length(path);
  return result;
}

}  // namespace warren

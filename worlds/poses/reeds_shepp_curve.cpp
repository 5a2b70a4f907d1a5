// SPDX-License-Identifier: BSD-3-Clause
// The shortest way of a car that may also back up: Reeds, Shepp, Pacific J. Math. 145 (1990). Its words, | a change of
// gear: CSC, C|C|C, C|CC, CC|C, CC|CC, C|CC|C, C|CSC, CSC|C, C|CSC|C, where a second arc beside S is a quarter turn: 48
// with left and right, forwards and backwards. All are tried, and the shortest whose end is the goal up to rounding is
// taken; the published tables that would spare some contain errors.
//
// The families are solved here for signed arcs (negative: backwards), so each closed form also gives ways with gear
// changes that the theorem doesn't need; they are ways all the same, and the shortest of more ways is no longer.
// Mirror (left is right), time reversal (forwards is backwards) and the way back from the goal give the rest from eight
// forms. The length is a metric, and continuous. bench/steering_bench.cpp: below 1 us a pair.
//
// In turning radii, from the origin with heading 0 to (x, y, phi), as complex numbers: a left circle at heading h has
// its centre at i e^(ih) from the car, a right one at -i e^(ih). Adding up centre to centre along a word gives, for the
// vector from the first circle (left) to the last one,
//   L t S u L v             u e^(it)                          R a L v after L t:  4 sin(a/2) e^(i(t - a/2))
//   L t S u R v             (u - 2i) e^(it)
//   L t R a L -a R v        -2i (2 cos a - 1) e^(i(t - a))
//   L t R a L a R v         -2i (2 - e^(-ia)) e^(it)
//   L t R -q S u L v        (-2 + i (u - 2)) e^(it)           q: a quarter turn
//   L t R -q S u R v        i (u - 2) e^(it)
//   L t R -q S u L -q R v   (-2 + i (u - 4)) e^(it)
// whose absolute value gives u or a and whose argument gives t; v makes the heading right.
#include <limits>
#include <numbers>

#include "core/base/trigonometry.hpp"
#include "core/base/whole.hpp"
#include "worlds/poses/steering_curve.hpp"

namespace warren {
namespace {

constexpr double quarter = 0.5 * std::numbers::pi;

/// How the goal was changed before the word was solved for it.
struct Change {
  bool mirrored = false;
  bool reversed = false;   // in time: forwards is backwards
  bool from_goal = false;  // the way back
};

double root(double square) { return std::sqrt(std::max(square, 0.0)); }

/// Into [-pi, pi], for angles within some turns.
double wrapped(double angle) {
  while (angle > std::numbers::pi) angle -= 2.0 * std::numbers::pi;
  while (angle < -std::numbers::pi) angle += 2.0 * std::numbers::pi;
  return angle;
}

/// Absolute value and argument.
struct Polar {
  double size;
  double angle;
  explicit Polar(Vec2 v) : size(norm(v)), angle(portable::atan2(v.y, v.x)) {}
  /// Of the vector with its x the other way.
  void reverse() { angle = std::copysign(std::numbers::pi, angle) - angle; }
};

/// pieces: in the frame in which they were found.
SteeringWord word_of(const Change& change, std::span<const SteeringPiece> pieces) {
  SteeringWord word;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const SteeringPiece& piece = pieces[change.from_goal ? pieces.size() - 1 - i : i];
    const Steer steer = change.mirrored ? static_cast<Steer>(-as_whole<int>(piece.steer)) : piece.steer;
    word.add(steer, change.reversed ? -piece.length : piece.length);
  }
  return word;
}

/// The shortest word, the first of those that are as long: among many that only turn, rounding would choose. That it
/// ends at the goal is asked where `sure`.
class Shortest {
 public:
  Shortest(const Se2& goal, double off, bool sure) : goal_(goal), off_(off), sure_(sure) {}
  /// Is it worth to go on with a word that has at least this length?
  bool worth(double at_least) const { return at_least < length_ - (as_long + off_); }
  /// length: of the word, up to rounding.
  void take(double length, const SteeringWord& word) {
    if (sure_ && !ends_at(word, goal_, off_)) return;
    length_ = length;
    best_ = word;
  }
  const SteeringWord& best() const { return best_; }  ///< of no piece: none

 private:
  static constexpr double as_long = 1e-12;
  Se2 goal_;
  double off_;
  bool sure_;
  double length_ = std::numeric_limits<double>::infinity();
  SteeringWord best_;
};

/// All words up to a length.
struct All {
  double longest;
  const std::function<void(const SteeringWord&)>& visit;

  /// Bounds are sums of other roundings than lengths.
  bool worth(double at_least) const { return at_least <= longest + 1e-12 * longest; }
  void take(double length, const SteeringWord& word) const {
    if (length <= longest) visit(word);
  }
};

/// Hands the words to a goal, as far as they are worth it, to the taker.
template <class Taker>
class Enumeration {
  using enum Steer;

 public:
  /// off: what rounding put the goal off by
  Enumeration(const Se2& goal, double off, Taker& taker)
      : taker_(taker), off_(off), same_(1e-12 + off), touching_(1e-11 + 8.0 * off) {
    const auto [s, c] = portable::sin_and_cos(goal.theta);
    const auto four = [&, s = s, c = c](bool from_goal, double x, double y) {
      const Frame plain({false, false, from_goal}, {x, y}, goal.theta, s, c);
      const Frame mirrored({true, false, from_goal}, {x, -y}, -goal.theta, -s, c);
      std::array all{plain, mirrored, plain, mirrored};
      all[2].reverse();
      all[3].reverse();
      return all;
    };
    const auto there = four(false, goal.x, goal.y);
    for (const Frame& frame : there) solve_straight(frame);
    for (const Frame& frame : there) solve_arcs(frame);
    // The goal seen the other way round: turned words, last piece first.
    for (const Frame& frame : four(true, goal.x * c + goal.y * s, goal.x * s - goal.y * c)) solve_quarter(frame);
  }

 private:
  /// The goal, changed, and the vectors from the first circle (left) to the last one, left or right.
  struct Frame {
    Change change;
    double phi;
    Polar to_left;
    Polar to_right;
    Frame(const Change& how, Vec2 goal, double theta, double s, double c)
        : change(how), phi(theta), to_left({goal.x - s, goal.y + c - 1.0}), to_right({goal.x + s, goal.y - c - 1.0}) {}
    /// What the first and the last arc turn at least, both together, if what lies between them turns so far: most
    /// words are too long by that, and need no arctangents.
    double turn(double between = 0.0) const { return std::abs(wrapped(phi - between)); }
    /// In time: x, and so heading and turning centres, the other way.
    void reverse() {
      change.reversed = true;
      phi = -phi;
      to_left.reverse();
      to_right.reverse();
    }
  };

  bool worth(double at_least) const { return taker_.worth(at_least); }
  /// Along the tangent between two circles whose middles are so far apart. Where they touch up to rounding there is
  /// none: its root would make a piece of it, and turn the curve by as much.
  double tangent(double apart) const { return apart <= 2.0 + same_ ? 0.0 : root(apart * apart - 4.0); }
  /// The arc between circles that touch is none, as the tangent is.
  double arc_of(double cosine) const { return cosine >= 1.0 - 0.25 * same_ ? 0.0 : portable::acos(cosine); }
  /// between: what all pieces but the first and the last are long.
  void take(const Frame& frame, double between, std::initializer_list<SteeringPiece> pieces) {
    const double length = between + std::abs(pieces.begin()->length) + std::abs(std::prev(pieces.end())->length);
    if (worth(length)) taker_.take(length, word_of(frame.change, {pieces.begin(), pieces.end()}));
  }
  void solve_straight(const Frame& f) {
    // What rounding alone turns, or drives between two circles that are one, is no piece.
    if (f.to_left.size <= 1e-9 + 4.0 * off_) take(f, 0.0, {{left, 0.0}, {straight, 0.0}, {left, f.phi}});
    const double across = f.to_left.size;
    if (worth(across + f.turn())) {
      const double first = f.to_left.angle;
      if (across * std::abs(first) <= 4.0 * off_) take(f, across, {{left, 0.0}, {straight, across}, {left, f.phi}});
      take(f, across, {{left, first}, {straight, across}, {left, wrapped(f.phi - first)}});
    }
    if (f.to_right.size >= 2.0 - touching_) {
      const double way = tangent(f.to_right.size);
      if (worth(way + f.turn())) {
        const double first = wrapped(f.to_right.angle + portable::atan2(2.0, way));
        take(f, way, {{left, first}, {straight, way}, {right, wrapped(first - f.phi)}});
      }
    }
  }
  void solve_arcs(const Frame& f) {
    if (f.to_left.size <= 4.0 + touching_) {
      const double arc = 2.0 * portable::asin(std::min(0.25 * f.to_left.size, 1.0));
      if (worth(std::max(arc, f.turn()))) {
        const double first = wrapped(f.to_left.angle - 0.5 * arc + std::numbers::pi);
        take(f, arc, {{left, first}, {right, -arc}, {left, wrapped(f.phi - first - arc)}});
      }
    }
    solve_four_arcs(f);
    solve_quarter(f);
    solve_two_quarters(f);
  }
  void solve_four_arcs(const Frame& f) {
    const double out_cosine = 0.25 * (2.0 + f.to_right.size);
    if (out_cosine <= 1.0 + touching_) {
      const double arc = arc_of(out_cosine);
      if (worth(2.0 * arc + f.turn(-2.0 * arc))) {
        const double first = wrapped(f.to_right.angle + arc + quarter);
        const double last = wrapped(first - 2.0 * arc - f.phi);
        take(f, 2.0 * arc, {{left, first}, {right, arc}, {left, -arc}, {right, last}});
      }
    }
    const double in_cosine = (20.0 - f.to_right.size * f.to_right.size) / 16.0;
    if (in_cosine >= -1.0 && in_cosine <= 1.0 + touching_) {
      const double arc = arc_of(in_cosine);
      if (worth(2.0 * arc + f.turn())) {
        const double first = wrapped(f.to_right.angle + quarter + portable::atan2(portable::sin(arc), 2.0 - in_cosine));
        take(f, 2.0 * arc, {{left, first}, {right, -arc}, {left, -arc}, {right, wrapped(first - f.phi)}});
      }
    }
  }
  void solve_quarter(const Frame& f) {
    if (f.to_left.size >= 2.0 - touching_) {
      const double across = root(f.to_left.size * f.to_left.size - 4.0);
      const double way = 2.0 - across;
      const double between = quarter + std::abs(way);
      if (worth(between + f.turn(quarter))) {
        const double first = wrapped(f.to_left.angle + portable::atan2(across, -2.0));
        const double last = wrapped(f.phi - first - quarter);
        take(f, between, {{left, first}, {right, -quarter}, {straight, way}, {left, last}});
      }
    }
    const double way = 2.0 - f.to_right.size;
    const double between = quarter + std::abs(way);
    if (worth(between + f.turn(quarter))) {
      const double first = wrapped(f.to_right.angle + quarter);
      const double last = wrapped(first + quarter - f.phi);
      take(f, between, {{left, first}, {right, -quarter}, {straight, way}, {right, last}});
    }
  }
  void solve_two_quarters(const Frame& f) {
    if (f.to_right.size < 2.0 - touching_) return;
    const double across = root(f.to_right.size * f.to_right.size - 4.0);
    const double way = 4.0 - across;
    const double between = 2.0 * quarter + std::abs(way);
    if (!worth(between + f.turn())) return;
    const double first = wrapped(f.to_right.angle + portable::atan2(across, -2.0));
    const double last = wrapped(first - f.phi);
    take(f, between, {{left, first}, {right, -quarter}, {straight, way}, {left, -quarter}, {right, last}});
  }

  Taker& taker_;
  double off_;
  double same_;      // what is so little apart is one place: less than ends_at() allows
  double touching_;  // circles that touch up to rounding count as touching; ends_at() decides whether that is true
};

/// Some order of poses.
bool precedes(const Se2& a, const Se2& b) {
  if (a.x != b.x) return a.x < b.x;
  return a.y != b.y ? a.y < b.y : a.theta < b.theta;
}

SteeringWord driven_back(const SteeringWord& word) {
  SteeringWord back = word;
  std::reverse(back.pieces.begin(), back.pieces.begin() + back.count);
  for (SteeringPiece& piece : back.pieces) piece.length = -piece.length;
  return back;
}

SteeringWord shortest_onwards(const Se2& a, const Se2& b, double turning_radius) noexcept {
  const Se2 goal = seen_from(a, b, turning_radius);
  const double off = off_by_rounding(a, b, turning_radius);
  Shortest any(goal, off, false);
  Enumeration<Shortest>(goal, off, any);
  if (ends_at(any.best(), goal, off)) return any.best();
  Shortest sure(goal, off, true);
  Enumeration<Shortest>(goal, off, sure);
  return sure.best().count > 0 ? sure.best() : any.best();
}

}  // namespace

SteeringWord ReedsSheppCurve::shortest(const Se2& a, const Se2& b, double turning_radius) noexcept {
  if (a == b) return {};
  return precedes(b, a) ? driven_back(shortest_onwards(b, a, turning_radius)) : shortest_onwards(a, b, turning_radius);
}

void ReedsSheppCurve::for_each_word(const Se2& a, const Se2& b, double turning_radius, double longest,
                                    const std::function<void(const SteeringWord&)>& visit) {
  All all{longest, visit};
  Enumeration<All>(seen_from(a, b, turning_radius), off_by_rounding(a, b, turning_radius), all);
}

}  // namespace warren

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

enum class WordShape : std::uint8_t { lsl, lsr, lrl, lrlr_out, lrlr_in, lrsl, lrsr, lrslr };

/// How the goal was changed before the word was solved for it.
struct Change {
  bool mirrored = false;
  bool reversed = false;   // in time: forwards is backwards
  bool from_goal = false;  // the way back
};

struct Solved {
  double length = std::numeric_limits<double>::infinity();
  WordShape shape = WordShape::lsl;
  Change change;
  double first = 0.0;
  double middle = 0.0;
  double last = 0.0;
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

/// The pieces of the shape in the frame in which it was solved.
SteeringWord plain_word(const Solved& w) {
  using enum Steer;
  const auto word = [&w](std::initializer_list<SteeringPiece> behind_the_first) {
    SteeringWord all;
    all.add(left, w.first);
    for (const SteeringPiece& piece : behind_the_first) all.add(piece.steer, piece.length);
    return all;
  };
  switch (w.shape) {
    case WordShape::lsl:
      return word({{straight, w.middle}, {left, w.last}});
    case WordShape::lsr:
      return word({{straight, w.middle}, {right, w.last}});
    case WordShape::lrl:
      return word({{right, w.middle}, {left, w.last}});
    case WordShape::lrlr_out:
      return word({{right, w.middle}, {left, -w.middle}, {right, w.last}});
    case WordShape::lrlr_in:
      return word({{right, w.middle}, {left, w.middle}, {right, w.last}});
    case WordShape::lrsl:
      return word({{right, -quarter}, {straight, w.middle}, {left, w.last}});
    case WordShape::lrsr:
      return word({{right, -quarter}, {straight, w.middle}, {right, w.last}});
    case WordShape::lrslr:
      return word({{right, -quarter}, {straight, w.middle}, {left, -quarter}, {right, w.last}});
  }
  return {};
}

SteeringWord word_of(const Solved& w) {
  const SteeringWord plain = plain_word(w);
  SteeringWord word;
  for (std::size_t i = 0; i < plain.count; ++i) {
    SteeringPiece piece = plain.pieces[w.change.from_goal ? plain.count - 1 - i : i];
    if (w.change.mirrored) piece.steer = static_cast<Steer>(-as_whole<int>(piece.steer));
    word.add(piece.steer, w.change.reversed ? -piece.length : piece.length);
  }
  return word;
}

/// The shortest word, the first of those that are as long: among many that only turn, rounding would choose. That it
/// ends at the goal is asked where `sure`.
class Shortest {
 public:
  Shortest(const Se2& goal, double off, bool sure) : goal_(goal), off_(off), sure_(sure) {}
  /// Is it worth to go on with a word that has at least this length?
  bool worth(double at_least) const { return at_least < best_.length - (as_long + off_); }
  void take(const Solved& word) {
    if (worth(word.length) && (!sure_ || ends_at(word_of(word), goal_, off_))) best_ = word;
  }
  const Solved& best() const { return best_; }

 private:
  static constexpr double as_long = 1e-12;
  Se2 goal_;
  double off_;
  bool sure_;
  Solved best_;
};

/// All words up to a length.
class All {
 public:
  All(double longest, const std::function<void(const SteeringWord&)>& visit) : longest_(longest), visit_(visit) {}
  /// Bounds are sums of other roundings than lengths.
  bool worth(double at_least) const { return at_least <= longest_ + 1e-12 * longest_; }
  void take(const Solved& word) {
    if (word.length <= longest_) visit_(word_of(word));
  }

 private:
  double longest_;
  const std::function<void(const SteeringWord&)>& visit_;
};

/// Hands the words to a goal, as far as they are worth it, to the taker.
template <class Taker>
class Enumeration {
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
  void take(const Frame& frame, WordShape shape, double first, double middle, double last, double fixed) {
    taker_.take({fixed + std::abs(first) + std::abs(last), shape, frame.change, first, middle, last});
  }
  void solve_straight(const Frame& f) {
    // What rounding alone turns, or drives between two circles that are one, is no piece.
    if (f.to_left.size <= 1e-9 + 4.0 * off_) take(f, WordShape::lsl, 0.0, 0.0, f.phi, 0.0);
    if (worth(f.to_left.size + f.turn())) {
      const double first = f.to_left.angle;
      if (f.to_left.size * std::abs(first) <= 4.0 * off_)
        take(f, WordShape::lsl, 0.0, f.to_left.size, f.phi, f.to_left.size);
      take(f, WordShape::lsl, first, f.to_left.size, wrapped(f.phi - first), f.to_left.size);
    }
    if (f.to_right.size >= 2.0 - touching_) {
      const double straight = tangent(f.to_right.size);
      if (worth(straight + f.turn())) {
        const double first = wrapped(f.to_right.angle + portable::atan2(2.0, straight));
        take(f, WordShape::lsr, first, straight, wrapped(first - f.phi), straight);
      }
    }
  }
  void solve_arcs(const Frame& f) {
    if (f.to_left.size <= 4.0 + touching_) {
      const double arc = 2.0 * portable::asin(std::min(0.25 * f.to_left.size, 1.0));
      if (worth(std::max(arc, f.turn()))) {
        const double first = wrapped(f.to_left.angle - 0.5 * arc + std::numbers::pi);
        take(f, WordShape::lrl, first, -arc, wrapped(f.phi - first - arc), arc);
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
        take(f, WordShape::lrlr_out, first, arc, wrapped(first - 2.0 * arc - f.phi), 2.0 * arc);
      }
    }
    const double in_cosine = (20.0 - f.to_right.size * f.to_right.size) / 16.0;
    if (in_cosine >= -1.0 && in_cosine <= 1.0 + touching_) {
      const double arc = arc_of(in_cosine);
      if (worth(2.0 * arc + f.turn())) {
        const double first = wrapped(f.to_right.angle + quarter + portable::atan2(portable::sin(arc), 2.0 - in_cosine));
        take(f, WordShape::lrlr_in, first, -arc, wrapped(first - f.phi), 2.0 * arc);
      }
    }
  }
  void solve_quarter(const Frame& f) {
    if (f.to_left.size >= 2.0 - touching_) {
      const double across = root(f.to_left.size * f.to_left.size - 4.0);
      const double straight = 2.0 - across;
      if (worth(quarter + std::abs(straight) + f.turn(quarter))) {
        const double first = wrapped(f.to_left.angle + portable::atan2(across, -2.0));
        take(f, WordShape::lrsl, first, straight, wrapped(f.phi - first - quarter), quarter + std::abs(straight));
      }
    }
    const double straight = 2.0 - f.to_right.size;
    if (worth(quarter + std::abs(straight) + f.turn(quarter))) {
      const double first = wrapped(f.to_right.angle + quarter);
      take(f, WordShape::lrsr, first, straight, wrapped(first + quarter - f.phi), quarter + std::abs(straight));
    }
  }
  void solve_two_quarters(const Frame& f) {
    if (f.to_right.size < 2.0 - touching_) return;
    const double across = root(f.to_right.size * f.to_right.size - 4.0);
    const double straight = 4.0 - across;
    if (!worth(2.0 * quarter + std::abs(straight) + f.turn())) return;
    const double first = wrapped(f.to_right.angle + portable::atan2(across, -2.0));
    take(f, WordShape::lrslr, first, straight, wrapped(first - f.phi), 2.0 * quarter + std::abs(straight));
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
  const SteeringWord word = word_of(any.best());
  if (ends_at(word, goal, off)) return word;
  Shortest sure(goal, off, true);
  Enumeration<Shortest>(goal, off, sure);
  return std::isfinite(sure.best().length) ? word_of(sure.best()) : word;
}

}  // namespace

SteeringWord ReedsSheppCurve::shortest(const Se2& a, const Se2& b, double turning_radius) noexcept {
  if (a == b) return {};
  return precedes(b, a) ? driven_back(shortest_onwards(b, a, turning_radius)) : shortest_onwards(a, b, turning_radius);
}

void ReedsSheppCurve::for_each_word(const Se2& a, const Se2& b, double turning_radius, double longest,
                                    const std::function<void(const SteeringWord&)>& visit) {
  All all(longest, visit);
  Enumeration<All>(seen_from(a, b, turning_radius), off_by_rounding(a, b, turning_radius), all);
}

}  // namespace warren

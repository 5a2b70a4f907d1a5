// SPDX-License-Identifier: BSD-3-Clause
// A curve that a car drives: up to five pieces, each straight or an arc of the turning radius, forwards or backwards,
// or a turn on the spot, of which a radian counts as a turning radius of way.
// A SteeringWord is the recipe, in units of the turning radius; a SteeringCurve puts it between two poses, with the
// poses between the pieces computed once, so that a pose on the way costs one sine and one cosine. Which word is the
// shortest: worlds/poses/dubins_curve.cpp, worlds/poses/reeds_shepp_curve.cpp.
//
// How a differential drive goes from pose to pose: it turns on the spot towards the goal, or away from it to drive
// backwards, goes straight, and turns on the spot to the goal's heading. It takes the way that turns less, of equal
// ones that forwards. It drives no arcs: its `turning radius` only says how much a radian of turning counts.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/se2.hpp"

namespace warren {

enum class Steer : std::int8_t { right_on_spot = -2, right = -1, straight = 0, left = 1, left_on_spot = 2 };
constexpr bool is_on_spot(Steer steer) { return steer == Steer::left_on_spot || steer == Steer::right_on_spot; }
/// 1 of a turn to the left, -1 to the right.
constexpr double side_of(Steer steer) { return steer == Steer::straight ? 0.0 : steer > Steer::straight ? 1.0 : -1.0; }

/// One piece of constant steering.
struct SteeringPiece {
  Steer steer = Steer::straight;
  double length = 0.0;  ///< in turning radii: of a turn, its angle in radians; negative: backwards
};

/// Pieces in the order in which they are driven.
struct SteeringWord {
  static constexpr std::size_t most_pieces = 5;
  std::array<SteeringPiece, most_pieces> pieces{};
  std::uint8_t count = 0;
  double length = 0.0;  ///< sum of the pieces' lengths without their signs, in turning radii

  void add(Steer steer, double piece) {
    pieces[count++] = {steer, piece};
    length += std::abs(piece);
  }
  std::span<const SteeringPiece> used() const { return {pieces.data(), count}; }
  /// What the reference point goes, in turning radii.
  double driven() const {
    double way = length;
    for (const SteeringPiece& piece : used()) way -= is_on_spot(piece.steer) ? std::abs(piece.length) : 0.0;
    return way;
  }
};

/// The pose of b seen from a, positions in turning radii.
Se2 seen_from(const Se2& a, const Se2& b, double turning_radius) noexcept;

/// Where one piece leads to from a pose; everything in turning radii.
Se2 after_piece(const Se2& from, const SteeringPiece& piece) noexcept;

/// What rounded coordinates of a and b (and of poses cut from a curve between them) put seen_from(a, b) off by, at
/// most; in turning radii. Words must not tell goals apart that are so near: a car that misses by less would circle
/// anew.
double off_by_rounding(const Se2& a, const Se2& b, double turning_radius) noexcept;

/// Does the word, driven from the origin, end at `goal`, which is `off` (>= 0) by rounding?
bool ends_at(const SteeringWord& word, const Se2& goal, double off = 0.0) noexcept;

/// A word between two poses, in world units. Pieces of no length to speak of are left out.
class SteeringCurve {
 public:
  static constexpr double nothing = 1e-12;  ///< turning radii
  /// word: leads from a to b with this turning radius (> 0).
  SteeringCurve(const Se2& a, const Se2& b, const SteeringWord& word, double turning_radius) noexcept;

  double length() const { return length_; }
  double turning_radius() const { return radius_; }
  std::size_t piece_count() const { return count_; }
  const SteeringPiece& piece(std::size_t i) const { return pieces_[i]; }
  /// What the reference point goes, in world units.
  double driven() const;
  /// The pose where it has gone so far, 0 <= s <= driven().
  Se2 at_driven(double s) const noexcept;
  /// Of a piece, in world units, >= 0.
  double piece_length(std::size_t i) const { return radius_ * std::abs(pieces_[i].length); }
  /// The pose at which piece i begins; i = piece_count(): the end.
  const Se2& joint(std::size_t i) const { return joints_[i]; }
  /// The pose after the way s from the begin, 0 <= s <= length(); the ends are a and b themselves.
  Se2 at(double s) const noexcept;
  /// Of the reference point's way.
  Box box() const noexcept;

 private:
  std::array<SteeringPiece, SteeringWord::most_pieces> pieces_{};
  std::array<Se2, SteeringWord::most_pieces + 1> joints_{};
  std::size_t count_ = 0;
  double radius_;
  double length_ = 0.0;
};

/// How far any point of a body goes while its reference point goes 1 with this steering; on the spot, while it turns as
/// much as counts as 1. outline: around the reference point; of a disc, which looks the same however it is turned,
/// none.
double pace_of(Steer steer, std::span<const Vec2> outline, double turning_radius);

/// How far a body has gone along a curve, at most.
class CurveTravel {
 public:
  /// outline: as of pace_of(); of a disc maybe its middle.
  CurveTravel(const SteeringCurve& curve, std::span<const Vec2> outline) : count_(curve.piece_count()) {
    for (std::size_t i = 0; i < count_; ++i) {
      lengths_[i] = curve.piece_length(i);
      paces_[i] = pace_of(curve.piece(i).steer, outline, curve.turning_radius());
    }
  }
  /// After the way s from the begin.
  double operator()(double s) const {
    double travel = 0.0;
    for (std::size_t i = 0; i < count_ && s > 0.0; ++i) {
      travel += paces_[i] * std::min(s, lengths_[i]);
      s -= lengths_[i];
    }
    return travel;
  }

 private:
  std::array<double, SteeringWord::most_pieces> lengths_{};
  std::array<double, SteeringWord::most_pieces> paces_{};
  std::size_t count_;
};

/// Appends the poses at which the steering or the gear changes, and so many in longer arcs that none turns by more than
/// a quarter; the curve's begin is there already.
void append_joints(std::vector<Se2>& poses, const SteeringCurve& curve);

/// The turn of the leg that ends at each pose, anticlockwise, at most a half turn; 0 at the first, and of a straight.
std::vector<double> leg_turns(std::span<const Se2> poses);

/// The length of the leg that ends at each pose, straight or an arc that turns so; 0 at the first.
std::vector<double> leg_lengths(std::span<const Se2> poses, std::span<const double> turns);

/// The pose at the share t of the leg from a to b, which is straight or an arc.
Se2 pose_on_leg(const Se2& a, const Se2& b, double t);

/// The shortest way of a car that only drives forwards.
struct DubinsCurve {
  /// A way from a to b is none from b to a.
  static constexpr bool one_way = true;
  static constexpr bool turns_on_spot = false;

  /// The shortest word from a to b; turning_radius > 0.
  static SteeringWord shortest(const Se2& a, const Se2& b, double turning_radius) noexcept;
};

/// The shortest way of a car that may also back up.
struct ReedsSheppCurve {
  /// The way from b to a is the way from a to b, driven back. That has to be seen to: between near poses whose headings
  /// differ more, many words are as long as the turn. Of such the first that is tried is taken, anywhere.
  static constexpr bool one_way = false;
  static constexpr bool turns_on_spot = false;

  /// The shortest word from a to b; turning_radius > 0.
  static SteeringWord shortest(const Se2& a, const Se2& b, double turning_radius) noexcept;
  /// Every word towards b of at most this length, in turning radii, in no order; some of them twice. What is visited
  /// leads to b only if ends_at(word, seen_from(a, b, turning_radius), off_by_rounding(a, b, turning_radius)).
  static void for_each_word(const Se2& a, const Se2& b, double turning_radius, double longest,
                            const std::function<void(const SteeringWord&)>& visit);
};

struct DifferentialCurve {
  static constexpr bool one_way = false;
  static constexpr bool turns_on_spot = true;
  /// From a to b; turning_radius > 0. Of the word's length a radian of turning on the spot is one.
  static SteeringWord shortest(const Se2& a, const Se2& b, double turning_radius) noexcept;
};

}  // namespace warren

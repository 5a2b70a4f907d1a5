// SPDX-License-Identifier: BSD-3-Clause
// Oracles for steering curves that know no closed form: a numeric integrator, and all words of the theorems solved by
// Newton's method from many starts.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "core/base/rng.hpp"
#include "core/plane/se2.hpp"
#include "worlds/poses/steering_curve.hpp"

namespace warren::steering_words {

/// Where the word leads from a, by Gauss-Legendre quadrature of the heading's cosine and sine.
inline Se2 integrated(const Se2& a, const SteeringWord& word, double turning_radius) {
  constexpr double nodes[] = {-0.906179845938664, -0.5384693101056831, 0.0, 0.5384693101056831, 0.906179845938664};
  constexpr double weights[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                                0.2369268850561891};
  Se2 pose = a;
  for (const SteeringPiece& piece : word.used()) {
    const int steps = 1 + static_cast<int>(std::abs(piece.length));
    const double step = piece.length / steps;
    const double rate = static_cast<double>(piece.steer);
    for (int i = 0; i < steps; ++i) {
      for (int k = 0; k < 5; ++k) {
        const double theta = pose.theta + rate * step * 0.5 * (1.0 + nodes[k]);
        pose.x += turning_radius * step * 0.5 * weights[k] * std::cos(theta);
        pose.y += turning_radius * step * 0.5 * weights[k] * std::sin(theta);
      }
      pose.theta += rate * step;
    }
  }
  return pose;
}

/// A word with three unknowns: piece i has the length fixed[i] + sum of factor[i][k] * unknown k.
struct Pattern {
  std::vector<Steer> steers;
  std::vector<std::array<double, 3>> factors;
  std::vector<double> fixed;

  SteeringWord word(const std::array<double, 3>& unknowns) const {
    SteeringWord word;
    for (std::size_t i = 0; i < steers.size(); ++i) {
      double length = fixed[i];
      for (std::size_t k = 0; k < 3; ++k) length += factors[i][k] * unknowns[k];
      word.add(steers[i], length);
    }
    return word;
  }
};

inline constexpr std::array<double, 3> none{0, 0, 0};
inline constexpr std::array<double, 3> first{1, 0, 0};
inline constexpr std::array<double, 3> middle{0, 1, 0};
inline constexpr std::array<double, 3> minus_middle{0, -1, 0};
inline constexpr std::array<double, 3> last{0, 0, 1};

inline std::vector<Pattern> dubins_patterns() {
  std::vector<Pattern> patterns;
  for (const Steer a : {Steer::left, Steer::right}) {
    const Steer b = a == Steer::left ? Steer::right : Steer::left;
    patterns.push_back({{a, Steer::straight, a}, {first, middle, last}, {0, 0, 0}});
    patterns.push_back({{a, Steer::straight, b}, {first, middle, last}, {0, 0, 0}});
    patterns.push_back({{a, b, a}, {first, middle, last}, {0, 0, 0}});
  }
  return patterns;
}

/// The words of Reeds and Shepp's theorem, gears free.
inline std::vector<Pattern> reeds_shepp_patterns() {
  constexpr double q = 0.5 * std::numbers::pi;
  constexpr Steer s = Steer::straight;
  std::vector<Pattern> patterns = dubins_patterns();
  for (const Steer a : {Steer::left, Steer::right}) {
    const Steer b = a == Steer::left ? Steer::right : Steer::left;
    patterns.push_back({{a, b, a, b}, {first, middle, minus_middle, last}, {0, 0, 0, 0}});
    patterns.push_back({{a, b, a, b}, {first, middle, middle, last}, {0, 0, 0, 0}});
    for (const double quarter : {q, -q}) {
      for (const Steer c : {a, b}) {
        patterns.push_back({{a, b, s, c}, {first, none, middle, last}, {0, quarter, 0, 0}});
        patterns.push_back({{c, s, b, a}, {first, middle, none, last}, {0, 0, quarter, 0}});
      }
      patterns.push_back({{a, b, s, a, b}, {first, none, middle, none, last}, {0, quarter, 0, quarter, 0}});
      patterns.push_back({{a, b, s, a, b}, {first, none, middle, none, last}, {0, quarter, 0, -quarter, 0}});
    }
  }
  return patterns;
}

inline std::array<double, 3> miss(const SteeringWord& word, const Se2& goal) {
  Se2 pose;
  for (const SteeringPiece& piece : word.used()) pose = after_piece(pose, piece);
  return {pose.x - goal.x, pose.y - goal.y, std::remainder(pose.theta - goal.theta, 2.0 * std::numbers::pi)};
}

inline double size(const std::array<double, 3>& v) {
  return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])});
}

/// Newton's method with a numeric Jacobian, solved by Cramer's rule; false where it doesn't converge.
inline bool solve(const Pattern& pattern, const Se2& goal, std::array<double, 3>& x) {
  for (int iteration = 0; iteration < 25; ++iteration) {
    const std::array<double, 3> r = miss(pattern.word(x), goal);
    if (size(r) < 1e-12) return true;
    std::array<std::array<double, 3>, 3> j;
    for (std::size_t k = 0; k < 3; ++k) {
      constexpr double h = 1e-6;
      std::array<double, 3> up = x;
      std::array<double, 3> down = x;
      up[k] += h;
      down[k] -= h;
      const auto a = miss(pattern.word(up), goal);
      const auto b = miss(pattern.word(down), goal);
      for (std::size_t i = 0; i < 3; ++i) j[i][k] = std::remainder(a[i] - b[i], 2.0 * std::numbers::pi) / (2.0 * h);
    }
    const auto determinant = [](const std::array<std::array<double, 3>, 3>& m) {
      return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
             m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    };
    const double whole = determinant(j);
    if (std::abs(whole) < 1e-12) return false;
    for (std::size_t k = 0; k < 3; ++k) {
      auto part = j;
      for (std::size_t i = 0; i < 3; ++i) part[i][k] = r[i];
      x[k] -= std::clamp(determinant(part) / whole, -1.0, 1.0);
    }
  }
  return size(miss(pattern.word(x), goal)) < 1e-10;
}

/// The shortest word of the patterns that Newton's method finds; forwards: all pieces >= 0, arcs within a full turn;
/// else arcs within a half turn either way.
inline double shortest(const std::vector<Pattern>& patterns, const Se2& goal, bool forwards, std::uint64_t seed,
                       std::uint64_t starts) {
  double best = std::numeric_limits<double>::infinity();
  constexpr double pi = std::numbers::pi;
  for (std::size_t p = 0; p < patterns.size(); ++p) {
    for (std::uint64_t start = 0; start < starts; ++start) {
      std::array<double, 3> x;
      for (std::size_t k = 0; k < 3; ++k) {
        const double u = uniform(seed, 1000 * p + start, k);
        x[k] = forwards ? 2.0 * pi * u : 2.0 * pi * u - pi;
      }
      if (!solve(patterns[p], goal, x)) continue;
      SteeringWord word = patterns[p].word(x);
      double length = 0.0;
      bool proper = true;
      for (const SteeringPiece& piece : word.used()) {
        double way = piece.length;
        if (piece.steer != Steer::straight) {
          way = std::remainder(way, 2.0 * pi);
          if (forwards && way < -1e-9) way += 2.0 * pi;
        }
        proper = proper && (!forwards || way > -1e-9);
        length += std::abs(way);
      }
      // Paired arcs were turned as one; an arc wrapped alone would break the word, but not lengthen it.
      if (proper) best = std::min(best, length);
    }
  }
  return best;
}

}  // namespace warren::steering_words

// SPDX-License-Identifier: BSD-3-Clause
// The nearest free state around one that is not, whatever a state's numbers mean: spheres of directions whose radius
// grows by a quarter, the first of them that has a free state, then bisection towards the middle and directions beside
// the best one, nearer and nearer. Finds what is wider than the directions are apart; the distance is right to a
// thousandth where the free room has a smooth rim. Some thousand calls of is_free.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/base/rng.hpp"

namespace warren {

template <std::size_t n>
using Numbers = std::array<double, n>;

/// Unit vectors: both ways along each axis first, then `more` of even density, the same ones each time.
template <std::size_t n>
std::vector<Numbers<n>> directions_around(std::size_t more) {
  std::vector<Numbers<n>> directions;
  for (std::size_t k = 0; k < 2 * n; ++k) {
    directions.emplace_back();
    directions.back()[k / 2] = k % 2 == 0 ? 1.0 : -1.0;
  }
  for (std::uint64_t i = 0; directions.size() < 2 * n + more; ++i) {
    Numbers<n> d{};
    double square = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      d[k] = 2.0 * uniform(1, i, k) - 1.0;
      square += d[k] * d[k];
    }
    if (square > 1.0 || square < 1e-4) continue;
    for (double& x : d) x /= std::sqrt(square);
    directions.push_back(d);
  }
  return directions;
}

template <std::size_t n>
struct FreeDirection {
  Numbers<n> direction;   ///< a unit vector
  double distance = 0.0;  ///< along it, from the middle
};

struct FreeSearchRange {
  double first;         ///< radius of the first sphere, > 0
  double farthest;      ///< of the last
  double enough = 0.0;  ///< a state so near the middle needs no better one
};

/// The state that is so far from the middle in a direction.
template <std::size_t n>
Numbers<n> state_at(const Numbers<n>& middle, const Numbers<n>& direction, double distance) {
  Numbers<n> state = middle;
  for (std::size_t k = 0; k < n; ++k) state[k] += distance * direction[k];
  return state;
}

/// is_free(state): of Numbers<n>. directions: as directions_around() gives them. Nothing: there is none, or it is
/// narrower than directions are apart.
template <std::size_t n, class IsFree>
std::optional<FreeDirection<n>> nearest_free(const Numbers<n>& middle, std::span<const Numbers<n>> directions,
                                             const FreeSearchRange& range, const IsFree& is_free) {
  FreeDirection<n> best;
  const auto is_free_at = [&](const Numbers<n>& direction, double distance) {
    return is_free(state_at(middle, direction, distance));
  };
  // As near as it goes along a direction that is free at the best distance.
  const auto approach = [&](const Numbers<n>& direction, double blocked) {
    for (int i = 0; i < 10; ++i) {
      const double between = 0.5 * (blocked + best.distance);
      (is_free_at(direction, between) ? best.distance : blocked) = between;
    }
    best.direction = direction;
  };
  constexpr double growth = 1.25;
  double before = 0.0;
  bool found = false;
  for (double radius = range.first; !found && radius <= range.farthest; radius *= growth) {
    best.distance = radius;
    for (const Numbers<n>& direction : directions) {
      if (is_free_at(direction, best.distance)) {
        approach(direction, before);
        found = true;
      }
      if (found && best.distance <= range.enough) return best;
    }
    before = radius;
  }
  if (!found) return std::nullopt;
  constexpr double gain = 1e-4;
  for (double aside = 0.2; aside > 0.002; aside *= 0.5) {
    for (const Numbers<n>& side : directions.first(2 * n)) {
      Numbers<n> direction = best.direction;
      double square = 0.0;
      for (std::size_t k = 0; k < n; ++k) {
        direction[k] += aside * side[k];
        square += direction[k] * direction[k];
      }
      for (double& x : direction) x /= std::sqrt(square);
      if (!is_free_at(direction, (1.0 - gain) * best.distance)) continue;
      best.distance *= 1.0 - gain;
      approach(direction, 0.9 * best.distance);
    }
  }
  return best;
}

/// x to a multiple of a power of ten between a hundredth and a tenth of `size` > 0.
inline double in_few_digits(double x, double size) {
  double unit = 1.0;
  while (unit > 0.1 * size) unit /= 10.0;
  while (unit * 100.0 <= size) unit *= 10.0;
  const double rounded = unit < 1.0 ? std::round(x / unit) / std::round(1.0 / unit) : std::round(x / unit) * unit;
  return rounded + 0.0;  // no -0
}

/// Of the body's size: room that a state which is told has to spare.
inline constexpr double least_spare = 1e-5;

/// The nearest state that has room to spare, to as many digits as leave it half of that: up to a tenth farther where
/// that takes fewer, a tenth of its distance from the middle or of ten times what is near enough. is_free(state,
/// spare): with so much more room than it must have. Little room is sought only where there is nowhere more; size: what
/// the body's is, > 0.
template <std::size_t n, class IsFree>
std::optional<Numbers<n>> nearest_free_in_few_digits(const Numbers<n>& middle, std::span<const Numbers<n>> directions,
                                                     const FreeSearchRange& range, double size, const IsFree& is_free) {
  for (const double spare : {1e-2 * size, least_spare * size}) {
    const auto is_roomy = [&](const Numbers<n>& state) { return is_free(state, spare); };
    const auto found = nearest_free(middle, directions, range, is_roomy);
    if (!found) continue;
    // Where a state is sought far from the middle that is there, what is near enough needs few digits, too.
    double scale = std::max(found->distance, 10.0 * range.enough);
    for (; scale > 0.1 * spare; scale *= 0.1) {
      for (double more = 0.0; more < 0.1 * scale; more += 0.02 * scale) {
        Numbers<n> state = state_at(middle, found->direction, found->distance + more);
        for (double& x : state) x = in_few_digits(x, scale);
        if (is_free(state, 0.5 * spare)) return state;
      }
    }
  }
  return std::nullopt;
}

}  // namespace warren

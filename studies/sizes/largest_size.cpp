// SPDX-License-Identifier: BSD-3-Clause
#include "studies/sizes/largest_size.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace warren::studies {
namespace {

/// A side that fits and a larger one that doesn't; 0: not found.
struct Bracket {
  std::uint32_t fits = 0;
  std::uint32_t too_large = 0;
};

std::uint32_t doubled(std::uint32_t side, std::uint32_t most) {
  const double next = std::ceil(side * std::numbers::sqrt2);
  return next < most ? static_cast<std::uint32_t>(next) : most;
}

Bracket shrink(const SizeSearch& search, const std::function<bool(std::uint32_t)>& fits) {
  Bracket bracket{0, search.start};
  while (bracket.too_large > search.least) {
    const auto side = std::max(search.least, static_cast<std::uint32_t>(bracket.too_large / std::numbers::sqrt2));
    if (fits(side)) {
      bracket.fits = side;
      break;
    }
    bracket.too_large = side;
  }
  return bracket;
}

Bracket grow(const SizeSearch& search, const std::function<bool(std::uint32_t)>& fits) {
  Bracket bracket{search.start, 0};
  while (bracket.fits < search.most) {
    const std::uint32_t side = doubled(bracket.fits, search.most);
    if (!fits(side)) {
      bracket.too_large = side;
      break;
    }
    bracket.fits = side;
  }
  return bracket;
}

}  // namespace

std::uint32_t largest_side(const SizeSearch& search, const std::function<bool(std::uint32_t)>& fits) {
  Bracket bracket = fits(search.start) ? grow(search, fits) : shrink(search, fits);
  if (bracket.fits == 0 || bracket.too_large == 0) return bracket.fits;
  while (bracket.too_large - bracket.fits > std::max(1.0, search.step * bracket.fits)) {
    const std::uint32_t side = bracket.fits + (bracket.too_large - bracket.fits) / 2;
    (fits(side) ? bracket.fits : bracket.too_large) = side;
  }
  return bracket.fits;
}

std::uint32_t side_below(const SizeSearch& search, std::uint32_t side) {
  const double next = std::min(std::floor(side / (1.0 + search.step)), side - 1.0);
  return next < search.least ? 0 : static_cast<std::uint32_t>(next);
}

}  // namespace warren::studies

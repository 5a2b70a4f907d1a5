// SPDX-License-Identifier: BSD-3-Clause
// Row pass: column u contributes the curve curve(|x - u|) + height(u). The curves are translates of one convex
// function, so two of them change order once; `last_of_left` is where, in closed form.
#include "spatial/maps/distance_field.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

using Int = std::int64_t;

/// Largest integer at or below a / b, b > 0.
constexpr Int floor_div(Int a, Int b) { return a / b - (a % b < 0 ? 1 : 0); }

struct Centres {
  static constexpr Int curve(Int d) { return d * d; }
  /// The last x where the curve of i + lift is at or above that of u > i: (x - i)^2 - (x - u)^2 <= lift.
  static constexpr Int last_of_left(Int i, Int u, Int lift) { return floor_div(u * u - i * i + lift, 2 * (u - i)); }
};

struct Squares {
  static constexpr Int curve(Int d) {
    const Int half = std::max<Int>(2 * d - 1, 0);
    return half * half;
  }
  /// curve(x - i) - curve(x - u) grows with x: one straight piece left of i, one between, one right of u.
  static constexpr Int last_of_left(Int i, Int u, Int lift) {
    const Int w = u - i;
    const Int at_ends = (2 * w - 1) * (2 * w - 1);
    if (lift >= at_ends) return std::max(u, floor_div(floor_div(lift, 4 * w) + i + u + 1, 2));
    if (lift < -at_ends) return std::min(i - 1, floor_div(i + u - 1 + floor_div(lift, 4 * w), 2));
    if (w == 1) return i;
    return std::clamp(floor_div(i + u + floor_div(lift, 4 * (w - 1)), 2), i, u - 1);
  }
};

constexpr std::uint32_t nothing = DistanceField::far;
constexpr std::uint32_t farthest = 65'535;  // its square is the last that fits

/// For columns first .. last - 1: cells between a cell and the nearest blocked one of its column.
void column_pass(const Bitmap& blocked, bool outside_blocked, Range columns, std::uint32_t* distances) {
  const std::uint32_t width = blocked.width();
  const std::uint32_t height = blocked.height();
  std::vector<std::uint32_t> above(columns.size(), outside_blocked ? 0 : nothing);
  const auto step = [](std::uint32_t d) { return d == nothing ? nothing : d + 1; };
  for (std::uint32_t y = 0; y < height; ++y) {
    std::uint32_t* row = distances + std::size_t{y} * width + columns.first;
    const auto words = blocked.row(y);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const std::size_t x = columns.first + i;
      above[i] = (words[x / 64] >> x % 64 & 1U) != 0 ? 0 : step(above[i]);
      row[i] = above[i];
    }
  }
  std::fill(above.begin(), above.end(), outside_blocked ? 0 : nothing);
  for (std::uint32_t y = height; y-- > 0;) {
    std::uint32_t* row = distances + std::size_t{y} * width + columns.first;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      above[i] = std::min(row[i], step(above[i]));
      row[i] = above[i];
    }
  }
}

/// Scratch of one thread's rows.
struct Envelope {
  struct Piece {
    Int site;
    Int height;
    Int first;  // the first x where this site is nearest
  };
  std::vector<Piece> pieces;
};

/// Adds a site right of all others.
template <class Kind>
void add_site(Int site, Int height, Int width, Envelope& envelope) {
  auto& pieces = envelope.pieces;
  const auto at = [&](const Envelope::Piece& p, Int x) { return Kind::curve(std::abs(x - p.site)) + p.height; };
  while (!pieces.empty() &&
         at(pieces.back(), pieces.back().first) > Kind::curve(std::abs(pieces.back().first - site)) + height) {
    pieces.pop_back();
  }
  if (pieces.empty()) {
    pieces.push_back({site, height, 0});
    return;
  }
  const Int first = Kind::last_of_left(pieces.back().site, site, height - pieces.back().height) + 1;
  if (first < width) pieces.push_back({site, height, first});
}

/// Replaces a row's column distances by squared distances.
template <class Kind>
void row_pass(std::uint32_t* row, Int width, bool outside_blocked, Envelope& envelope) {
  auto& pieces = envelope.pieces;
  pieces.clear();
  if (outside_blocked) add_site<Kind>(-1, 0, width, envelope);
  for (Int x = 0; x < width; ++x) {
    if (row[x] <= farthest) add_site<Kind>(x, Kind::curve(row[x]), width, envelope);
  }
  if (outside_blocked) add_site<Kind>(width, 0, width, envelope);
  if (pieces.empty()) return std::fill(row, row + width, nothing);
  Int end = width;
  for (std::size_t p = pieces.size(); p-- > 0;) {
    const auto [site, height, first] = pieces[p];
    for (Int x = first; x < end; ++x) {
      row[x] = as_whole<std::uint32_t>(std::min<Int>(Kind::curve(std::abs(x - site)) + height, nothing));
    }
    end = first;
  }
}

}  // namespace

DistanceField::DistanceField(const Bitmap& blocked, CellDistance kind, bool outside_blocked, const Execution& execution)
    : width_(blocked.width()), height_(blocked.height()), kind_(kind) {
  constexpr std::uint32_t width_end = std::uint32_t{1} << 30;
  if (width_ >= width_end) throw InputError("map", "is too wide for a distance transform", std::to_string(width_));
  execution.reserve(blocked.size() * sizeof(std::uint32_t));
  squared_.resize(blocked.size());
  constexpr std::size_t columns = 512;
  for_chunks(width_, columns, execution, [&](Range r) { column_pass(blocked, outside_blocked, r, squared_.data()); });
  constexpr std::size_t rows = 32;
  for_chunks(height_, rows, execution, [&](Range r) {
    Envelope envelope;
    for (std::size_t y = r.first; y < r.last; ++y) {
      std::uint32_t* row = squared_.data() + y * width_;
      kind == CellDistance::centres ? row_pass<Centres>(row, width_, outside_blocked, envelope)
                                    : row_pass<Squares>(row, width_, outside_blocked, envelope);
    }
  });
}

double DistanceField::distance(std::uint32_t x, std::uint32_t y) const {
  return std::sqrt(squared(x, y)) / (kind_ == CellDistance::squares ? 2.0 : 1.0);
}

Bitmap blocked_for_disc(const Bitmap& blocked, double radius, const Execution& execution) {
  if (!(radius > 0.0)) return blocked;
  return blocked_for_disc(blocked, DistanceField(blocked, CellDistance::squares, true, execution), radius, execution);
}

Bitmap blocked_for_disc(const Bitmap& blocked, const DistanceField& field, double radius, const Execution& execution) {
  const double least = 4.0 * radius * radius;
  Bitmap result = blocked;
  constexpr std::size_t rows = 64;
  for_chunks(blocked.height(), rows, execution, [&](Range r) {
    for (auto y = as_whole<std::uint32_t>(r.first); y < r.last; ++y) {
      for (std::uint32_t x = 0; x < blocked.width(); ++x) {
        if (field.squared(x, y) < least) result.set(x, y);
      }
    }
  });
  return result;
}

}  // namespace warren

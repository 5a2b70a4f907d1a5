// SPDX-License-Identifier: BSD-3-Clause
// Row pass: column u contributes the curve curve(|x - u|) + height(u). The curves are translates of one convex
// function, so two of them change order once; `last_of_left` is where, in closed form.
#include "spatial/maps/distance_field.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "core/base/whole.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

/// Int: signed, holds the sum of the curves of a map's width and height. Largest integer at or below a / b, b > 0.
template <class Int>
constexpr Int floor_div(Int a, Int b) {
  return a / b - (a % b < 0 ? 1 : 0);
}

struct Centres {
  template <class Int>
  static constexpr Int curve(Int d) {
    return d * d;
  }
  /// The last x where the curve of i + lift is at or above that of u > i: (x - i)^2 - (x - u)^2 <= lift.
  template <class Int>
  static constexpr Int last_of_left(Int i, Int u, Int lift) {
    const Int w = u - i;
    return u + (w == 1 ? (lift - 1) >> 1 : floor_div<Int>(lift - w * w, 2 * w));
  }
};

struct Squares {
  template <class Int>
  static constexpr Int curve(Int d) {
    const Int half = std::max<Int>(2 * d - 1, 0);
    return half * half;
  }
  /// curve(x - i) - curve(x - u) grows with x: one straight piece left of i, one between, one right of u.
  template <class Int>
  static constexpr Int last_of_left(Int i, Int u, Int lift) {
    const Int w = u - i;
    const Int at_ends = (2 * w - 1) * (2 * w - 1);
    // Most often the columns are neighbours: no division.
    if (lift >= at_ends) return std::max(u, ((w == 1 ? lift >> 2 : floor_div<Int>(lift, 4 * w)) + i + u + 1) >> 1);
    if (lift < -at_ends) return std::min(i - 1, (i + u - 1 + (w == 1 ? lift >> 2 : floor_div<Int>(lift, 4 * w))) >> 1);
    if (w == 1) return i;
    return std::clamp((i + u + floor_div<Int>(lift, 4 * (w - 1))) >> 1, i, u - 1);
  }
};

constexpr std::uint32_t nothing = DistanceField::far;
constexpr std::uint32_t farthest = 65'535;  // its square is the last that fits

/// For columns first .. last - 1, first being a multiple of 64: cells between a cell and the nearest blocked one of its
/// column.
void column_pass(const Bitmap& blocked, bool outside_blocked, Range columns, std::uint32_t* distances,
                 const Execution& execution) {
  const std::uint32_t width = blocked.width();
  const std::uint32_t height = blocked.height();
  std::vector<std::uint32_t> above(columns.size(), outside_blocked ? 0 : nothing);
  const auto step = [](std::uint32_t d) { return d + (d == nothing ? 0 : 1); };
  for (std::uint32_t y = 0; y < height; ++y) {
    execution.poll(y);
    std::uint32_t* row = distances + std::size_t{y} * width + columns.first;
    for (std::uint32_t& d : above) d = step(d);
    const auto words = blocked.row(y).subspan(columns.first / Bitmap::word_bits);
    for (std::size_t first = 0; first < columns.size(); first += Bitmap::word_bits) {
      for (std::uint64_t rest = words[first / Bitmap::word_bits]; rest != 0; rest &= rest - 1) {
        above[first + as_whole<std::size_t>(std::countr_zero(rest))] = 0;
      }
    }
    std::copy(above.begin(), above.end(), row);
  }
  std::fill(above.begin(), above.end(), outside_blocked ? 0 : nothing);
  for (std::uint32_t y = height; y-- > 0;) {
    execution.poll(y);
    std::uint32_t* row = distances + std::size_t{y} * width + columns.first;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      above[i] = std::min(row[i], step(above[i]));
      row[i] = above[i];
    }
  }
}

/// Replaces the rows' column distances by squared distances: along the lower envelope of a row's curves.
template <class Kind, class Int>
void row_passes(Range rows, std::uint32_t columns, bool outside_blocked, std::uint32_t* distances,
                const Execution& execution) {
  struct Piece {
    Int site;
    Int height;
    Int first;  // the first x where this site is nearest
  };
  const auto width = as_whole<Int>(columns);
  std::vector<Piece> pieces(columns + std::size_t{2});
  Piece* const begin = pieces.data();
  // With a site right of all others; the new end of the pieces.
  const auto added = [begin, width](Int site, Int height, Piece* end) {
    const auto at = [](const Piece& p, Int x) { return Kind::curve(std::abs(x - p.site)) + p.height; };
    while (end != begin && at(end[-1], end[-1].first) > Kind::curve(std::abs(end[-1].first - site)) + height) --end;
    const Int first = end == begin ? 0 : Kind::last_of_left(end[-1].site, site, height - end[-1].height) + 1;
    if (first < width) *end++ = {site, height, first};
    return end;
  };
  for (std::size_t y = rows.first; y < rows.last; ++y) {
    if (columns >= 1U << 14U) execution.check();  // else once a chunk is often enough
    std::uint32_t* const row = distances + y * columns;
    Piece* end = begin;
    if (outside_blocked) end = added(-1, 0, end);
    for (Int x = 0; x < width; ++x) {
      if (row[x] <= farthest) end = added(x, Kind::curve(as_whole<Int>(row[x])), end);
    }
    if (outside_blocked) end = added(width, 0, end);
    if (end == begin) std::fill(row, row + width, nothing);
    Int last = width;
    while (end != begin) {
      const auto [site, height, first] = *--end;
      for (Int x = first; x < last; ++x) {
        const std::int64_t squared = Kind::curve(std::abs(x - site)) + height;
        row[x] = as_whole<std::uint32_t>(std::min<std::int64_t>(squared, nothing));
      }
      last = first;
    }
  }
}

struct CellBox {
  Cell begin;
  Cell end;
};

CellBox grown(const CellBox& box, std::uint32_t by, const CellBox& all) {
  return {{box.begin.x - std::min(by, box.begin.x), box.begin.y - std::min(by, box.begin.y)},
          {std::min(all.end.x, box.end.x + by), std::min(all.end.y, box.end.y + by)}};
}

}  // namespace

DistanceField::DistanceField(const Bitmap& blocked, CellDistance kind, bool outside_blocked, const Execution& execution)
    : width_(blocked.width()), height_(blocked.height()), kind_(kind), outside_blocked_(outside_blocked) {
  constexpr std::uint32_t width_end = std::uint32_t{1} << 30;
  if (width_ >= width_end) throw InputError("map", "is too wide for a distance transform", std::to_string(width_));
  constexpr std::size_t piece = 3 * sizeof(std::int64_t);  // of a row's envelope
  execution.reserve(blocked.size() * sizeof(std::uint32_t) +
                    std::size_t{thread_count(execution.threads)} * piece * width_);
  squared_.resize(blocked.size());
  constexpr std::size_t columns = 512;
  for_chunks(width_, columns, execution,
             [&](Range r) { column_pass(blocked, outside_blocked, r, squared_.data(), execution); });
  constexpr std::size_t rows = 32;
  constexpr std::uint32_t narrow = 1 << 14;  // the sum of two curves is below 2^31
  const bool is_narrow = std::max(width_, height_) < narrow;
  const auto pass = kind == CellDistance::centres
                        ? (is_narrow ? row_passes<Centres, std::int32_t> : row_passes<Centres, std::int64_t>)
                        : (is_narrow ? row_passes<Squares, std::int32_t> : row_passes<Squares, std::int64_t>);
  for_chunks(height_, rows, execution, [&](Range r) { pass(r, width_, outside_blocked, squared_.data(), execution); });
}

std::uint32_t DistanceField::cut_off_squared() const {
  const double most = (kind_ == CellDistance::squares ? 2.0 : 1.0) * kept_cells_;
  return bounded_whole<std::uint32_t>(std::ceil(most * most), 0.0, far);
}

void DistanceField::cut_off(double cells, const Execution& execution) {
  kept_cells_ = cells;
  const std::uint32_t most = cut_off_squared();
  for (std::uint32_t y = 0; y < height_; ++y) {
    if (y % 16 == 0) execution.check();
    const auto row = std::span(squared_).subspan(std::size_t{y} * width_, width_);
    for (std::uint32_t& squared : row) squared = std::min(squared, most);
  }
}

/// Whatever is nearest to a cell that feels the change, and not farther than what is kept, is twice that near to it.
void DistanceField::renew(const Bitmap& blocked, Cell low, Cell high, const Execution& execution) {
  const CellBox all{{0, 0}, {width_, height_}};
  const auto around = bounded_whole<std::uint32_t>(std::ceil(kept_cells_) + 1.0, 0.0, 1e9);
  const CellBox felt = grown({low, {high.x + 1, high.y + 1}}, around, all);
  const CellBox seen = grown(felt, around, all);
  const std::uint32_t width = seen.end.x - seen.begin.x;
  const std::uint32_t height = seen.end.y - seen.begin.y;
  execution.reserve(Bitmap::bytes_for(width + 2, height + 2));
  Bitmap part(width + 2, height + 2);  // with a frame, of what lies outside of the map, too
  for (std::uint32_t y = 0; y < height + 2; ++y) {
    execution.check();
    for (std::uint32_t x = 0; x < width + 2; ++x) {
      const Cell c{seen.begin.x + x - 1, seen.begin.y + y - 1};  // wraps around where there is no such cell
      const bool is_outside = c.x >= width_ || c.y >= height_;
      if (is_outside ? outside_blocked_ : blocked.test(c.x, c.y)) part.set(x, y);
    }
  }
  const DistanceField field(part, kind_, false, execution);
  const std::uint32_t most = cut_off_squared();
  for (std::uint32_t y = felt.begin.y; y < felt.end.y; ++y) {
    execution.check();
    for (std::uint32_t x = felt.begin.x; x < felt.end.x; ++x) {
      const std::uint32_t squared = field.squared(x - seen.begin.x + 1, y - seen.begin.y + 1);
      squared_[std::size_t{y} * width_ + x] = std::min(squared, most);
    }
  }
}

double DistanceField::distance(std::uint32_t x, std::uint32_t y) const {
  return std::sqrt(squared(x, y)) / (kind_ == CellDistance::squares ? 2.0 : 1.0);
}

Bitmap blocked_for_disc(const Bitmap& blocked, double radius, const Execution& execution) {
  execution.reserve(blocked.bytes());
  if (!(radius > 0.0)) return blocked;
  return blocked_for_disc(blocked, DistanceField(blocked, CellDistance::squares, true, execution), radius, execution);
}

namespace {

/// The words of the box's cells: is the middle of a disc not to be there?
void mark_for_disc(Bitmap& wide, const Bitmap& blocked, const DistanceField& field, double radius, const CellBox& box) {
  const auto most = bounded_whole<std::uint32_t>(std::ceil(4.0 * radius * radius) - 1.0, 0.0, DistanceField::far);
  for (std::uint32_t y = box.begin.y; y < box.end.y; ++y) {
    for (std::uint32_t first = box.begin.x / Bitmap::word_bits * Bitmap::word_bits; first < box.end.x;
         first += Bitmap::word_bits) {
      const std::uint32_t count = std::min(Bitmap::word_bits, wide.width() - first);
      std::uint64_t near = 0;
      for (std::uint32_t i = 0; i < count; ++i) near |= std::uint64_t{field.squared(first + i, y) <= most} << i;
      wide.row(y)[first / Bitmap::word_bits] = blocked.row(y)[first / Bitmap::word_bits] | near;
    }
  }
}

}  // namespace

Bitmap blocked_for_disc(const Bitmap& blocked, const DistanceField& field, double radius, const Execution& execution) {
  execution.reserve(blocked.bytes());
  Bitmap wide(blocked.width(), blocked.height(), false, [&] { execution.check(); });
  constexpr std::size_t rows = 64;
  for_chunks(blocked.height(), rows, execution, [&](Range r) {
    mark_for_disc(wide, blocked, field, radius,
                  {{0, as_whole<std::uint32_t>(r.first)}, {blocked.width(), as_whole<std::uint32_t>(r.last)}});
  });
  return wide;
}

void renew_for_disc(Bitmap& wide, const Bitmap& blocked, const DistanceField& field, double radius, Cell low, Cell high,
                    const Execution& execution) {
  const auto around = bounded_whole<std::uint32_t>(std::ceil(radius) + 1.0, 0.0, 1e9);
  const CellBox all{{0, 0}, {blocked.width(), blocked.height()}};
  const CellBox felt = grown({low, {high.x + 1, high.y + 1}}, around, all);
  for (std::uint32_t y = felt.begin.y; y < felt.end.y; ++y) {
    execution.check();
    mark_for_disc(wide, blocked, field, radius, {{felt.begin.x, y}, {felt.end.x, y + 1}});
  }
}

}  // namespace warren

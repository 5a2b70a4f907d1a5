// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/maps/free_cells.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

constexpr std::array<std::uint8_t, 512> steps_of(StepRule rule) {
  std::array<std::uint8_t, 512> table{};
  for (unsigned around = 0; around < table.size(); ++around) {
    const auto is_free = [&](int dx, int dy) { return (around >> (3 * (dy + 1) + dx + 1) & 1U) != 0; };
    unsigned allowed = 0;
    for (unsigned s = 0; s < cell_steps.size(); ++s) {
      const auto [dx, dy] = cell_steps[s];
      bool may = is_free(dx, dy);
      if (is_diagonal(s) && rule == StepRule::four) may = false;
      if (is_diagonal(s) && rule == StepRule::eight) may = may && is_free(dx, 0) && is_free(0, dy);
      allowed |= may ? 1U << s : 0U;
    }
    table[around] = as_whole<std::uint8_t>(allowed);
  }
  return table;
}

constexpr std::uint32_t tile = 64;
constexpr double least_drop = 0.6;

bool is_ridge(const DistanceField& field, double least, std::uint32_t x, std::uint32_t y) {
  const double here = field.distance(x, y);
  if (!(here > 0.0 && here >= least)) return false;
  const auto drop_to = [&](std::int64_t col, std::int64_t row) {  // what lies outside of the map is blocked
    if (col < 0 || row < 0 || col >= field.width() || row >= field.height()) return here;
    return here - field.distance(as_whole<std::uint32_t>(col), as_whole<std::uint32_t>(row));
  };
  constexpr std::array<std::array<int, 2>, 4> axes{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
  return std::any_of(axes.begin(), axes.end(), [&](const std::array<int, 2>& axis) {
    const double way = axis[1] == 0 || axis[0] == 0 ? 1.0 : std::sqrt(2.0);
    const double before = drop_to(std::int64_t{x} - axis[0], std::int64_t{y} - axis[1]);
    const double after = drop_to(std::int64_t{x} + axis[0], std::int64_t{y} + axis[1]);
    return before >= 0.0 && after >= 0.0 && before + after >= least_drop * way;
  });
}

/// The ridge cells of a band of rows, tile by tile.
std::vector<std::uint32_t> places_of(const DistanceField& field, double least, std::uint32_t first_row) {
  std::vector<std::uint32_t> places;
  const std::uint32_t last_row = std::min(first_row + tile, field.height());
  for (std::uint32_t first = 0; first < field.width(); first += tile) {
    const std::uint32_t last = std::min(first + tile, field.width());
    for (std::uint32_t y = first_row; y < last_row; ++y) {
      for (std::uint32_t x = first; x < last; ++x) {
        if (is_ridge(field, least, x, y)) places.push_back(y * field.width() + x);
      }
    }
  }
  return places;
}

}  // namespace

FreeCells::FreeCells(const Bitmap& blocked)
    : width_(blocked.width()), height_(blocked.height()), stride_((blocked.width() / 64 + 1) * 64) {
  per_stride_ = 1.0 / stride_;
  const std::uint64_t end = (std::uint64_t{height_} + 2) * stride_ + std::uint64_t{2} * margin;
  if (end >= std::numeric_limits<VertexId>::max()) {
    throw InputError("map", "has too many cells for a grid search: 2^32 with the margin");
  }
  number_end_ = end;
  words_.assign(end / 64 + 2, 0);
  const std::size_t row_words = stride_ / 64;
  for (std::uint32_t y = 0; y < height_; ++y) {
    const auto from = blocked.row(y);
    std::uint64_t* to = words_.data() + (y + 1) * row_words + margin / 64;
    for (std::size_t w = 0; w < from.size(); ++w) to[w] = ~from[w];
    if (width_ % 64 != 0) to[from.size() - 1] &= (std::uint64_t{1} << width_ % 64) - 1;
  }
}

Bitmap transposed(const Bitmap& bitmap, const Execution& execution) {
  Bitmap result(bitmap.height(), bitmap.width());
  for (std::uint32_t y = 0; y < bitmap.height(); ++y) {
    if (y % 16 == 0) execution.check();
    bitmap.for_each_in_row(y, [&](std::uint32_t x) { result.set(y, x); });
  }
  return result;
}

const std::array<std::uint8_t, 512>& allowed_steps(StepRule rule) {
  static constexpr std::array<std::uint8_t, 512> tables[] = {steps_of(StepRule::four), steps_of(StepRule::eight),
                                                             steps_of(StepRule::eight_squeezing)};
  return tables[as_whole<std::size_t>(rule)];
}

CorridorCells::CorridorCells(const DistanceField& field, double least, const Execution& execution)
    : width_(field.width()), ridge_(field.width(), field.height()) {
  const auto bands = parts_of_chunks((field.height() + tile - 1) / tile, 1, execution, [&](Range r) {
    return places_of(field, least, as_whole<std::uint32_t>(r.first) * tile);
  });
  std::size_t count = 0;
  for (const auto& band : bands) count += band.size();
  execution.reserve(count * (sizeof(std::uint32_t) + sizeof(double)));
  places_.reserve(count);
  weight_sums_.reserve(count);
  double sum = 0.0;
  for (const auto& band : bands) {
    for (const std::uint32_t place : band) {
      sum += 1.0 / field.distance(place % width_, place / width_);
      places_.push_back(place);
      ridge_.set(place % width_, place / width_);
      weight_sums_.push_back(sum);
    }
  }
}

CorridorCells::Place CorridorCells::at(double share) const {
  const auto found = std::upper_bound(weight_sums_.begin(), weight_sums_.end(), share * weight_sums_.back());
  const auto i = std::min<std::size_t>(as_whole<std::size_t>(found - weight_sums_.begin()), places_.size() - 1);
  const double weight = i == 0 ? weight_sums_[0] : weight_sums_[i] - weight_sums_[i - 1];
  return {{places_[i] % width_, places_[i] / width_}, 1.0 / weight};
}

namespace {

/// The free cells of a row as words, with a blocked word before and after; rows outside of the map are blocked.
class FreeRow {
 public:
  FreeRow(const Bitmap& blocked, std::int64_t y) : words_((blocked.width() + 63) / 64 + 2, 0) {
    if (y < 0 || y >= blocked.height()) return;
    const auto row = blocked.row(as_whole<std::uint32_t>(y));
    for (std::size_t w = 0; w < row.size(); ++w) words_[w + 1] = ~row[w];
    if (blocked.width() % 64 != 0) words_[row.size()] &= (std::uint64_t{1} << blocked.width() % 64) - 1;
  }
  std::uint64_t here(std::size_t w) const { return words_[w + 1]; }
  /// Is the cell left, or right, of each free?
  std::uint64_t left(std::size_t w) const { return words_[w + 1] << 1 | words_[w] >> 63; }
  std::uint64_t right(std::size_t w) const { return words_[w + 1] >> 1 | words_[w + 2] << 63; }

 private:
  std::vector<std::uint64_t> words_;
};

constexpr std::size_t rows_a_chunk = 64;

}  // namespace

Bitmap cell_milestones(const Bitmap& blocked, const Execution& execution) {
  Bitmap kept(blocked.width(), blocked.height());
  execution.reserve(kept.bytes());
  constexpr std::uint64_t odd_columns = 0xAAAAAAAAAAAAAAAAU;
  for_each_index(blocked.height(), rows_a_chunk, execution, [&](std::size_t y) {
    const auto number = as_whole<std::int64_t>(y);
    const FreeRow below(blocked, number - 1);
    const FreeRow row(blocked, number);
    const FreeRow above(blocked, number + 1);
    const auto out = kept.row(as_whole<std::uint32_t>(y));
    for (std::size_t w = 0; w < out.size(); ++w) {
      const std::uint64_t sides = row.left(w) & row.right(w);
      const std::uint64_t ends = below.here(w) & above.here(w);
      const std::uint64_t level = sides & ~(below.here(w) | above.here(w));
      const std::uint64_t upright = ends & ~(row.left(w) | row.right(w));
      const std::uint64_t left_out = (level | upright) & (y % 2 == 0 ? odd_columns : ~odd_columns);
      out[w] = row.here(w) & ~left_out;
    }
  });
  return kept;
}

bool is_narrow(const Bitmap& blocked) {
  if (blocked.empty()) return false;
  std::uint64_t free = 0;
  std::uint64_t wide = 0;
  FreeRow below(blocked, -1);
  FreeRow row(blocked, 0);
  for (std::int64_t y = 0; y < blocked.height(); ++y) {
    FreeRow above(blocked, y + 1);
    for (std::size_t w = 0; w < blocked.row(0).size(); ++w) {
      const auto square = [&](const FreeRow& other) {
        return (row.left(w) & other.here(w) & other.left(w)) | (row.right(w) & other.here(w) & other.right(w));
      };
      free += as_whole<std::uint64_t>(std::popcount(row.here(w)));
      wide += as_whole<std::uint64_t>(std::popcount(row.here(w) & (square(below) | square(above))));
    }
    below = std::move(row);
    row = std::move(above);
  }
  return 2 * wide < free;
}

namespace {

// Row pass: column u contributes the curve curve(|x - u|) + height(u). The curves are translates of one convex
// function, so two of them change order once; `last_of_left` is where, in closed form.

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
void column_pass(const Bitmap& blocked, bool outside_blocked, Range columns, std::uint32_t* distances) {
  const std::uint32_t width = blocked.width();
  const std::uint32_t height = blocked.height();
  std::vector<std::uint32_t> above(columns.size(), outside_blocked ? 0 : nothing);
  const auto step = [](std::uint32_t d) { return d + (d == nothing ? 0 : 1); };
  for (std::uint32_t y = 0; y < height; ++y) {
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
    std::uint32_t* row = distances + std::size_t{y} * width + columns.first;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      above[i] = std::min(row[i], step(above[i]));
      row[i] = above[i];
    }
  }
}

/// The lower envelope of a row's curves. Scratch of one thread's rows.
template <class Kind, class Int>
class Envelope {
 public:
  explicit Envelope(std::uint32_t width) : width_(as_whole<Int>(width)), pieces_(width + std::size_t{2}) {}

  /// Replaces a row's column distances by squared distances.
  void pass(std::uint32_t* row, bool outside_blocked) {
    Piece* end = pieces_.data();
    if (outside_blocked) end = added(-1, 0, end);
    for (Int x = 0; x < width_; ++x) {
      if (row[x] <= farthest) end = added(x, Kind::curve(as_whole<Int>(row[x])), end);
    }
    if (outside_blocked) end = added(width_, 0, end);
    if (end == pieces_.data()) return std::fill(row, row + width_, nothing);
    Int last = width_;
    while (end != pieces_.data()) {
      const auto [site, height, first] = *--end;
      for (Int x = first; x < last; ++x) {
        const std::int64_t squared = Kind::curve(std::abs(x - site)) + height;
        row[x] = as_whole<std::uint32_t>(std::min<std::int64_t>(squared, nothing));
      }
      last = first;
    }
  }

 private:
  struct Piece {
    Int site;
    Int height;
    Int first;  // the first x where this site is nearest
  };

  /// Adds a site right of all others; the new end of the pieces.
  Piece* added(Int site, Int height, Piece* end) {
    const auto at = [](const Piece& p, Int x) { return Kind::curve(std::abs(x - p.site)) + p.height; };
    while (end != pieces_.data() && at(end[-1], end[-1].first) > Kind::curve(std::abs(end[-1].first - site)) + height) {
      --end;
    }
    const Int first = end == pieces_.data() ? 0 : Kind::last_of_left(end[-1].site, site, height - end[-1].height) + 1;
    if (first < width_) *end++ = {site, height, first};
    return end;
  }

  Int width_;
  std::vector<Piece> pieces_;
};

struct CellBox {
  Cell begin;
  Cell end;
};

CellBox grown(const CellBox& box, std::uint32_t by, const CellBox& all) {
  return {{box.begin.x - std::min(by, box.begin.x), box.begin.y - std::min(by, box.begin.y)},
          {std::min(all.end.x, box.end.x + by), std::min(all.end.y, box.end.y + by)}};
}

/// Rows of a field of columns' distances.
template <class Kind, class Int>
void row_passes(Range rows, std::uint32_t width, bool outside_blocked, std::uint32_t* distances) {
  Envelope<Kind, Int> envelope(width);
  for (std::size_t y = rows.first; y < rows.last; ++y) envelope.pass(distances + y * width, outside_blocked);
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
  for_chunks(width_, columns, execution, [&](Range r) { column_pass(blocked, outside_blocked, r, squared_.data()); });
  constexpr std::size_t rows = 32;
  constexpr std::uint32_t narrow = 1 << 14;  // the sum of two curves is below 2^31
  const bool is_narrow = std::max(width_, height_) < narrow;
  const auto pass = kind == CellDistance::centres
                        ? (is_narrow ? row_passes<Centres, std::int32_t> : row_passes<Centres, std::int64_t>)
                        : (is_narrow ? row_passes<Squares, std::int32_t> : row_passes<Squares, std::int64_t>);
  for_chunks(height_, rows, execution, [&](Range r) { pass(r, width_, outside_blocked, squared_.data()); });
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
  Bitmap wide(blocked.width(), blocked.height());
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

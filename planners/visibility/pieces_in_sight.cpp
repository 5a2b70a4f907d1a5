// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility/pieces_in_sight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/plane/geometry.hpp"

namespace warren {
namespace {

constexpr double open_sight = std::numeric_limits<double>::infinity();
constexpr double margin = 1e-9;          // of places: far above their rounding, far below a range's width
constexpr double shallow = 1e-6;         // sines below this: a distance along the ray is not to be trusted
constexpr double outwards = 1.0 + 1e-9;  // distances are rounded up by this
constexpr double bent = 0.999;           // a chord of a range of directions, at its middle, and rounding

Vec2 direction_at(double place) {
  if (place < 1.0) return {1.0 - place, place};
  if (place < 2.0) return {1.0 - place, 2.0 - place};
  if (place < 3.0) return {place - 3.0, 2.0 - place};
  return {place - 3.0, place - 4.0};
}

/// The first and the last direction, anticlockwise, in which the box lies; the origin is not in it.
struct BoxView {
  Vec2 first;
  Vec2 last;
};
BoxView view_of(const Box& b) {
  if (b.min.x > 0.0) {
    if (b.min.y > 0.0) return {{b.max.x, b.min.y}, {b.min.x, b.max.y}};
    if (b.max.y < 0.0) return {b.min, b.max};
    return {b.min, {b.min.x, b.max.y}};
  }
  if (b.max.x < 0.0) {
    if (b.min.y > 0.0) return {b.max, b.min};
    if (b.max.y < 0.0) return {{b.min.x, b.max.y}, {b.max.x, b.min.y}};
    return {b.max, {b.max.x, b.min.y}};
  }
  if (b.min.y > 0.0) return {{b.max.x, b.min.y}, b.min};
  return {{b.min.x, b.max.y}, b.max};
}

}  // namespace

double direction_place(Vec2 d) {
  const double sum = std::abs(d.x) + std::abs(d.y);
  if (d.y >= 0.0) return d.x >= 0.0 ? d.y / sum : 1.0 - d.x / sum;
  return d.x < 0.0 ? 2.0 - d.y / sum : 3.0 + d.x / sum;
}

NearPieces::NearPieces(const PlanePieces& pieces, const Execution& execution)
    : pieces_(pieces),
      execution_(execution),
      cell_epoch_(pieces.grid().cell_count(), 0),
      piece_epoch_(pieces.pieces().size(), 0) {
  for (std::size_t i = 0; i < directions; ++i) {
    const Vec2 d = direction_at(4.0 * static_cast<double>(i) / static_cast<double>(directions));
    unit_[i] = (1.0 / norm(d)) * d;
  }
}

void NearPieces::open(std::span<const PlaceRange> ranges) {
  constexpr double scale = static_cast<double>(directions) / 4.0;
  sight_.fill(0.0);
  for (const PlaceRange& r : ranges) {
    const double end = r.last >= r.first ? r.last : r.last + 4.0;
    if (end - r.first >= 4.0 - 2.0 / scale) return sight_.fill(open_sight);
    const auto first = static_cast<std::size_t>((r.first + 4.0 - margin) * scale);
    const auto last = static_cast<std::size_t>((end + 4.0 + margin) * scale);
    for (std::size_t i = first; i <= last; ++i) sight_[i % directions] = open_sight;
  }
}

/// But for the range that begins at place 2: directions just before it may be rounded to it.
void NearPieces::close_downwards() { std::fill(sight_.begin() + directions / 2 + 1, sight_.end(), 0.0); }

void NearPieces::next_epoch() {
  if (++epoch_ != 0) return;
  std::fill(cell_epoch_.begin(), cell_epoch_.end(), 0);
  std::fill(piece_epoch_.begin(), piece_epoch_.end(), 0);
  epoch_ = 1;
}

bool NearPieces::is_hidden(const View& v) const {
  if (!v.steep) return false;
  // A piece is nowhere nearer in a range than at both its borders, but for what the range bends.
  const double least = v.to_line * bent;
  const auto behind = [&](std::size_t i, std::size_t border) { return sight_[i] * sine(v, border) < least; };
  for (std::size_t i = v.begin; i < v.end; ++i) {
    if (!behind(i % directions, i) || !behind(i % directions, i + 1)) return false;
  }
  // Ranges that the piece's ends lie in: by its least distance.
  const double nearest = std::sqrt(distance_sq(Vec2{}, {v.first, v.last})) * bent;
  for (std::size_t i = v.outer_begin; i < v.begin; ++i) {
    if (sight_[i % directions] >= nearest) return false;
  }
  for (std::size_t i = v.end; i < v.outer_end; ++i) {
    if (sight_[i % directions] >= nearest) return false;
  }
  return true;
}

void NearPieces::hide_behind(const View& v) {
  const double length = norm(v.last - v.first);
  const double farthest = std::max(norm(v.first), norm(v.last));
  const auto distance_at = [&](std::size_t border) {
    const double s = sine(v, border);
    return v.steep && s > shallow * length ? std::min(v.to_line / s, farthest) : farthest;
  };
  double here = distance_at(v.begin);
  for (std::size_t i = v.begin; i < v.end; ++i) {
    const double next = distance_at(i + 1);
    double& sight = sight_[i % directions];
    sight = std::min(sight, std::max(here, next) * outwards);
    here = next;
  }
}

void NearPieces::see(std::uint32_t piece) {
  constexpr double scale = static_cast<double>(directions) / 4.0;
  if (piece_epoch_[piece] == epoch_) return;
  piece_epoch_[piece] = epoch_;
  const Segment s = pieces_.segment(piece);
  View v{s.a - eye_, s.b - eye_, 0.0, true, 0, 0, 0, 0};
  v.to_line = cross(v.first, v.last);
  if (v.to_line < 0.0) {
    std::swap(v.first, v.last);
    v.to_line = -v.to_line;
  }
  const double size = norm(v.first) * norm(v.last);
  if (!(v.to_line > 1e-12 * size)) {  // seen end on, or the eye is its end
    seen_.push_back(piece);
    return;
  }
  v.steep = v.to_line > shallow * norm(v.first) * norm(v.last - v.first);
  const double first = direction_place(v.first) + 4.0;  // so that a margin before place 0 stays positive
  double last = direction_place(v.last) + 4.0;
  if (last < first) last += 4.0;
  v.outer_begin = static_cast<std::size_t>((first - margin) * scale);
  v.outer_end = static_cast<std::size_t>((last + margin) * scale) + 1;
  v.begin = static_cast<std::size_t>(std::ceil((first + margin) * scale));
  v.end = static_cast<std::size_t>(std::floor((last - margin) * scale));
  if (v.begin >= v.end) {  // too narrow to hide anything
    seen_.push_back(piece);
    return;
  }
  if (is_hidden(v)) return;
  seen_.push_back(piece);
  hide_behind(v);
}

bool NearPieces::is_hidden(SegmentGrid::Cell cell) const {
  constexpr double scale = static_cast<double>(directions) / 4.0;
  const Box at = pieces_.grid().box_of_cell(cell);
  const Box box{at.min - eye_, at.max - eye_};
  const Vec2 nearest{std::max({box.min.x, -box.max.x, 0.0}), std::max({box.min.y, -box.max.y, 0.0})};
  const double distance = norm(nearest);
  if (!(distance > 0.0)) return false;
  const BoxView view = view_of(box);
  const double first = direction_place(view.first) + 4.0 - margin;
  double last = direction_place(view.last) + 4.0 + margin;
  if (last < first) last += 4.0;
  const auto end = static_cast<std::size_t>(last * scale);
  for (auto i = static_cast<std::size_t>(first * scale); i <= end; ++i) {
    if (sight_[i % directions] >= distance) return false;
  }
  return true;
}

void NearPieces::propose(SegmentGrid::Cell cell) {
  if (cell.col >= pieces_.grid().cols() || cell.row >= pieces_.grid().rows()) return;  // below 0 wraps
  std::uint32_t& epoch = cell_epoch_[pieces_.grid().index(cell)];
  if (epoch == epoch_) return;
  epoch = epoch_;
  next_.push_back(cell);
}

void NearPieces::propose_beyond(SegmentGrid::Cell from) {
  if (from.col >= home_.col) propose({from.col + 1, from.row});
  if (from.col <= home_.col) propose({from.col - 1, from.row});
  if (from.row >= home_.row) propose({from.col, from.row + 1});
  if (from.row <= home_.row) propose({from.col, from.row - 1});
}

void NearPieces::enter(SegmentGrid::Cell cell) {
  if (++entered_ % 64 == 0) execution_.check();
  if (is_hidden(cell)) return;
  for (const std::uint32_t piece : pieces_.grid().in_cell(cell)) see(piece);
  propose_beyond(cell);
}

std::span<const std::uint32_t> NearPieces::look(Vec2 p, std::span<const PlaceRange> ranges, bool upwards) {
  const SegmentGrid& grid = pieces_.grid();
  seen_.clear();
  if (!grid.box().contains(p)) {
    seen_.resize(pieces_.pieces().size());
    std::iota(seen_.begin(), seen_.end(), 0U);
    return seen_;
  }
  next_epoch();
  open(ranges);
  if (upwards) close_downwards();
  eye_ = p;
  home_ = grid.cell_of(p);
  next_.clear();
  propose(home_);
  while (!next_.empty()) {
    now_.swap(next_);
    next_.clear();
    for (const SegmentGrid::Cell cell : now_) enter(cell);
  }
  return seen_;
}

}  // namespace warren

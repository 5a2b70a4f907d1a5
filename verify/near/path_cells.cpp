// SPDX-License-Identifier: BSD-3-Clause
#include "verify/near/path_cells.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace warren {
namespace {

constexpr double box_cells_per_leg = 64;
constexpr double box_pieces_per_leg = 4;
constexpr double free_cells = 1024;  // for a path of few legs
constexpr std::size_t legs_between_checks = 4096;

float rounded_down(double x) {
  constexpr double largest = std::numeric_limits<float>::max();
  if (!(std::abs(x) < largest))
    return x > 0.0 ? std::numeric_limits<float>::max() : -std::numeric_limits<float>::infinity();
  const auto f = static_cast<float>(x);
  return static_cast<double>(f) > x ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
float rounded_up(double x) { return -rounded_down(-x); }

}  // namespace

void PathBoxes::FloatBox::include(const FloatBox& box) {
  min_x = std::min(min_x, box.min_x);
  min_y = std::min(min_y, box.min_y);
  max_x = std::max(max_x, box.max_x);
  max_y = std::max(max_y, box.max_y);
}

PathBoxes::FloatBox PathBoxes::rounded(const Box& box) {
  return {rounded_down(box.min.x), rounded_down(box.min.y), rounded_up(box.max.x), rounded_up(box.max.y)};
}

PathBoxes::PathBoxes(const LegBoxes& legs, double typical_wall, const Execution& execution)
    : path_(legs.path()), box_(legs.box()) {
  choose_cell(legs.length(), typical_wall);
  // Paths like to run on a lattice, and better through the middle of cells than between two: the middle of the path
  // does.
  const Vec2 inside = path_[path_.size() / 2];
  const auto before = [this](double extent) { return (std::ceil(extent * per_cell_) + 0.5) * cell_; };
  origin_ = inside - Vec2{before(inside.x - box_.min.x), before(inside.y - box_.min.y)};
  columns_ = std::floor((box_.max.x - origin_.x) * per_cell_) + 2.0;
  rows_ = std::floor((box_.max.y - origin_.y) * per_cell_) + 2.0;
  stride_ = cell_number(columns_) / 8 + 1;
  mark_cells(execution);
  gather_boxes(execution);
}

void PathBoxes::choose_cell(double length, double typical_wall) {
  const auto legs = static_cast<double>(path_.size() - 1);
  cell_ = std::max(typical_wall, length / (box_pieces_per_leg * legs + free_cells));
  cell_ = std::max(
      cell_, std::sqrt(box_.width()) * std::sqrt(box_.height()) / std::sqrt(box_cells_per_leg * legs + free_cells));
  if (cell_ == 0.0) cell_ = 1.0;
  per_cell_ = 1.0 / cell_;
}

template <class Visit>
void PathBoxes::for_each_cell(const Segment& piece, const Visit& visit) const {
  const auto& [a, b] = piece;
  const auto number = [](double u, double count) { return cell_number(std::clamp(u, 0.0, count - 1.0)); };
  const double ua = (a.x - origin_.x) * per_cell_;
  const double ub = (b.x - origin_.x) * per_cell_;
  const double va = (a.y - origin_.y) * per_cell_;
  const double vb = (b.y - origin_.y) * per_cell_;
  const std::size_t column_last = number(std::max(ua, ub) + slack, columns_);
  const std::size_t row_last = number(std::max(va, vb) + slack, rows_);
  const std::size_t column_first = number(std::min(ua, ub) - slack, columns_);
  for (std::size_t row = number(std::min(va, vb) - slack, rows_); row <= row_last; ++row) {
    for (std::size_t column = column_first; column <= column_last; ++column) visit(column, row);
  }
}

template <class Visit>
void PathBoxes::for_each_piece(const Execution& execution, const Visit& visit) const {
  for (std::size_t leg = 0; leg + 1 < path_.size(); ++leg) {
    if (leg % legs_between_checks == 0) execution.check();
    const Vec2 a = path_[leg];
    const Vec2 b = path_[leg + 1];
    if (a.x == b.x || a.y == b.y) {  // its box is the leg itself, so it need not be cut
      visit(Segment{a, b}, box_of({a, b}));
      continue;
    }
    const double extent = std::max(std::abs(b.x - a.x), std::abs(b.y - a.y)) * per_cell_;
    const double pieces = std::max(1.0, std::ceil(extent));
    // Rounding of the cuts: three roundings of a difference and one of the sum, generously.
    const Vec2 error{4e-15 * std::max(std::abs(a.x), std::abs(b.x)), 4e-15 * std::max(std::abs(a.y), std::abs(b.y))};
    Vec2 p = a;
    for (double piece = 1.0; piece <= pieces; piece += 1.0) {
      const Vec2 q = piece == pieces ? b : a + (piece / pieces) * (b - a);
      Box box = box_of({p, q});
      box.min = box.min - error;
      box.max = box.max + error;
      visit(Segment{p, q}, box);
      p = q;
    }
  }
}

void PathBoxes::mark_cells(const Execution& execution) {
  const std::size_t bytes = cell_number(rows_) * stride_ + sizeof(std::uint64_t);
  execution.reserve(bytes * (1 + sizeof(std::uint32_t)));
  bits_.assign(bytes, 0);
  for_each_piece(execution, [&](const Segment& piece, const Box&) {
    for_each_cell(piece, [&](std::size_t column, std::size_t row) {
      std::uint8_t& byte = bits_[row * stride_ + column / 8];
      byte = as_whole<std::uint8_t>(byte | (1U << (column % 8)));
    });
  });
  rank_.resize(bytes + 1);
  std::uint32_t marked = 0;
  for (std::size_t i = 0; i < bytes; ++i) {
    rank_[i] = marked;
    marked += ones_below(bits_[i], 8);
  }
  rank_[bytes] = marked;
}

void PathBoxes::gather_boxes(const Execution& execution) {
  const std::size_t marked = rank_.back();
  execution.reserve(marked * sizeof(Passage));
  constexpr float far = std::numeric_limits<float>::infinity();
  constexpr FloatBox nothing{far, far, -far, -far};
  boxes_.assign(marked, {nothing, nothing});
  for_each_piece(execution, [&](const Segment& piece, const Box& box) {
    const FloatBox outer = rounded(box);
    FloatBox Passage::*const kind = box.width() >= box.height() ? &Passage::level : &Passage::steep;
    for_each_cell(piece, [&](std::size_t column, std::size_t row) {
      const std::size_t slot = slot_of(column, row);
      (boxes_[slot].*kind).include(outer);
    });
  });
}

void PathBoxes::set_reach(double least, double r) {
  near_sq_ = std::max(least * least, r * r * (1.0 + 1e-12));
  grow_ = std::max(least, r) * (1.0 + 1e-9) * per_cell_ + slack;
}

}  // namespace warren

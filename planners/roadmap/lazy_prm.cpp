// SPDX-License-Identifier: BSD-3-Clause
// The dead ends of a maze (DeadEnds, DeadEndSeals). The planner is a template in the header: LazyPlan.
#include "planners/roadmap/lazy_prm.hpp"

#include <cmath>

#include "core/plane/geometry.hpp"

namespace warren {
namespace {

constexpr std::uint8_t is_kept = 0xF0;  // more than one way out

/// Closes a cell of one side after the other, while the next one has no more.
void peel_from(std::size_t cell, CellSides& cells, RawVector<std::uint8_t>& left) {
  while (std::has_single_bit(left[cell]) && (cells.open[cell] & is_kept) == 0) {
    const std::uint8_t side = std::exchange(left[cell], std::uint8_t{0});
    cells.open[cell] |= static_cast<std::uint8_t>(side << 4U);
    cell = cells.beyond(cell, side);
    left[cell] &= static_cast<std::uint8_t>(CellSides::all - CellSides::opposite(side));
  }
}

/// From the nearer of its points.
double distance_to_box(const Segment& s, const Box& box) {
  const double dx = std::max({box.min.x - std::max(s.a.x, s.b.x), std::min(s.a.x, s.b.x) - box.max.x, 0.0});
  const double dy = std::max({box.min.y - std::max(s.a.y, s.b.y), std::min(s.a.y, s.b.y) - box.max.y, 0.0});
  return std::sqrt(dx * dx + dy * dy);
}

}  // namespace

DeadEnds::DeadEnds(CellSides cells, std::span<const std::size_t> kept, const Execution& execution)
    : cells_(std::move(cells)) {
  if (cells_.open.empty()) return;
  execution.reserve(cells_.open.size());
  RawVector<std::uint8_t> left(cells_.open.size());
  std::copy(cells_.open.begin(), cells_.open.end(), left.begin());
  for (const std::size_t cell : kept) cells_.open[cell] |= is_kept;
  for (std::size_t cell = 0; cell < left.size(); ++cell) {
    execution.poll(cell);
    peel_from(cell, cells_, left);
  }
  for (const std::size_t cell : kept) cells_.open[cell] &= CellSides::all;
}

DeadEndSeals::DeadEndSeals(const DeadEnds& dead_ends, const Neighbours<2>& milestones, double radius,
                           const Execution& execution)
    : dead_ends_(&dead_ends), milestones_(&milestones), radius_(radius) {
  const std::size_t cells = dead_ends.cells().open.size();
  execution.reserve(cells * sizeof(VertexId));
  waits_for_.assign(cells, nobody);
}

/// A cell whose way out leads into a sealed one is sealed, too; motions pass over few cells at once, so that the search
/// may not have come by in each.
bool DeadEndSeals::is_sealed(std::size_t cell, std::span<const double> labels) {
  constexpr int cells_of_a_motion = 4;
  const CellSides& cells = dead_ends_->cells();
  VertexId& waits_for = waits_for_[cell];
  std::size_t at = cell;
  for (int step = 0; step < cells_of_a_motion && dead_ends_->way_out(at) != 0; ++step) {
    if (waits_for_[at] == sealed) {
      waits_for = sealed;
      return true;
    }
    at = cells.beyond(at, dead_ends_->way_out(at));
  }
  if (waits_for != nobody && !std::signbit(labels[waits_for])) return false;
  const Segment way_out = cells.side_of_cell(cell, dead_ends_->way_out(cell));
  if (!gather_outside(cell, way_out)) return false;
  waits_for = unsettled_outside(way_out, labels);
  if (waits_for == nobody) waits_for = sealed;
  return waits_for == sealed;
}

/// The cells beyond the way out that a motion over it can reach, by open sides; false where they are too many.
bool DeadEndSeals::gather_outside(std::size_t cell, const Segment& way_out) {
  const CellSides& cells = dead_ends_->cells();
  outside_.assign(1, cells.beyond(cell, dead_ends_->way_out(cell)));
  for (std::size_t i = 0; i < outside_.size(); ++i) {
    for (unsigned sides = dead_ends_->open_sides(outside_[i]); sides != 0; sides &= sides - 1) {
      const std::size_t next = cells.beyond(outside_[i], static_cast<std::uint8_t>(sides & (0U - sides)));
      if (next == cell || distance_to_box(way_out, cells.box_of_cell(next)) > radius_) continue;
      if (std::find(outside_.begin(), outside_.end(), next) != outside_.end()) continue;
      if (outside_.size() == most_near) return false;
      outside_.push_back(next);
    }
  }
  return true;
}

/// One of the milestones that a motion over the way out can come to; nobody where all of them are settled.
VertexId DeadEndSeals::unsettled_outside(const Segment& way_out, std::span<const double> labels) const {
  constexpr double for_rounding = 1e-6;
  VertexId found = nobody;
  const Vec2 middle = 0.5 * (way_out.a + way_out.b);
  milestones_->for_each_within(middle, radius_ + 0.5 + for_rounding, [&](VertexId w, double) {
    if (found != nobody || std::signbit(labels[w])) return;
    const Vec2 p = milestones_->point(w);
    if (distance(p, way_out) > radius_ + for_rounding) return;
    if (std::find(outside_.begin(), outside_.end(), dead_ends_->cells().cell_of(p)) != outside_.end()) found = w;
  });
  return found;
}

}  // namespace warren

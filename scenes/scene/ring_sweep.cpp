// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/scene/ring_sweep.hpp"

namespace warren {

RingSides::RingSides(std::span<const Vec2> corners, std::span<const std::uint32_t> first)
    : corners_(corners), next_(corners.size()), previous_(corners.size()) {
  const auto count = static_cast<std::uint32_t>(corners.size());
  for (std::size_t r = 0; r < first.size(); ++r) {
    const std::uint32_t end = r + 1 < first.size() ? first[r + 1] : count;
    for (std::uint32_t i = first[r]; i < end; ++i) {
      next_[i] = i + 1 < end ? i + 1 : first[r];
      previous_[next_[i]] = i;
    }
  }
}

bool RingSides::meet(std::size_t i, std::size_t j) const {
  if (next(i) == j) return fold(j);
  if (next(j) == i) return fold(i);
  return segments_touch(side(i), side(j));
}

bool RingSides::cross(std::size_t i, std::size_t j) const {
  const bool in_line = orient2d(low(i), high(i), low(j)) == 0 && orient2d(low(i), high(i), high(j)) == 0;
  if (in_line) return is_before(low(i), high(j)) && is_before(low(j), high(i));
  return segments_cross(side(i), side(j));
}

bool RingSides::fold(std::size_t i) const {
  const Vec2 p = corner(previous(i));
  const Vec2 q = corner(next(i));
  return on_segment(q, {p, corner(i)}) || on_segment(p, {corner(i), q});
}

bool RingSweep::Order::operator()(std::uint32_t i, std::uint32_t j) const {
  if (i == j) return false;
  const Vec2 a = rings->low(i);
  const Vec2 b = rings->low(j);
  int side = 0;  // of j, seen from i
  if (is_before(b, a)) {
    side = -orient2d(b, rings->high(j), a);
    if (side == 0 && may_touch) side = -orient2d(b, rings->high(j), rings->high(i));
    if (side == 0) *contact = SideContact{i, j};  // i begins on j
  } else if (is_before(a, b)) {
    side = orient2d(a, rings->high(i), b);
    if (side == 0 && may_touch) side = orient2d(a, rings->high(i), rings->high(j));
    if (side == 0) *contact = SideContact{i, j};
  } else {
    side = orient2d(a, rings->high(i), rings->high(j));
    const bool may_meet = may_touch || rings->next(i) == j || rings->next(j) == i;
    if (side == 0 || !may_meet) *contact = SideContact{i, j};
  }
  return side > 0 || (side == 0 && i < j);
}

/// Takes the sides off that end in the corners and puts those on that begin there. The side below them.
std::uint32_t RingSweep::pass(std::span<const std::uint32_t> corners) {
  const Vec2 here = rings_.corner(corners.front());
  Status::iterator lowest = order_.end();  // what lies above or begins in the corners
  for (const std::uint32_t corner : corners) {
    for (const std::uint32_t side : {rings_.previous(corner), corner}) {
      if (rings_.high(side) == here) lowest = remove(side);
    }
  }
  for (const std::uint32_t corner : corners) {
    for (const std::uint32_t side : {rings_.previous(corner), corner}) {
      if (!(rings_.low(side) == here) || contact_) continue;
      insert(side);
      lowest = place_[side];
    }
  }
  if (contact_) return no_side;
  while (lowest != order_.begin() && rings_.low(*std::prev(lowest)) == here) --lowest;
  if (may_touch_) look_around(here, lowest);
  return lowest == order_.begin() ? no_side : *std::prev(lowest);
}

/// Is the inside between every second pair of sides? And do the corners lie on the side below or above?
void RingSweep::look_around(Vec2 here, Status::iterator lowest) {
  touched_ = no_side;
  const auto look_at = [&](std::uint32_t side) {
    if (on_segment(here, rings_.side(side))) touched_ = side;
  };
  bool inside = false;
  if (lowest != order_.begin()) {
    inside = rings_.ahead(*std::prev(lowest));
    look_at(*std::prev(lowest));
  }
  for (auto at = lowest; at != order_.end(); ++at) {
    if (rings_.ahead(*at) == inside) contact_ = SideContact{*at, *at};
    inside = !inside;
    if (rings_.low(*at) == here) continue;
    look_at(*at);
    return;
  }
}

RingSweep::Status::iterator RingSweep::remove(std::uint32_t side) {
  const auto after = order_.erase(place_[side]);
  place_[side] = order_.end();
  if (after != order_.begin() && after != order_.end()) compare(*std::prev(after), *after);
  return after;
}

void RingSweep::insert(std::uint32_t side) {
  const auto at = order_.insert(side).first;
  place_[side] = at;
  if (contact_) return;
  if (at != order_.begin()) compare(*std::prev(at), side);
  if (std::next(at) != order_.end()) compare(side, *std::next(at));
}

}  // namespace warren

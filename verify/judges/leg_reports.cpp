// SPDX-License-Identifier: BSD-3-Clause
#include "verify/judges/leg_reports.hpp"

#include <fmt/format.h>

#include <cmath>

namespace warren {

void LegReport::add(const LegReport& more) {
  least = std::min(least, more.least);
  met = std::min(met, more.met);
  looks += more.looks;
  if (more.violation && (!violation || more.violation->leg < violation->leg)) violation = more.violation;
}

Violation elsewhere(std::string_view which, std::span<const double> wanted, double distance, std::size_t leg) {
  return {leg, distance, fmt::format("{}: {}", which, fmt::join(wanted, " "))};
}

Verification verdict_on(const LegReport& legs, const WrongEnds& ends) {
  Verification verdict;
  verdict.min_clearance = legs.least;
  verdict.first_violation = ends.start ? ends.start : legs.violation ? legs.violation : ends.goal;
  verdict.verified = !verdict.first_violation;
  return verdict;
}

void Tally::join(const Tally& other) {
  least = std::min(least, other.least);
  violation = std::min(violation, other.violation);
  contacts.insert(contacts.end(), other.contacts.begin(), other.contacts.end());
  box.include(other.box);
}

void check_box(const Box& box, const LegBoxes& legs, Tally& tally) {
  if (box.empty() || (box.contains(legs.box().min) && box.contains(legs.box().max))) return;
  for (std::size_t i = 0; i < legs.path().size(); ++i) {
    if (box.contains(legs.path()[i])) continue;
    tally.violation = std::min(tally.violation, LegContact{i == 0 ? 0 : i - 1, box_number});
    return;
  }
}

/// Does the whole box lie farther from the obstacle's line than is of interest?
bool Comparison::beside(const Segment& obstacle, const Box& box) const {
  const Vec2 along = obstacle.b - obstacle.a;
  const Vec2 low = box.min - obstacle.a;  // the box's middle itself would be rounded as its coordinates are
  const Vec2 high = box.max - obstacle.a;
  const Vec2 to = 0.5 * (low + high);
  const double spread = 0.5 * (std::abs(along.x) * box.height() + std::abs(along.y) * box.width());
  const Vec2 most{std::abs(low.x) + std::abs(high.x), std::abs(low.y) + std::abs(high.y)};
  const double error = 1e-15 * (std::abs(along.x) * most.y + std::abs(along.y) * most.x);
  const double room = std::abs(cross(along, to)) - spread - 8.0 * error;
  const double length_sq = dot(along, along);
  constexpr double trifle = 1e-280;      // squares below it are rounded, to 0 at last: they decide nothing
  constexpr double least_room = 1e-140;  // its root
  return length_sq >= trifle && room > least_room &&
         room * room > std::max(near_sq_, trifle) * length_sq * (1.0 + 4.0 * exact::distance_error);
}

void Comparison::compare(const Segment& s, std::size_t leg, const Segment& obstacle, std::size_t number) {
  const double r = options_.reach();
  const double d = exact::distance(s, obstacle);
  if (d < tally_.least) {
    tally_.least = d;
    narrow();
  }
  if (r > 0.0) {
    if (d <= r * (1.0 + 1e-12) || is_doubtful(d, s, obstacle)) {
      if (exact::closer_than(s, obstacle, r)) forbid(leg, number);
    }
  } else if (d == 0.0 && exact::touch(s, obstacle)) {
    touch(s, leg, obstacle, number);
  }
}

/// Is d within its own rounding of the clearance?
bool Comparison::is_doubtful(double d, const Segment& s, const Segment& obstacle) const {
  Box both = box_of(s);
  both.include(box_of(obstacle));
  return d <= options_.reach() + 1e-14 * std::max(both.width(), both.height());
}

void Comparison::touch(const Segment& s, std::size_t leg, const Segment& obstacle, std::size_t number) {
  if (options_.contact == Contact::blocked || exact::cross_inside(s, obstacle)) return forbid(leg, number);
  const LegContact contact{leg, number};
  if (tally_.contacts.empty() || tally_.contacts.back() != contact) tally_.contacts.push_back(contact);
}

void Comparison::narrow() {
  const double r = options_.reach();
  const double least = std::min(at_most_, tally_.least);
  near_sq_ = std::max(least * least, r * r * (1.0 + 1e-12));
}

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// Plane geometry of the matrix's own, so that its judge shares no line with the program: points, rings, distances, all
// by brute force in plain doubles. What touches within `touch` counts as apart: a judge of samples refutes what it
// sees, and proves nothing.
#pragma once

#include <vector>

namespace warren::test {

struct PlanePoint {
  double x = 0.0;
  double y = 0.0;
};
using Ring = std::vector<PlanePoint>;

struct PlaneLine {
  PlanePoint a;
  PlanePoint b;
};

/// An open region between rings: a point is inside where an odd number of them holds it.
using Region = std::vector<Ring>;

inline constexpr double touch = 1e-9;  ///< what doubles may be wrong by, in worlds of ten units

double distance_of(PlanePoint p, const PlaneLine& line);
double distance_of(const PlaneLine& s, const PlaneLine& t);
/// Do they cross, each end clearly on its side of the other?
bool crosses(const PlaneLine& s, const PlaneLine& t);
std::vector<PlaneLine> sides_of(const Ring& ring);
bool holds(const Ring& ring, PlanePoint p);
bool holds(const Region& region, PlanePoint p);
/// The least distance from the sides of its rings.
double distance_from_sides(const Region& region, PlanePoint p);
/// A point well inside of a simple ring.
PlanePoint point_inside(const Ring& ring);

}  // namespace warren::test

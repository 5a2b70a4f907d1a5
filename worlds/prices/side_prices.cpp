// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/plane/geometry.hpp"
#include "worlds/prices/map_prices.hpp"

namespace warren {
namespace {

/// The segment as it is seen from a leg, where that passes `middle` and nothing changes.
StretchDistance seen(const Segment& side, Vec2 p, Vec2 u, Vec2 middle) {
  const Vec2 along = side.b - side.a;
  const double foot = dot(middle - side.a, along);
  if (!(foot > 0.0)) return StretchDistance::corner(side.a, p, u);
  if (foot >= dot(along, along)) return StretchDistance::corner(side.b, p, u);
  const Vec2 normal = (1.0 / norm(along)) * Vec2{-along.y, along.x};
  const double turned = dot(middle - side.a, normal) < 0.0 ? -1.0 : 1.0;
  return StretchDistance::side(turned * dot(p - side.a, normal), turned * dot(u, normal));
}

}  // namespace

SidePrices::SidePrices(const WallIndex& sides, double radius, const Prices& prices)
    : sides_(sides), areas_(prices, [](Vec2 p) { return p; }) {
  if (!prices.clearance || !(prices.clearance->price > 0.0)) return;
  reach_ = clearance_reach(*prices.clearance, radius) + radius;
  price_ = clearance_scale(*prices.clearance, radius);
}

/// Of a leg that is not much longer than the reach.
double SidePrices::nearness(Vec2 p, Vec2 u, double length, Scratch& scratch) const {
  const double half = 0.5 * length;
  if (sides_.clearance(p + half * u, reach_ + half) >= reach_ + half) return 0.0;
  const Segment leg{p, p + length * u};
  std::vector<Segment>& near = scratch.near;
  near.clear();
  double enough = reach_;  // the distance to a segment is convex, so greatest at an end of the leg
  sides_.for_each_near(box_of(leg).grown(reach_), [&](const Segment& side) {
    near.push_back(side);
    enough = std::min(enough, std::max(distance(leg.a, side), distance(leg.b, side)));
    return true;
  });
  constexpr double rounding = 1.0 + 1e-9;
  std::erase_if(near, [&](const Segment& side) { return distance(leg, side) > enough * rounding; });
  std::vector<double>& cuts = scratch.cuts;
  cuts.assign({0.0, length});
  for (const Segment& side : near) {
    const Vec2 along = side.b - side.a;
    for (const Vec2 end : {side.a, side.b}) {
      const double t = dot(end - p, along) / dot(u, along);
      if (t > 0.0 && t < length) cuts.push_back(t);
    }
  }
  std::sort(cuts.begin(), cuts.end());
  double sum = 0.0;
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    if (!(cuts[i] > cuts[i - 1])) continue;
    scratch.things.clear();
    const Vec2 middle = p + 0.5 * (cuts[i - 1] + cuts[i]) * u;
    for (const Segment& side : near) scratch.things.push_back(seen(side, p, u, middle));
    sum += scratch.sum.integral(scratch.things, cuts[i - 1], cuts[i], reach_);
  }
  return sum;
}

PriceParts SidePrices::parts(Vec2 a, Vec2 b, Scratch& scratch) const {
  PriceParts parts;
  const double length = distance(a, b);
  if (!(length > 0.0)) return parts;
  const Vec2 u = (1.0 / length) * (b - a);
  if (reach_ > 0.0) {
    constexpr double most_pieces = 10'000.0;
    const double pieces = std::min(std::ceil(length / reach_), most_pieces);
    for (double i = 0.0; i < pieces; ++i) {
      const double from = i / pieces * length;
      const double to = (i + 1.0) / pieces * length;
      parts.clearance += price_ * nearness(a + from * u, u, to - from, scratch);
    }
  }
  if (!areas_.empty()) {
    parts.areas = areas_.over(a, u, length, scratch.cuts, [&](Vec2 p) { return areas_.factor(p); });
  }
  return parts;
}

}  // namespace warren

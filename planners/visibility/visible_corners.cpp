// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility/visible_corners.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/plane/polygon_distance.hpp"
#include "parallel/chunks.hpp"

namespace warren {
namespace {

/// Half a turn round from a place.
double opposite(double place) { return place < 2.0 ? place + 2.0 : place - 2.0; }

/// The sector's directions, all where rounded places can't tell next to none from next to all.
PlaceRange range_of(Vec2 at, const Sector& sector) {
  constexpr double doubt = 1e-9;
  if (sector.whole || sector.first == sector.last) return all_round;
  const PlaceRange range{direction_place(sector.first - at), direction_place(sector.last - at)};
  const double apart = std::abs(range.last - range.first);
  return apart < doubt || apart > 4.0 - doubt ? all_round : range;
}

}  // namespace

VisibleCorners::VisibleCorners(const PlaneObstacles& obstacles, const Execution& execution)
    : polygons_(obstacles.polygons), bounds_(obstacles.bounds), pieces_(obstacles, execution) {
  constexpr std::size_t grain = 4096;
  const std::size_t corners = pieces_.corner_count();
  std::vector<std::vector<SectorEnds>> parts(chunk_count(corners, grain));
  first_vertex_.assign(pieces_.points().size() + 1, 0);
  for_chunks(corners, grain, execution, [&](Range r) {
    std::vector<SectorEnds>& part = parts[r.first / grain];
    for (std::size_t p = r.first; p < r.last; ++p) {
      if (p % 64 == 0) execution.check();
      const auto at = static_cast<PointId>(p);
      const std::vector<SectorOfPoints> sectors = free_sectors_at(pieces_, at, execution);
      first_vertex_[p + 1] = static_cast<VertexId>(sectors.size());
      for (const SectorOfPoints& s : sectors) {
        const Vec2 first = pieces_.points()[s.first];
        const Vec2 last = pieces_.points()[s.last];
        part.push_back({s.first, s.last, warren::is_reflex(pieces_.points()[p], {first, last, false})});
      }
    }
  });
  for (std::size_t p = 0; p < pieces_.points().size(); ++p) first_vertex_[p + 1] += first_vertex_[p];
  for (const auto& part : parts) ends_.insert(ends_.end(), part.begin(), part.end());
  execution.check();
  point_.resize(ends_.size());
  any_.assign(pieces_.points().size(), 0);
  reflex_.assign(pieces_.points().size(), 0);
  for (PointId p = 0; p < pieces_.points().size(); ++p) {
    for (VertexId v = first_vertex_[p]; v < first_vertex_[p + 1]; ++v) {
      point_[v] = p;
      any_[p] = 1;
      if (ends_[v].reflex) reflex_[p] = 1;
    }
  }
}

bool VisibleCorners::is_blocked(Vec2 at) const {
  if (bounds_ && !bounds_->contains(at)) return true;
  if (!free_sectors(pieces_, at).empty()) return false;
  for (std::size_t p = 0; p < polygons_.size(); ++p) {
    if (strictly_inside(polygons_[p], at)) return true;
  }
  return false;
}

CornerSight::CornerSight(const VisibleCorners& corners, const Execution& execution)
    : corners_(corners), near_(corners.pieces(), execution), sweep_(corners.pieces(), execution) {}

void CornerSight::arrive(Vec2 eye, PointId p, Lanes lanes, SightLines which, std::vector<VertexId>& seen) const {
  const Vec2 at = corners_.pieces().points()[p];
  const VertexId first = corners_.vertices_first(p);
  const VertexId end = corners_.vertices_first(p + 1);
  for (VertexId v = first; v < end; ++v) {
    const Sector sector = corners_.sector(v);
    if (end - first > 1) {  // looking back, the right lane lies anticlockwise
      const Lanes back = lanes_in_sector(at, sector, eye);
      const bool left = (lanes & left_lane) != 0 && (back & right_lane) != 0;
      const bool right = (lanes & right_lane) != 0 && (back & left_lane) != 0;
      if (!left && !right) continue;
    }
    if (which == SightLines::tangent && !(corners_.is_reflex(v) && is_tangent(at, sector, eye))) continue;
    seen.push_back(v);
  }
}

template <class Departure>
void CornerSight::look(Vec2 eye, RotationalSweep::Turn how_far, std::span<const PlaceRange> ranges, SightLines which,
                       std::optional<Vec2> extra, const Departure& departure, std::vector<VertexId>& seen) {
  const std::vector<std::uint8_t>& wanted = which == SightLines::all ? corners_.any_ : corners_.reflex_;
  const auto near = near_.look(eye, ranges, how_far == RotationalSweep::Turn::upper_half);
  sweep_.run(eye, how_far, near, wanted, extra, departure, [&](PointId p, Lanes lanes) {
    if (p == RotationalSweep::target) {
      seen.push_back(target);
    } else {
      arrive(eye, p, lanes, which, seen);
    }
  });
}

void CornerSight::above_vertex(VertexId v, SightLines which, std::vector<VertexId>& seen) {
  seen.clear();
  const bool tangent = which == SightLines::tangent;
  if (tangent && !corners_.is_reflex(v)) return;
  const Vec2 eye = corners_.position(v);
  const Sector sector = corners_.sector(v);
  const PlaceRange all = range_of(eye, sector);
  std::array<PlaceRange, 2> ranges{all, all};
  if (tangent && sector.first != sector.last) {
    const double first = direction_place(sector.first - eye);
    const double last = direction_place(sector.last - eye);
    ranges = {{{first, opposite(last)}, {opposite(first), last}}};
  }
  const auto departure = [&](Vec2 q) {
    const Lanes lanes = lanes_in_sector(eye, sector, q);
    return tangent && lanes != no_lane && !is_tangent(eye, sector, q) ? no_lane : lanes;
  };
  look(eye, RotationalSweep::Turn::upper_half, ranges, which, std::nullopt, departure, seen);
  std::sort(seen.begin(), seen.end());
}

void CornerSight::taut_from_vertex(VertexId v, Vec2 from, std::optional<Vec2> extra, std::vector<VertexId>& seen) {
  seen.clear();
  const Vec2 eye = corners_.position(v);
  const Sector sector = corners_.sector(v);
  const int first_side = orient2d(from, eye, sector.first);
  const int last_side = orient2d(from, eye, sector.last);
  const bool left = first_side >= 0 && last_side >= 0;  // obstacles on the left: the way may bend to the left
  const bool right = first_side <= 0 && last_side <= 0;
  const double straight = direction_place(eye - from);
  std::array<PlaceRange, 2> ranges{{{straight, straight}, {straight, straight}}};
  if (left) ranges[0].last = direction_place(sector.last - eye);
  if (right) ranges[1].first = direction_place(sector.first - eye);
  // Exactly the directions of the ranges: elsewhere nothing was looked at.
  const auto is_taut = [&](Vec2 q) {
    const int side = orient2d(from, eye, q);
    if (side > 0) return left && orient2d(eye, sector.last, q) <= 0;
    if (side < 0) return right && orient2d(eye, sector.first, q) >= 0;
    return !DirectionOrder(eye).same(from, q);
  };
  const auto departure = [&](Vec2 q) { return is_taut(q) ? lanes_in_sector(eye, sector, q) : no_lane; };
  look(eye, RotationalSweep::Turn::whole, ranges, SightLines::tangent, extra, departure, seen);
  std::sort(seen.begin(), seen.end());
}

void CornerSight::from_point(Vec2 p, SightLines which, std::optional<Vec2> extra, std::vector<VertexId>& seen) {
  seen.clear();
  for (const Sector& sector : free_sectors(corners_.pieces(), p)) {
    const PlaceRange range = range_of(p, sector);
    const auto departure = [&](Vec2 q) { return lanes_in_sector(p, sector, q); };
    look(p, RotationalSweep::Turn::whole, {&range, 1}, which, extra, departure, seen);
  }
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
}

}  // namespace warren

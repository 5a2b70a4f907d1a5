// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility/sectors_at_corner.hpp"

#include "parallel/polled_sort.hpp"

namespace warren {
namespace {

/// A piece that leaves the point, and how many more polygons lie anticlockwise of it than clockwise.
struct Spoke {
  Vec2 towards;
  int rise;
  PointId end;
};

void add_spokes(const PlanePieces& pieces, std::uint32_t piece, Vec2 at, std::vector<Spoke>& spokes) {
  const Segment s = pieces.segment(piece);
  if (!on_segment(at, s)) return;
  const Piece& p = pieces.pieces()[piece];
  if (!(s.a == at)) spokes.push_back({s.a, -p.rise, p.a});
  if (!(s.b == at)) spokes.push_back({s.b, p.rise, p.b});
}

/// Sorts the spokes, at least one, and calls visit(spoke, next spoke) for the free sectors between them.
template <class Visit>
void visit_free(const PlanePieces& pieces, Vec2 at, std::vector<Spoke>& spokes, const Execution& execution,
                const Visit& visit) {
  const DirectionOrder before(at);
  polled_sort(spokes.begin(), spokes.end(), execution,
              [&](const Spoke& s, const Spoke& t) { return before(s.towards, t.towards); });
  // The depth was taken just anticlockwise of +x: past the first spoke if that is +x, else before all.
  int depth = pieces.depth_beside(at);
  if (spokes[0].towards.y == at.y && spokes[0].towards.x > at.x) depth -= spokes[0].rise;
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    depth += spokes[i].rise;
    if (depth == 0) visit(spokes[i], spokes[(i + 1) % spokes.size()]);
  }
}

}  // namespace

Lanes lanes_in_sector(Vec2 at, const Sector& sector, Vec2 q) {
  if (sector.whole || sector.first == sector.last) return both_lanes;
  const DirectionOrder order(at);
  const int from_first = orient2d(at, sector.first, q);
  const int from_last = orient2d(at, sector.last, q);
  if (from_first == 0 && order.is_low(sector.first) == order.is_low(q)) return left_lane;
  if (from_last == 0 && order.is_low(sector.last) == order.is_low(q)) return right_lane;
  const int turn = orient2d(at, sector.first, sector.last);
  const bool inside = turn > 0   ? from_first > 0 && from_last < 0
                      : turn < 0 ? !(from_last > 0 && from_first < 0)
                                 : from_first > 0;
  return inside ? both_lanes : no_lane;
}

std::vector<Sector> free_sectors(const PlanePieces& pieces, Vec2 at) {
  std::vector<Spoke> spokes;
  if (pieces.grid().box().contains(at)) {
    for (const std::uint32_t piece : pieces.grid().in_cell(pieces.grid().cell_of(at))) {
      add_spokes(pieces, piece, at, spokes);
    }
  }
  std::vector<Sector> sectors;
  if (!spokes.empty()) {
    visit_free(pieces, at, spokes, {}, [&](const Spoke& s, const Spoke& t) {
      sectors.push_back({s.towards, t.towards, false});
    });
  } else if (pieces.depth_beside(at) == 0) {
    sectors.push_back({{}, {}, true});
  }
  return sectors;
}

std::vector<SectorOfPoints> free_sectors_at(const PlanePieces& pieces, PointId at, const Execution& execution) {
  std::vector<Spoke> spokes;
  for (const std::uint32_t piece : pieces.pieces_at(at)) add_spokes(pieces, piece, pieces.points()[at], spokes);
  std::vector<SectorOfPoints> sectors;
  visit_free(pieces, pieces.points()[at], spokes, execution, [&](const Spoke& s, const Spoke& t) {
    sectors.push_back({s.end, t.end});
  });
  return sectors;
}

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
#include "planners/visibility/plane_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/base/error.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/sort.hpp"

namespace warren {
namespace {

constexpr std::size_t pieces_a_look = 1 << 14;

/// All sides and walls as segments between numbered points, as they are given.
struct Sides {
  std::vector<Vec2> ends;          // two a side
  std::vector<std::int32_t> rise;  // one a side
  std::size_t corner_ends = 0;     // the first ends, without those of the bounds

  void add(Vec2 a, Vec2 b, std::int32_t change) {
    if (a == b) return;
    ends.push_back(a);
    ends.push_back(b);
    rise.push_back(change);
  }
};

bool has_area(const Box& box) { return box.width() > 0.0 && box.height() > 0.0; }

Sides sides_of(const PlaneObstacles& obstacles) {
  Sides sides;
  for (std::size_t p = 0; p < obstacles.polygons.size(); ++p) {
    for_each_side(obstacles.polygons[p], [&](Vec2 a, Vec2 b) { sides.add(a, b, 1); });
  }
  for (const Segment& wall : obstacles.walls) sides.add(wall.a, wall.b, 0);
  sides.corner_ends = sides.ends.size();
  if (obstacles.bounds) {
    const Box& box = *obstacles.bounds;
    const int change = has_area(box) ? -1 : 0;  // outside, on the right, counts as a polygon
    for_each_side(box.corners(), [&](Vec2 a, Vec2 b) { sides.add(a, b, change); });
  }
  if (sides.ends.size() >= (std::size_t{1} << 32)) throw InputError("obstacles", "more than 2^31 sides and walls");
  return sides;
}

/// Numbers equal ends alike, in the order in which they first appear; `points` receives the different ones.
std::vector<PointId> number_points(std::span<const Vec2> ends, std::vector<Vec2>& points, const Execution& execution) {
  std::vector<std::uint32_t> order(ends.size());
  std::iota(order.begin(), order.end(), 0U);
  polled_sort(order.begin(), order.end(), execution, [&](std::uint32_t i, std::uint32_t j) {
    return ends[i] == ends[j] ? i < j : is_before(ends[i], ends[j]);
  });
  std::vector<PointId> number(ends.size());  // first of all the first end at the same place
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k % pieces_a_look == 0) execution.check();
    const bool again = k > 0 && ends[order[k]] == ends[order[k - 1]];
    number[order[k]] = again ? number[order[k - 1]] : order[k];
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (i % pieces_a_look == 0) execution.check();
    if (number[i] == i) {
      number[i] = static_cast<PointId>(points.size());
      points.push_back(ends[i]);
    } else {
      number[i] = number[number[i]];
    }
  }
  return number;
}

/// Is the point (at.x + d, at.y + d^2), for all small d > 0, left of a -> b?
bool is_left(const Segment& s, Vec2 at) {
  const int side = orient2d(s.a, s.b, at);
  if (side != 0) return side > 0;
  if (s.a.y != s.b.y) return s.b.y < s.a.y;
  return s.b.x > s.a.x;
}

/// Of two points on one ray from the eye, neither of which is there.
bool is_nearer_on_ray(Vec2 eye, Vec2 p, Vec2 q) {
  if (p.x != q.x) return (p.x < q.x) == (eye.x < q.x);
  return p.y != q.y && (p.y < q.y) == (eye.y < q.y);
}

constexpr double open_sight = std::numeric_limits<double>::infinity();
constexpr double place_margin = 1e-9;    // of places: far above their rounding, far below a range's width
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
std::pair<Vec2, Vec2> view_of(const Box& b) {
  const bool right = b.min.x > 0.0;
  const bool left = b.max.x < 0.0;
  const bool above = b.min.y > 0.0;
  const bool below = b.max.y < 0.0;
  return {{above || (left && !below) ? b.max.x : b.min.x, right || (above && !left) ? b.min.y : b.max.y},
          {below || (left && !above) ? b.max.x : b.min.x, left || (above && !right) ? b.min.y : b.max.y}};
}

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

constexpr double place_doubt = 1e-12;  // places that differ by more are in the directions' order for certain
constexpr std::size_t near_per_poll = 1 << 14;

}  // namespace

PlanePieces::PlanePieces(const PlaneObstacles& obstacles, const Execution& execution) {
  const Sides sides = sides_of(obstacles);
  outside_depth_ = obstacles.bounds && has_area(*obstacles.bounds) ? 1 : 0;
  execution.reserve(sides.rise.size() * 150);
  const std::vector<PointId> number = number_points(sides.ends, points_, execution);
  for (std::size_t i = 0; i < sides.corner_ends; ++i)
    corner_count_ = std::max<std::size_t>(corner_count_, number[i] + 1);
  cut(number, sides.rise, execution);
  execution.reserve((points_.size() + 2 * pieces_.size()) * sizeof(std::uint32_t));
  const auto each = [&](const auto& visit) {
    for (std::uint32_t i = 0; i < pieces_.size(); ++i) {
      if (i % pieces_a_look == 0) execution.check();
      visit(pieces_[i].a, i);
      visit(pieces_[i].b, i);
    }
  };
  at_point_ = items_by_key(points_.size(), each, [&] { execution.check(); });
  std::vector<Segment> segments(pieces_.size());
  for (std::size_t i = 0; i < segments.size(); ++i) segments[i] = segment(static_cast<std::uint32_t>(i));
  grid_ = SegmentGrid(segments, execution);
  grid_.for_each_pair(segments, execution, [&](std::uint32_t i, std::uint32_t j) {
    crosses_ = segments_cross(segments[i], segments[j]);
    return !crosses_;
  });
  sound_depths(execution);
}

/// The places at which segments have to be cut: (segment, point inside it).
RawVector<PlanePieces::Cut> PlanePieces::cuts_of(std::span<const Segment> segments, const Execution& execution) const {
  const SegmentGrid grid(segments, execution);
  RawVector<Cut> cuts;
  std::size_t looks = 0;
  for (std::size_t p = 0; p < points_.size(); ++p) {
    const Vec2 at = points_[p];
    for (const std::uint32_t i : grid.in_cell(grid.cell_of(at))) {
      execution.poll(++looks);  // exact predicates can take microseconds
      if (segments[i].a == at || segments[i].b == at || !on_segment(at, segments[i])) continue;
      push_asked(cuts, {i, static_cast<PointId>(p)}, execution);
    }
  }
  const auto is_earlier = [&](const Cut& c, const Cut& d) {
    if (c.segment != d.segment) return c.segment < d.segment;
    return is_nearer_on_ray(segments[c.segment].a, points_[c.at], points_[d.at]);
  };
  polled_sort(cuts.begin(), cuts.end(), execution, is_earlier);
  return cuts;
}

void PlanePieces::cut(std::span<const PointId> ends, std::span<const std::int32_t> rises, const Execution& execution) {
  std::vector<Segment> segments(rises.size());
  for (std::size_t i = 0; i < segments.size(); ++i) segments[i] = {points_[ends[2 * i]], points_[ends[2 * i + 1]]};
  const RawVector<Cut> cuts = cuts_of(segments, execution);
  RawVector<Piece> pieces;
  execution.reserve((segments.size() + cuts.size()) * sizeof(Piece));
  pieces.reserve(segments.size() + cuts.size());
  auto cut = cuts.begin();
  for (std::uint32_t i = 0; i < segments.size(); ++i) {
    if (i % pieces_a_look == 0) execution.check();
    PointId last = ends[2 * i];
    for (; cut != cuts.end() && cut->segment == i; ++cut) {
      pieces.push_back({last, cut->at, rises[i]});
      last = cut->at;
    }
    pieces.push_back({last, ends[2 * i + 1], rises[i]});
  }
  for (Piece& p : pieces) {
    if (p.a > p.b) p = {p.b, p.a, -p.rise};
  }
  polled_sort(pieces.begin(), pieces.end(), execution,
              [](const Piece& p, const Piece& q) { return p.a != q.a ? p.a < q.a : p.b < q.b; });
  for (const Piece& p : pieces) {
    if (!pieces_.empty() && pieces_.back().a == p.a && pieces_.back().b == p.b) {
      pieces_.back().rise += p.rise;
    } else {
      push_asked(pieces_, p, execution);
    }
  }
}

int PlanePieces::rise_in_cell(SegmentGrid::Cell cell, Vec2 from, Vec2 to) const {
  if (from == to) return 0;
  int rise = 0;
  for (const std::uint32_t piece : grid_.in_cell(cell)) {
    if (pieces_[piece].rise == 0) continue;
    const Segment s = segment(piece);
    const bool meets = from.x == to.x ? (s.a.x <= from.x) != (s.b.x <= from.x) : (s.a.y <= from.y) != (s.b.y <= from.y);
    if (!meets) continue;
    const bool was_left = is_left(s, from);
    if (was_left != is_left(s, to)) rise += was_left ? -pieces_[piece].rise : pieces_[piece].rise;
  }
  return rise;
}

void PlanePieces::sound_depths(const Execution& execution) {
  depth_.resize(grid_.cell_count());
  for (std::uint32_t row = 0; row < grid_.rows(); ++row) {
    execution.check();
    std::int32_t depth = outside_depth_;
    for (std::uint32_t col = 0; col < grid_.cols(); ++col) {
      depth_[grid_.index({col, row})] = depth;
      const double y = grid_.y_line(row);
      depth += rise_in_cell({col, row}, {grid_.x_line(col), y}, {grid_.x_line(col + 1), y});
    }
  }
}

int PlanePieces::depth_beside(Vec2 p) const {
  if (!grid_.box().contains(p)) return outside_depth_;
  const SegmentGrid::Cell cell = grid_.cell_of(p);
  const Vec2 corner{grid_.x_line(cell.col), grid_.y_line(cell.row)};
  const Vec2 below{corner.x, p.y};
  return depth_[grid_.index(cell)] + rise_in_cell(cell, corner, below) + rise_in_cell(cell, below, p);
}

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
  sight_.fill(0.0);
  for (const PlaceRange& r : ranges) {
    const double end = r.last >= r.first ? r.last : r.last + 4.0;
    if (end - r.first >= 4.0 - 2.0 / scale && r.reach == open_sight) return sight_.fill(open_sight);
    const auto first = static_cast<std::size_t>((r.first + 4.0 - place_margin) * scale);
    const auto last = static_cast<std::size_t>((end + 4.0 + place_margin) * scale);
    for (std::size_t i = first; i <= last; ++i) sight_[i % directions] = std::max(sight_[i % directions], r.reach);
  }
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
  if (!(v.to_line > 1e-12 * size)) return seen_.push_back(piece);  // seen end on, or the eye is its end
  v.steep = v.to_line > shallow * norm(v.first) * norm(v.last - v.first);
  const double first = direction_place(v.first) + 4.0;  // so that a margin before place 0 stays positive
  double last = direction_place(v.last) + 4.0;
  if (last < first) last += 4.0;
  v.outer_begin = static_cast<std::size_t>((first - place_margin) * scale);
  v.outer_end = static_cast<std::size_t>((last + place_margin) * scale) + 1;
  v.begin = static_cast<std::size_t>(std::ceil((first + place_margin) * scale));
  v.end = static_cast<std::size_t>(std::floor((last - place_margin) * scale));
  if (v.begin >= v.end) return seen_.push_back(piece);  // too narrow to hide anything
  if (is_hidden(v)) return;
  seen_.push_back(piece);
  hide_behind(v);
}

bool NearPieces::is_hidden(SegmentGrid::Cell cell) const {
  const Box at = pieces_.grid().box_of_cell(cell);
  const Box box{at.min - eye_, at.max - eye_};
  const Vec2 nearest{std::max({box.min.x, -box.max.x, 0.0}), std::max({box.min.y, -box.max.y, 0.0})};
  const double distance = norm(nearest);
  if (!(distance > 0.0)) return false;
  const auto [rightmost, leftmost] = view_of(box);
  const double first = direction_place(rightmost) + 4.0 - place_margin;
  double last = direction_place(leftmost) + 4.0 + place_margin;
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

std::span<const std::uint32_t> NearPieces::look(Vec2 p, std::span<const PlaceRange> ranges, bool upwards) {
  const SegmentGrid& grid = pieces_.grid();
  seen_.clear();
  if (!grid.box().contains(p)) {
    seen_.resize(pieces_.pieces().size());
    std::iota(seen_.begin(), seen_.end(), 0U);
    return seen_;
  }
  if (++epoch_ == 0) {
    std::fill(cell_epoch_.begin(), cell_epoch_.end(), 0);
    std::fill(piece_epoch_.begin(), piece_epoch_.end(), 0);
    epoch_ = 1;
  }
  open(ranges);
  // The range that begins at place 2 stays open: directions just before it may be rounded to it.
  if (upwards) std::fill(sight_.begin() + directions / 2 + 1, sight_.end(), 0.0);
  eye_ = p;
  home_ = grid.cell_of(p);
  next_.clear();
  propose(home_);
  while (!next_.empty()) {
    now_.swap(next_);
    next_.clear();
    for (const SegmentGrid::Cell cell : now_) {
      if (++entered_ % 64 == 0) execution_.check();
      if (is_hidden(cell)) continue;
      for (const std::uint32_t piece : grid.in_cell(cell)) see(piece);
      propose_beyond(cell);
    }
  }
  return seen_;
}

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
  const Vec2 p = pieces.points()[at];
  std::vector<Spoke> spokes;
  for (const std::uint32_t piece : pieces.pieces_at(at)) add_spokes(pieces, piece, p, spokes);
  std::vector<SectorOfPoints> sectors;
  visit_free(pieces, p, spokes, execution, [&](const Spoke& s, const Spoke& t) {
    sectors.push_back({s.end, t.end, is_reflex(p, {s.towards, t.towards, false})});
  });
  return sectors;
}

RotationalSweep::RotationalSweep(const PlanePieces& pieces, const Execution& execution)
    : pieces_(pieces), execution_(execution), event_of_(pieces.points().size(), 0) {}

bool RotationalSweep::same_ray(const Event& e, const Event& f) const {
  return std::abs(e.place - f.place) < place_doubt && DirectionOrder(eye_).same(e.at, f.at);
}

bool RotationalSweep::comes_before(const Event& e, const Event& f) const {
  const DirectionOrder before(eye_);
  if (!before.same(e.at, f.at)) return before(e.at, f.at);
  if (e.at == f.at) return e.id == target && f.id != target;
  return is_nearer_on_ray(eye_, e.at, f.at);
}

std::uint32_t RotationalSweep::event_of(PointId p) {
  const std::uint32_t known = event_of_[p];
  if (known < events_.size() && events_[known].id == p) return known;
  const auto number = static_cast<std::uint32_t>(events_.size());
  const Vec2 at = pieces_.points()[p];
  events_.push_back({at, direction_place(at - eye_), p, none, none, false});
  event_of_[p] = number;
  return number;
}

void RotationalSweep::add_radial_piece(PointId a, PointId b) {
  const Vec2 at_a = pieces_.points()[a];
  const Vec2 at_b = pieces_.points()[b];
  const bool from_eye = at_a == eye_ || at_b == eye_;
  const bool around_eye = !from_eye && !DirectionOrder(eye_).same(at_a, at_b);
  const bool a_is_nearer = at_a == eye_ || (!from_eye && is_nearer_on_ray(eye_, at_a, at_b));
  const auto add = [&](PointId p, Vec2 at, bool is_farther) {
    if (at == eye_ || !is_passed(at)) return;
    Event& event = events_[event_of(p)];
    event.comes_along_a_piece = event.comes_along_a_piece || is_farther;
  };
  add(a, at_a, around_eye || !a_is_nearer);
  add(b, at_b, around_eye || a_is_nearer);
}

void RotationalSweep::add_piece(PointId a, PointId b) {
  const int turn = orient2d(eye_, pieces_.points()[a], pieces_.points()[b]);
  if (turn == 0) return add_radial_piece(a, b);
  if (turn < 0) std::swap(a, b);
  const Segment seen{pieces_.points()[a], pieces_.points()[b]};
  const bool starts = is_passed(seen.a);
  const bool ends = is_passed(seen.b);
  if (!starts && !ends) return;
  const auto number = static_cast<std::uint32_t>(seen_.size());
  seen_.push_back(seen);
  next_start_.push_back(starts ? std::exchange(events_[event_of(a)].starts, number) : none);
  next_end_.push_back(ends ? std::exchange(events_[event_of(b)].ends, number) : none);
  const DirectionOrder order(eye_);
  if (order.is_low(seen.a) && !order.is_low(seen.b)) crossed_at_first_.push_back(number);
}

void RotationalSweep::sort_events() {
  order_.resize(events_.size());
  for (std::uint32_t i = 0; i < order_.size(); ++i) order_[i] = {events_[i].place, i};
  polled_sort(order_.begin(), order_.end(), execution_,
              [](const Turned& t, const Turned& u) { return t.place < u.place; });
  // Runs of places too close to tell are sorted exactly: two points mostly, thousands where corners are collinear.
  const auto before = [&](const Turned& t, const Turned& u) {
    return comes_before(events_[t.event], events_[u.event]);
  };
  for (auto first = order_.begin(), end = first; first != order_.end(); first = end) {
    for (++end; end != order_.end() && end->place - (end - 1)->place <= place_doubt;) ++end;
    if (end - first > 1) polled_sort(first, end, execution_, before);
  }
}

void RotationalSweep::prepare(Vec2 eye, std::span<const std::uint32_t> near, std::optional<Vec2> extra) {
  eye_ = eye;
  events_.clear();
  seen_.clear();
  next_start_.clear();
  next_end_.clear();
  crossed_at_first_.clear();
  for (std::size_t i = 0; i < near.size(); ++i) {
    if (i % near_per_poll == 0) execution_.check();
    add_piece(pieces_.pieces()[near[i]].a, pieces_.pieces()[near[i]].b);
  }
  if (extra && !(*extra == eye)) events_.push_back({*extra, direction_place(*extra - eye), target, none, none, false});
  sort_events();
}

}  // namespace warren

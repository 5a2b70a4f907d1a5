// SPDX-License-Identifier: BSD-3-Clause
#include "planners/vertical_cells/cell_decomposition.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <iterator>
#include <set>

#include "core/base/raw_vector.hpp"
#include "core/plane/geometry.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/sort.hpp"
#include "spatial/obstacles/segment_grid.hpp"

namespace warren {
namespace {

std::string name_of(std::size_t obstacle, std::size_t polygon_count) {
  if (obstacle == ObstacleClash::bounds) return "the bounds";
  if (obstacle < polygon_count) return "polygon " + std::to_string(obstacle);
  return "wall " + std::to_string(obstacle - polygon_count);
}

std::string complaint(std::size_t obstacle, std::size_t other, std::size_t polygon_count) {
  const std::string rule = "; vertical cells need obstacles that touch at most";
  if (obstacle == other) return "crosses itself" + rule;
  if (other == ObstacleClash::bounds) return "reaches out of the bounds" + rule + " their sides";
  const bool overlap = obstacle < polygon_count && other < polygon_count;
  return (overlap ? "overlaps " : "crosses ") + name_of(other, polygon_count) + rule;
}

/// The polygons, and the outside of the bounds as four more.
PolygonSet framed(const PlaneObstacles& obstacles) {
  PolygonSet polygons = obstacles.polygons;
  if (!obstacles.bounds) return polygons;
  const Box& inner = *obstacles.bounds;
  Box outer = inner;
  for (const Vec2 p : polygons.corners) outer.include(p);
  outer = outer.grown(std::max({outer.width(), outer.height(), std::abs(outer.min.x), std::abs(outer.max.y)}));
  for (const Box& side : {Box{outer.min, {inner.min.x, outer.max.y}}, Box{{inner.max.x, outer.min.y}, outer.max},
                          Box{{inner.min.x, outer.min.y}, {inner.max.x, inner.min.y}},
                          Box{{inner.min.x, inner.max.y}, {inner.max.x, outer.max.y}}}) {
    polygons.add(side.corners());
  }
  return polygons;
}

/// The cell is open when the sweep comes to p, or when it leaves it, and p lies between its segments or on them.
bool holds(const CellDecomposition& cells, const VerticalCell& cell, Vec2 p) {
  if (cell.left != no_number && is_before(p, cells.corners[cell.left])) return false;
  if (cell.right != no_number && is_before(cells.corners[cell.right], p)) return false;
  return cells.side(cell.lower, p) >= 0 && cells.side(cell.upper, p) <= 0;
}

constexpr std::size_t corners_per_poll = 4096;
constexpr std::size_t bytes_per_corner = 150;

Segment left_to_right(Vec2 p, Vec2 q) { return is_before(q, p) ? Segment{q, p} : Segment{p, q}; }

/// A segment on the sweep line, a before b, and what lies above it up to the next one.
struct SweepEntry {
  Vec2 a, b;
  std::uint32_t segment;  ///< its number
  std::uint32_t cell;     ///< the open cell above, or none
  std::uint32_t polygon;  ///< the polygon whose inside lies above, or none
};

/// What may change where an entry stays in its place.
struct SweepPlace {
  mutable SweepEntry entry;
};

/// All entries are alike, so that each stays where it was put; a search is for the first of which a test is true, which
/// is false below some place and true above it.
struct ByPlace {
  using is_transparent = void;  // NOLINT(readability-identifier-naming): the standard's name
  bool operator()(const SweepPlace&, const SweepPlace&) const { return false; }
  template <class Test>
  bool operator()(const SweepPlace& place, const Test& test) const {
    return !test(place.entry);
  }
};

/// The segments that a vertical sweep line meets, from bottom to top; the first one is the box's lower side. O(log n) a
/// search, O(1) a step, an insertion or a removal at a known place.
using SweepOrder = std::multiset<SweepPlace, ByPlace>;

/// At a corner the sweep takes the segments that touch it off the line (they end there, or pass through it and go on
/// from there), sorts what goes on to the right by angle, and puts that in their place. Gaps on the left end their
/// cells, gaps on the right begin new ones, and the lines below and above the corner become doors. Segments that lie on
/// each other keep no gap between them. Crossings show where two segments become neighbours (Shamos, Hoey 1976),
/// overlaps where the line would enter one polygon inside another.
class CellSweep {
 public:
  CellSweep(const PlaneObstacles& obstacles, std::span<const Vec2> points, Overlaps overlaps,
            const Execution& execution)
      : obstacles_(obstacles),
        overlaps_(overlaps),
        execution_(execution),
        order_{SweepPlace{{{}, {}, CellDecomposition::floor_segment, no_number, no_number}}} {
    const std::size_t corners = obstacles.polygons.corners.size() + 2 * obstacles.walls.size();
    if (corners >= std::size_t{1} << 31) throw InputError("cells", "expected fewer than 2^31 corners");
    execution.reserve(corners * bytes_per_corner);
    result_.box = box_around(obstacles);
    if (!obstacles.bounds && result_.box.empty()) result_.box = box_around(points);
    result_.corners.reserve(corners);
    result_.segments.reserve(corners - obstacles.walls.size());
    events_.reserve(corners);
    add_polygons();
    add_walls();
    node_of_.assign(result_.segments.size(), order_.end());
  }
  CellDecomposition run() {
    execution_.check();
    polled_sort(events_.begin(), events_.end(), execution_, [](const Event& e, const Event& f) {
      return is_before(e.at, f.at) || (e.at == f.at && e.number < f.number);
    });
    result_.cells.reserve(events_.size() + 1);
    result_.doors.reserve(events_.size());
    order_.begin()->entry.cell = open_cell(CellDecomposition::floor_segment, order_.end());
    result_.cells.front().left = no_number;
    std::size_t polled = 0;
    for (std::size_t first = 0, last = 0; first < events_.size(); first = last) {
      while (last < events_.size() && events_[last].at == events_[first].at) ++last;
      gather(first, last);
      find_touching();
      pass_corner();
      if (last - polled < corners_per_poll) continue;
      execution_.check();
      execution_.advance(last - polled);
      polled = last;
    }
    return std::move(result_);
  }

 private:
  using Node = SweepOrder::const_iterator;
  /// A corner, by its number.
  struct Event {
    Vec2 at;
    std::uint32_t number;
  };

  void add_polygons() {
    const PolygonSet& polygons = obstacles_.polygons;
    result_.corners = polygons.corners;
    polygon_of_.resize(polygons.corners.size());
    side_before_.resize(polygons.corners.size());
    for (std::size_t p = 0; p < polygons.size(); ++p) {
      execution_.poll(p);
      const std::span<const Vec2> corners = polygons[p];
      const bool inside = stands_inside(corners, p);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto number = static_cast<std::uint32_t>(polygons.first[p] + i);
        polygon_of_[number] = static_cast<std::uint32_t>(p);
        side_before_[number] = i == 0 ? polygons.first[p + 1] - 1 : number - 1;
        result_.segments.push_back(left_to_right(corners[i], corners[i + 1 == corners.size() ? 0 : i + 1]));
        if (inside) events_.push_back({corners[i], number});
      }
    }
  }
  void add_walls() {
    for (std::size_t w = 0; w < obstacles_.walls.size(); ++w) {
      execution_.poll(w);
      const Segment& wall = obstacles_.walls[w];
      const Segment s = left_to_right(wall.a, wall.b);
      const auto number = static_cast<std::uint32_t>(result_.corners.size());
      result_.segments.push_back(s);
      for (const Vec2 p : {s.a, s.b}) result_.corners.push_back(p);
      const Vec2 ends[] = {s.a, s.b};
      if (s.a == s.b || !stands_inside(ends, obstacles_.polygons.size() + w)) continue;
      for (const std::uint32_t end : {0U, 1U}) events_.push_back({ends[end], number + end});
    }
  }
  /// Is the obstacle to be reckoned with? Throws ObstacleClash where it lies inside and outside the box.
  bool stands_inside(std::span<const Vec2> corners, std::size_t obstacle) const {
    const Box& box = result_.box;
    const Box own = box_around(corners);
    if (box.contains(own.min) && box.contains(own.max)) return true;
    const bool apart =
        own.max.x <= box.min.x || own.min.x >= box.max.x || own.max.y <= box.min.y || own.min.y >= box.max.y;
    if (!apart) throw ObstacleClash(obstacle, ObstacleClash::bounds, obstacles_.polygons.size());
    return false;
  }

  /// Which segments end and start in this point?
  void gather(std::size_t first, std::size_t last) {
    at_ = events_[first].at;
    corner_ = events_[first].number;
    ending_.clear();
    starting_.clear();
    const auto sides = static_cast<std::uint32_t>(polygon_of_.size());
    for (std::size_t i = first; i < last; ++i) {
      const std::uint32_t number = events_[i].number;
      if (number >= sides) {
        sort_segment(sides + (number - sides) / 2);
      } else {
        sort_segment(number);
        sort_segment(side_before_[number]);
      }
    }
  }
  void sort_segment(std::uint32_t segment) {
    (result_.segments[segment].a == at_ ? starting_ : ending_).push_back(segment);
  }
  void find_touching() {
    touching_.clear();
    Node first;
    if (ending_.empty()) {
      first = order_.lower_bound([&](const SweepEntry& entry) { return side(entry, at_) <= 0; });
    } else {
      first = node_of_[ending_.front()];
      while (side(std::prev(first)->entry, at_) == 0) --first;
    }
    below_ = std::prev(first);
    for (above_ = first; above_ != order_.end() && side(above_->entry, at_) == 0; ++above_) touching_.push_back(above_);
  }
  void pass_corner() {
    const std::uint32_t lower_cell = below_->entry.cell;
    const Node top = touching_.empty() ? below_ : touching_.back();
    const std::uint32_t upper_cell = top->entry.cell;
    const std::uint32_t upper_polygon = top->entry.polygon;
    if (lower_cell != no_number) result_.cells[lower_cell].right = corner_;
    for (const Node n : touching_) {
      if (n->entry.cell != no_number) result_.cells[n->entry.cell].right = corner_;
    }
    sort_starting();
    put_starting();
    open_cells(upper_polygon);
    const Node last = put_.empty() ? below_ : put_.back();
    const Box& box = result_.box;
    const bool on_floor = below_ == order_.begin() && (at_.y == box.min.y || at_.x == box.max.x);
    const bool on_ceiling = above_ == order_.end() && (at_.y == box.max.y || at_.x == box.min.x);
    add_door(lower_cell, below_->entry.cell, false, on_floor);
    add_door(upper_cell, last->entry.cell, true, on_ceiling);
    check_neighbours(below_, put_.empty() ? above_ : put_.front());
    if (!put_.empty()) check_neighbours(last, above_);
  }
  /// Takes over what goes on through the corner, and sorts by angle from below; of segments that lie on each other,
  /// those that leave a polygon first, those that enter one last.
  void sort_starting() {
    const std::size_t begun = starting_.size();
    for (const Node n : touching_) {
      if (!(n->entry.b == at_)) starting_.push_back(n->entry.segment);
    }
    const std::size_t ended = touching_.size() - (starting_.size() - begun);
    if (ended != ending_.size()) clash(ending_.front(), ending_.back());  // crossings are found before they show here
    if (starting_.size() < 2) return;
    const auto rank = [&](std::uint32_t segment) { return is_wall(segment) ? 1 : inside_is_above(segment) ? 2 : 0; };
    polled_sort(starting_.begin(), starting_.end(), execution_, [&](std::uint32_t s, std::uint32_t t) {
      const int turn = orient2d(at_, result_.segments[s].b, result_.segments[t].b);
      if (turn != 0) return turn > 0;
      return rank(s) != rank(t) ? rank(s) < rank(t) : s < t;
    });
  }
  /// Puts starting_ in the place of touching_; nodes are used again.
  void put_starting() {
    put_.clear();
    Node place = below_;
    for (std::size_t i = 0; i < starting_.size(); ++i) {
      const std::uint32_t segment = starting_[i];
      const Segment& s = result_.segments[segment];
      const SweepEntry entry{s.a, s.b, segment, no_number, no_number};
      if (i < touching_.size()) {
        place = touching_[i];
        place->entry = entry;
      } else {
        place = order_.insert(std::next(place), SweepPlace{entry});
      }
      node_of_[segment] = place;
      put_.push_back(place);
    }
    for (std::size_t i = starting_.size(); i < touching_.size(); ++i) order_.erase(touching_[i]);
  }
  /// Opens a cell in each free gap right of the corner. upper_polygon: what lies below above_, on both sides.
  void open_cells(std::uint32_t upper_polygon) {
    std::uint32_t polygon = below_->entry.polygon;
    below_->entry.cell = no_number;
    if (polygon == no_number) {
      below_->entry.cell = open_cell(below_->entry.segment, put_.empty() ? above_ : put_.front());
    }
    for (std::size_t i = 0; i < put_.size(); ++i) {
      SweepEntry& entry = put_[i]->entry;
      polygon = polygon_beyond(polygon, entry.segment);
      entry.polygon = polygon;
      const bool is_last = i + 1 == put_.size();
      const bool is_void = !is_last && orient2d(at_, entry.b, put_[i + 1]->entry.b) == 0;
      if (polygon == no_number && !is_void) entry.cell = open_cell(entry.segment, is_last ? above_ : put_[i + 1]);
    }
    if (polygon == upper_polygon) return;
    const std::uint32_t segment = starting_.empty() ? ending_.back() : starting_.back();
    throw ObstacleClash(owner(segment), polygon != no_number ? polygon : upper_polygon, obstacles_.polygons.size());
  }
  std::uint32_t open_cell(std::uint32_t lower, Node upper_node) {
    constexpr std::array<std::uint32_t, 4> no_doors{no_number, no_number, no_number, no_number};
    result_.cells.push_back({lower, segment_of(upper_node), corner_, no_number, no_doors});
    return static_cast<std::uint32_t>(result_.cells.size() - 1);
  }
  void add_door(std::uint32_t left, std::uint32_t right, bool above, bool shut) {
    if (left == no_number) return;  // blocked on both sides
    if (shut && !obstacles_.bounds) {
      shut = is_flat(result_, obstacles_, result_.cells[left]) || is_flat(result_, obstacles_, result_.cells[right]);
    }
    const auto door = static_cast<std::uint32_t>(result_.doors.size());
    result_.doors.push_back({left, right, corner_, above, shut});
    const std::size_t place = above ? 1 : 0;
    result_.cells[left].doors[2 + place] = door;
    result_.cells[right].doors[place] = door;
  }
  /// Does the upper one stay above the lower one, up to where the first of them ends?
  void check_neighbours(Node lower, Node upper) const {
    if (lower == order_.begin() || upper == order_.end()) return;
    const SweepEntry& low = lower->entry;
    const SweepEntry& high = upper->entry;
    const bool low_ends = is_before(low.b, high.b);
    const int order = low_ends ? -side(high, low.b) : side(low, high.b);
    if (order < 0) clash(low.segment, high.segment);
  }
  /// The polygon above the segment, where `polygon` is the one below it; where polygons are united, one less than the
  /// number of polygons there, which is no_number where there is none.
  std::uint32_t polygon_beyond(std::uint32_t polygon, std::uint32_t segment) const {
    if (is_wall(segment)) return polygon;
    if (overlaps_ == Overlaps::united) return inside_is_above(segment) ? polygon + 1 : polygon - 1;
    const std::uint32_t own = polygon_of_[segment];
    const bool enters = inside_is_above(segment);
    if (enters ? polygon == no_number : polygon == own) return enters ? own : no_number;
    throw ObstacleClash(own, polygon == no_number ? own : polygon, obstacles_.polygons.size());
  }
  [[noreturn]] void clash(std::uint32_t segment, std::uint32_t other) const {
    throw ObstacleClash(owner(segment), owner(other), obstacles_.polygons.size());
  }

  static int side(const SweepEntry& entry, Vec2 p) {
    // The box's lower side is below all: what touches it is asked where that matters.
    return entry.segment == CellDecomposition::floor_segment ? 1 : orient2d(entry.a, entry.b, p);
  }
  bool is_wall(std::uint32_t segment) const { return segment >= polygon_of_.size(); }
  bool inside_is_above(std::uint32_t segment) const { return result_.segments[segment].a == result_.corners[segment]; }
  std::size_t owner(std::uint32_t segment) const {
    if (!is_wall(segment)) return polygon_of_[segment];
    return obstacles_.polygons.size() + segment - polygon_of_.size();
  }
  std::uint32_t segment_of(Node n) const {
    return n == order_.end() ? CellDecomposition::ceiling_segment : n->entry.segment;
  }

  const PlaneObstacles& obstacles_;
  const Overlaps overlaps_;
  const Execution& execution_;
  CellDecomposition result_;
  std::vector<std::uint32_t> polygon_of_;   // of each side
  std::vector<std::uint32_t> side_before_;  // of each polygon's corner: the side that ends there
  std::vector<Node> node_of_;               // of each segment that is on the line
  std::vector<Event> events_;
  SweepOrder order_;

  // About the corner that is being passed:
  Vec2 at_;
  std::uint32_t corner_ = 0;
  std::vector<std::uint32_t> ending_, starting_;  // segments
  std::vector<Node> touching_;                    // from bottom to top
  std::vector<Node> put_;                         // where starting_ went
  Node below_, above_;                            // the neighbours of all that; above_ may be the end
};

/// How far rounding to the nearest point of a grid moves a point at most, in units of the grid.
constexpr double rounding_units = 0.7072;

/// A place where a piece must be cut.
struct PieceCut {
  std::uint32_t piece;
  Vec2 at;
  friend bool operator==(const PieceCut&, const PieceCut&) = default;
};

struct CrossingCuts {
  RawVector<PieceCut> cuts;  ///< some more than once
  bool crossed = false;      ///< is one of them a rounded crossing?
};

Vec2 rounded_crossing(const Segment& p, const Segment& q) {
  const Vec2 along = p.b - p.a;
  const Vec2 other = q.b - q.a;
  const double t = std::clamp(cross(q.a - p.a, other) / cross(along, other), 0.0, 1.0);
  return {std::nearbyint(p.a.x + t * along.x), std::nearbyint(p.a.y + t * along.y)};
}

/// Where pieces still have to be split: at ends that lie inside another one, and at the rounded points of crossings.
/// Throws Stopped at the deadline and the memory limit: crowded pieces have many cuts.
CrossingCuts find_cuts(const std::vector<IntegerPiece>& pieces, const Execution& execution) {
  CrossingCuts found;
  execution.reserve(pieces.size() * sizeof(Segment));
  std::vector<Segment> segments;
  segments.reserve(pieces.size());
  for (const IntegerPiece& p : pieces) segments.push_back({p.a, p.b});
  const auto cut = [&](std::uint32_t piece, Vec2 at) {
    const bool is_end = at == segments[piece].a || at == segments[piece].b;
    if (!is_end) push_asked(found.cuts, {piece, at}, execution);
  };
  SegmentGrid(segments, execution).for_each_pair(segments, execution, [&](std::uint32_t i, std::uint32_t j) {
    const Segment& p = segments[i];
    const Segment& q = segments[j];
    if (segments_cross(p, q)) {
      const Vec2 at = rounded_crossing(p, q);
      const std::size_t before = found.cuts.size();
      cut(i, at);
      cut(j, at);
      found.crossed = found.crossed || found.cuts.size() > before;
      return true;
    }
    for (const Vec2 end : {q.a, q.b}) {
      if (on_segment(end, p)) cut(i, end);
    }
    for (const Vec2 end : {p.a, p.b}) {
      if (on_segment(end, q)) cut(j, end);
    }
    return true;
  });
  return found;
}

constexpr double largest_snapped = 0x1.0p29;
constexpr int most_rounds = 24;
constexpr std::size_t snapped_per_poll = 1 << 14;

/// The least power of two of which `most` times is no less than a size > 0; 1 for 0.
double unit_for(double size, double most) {
  int exponent = 0;
  if (size > 0.0) std::frexp(size / most, &exponent);
  return std::ldexp(1.0, exponent);
}

SnapGrid grid_of(std::span<const Segment> segments) {
  Box box;
  for (const Segment& s : segments) box.include(box_of(s));
  SnapGrid grid;
  if (box.empty()) return grid;
  grid.unit = unit_for(0.5 * std::max(box.width(), box.height()), largest_snapped);
  const auto rounded = [&](double c) { return std::nearbyint(c / grid.unit) * grid.unit; };
  grid.origin = {rounded(0.5 * box.min.x + 0.5 * box.max.x), rounded(0.5 * box.min.y + 0.5 * box.max.y)};
  return grid;
}

Vec2 snapped(const SnapGrid& grid, Vec2 p) {
  return {std::nearbyint((p.x - grid.origin.x) / grid.unit), std::nearbyint((p.y - grid.origin.y) / grid.unit)};
}

/// Splits the pieces at their cuts, in order along each.
std::vector<IntegerPiece> split(const std::vector<IntegerPiece>& pieces, RawVector<PieceCut>& cuts,
                                const Execution& execution) {
  polled_sort(cuts.begin(), cuts.end(), execution, [](const PieceCut& c, const PieceCut& d) {
    return c.piece != d.piece ? c.piece < d.piece : is_before(c.at, d.at);
  });
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  std::vector<IntegerPiece> parts;
  execution.reserve((pieces.size() + cuts.size()) * sizeof(IntegerPiece));
  parts.reserve(pieces.size() + cuts.size());
  auto cut = cuts.begin();
  for (std::uint32_t i = 0; i < pieces.size(); ++i) {
    if (i % snapped_per_poll == 0) execution.check();
    Vec2 from = pieces[i].a;
    for (; cut != cuts.end() && cut->piece == i; ++cut) {
      parts.push_back({from, cut->at, pieces[i].source});
      from = cut->at;
    }
    parts.push_back({from, pieces[i].b, pieces[i].source});
  }
  return parts;
}

/// Turns pieces to run from left to right and drops doubles (the lowest source stays).
void tidy(std::vector<IntegerPiece>& pieces, const Execution& execution) {
  for (IntegerPiece& p : pieces) {
    if (is_before(p.b, p.a)) std::swap(p.a, p.b);
  }
  polled_sort(pieces.begin(), pieces.end(), execution, [](const IntegerPiece& p, const IntegerPiece& q) {
    if (!(p.a == q.a)) return is_before(p.a, q.a);
    return p.b == q.b ? p.source < q.source : is_before(p.b, q.b);
  });
  const auto same = [](const IntegerPiece& p, const IntegerPiece& q) { return p.a == q.a && p.b == q.b; };
  pieces.erase(std::unique(pieces.begin(), pieces.end(), same), pieces.end());
}

constexpr double largest_integer = 0x1.0p45;

/// Appends the ring without corners that equal the one before; a ring that has no room is left empty.
void add_ring(std::vector<Vec2> ring, PolygonSet& to) {
  ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  if (ring.size() < 3) ring.clear();
  to.add(ring);
}

PolygonSet rounded(const PolygonSet& polygons, double unit) {
  PolygonSet result;
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    std::vector<Vec2> ring;
    for (const Vec2 p : polygons[i]) ring.push_back({std::nearbyint(p.x / unit), std::nearbyint(p.y / unit)});
    add_ring(std::move(ring), result);
  }
  return result;
}

/// Piece i is the side that begins at corner i.
std::vector<IntegerPiece> sides_of(const PolygonSet& polygons) {
  std::vector<IntegerPiece> sides;
  sides.reserve(polygons.corners.size());
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    for_each_side(polygons[p], [&](Vec2 a, Vec2 b) {
      sides.push_back({a, b, static_cast<std::uint32_t>(sides.size())});
    });
  }
  return sides;
}

/// Puts the cuts, in the order along their sides, between the sides' ends.
PolygonSet with_cuts(const PolygonSet& polygons, const std::vector<IntegerPiece>& sides, RawVector<PieceCut>& cuts,
                     const Execution& execution) {
  const auto along = [&](const PieceCut& c) {
    return dot(c.at - sides[c.piece].a, sides[c.piece].b - sides[c.piece].a);
  };
  polled_sort(cuts.begin(), cuts.end(), execution, [&](const PieceCut& c, const PieceCut& d) {
    if (c.piece != d.piece) return c.piece < d.piece;
    return along(c) != along(d) ? along(c) < along(d) : is_before(c.at, d.at);
  });
  PolygonSet result;
  auto cut = cuts.begin();
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    std::vector<Vec2> ring;
    for (std::uint32_t i = polygons.first[p]; i < polygons.first[p + 1]; ++i) {
      ring.push_back(polygons.corners[i]);
      for (; cut != cuts.end() && cut->piece == i; ++cut) ring.push_back(cut->at);
    }
    add_ring(std::move(ring), result);
  }
  return result;
}

}  // namespace

ObstacleClash::ObstacleClash(std::size_t obstacle, std::size_t other, std::size_t polygon_count)
    : InputError(name_of(obstacle, polygon_count), complaint(obstacle, other, polygon_count)),
      obstacle_(obstacle),
      other_(other) {}

int CellDecomposition::side(std::uint32_t segment, Vec2 p) const noexcept {
  if (segment == floor_segment) return p.y > box.min.y ? 1 : p.y < box.min.y ? -1 : 0;
  if (segment == ceiling_segment) return p.y > box.max.y ? 1 : p.y < box.max.y ? -1 : 0;
  return orient2d(segments[segment].a, segments[segment].b, p);
}

double CellDecomposition::height(std::uint32_t segment, double x) const noexcept {
  if (segment == floor_segment) return box.min.y;
  if (segment == ceiling_segment) return box.max.y;
  const Segment& s = segments[segment];
  const double width = s.b.x - s.a.x;
  if (!(width > 0.0)) return x > s.a.x ? s.b.y : s.a.y;
  const double y = s.a.y + (x - s.a.x) / width * (s.b.y - s.a.y);
  return std::clamp(y, std::min(s.a.y, s.b.y), std::max(s.a.y, s.b.y));
}

Segment CellDecomposition::door_line(std::uint32_t door) const {
  const Vec2 corner = corners[doors[door].corner];
  const Vec2 far{corner.x, height(far_segment(door), corner.x)};
  return doors[door].above ? Segment{corner, far} : Segment{far, corner};
}

CellDecomposition decompose(const PlaneObstacles& given, std::span<const Vec2> points, const Execution& execution,
                            Overlaps overlaps) {
  PlaneObstacles united;
  if (overlaps == Overlaps::united) {
    assert(given.walls.empty());
    united.polygons = node_polygons(framed(given), execution).polygons;
  }
  const PlaneObstacles& obstacles = overlaps == Overlaps::united ? united : given;
  CellDecomposition cells = CellSweep(obstacles, points, overlaps, execution).run();
  for (const Vec2 p : points) cells.places.push_back(locate(cells, obstacles, p, execution));
  return cells;
}

CellPlace locate(const CellDecomposition& cells, const PlaneObstacles& obstacles, Vec2 p, const Execution& execution) {
  if (!cells.box.contains(p)) return {.blocked = true, .cells = {}};
  CellPlace place;
  for (std::size_t i = 0; i < obstacles.polygons.size() && !place.blocked; ++i) {
    execution.poll(i);
    place.blocked = strictly_inside(obstacles.polygons[i], p);
  }
  for (std::uint32_t i = 0; i < cells.cells.size(); ++i) {
    execution.poll(i);
    if (holds(cells, cells.cells[i], p) && !is_flat(cells, obstacles, cells.cells[i])) place.cells.push_back(i);
  }
  return place;
}

bool is_flat(const CellDecomposition& cells, const PlaneObstacles& obstacles, const VerticalCell& cell) {
  const bool on_floor = cell.lower == CellDecomposition::floor_segment;
  const bool on_ceiling = cell.upper == CellDecomposition::ceiling_segment;
  if (on_floor == on_ceiling) return false;
  const std::uint32_t segment = on_floor ? cell.upper : cell.lower;
  const bool is_wall = segment >= obstacles.polygons.corners.size();
  const Segment& s = cells.segments[segment];
  const Box& box = cells.box;
  if (!obstacles.bounds && (!is_wall || side_under(s, box) == BoxSide::none)) return false;
  const double y = on_floor ? box.min.y : box.max.y;
  const double x = on_floor ? box.max.x : box.min.x;
  return (s.a.y == y && s.b.y == y) || (s.a.x == x && s.b.x == x);
}

SnappedSegments snap_segments(std::span<const Segment> segments, const Execution& execution) {
  if (segments.size() >= std::size_t{1} << 31) throw InputError("medial axis", "expected fewer than 2^31 segments");
  execution.reserve(segments.size() * 2 * sizeof(IntegerPiece));
  SnappedSegments result{grid_of(segments), {}, 0.0};
  std::vector<IntegerPiece>& pieces = result.segments;
  pieces.reserve(segments.size());
  bool is_exact = true;
  for (std::size_t i = 0; i < segments.size(); ++i) {
    if (i % snapped_per_poll == 0) execution.check();
    const Vec2 a = snapped(result.grid, segments[i].a);
    const Vec2 b = snapped(result.grid, segments[i].b);
    is_exact = is_exact && result.grid.at(a.x, a.y) == segments[i].a && result.grid.at(b.x, b.y) == segments[i].b;
    pieces.push_back({a, b, static_cast<std::uint32_t>(i)});
  }
  result.error = is_exact ? 0.0 : rounding_units * result.grid.unit;
  for (int round = 0;; ++round) {
    tidy(pieces, execution);
    CrossingCuts found = find_cuts(pieces, execution);
    if (found.cuts.empty()) break;
    if (round == most_rounds) throw InputError("medial axis", "obstacles cross too often within a rounding unit");
    if (found.crossed) result.error += rounding_units * result.grid.unit;
    pieces = split(pieces, found.cuts, execution);
  }
  return result;
}

NodedPolygons node_polygons(const PolygonSet& polygons, const Execution& execution) {
  if (polygons.corners.size() >= std::size_t{1} << 31) throw InputError("union", "expected fewer than 2^31 sides");
  const Box box = box_around(polygons.corners);
  const double unit = unit_for(std::max({-box.min.x, box.max.x, -box.min.y, box.max.y}), largest_integer);
  NodedPolygons result{rounded(polygons, unit), rounding_units * unit};
  for (int round = 0;; ++round) {
    const std::vector<IntegerPiece> sides = sides_of(result.polygons);
    execution.reserve(sides.size() * (sizeof(IntegerPiece) + sizeof(Vec2)));
    CrossingCuts found = find_cuts(sides, execution);
    if (found.cuts.empty()) break;
    if (round == most_rounds) throw InputError("union", "outlines cross too often within a rounding unit");
    if (found.crossed) result.error += rounding_units * unit;
    result.polygons = with_cuts(result.polygons, sides, found.cuts, execution);
  }
  for (Vec2& corner : result.polygons.corners) corner = unit * corner;  // exact: a power of two
  return result;
}

}  // namespace warren

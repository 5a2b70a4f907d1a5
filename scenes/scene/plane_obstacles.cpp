// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/scene/plane_obstacles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <set>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/items_by_key.hpp"
#include "core/plane/geometry.hpp"
#include "parallel/asked_memory.hpp"
#include "parallel/chunks.hpp"
#include "parallel/sort.hpp"

namespace warren {
namespace {

/// Closed rings, one after the other; side i runs from corner i to the next one of its ring.
class RingSides {
 public:
  /// first: the number of each ring's first corner, ascending from 0, and how many corners there are. Refers to these.
  RingSides(std::span<const Vec2> corners, std::span<const std::uint32_t> first)
      : corners_(corners), next_(corners.size()), previous_(corners.size()) {
    for (std::size_t r = 0; r + 1 < first.size(); ++r) {
      for (std::uint32_t i = first[r]; i < first[r + 1]; ++i) {
        next_[i] = i + 1 < first[r + 1] ? i + 1 : first[r];
        previous_[next_[i]] = i;
      }
    }
  }

  std::size_t size() const { return corners_.size(); }
  std::uint32_t next(std::size_t i) const { return next_[i]; }
  std::uint32_t previous(std::size_t i) const { return previous_[i]; }
  Vec2 corner(std::size_t i) const { return corners_[i]; }
  Segment side(std::size_t i) const { return {corners_[i], corners_[next_[i]]}; }
  /// Does the side run with the sweep?
  bool ahead(std::size_t i) const { return is_before(corners_[i], corners_[next_[i]]); }
  /// The end of a side that the sweep reaches first, and the other.
  Vec2 low(std::size_t i) const { return ahead(i) ? corners_[i] : corners_[next_[i]]; }
  Vec2 high(std::size_t i) const { return ahead(i) ? corners_[next_[i]] : corners_[i]; }

  /// Do the sides share more than a corner in which one follows the other?
  bool meet(std::size_t i, std::size_t j) const {
    if (next(i) == j) return fold(j);
    if (next(j) == i) return fold(i);
    return segments_touch(side(i), side(j));
  }
  /// Do they cross, or share more than a point? Where one ends on the other they do not.
  bool cross(std::size_t i, std::size_t j) const {
    const bool in_line = orient2d(low(i), high(i), low(j)) == 0 && orient2d(low(i), high(i), high(j)) == 0;
    if (in_line) return is_before(low(i), high(j)) && is_before(low(j), high(i));
    return segments_cross(side(i), side(j));
  }
  /// Does the ring turn back on itself in corner i?
  bool fold(std::size_t i) const {
    const Vec2 p = corner(previous(i));
    const Vec2 q = corner(next(i));
    return on_segment(q, {p, corner(i)}) || on_segment(p, {corner(i), q});
  }

 private:
  std::span<const Vec2> corners_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> previous_;
};

/// A line swept over closed rings of corners (Shamos, Hoey 1976). It stops at the first contact of two sides that must
/// not meet, and tells at each corner which side lies directly below: O(n log n), exact, whatever the rings: neighbours
/// on the line are compared, and where rings meet first, two neighbours meet. Corners are ordered by x, then y, as if
/// the line leaned a little, so vertical sides and equal x need no rule of their own. Where rings may touch at points,
/// the corners of one place are passed together; that they touch and do not cross there is seen by what is inside: of
/// the sides on the line every second one has the inside above it. The sides on the sweep line, lowest first. They do
/// not cross left of it, or the sweep would have ended.
class RingSweep {
 public:
  static constexpr std::uint32_t no_side = 0xffffffffU;

  /// Refers to both. No ring folds. may_touch: rings may meet at points, from the inside that they bound, which lies
  /// left of their sides.
  RingSweep(const RingSides& rings, const Execution& execution, bool may_touch)
      : rings_(rings),
        execution_(execution),
        may_touch_(may_touch),
        order_(Order{&rings, &contact_, may_touch}),
        place_(rings.size(), order_.end()) {}

  /// Calls visit(corners, below, touched) once the sweep has passed the corners of a place, one where rings may not
  /// touch. below: the side that lies directly below, or no_side; touched: the side that the place lies on, between its
  /// ends, or no_side. The first contact that may not be, where the sweep ended, if there is one. Throws Stopped.
  template <class Visit>
  std::optional<SideContact> run(const Visit& visit) {
    std::vector<std::uint32_t> corners(rings_.size());
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::uint32_t>(i);
    polled_sort(corners.begin(), corners.end(), execution_,
                [&](std::uint32_t i, std::uint32_t j) { return is_before(rings_.corner(i), rings_.corner(j)); });
    std::size_t end = 0;
    std::size_t places = 0;
    for (std::size_t k = 0; k < corners.size(); k = end) {
      execution_.poll(places++);
      const auto here = [&](std::size_t other) { return rings_.corner(corners[other]) == rings_.corner(corners[k]); };
      if (!may_touch_ && k > 0 && here(k - 1)) return SideContact{corners[k - 1], corners[k]};
      for (end = k + 1; may_touch_ && end < corners.size() && here(end);) ++end;
      const std::span<const std::uint32_t> place(corners.data() + k, end - k);
      const std::uint32_t below = pass(place);
      if (contact_) return contact_;
      visit(place, below, touched_);
    }
    return std::nullopt;
  }

 private:
  /// Compares a side that begins in the corner that the line has reached with those on the line.
  struct Order {
    const RingSides* rings;
    std::optional<SideContact>* contact;
    bool may_touch;
    bool operator()(std::uint32_t i, std::uint32_t j) const {
      if (i == j) return false;
      const Vec2 a = rings->low(i);
      const Vec2 b = rings->low(j);
      int side = 0;  // of j, seen from i; 0: one begins on the other
      bool may_meet = true;
      if (is_before(b, a)) {
        side = -orient2d(b, rings->high(j), a);
        if (side == 0 && may_touch) side = -orient2d(b, rings->high(j), rings->high(i));
      } else if (is_before(a, b)) {
        side = orient2d(a, rings->high(i), b);
        if (side == 0 && may_touch) side = orient2d(a, rings->high(i), rings->high(j));
      } else {
        side = orient2d(a, rings->high(i), rings->high(j));
        may_meet = may_touch || rings->next(i) == j || rings->next(j) == i;
      }
      if (side == 0 || !may_meet) *contact = SideContact{i, j};
      return side > 0 || (side == 0 && i < j);
    }
  };
  using Status = std::set<std::uint32_t, Order>;

  /// Takes the sides off that end in the corners and puts those on that begin there. The side below them.
  std::uint32_t pass(std::span<const std::uint32_t> corners) {
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
  void look_around(Vec2 here, Status::iterator lowest) {
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
  void compare(std::uint32_t i, std::uint32_t j) {
    if (!contact_ && (may_touch_ ? rings_.cross(i, j) : rings_.meet(i, j))) contact_ = SideContact{i, j};
  }
  Status::iterator remove(std::uint32_t side) {
    const auto after = order_.erase(place_[side]);
    place_[side] = order_.end();
    if (after != order_.begin() && after != order_.end()) compare(*std::prev(after), *after);
    return after;
  }
  void insert(std::uint32_t side) {
    const auto at = order_.insert(side).first;
    place_[side] = at;
    if (contact_) return;
    if (at != order_.begin()) compare(*std::prev(at), side);
    if (std::next(at) != order_.end()) compare(side, *std::next(at));
  }

  const RingSides& rings_;
  const Execution& execution_;
  bool may_touch_;
  std::optional<SideContact> contact_;
  std::uint32_t touched_ = no_side;
  Status order_;
  std::vector<Status::iterator> place_;
};

/// Cuts a polygon along what ties its holes. The inside lies left of each side: the outer ring runs anticlockwise,
/// holes clockwise. The cuts are found as a line sweeps over the rings: between a side with the inside above it and the
/// next side above lies an open strip; its post is the corner that the line passed last in it (or on the side, or where
/// it opened). Nothing lies between a post and the next corner in the strip, so what joins the two meets no ring, and
/// no two such joins cross.
class HoleCutter {
 public:
  static constexpr std::size_t bytes_a_corner = 192;  // with the rings, a sweep over them and what they are cut into

  /// The outer ring first. Refers to them. Throws Stopped.
  HoleCutter(const PolygonSet& rings, const Execution& execution)
      : corners_(rings.corners),
        rings_(corners_, rings.first),
        posts_(rings_.size()),
        place_(rings_.size(), Place::other),
        one_of_(rings_.size()) {
    for (std::uint32_t i = 0; i < rings_.size(); ++i) add_line(i, rings_.next(i));
    for (std::size_t r = 1; r < rings.size(); ++r) {
      execution.check();
      std::uint32_t low = rings.first[r];
      std::uint32_t high = low;
      for (std::uint32_t i = rings_.next(low); i != rings.first[r]; i = rings_.next(i)) {
        if (is_before(corners_[i], corners_[low])) low = i;
        if (is_before(corners_[high], corners_[i])) high = i;
      }
      place_[low] = Place::leftmost;
      place_[high] = Place::rightmost;
    }
  }

  /// Ties all rings but the first one to what lies left and right of them. False: rings cross, or share more than a
  /// point, or a hole lies outside.
  bool tie_holes(const Execution& execution) {
    RingSweep sweep(rings_, execution, true);
    if (sweep.run([&](auto corners, auto below, auto touched) { pass(corners, below, touched); })) return false;
    const auto split = [&](std::uint32_t side, std::uint32_t corner) {  // what is left of the line is its first part
      add_line(corner, lines_[side].to);
      lines_[side].to = corner;
    };
    for (const auto& [side, corner] : touches_) {
      if (!rings_.ahead(side)) split(side, corner);
    }
    for (auto touch = touches_.rbegin(); touch != touches_.rend(); ++touch) {
      if (rings_.ahead(touch->first)) split(touch->first, touch->second);
    }
    execution.check();
    for (Line& line : lines_) line = {one_of_[line.from], one_of_[line.to]};
    execution.check();
    for (const auto& [from, to] : cuts_) {
      add_line(from, to);
      add_line(to, from);
    }
    return true;
  }

  /// The outlines left of all lines; none where these do not close. Throws Stopped.
  std::vector<std::vector<Vec2>> pieces(const Execution& execution) {
    std::size_t steps = 0;
    const auto each_line = [&](const auto& visit) {
      for (std::uint32_t i = 0; i < lines_.size(); ++i) {
        execution.poll(i);
        visit(lines_[i].from, i);
      }
    };
    const ItemsByKey leaving = items_by_key(corners_.size(), each_line, [&] { execution.check(); });
    std::vector<char> used(lines_.size(), 0);
    std::vector<std::vector<Vec2>> result;
    for (std::uint32_t first = 0; first < lines_.size(); ++first) {
      if (used[first] != 0) continue;
      std::vector<Vec2>& outline = result.emplace_back();
      std::uint32_t line = first;
      do {
        execution.poll(++steps);
        if (used[line] != 0) return {};
        used[line] = 1;
        outline.push_back(corners_[lines_[line].from]);
        line = next_line(line, leaving.of(lines_[line].to));
      } while (line != first);
      if (anticlockwise(outline) != outline) return {};
    }
    return result;
  }

 private:
  struct Line {
    std::uint32_t from, to;
  };
  /// Of holes, where nothing else lies further left or right.
  enum class Place : std::uint8_t { other, leftmost, rightmost };

  /// Corners of one place, where rings touch; below: the side that they lie directly above; touched: the one that they
  /// lie on. Who touches is tied there already.
  void pass(std::span<const std::uint32_t> corners, std::uint32_t below, std::uint32_t touched) {
    const std::uint32_t one = corners.front();
    place_[one] = place_of(corners, touched);
    for (const std::uint32_t corner : corners) one_of_[corner] = one;
    if (touched != RingSweep::no_side) touches_.emplace_back(touched, one);
    if (below != RingSweep::no_side && rings_.ahead(below)) arrive(one, below);
    for (const std::uint32_t corner : corners) {
      const std::uint32_t before = rings_.previous(corner);
      if (rings_.ahead(before)) arrive(one, before);  // ends here, with the inside above it
      if (rings_.ahead(corner)) posts_[corner] = one;
    }
  }

  Place place_of(std::span<const std::uint32_t> corners, std::uint32_t touched) const {
    bool ends = touched != RingSweep::no_side;  // does a side end here, or begin?
    bool begins = ends;
    Place place = Place::other;
    for (const std::uint32_t corner : corners) {
      const bool arrives = rings_.ahead(rings_.previous(corner));
      const bool leaves = rings_.ahead(corner);
      ends = ends || arrives || !leaves;
      begins = begins || leaves || !arrives;
      if (place_[corner] != Place::other) place = place_[corner];
    }
    return (place == Place::leftmost && ends) || (place == Place::rightmost && begins) ? Place::other : place;
  }

  void arrive(std::uint32_t corner, std::uint32_t side) {
    std::uint32_t& post = posts_[side];
    if (place_[corner] == Place::leftmost || place_[post] == Place::rightmost) cuts_.emplace_back(post, corner);
    post = corner;
  }

  void add_line(std::uint32_t from, std::uint32_t to) { lines_.push_back({from, to}); }

  /// Of the lines that leave the end of `arriving`, the first one clockwise of the way back.
  std::uint32_t next_line(std::uint32_t arriving, std::span<const std::uint32_t> leaving) const {
    const Vec2 at = corners_[lines_[arriving].to];
    const Vec2 back = corners_[lines_[arriving].from];
    std::uint32_t best = leaving.front();
    for (const std::uint32_t line : leaving) {
      if (turns_sooner(at, back, corners_[lines_[line].to], corners_[lines_[best].to])) best = line;
    }
    return best;
  }

  /// Going clockwise from `back` around `at`, a full turn for `back` itself, is p met before q?
  static bool turns_sooner(Vec2 at, Vec2 back, Vec2 p, Vec2 q) {
    const auto quarter = [&](Vec2 r) {  // 0: right of the way back; 1: straight on; 2: left of it; 3: the way back
      const int side = orient2d(at, back, r);
      if (side != 0) return side < 0 ? 0 : 2;
      return on_segment(r, {at, back}) || on_segment(back, {at, r}) ? 3 : 1;
    };
    if (quarter(p) != quarter(q)) return quarter(p) < quarter(q);
    return orient2d(at, p, q) < 0;
  }

  const std::vector<Vec2>& corners_;
  RingSides rings_;
  std::vector<std::uint32_t> posts_;  // of the strip above each side; only of sides on the line, with the inside above
  std::vector<Place> place_;
  std::vector<std::uint32_t> one_of_;  // of a corner: the one of its place that stands for all of them
  std::vector<std::pair<std::uint32_t, std::uint32_t>> touches_;  // sides with corners on them, from left to right
  std::vector<std::pair<std::uint32_t, std::uint32_t>> cuts_;
  std::vector<Line> lines_;  // sides, and each cut in both directions
};

/// The sides that two of the pieces have, in opposite directions.
std::vector<Segment> shared_sides(std::span<const std::vector<Vec2>> pieces, const Execution& execution) {
  std::vector<Segment> sides;
  for (const std::vector<Vec2>& piece : pieces) {
    for_each_side(piece, [&](Vec2 a, Vec2 b) {
      push_asked(sides, is_before(a, b) ? Segment{a, b} : Segment{b, a}, execution);
    });
  }
  polled_sort(sides.begin(), sides.end(), execution, [](const Segment& s, const Segment& t) {
    return s.a == t.a ? is_before(s.b, t.b) : is_before(s.a, t.a);
  });
  std::vector<Segment> shared;
  for (std::size_t i = 1; i < sides.size(); ++i) {
    execution.poll(i);
    if (sides[i] == sides[i - 1]) push_asked(shared, sides[i], execution);
  }
  return shared;
}

constexpr std::size_t obstacle_grain = 512;

/// Appends the corners without repetitions, the last one and the first included.
void append_distinct(std::vector<Vec2>& to, const std::vector<Vec2>& corners) {
  const std::size_t begin = to.size();
  std::ranges::unique_copy(corners, std::back_inserter(to));
  while (to.size() > begin + 1 && to.back() == to[begin]) to.pop_back();
}

/// Of three corners at least.
bool has_area(std::span<const Vec2> corners) {
  return std::ranges::any_of(corners.subspan(2), [&](Vec2 p) { return orient2d(corners[0], corners[1], p) != 0; });
}

std::string text_of(Vec2 p) { return fmt::format("{} {}", p.x, p.y); }

/// place(): names the polygon. No two corners in a row are equal.
template <class Place>
void check_outline(std::span<const Vec2> corners, const Execution& execution, const Place& place) {
  if (corners.size() < 3) {
    throw InputError(place(), "a polygon needs at least three different corners", std::to_string(corners.size()));
  }
  if (!has_area(corners)) {
    throw InputError(place(), "this polygon has no area: all its corners lie on one line");
  }
  const auto contact = self_contact(corners, execution);
  if (!contact) return;
  throw InputError(place(),
                   fmt::format("a polygon's outline must not cross or touch itself; the sides from {} and from {} meet",
                               text_of(corners[contact->first]), text_of(corners[contact->second])));
}

void check_corners(const Scene& scene, std::size_t corners) {
  if (corners <= std::numeric_limits<std::uint32_t>::max()) return;
  throw InputError(scene.source, "polygons with 2^32 corners and more are too many");
}

/// The checked outlines of some polygons.
PolygonSet checked_outlines(const Scene& scene, Range range, const Execution& execution) {
  PolygonSet set;
  std::size_t corners = 0;
  for (std::size_t i = range.first; i < range.last; ++i) corners += scene.polygons[i].corners.size();
  execution.reserve(corners * sizeof(Vec2));
  set.corners.reserve(corners);
  for (std::size_t i = range.first; i < range.last; ++i) {
    append_distinct(set.corners, scene.polygons[i].corners);
    check_corners(scene, set.corners.size());
    set.first.push_back(static_cast<std::uint32_t>(set.corners.size()));
    const std::span<Vec2> outline = std::span(set.corners).subspan(set.first[set.first.size() - 2]);
    check_outline(outline, execution, [&] { return place_of_polygon(scene, i); });
    if (runs_clockwise(outline)) std::reverse(outline.begin(), outline.end());
  }
  return set;
}

}  // namespace

std::vector<std::vector<Vec2>> without_holes(const std::vector<Vec2>& outer, std::span<const std::vector<Vec2>> holes,
                                             const Execution& execution) {
  std::size_t corners = outer.size();
  for (const std::vector<Vec2>& hole : holes) corners += hole.size();
  execution.reserve(corners * HoleCutter::bytes_a_corner);
  std::vector<std::vector<Vec2>> rings{anticlockwise(outer)};
  for (const std::vector<Vec2>& hole : holes) {
    execution.poll(rings.size());
    std::vector<Vec2> ring = anticlockwise(hole);
    std::reverse(ring.begin(), ring.end());
    if (ring.size() < 3 || anticlockwise(ring) == ring) return {};  // what has no area can't be turned
    rings.push_back(std::move(ring));
  }
  PolygonSet checked;
  for (const std::vector<Vec2>& ring : rings) {
    if (ring.size() < 3 || self_contact(ring, execution)) return {ring};
    checked.add(ring);
  }
  HoleCutter cutter(checked, execution);
  if (!cutter.tie_holes(execution)) return {};
  return cutter.pieces(execution);
}

void add_without_holes(Scene& scene, std::size_t line, std::vector<Vec2> outer,
                       std::span<const std::vector<Vec2>> holes, const Execution& execution) {
  if (holes.empty()) return push_asked(scene.polygons, {std::move(outer), line}, execution);
  std::vector<std::vector<Vec2>> pieces = without_holes(outer, holes, execution);
  if (pieces.empty()) {
    throw InputError(fmt::format("{}:{}", scene.source, line),
                     "a hole must have an area, lie inside its polygon and meet its outline and other holes in single "
                     "points at most");
  }
  const std::vector<Segment> seams = shared_sides(pieces, execution);
  for (const Segment& seam : seams) push_asked(scene.seams, seam, execution);
  for (std::vector<Vec2>& piece : pieces) push_asked(scene.polygons, {std::move(piece), line}, execution);
}

bool stands_on_seam(const Scene& scene, Vec2 p) {
  return std::any_of(scene.seams.begin(), scene.seams.end(),
                     [&](const Segment& s) { return on_segment(p, s) && !(p == s.a) && !(p == s.b); });
}

std::optional<SideContact> self_contact(std::span<const Vec2> corners, const Execution& execution) {
  constexpr std::size_t few = 24;
  constexpr std::size_t bytes_a_corner = 64;  // with its side on the line; of large ones alone it is asked
  if (corners.size() > 100 * few) execution.reserve(corners.size() * bytes_a_corner);
  const std::uint32_t one_ring[] = {0, static_cast<std::uint32_t>(corners.size())};
  const RingSides outline(corners, one_ring);
  if (outline.size() <= few) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
      for (std::size_t j = i + 1; j < outline.size(); ++j) {
        if (outline.meet(i, j)) return SideContact{i, j};
      }
    }
    return std::nullopt;
  }
  for (std::size_t i = 0; i < outline.size(); ++i) {
    execution.poll(i + 1);
    if (outline.fold(i)) return SideContact{outline.previous(i), i};
  }
  return RingSweep(outline, execution, false).run([](auto, auto, auto) {});
}

std::vector<Vec2> anticlockwise(const std::vector<Vec2>& corners) {
  std::vector<Vec2> outline;
  append_distinct(outline, corners);
  if (outline.size() < 3 || !has_area(outline)) return corners;
  if (runs_clockwise(outline)) std::reverse(outline.begin(), outline.end());
  return outline;
}

std::string place_of_polygon(const Scene& scene, std::size_t polygon) {
  const std::size_t line = scene.polygons[polygon].line;
  return line > 0 ? fmt::format("{}:{}", scene.source, line) : fmt::format("{}: polygon {}", scene.source, polygon);
}

void check_polygons(const Scene& scene, const Execution& execution) {
  for_chunks(scene.polygons.size(), obstacle_grain, execution,
             [&](Range range) { checked_outlines(scene, range, execution); });
}

void check_body(std::span<const Vec2> outline, const std::string& where, const Execution& execution) {
  std::vector<Vec2> corners;
  append_distinct(corners, {outline.begin(), outline.end()});
  check_outline(corners, execution, [&] { return where; });
}

PlaneObstacles plane_obstacles(const Scene& scene, const Execution& execution) {
  PlaneObstacles obstacles;
  const std::vector<PolygonSet> parts =
      parts_of_chunks(scene.polygons.size(), obstacle_grain, execution,
                      [&](Range range) { return checked_outlines(scene, range, execution); });
  std::size_t corners = 0;
  for (const PolygonSet& part : parts) corners += part.corners.size();
  check_corners(scene, corners);
  execution.reserve(corners * sizeof(Vec2) + scene.walls.size() * sizeof(Segment));
  obstacles.polygons.corners.reserve(corners);
  for (const PolygonSet& part : parts) {
    execution.check();
    for (std::size_t i = 0; i < part.size(); ++i) obstacles.polygons.add(part[i]);
  }
  obstacles.walls.reserve(scene.walls.size());
  scene.walls.visit([&](auto walls) {
    for (const auto& wall : walls) {
      execution.poll(obstacles.walls.size());
      obstacles.walls.push_back(wall.segment());
    }
  });
  obstacles.bounds = scene.bounds;
  return obstacles;
}

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// The sides of polygons, the walls and the bounds as pieces that share no points but their ends: wherever a corner or
// a wall's end lies on another side or wall, that one is cut there (exactly: no new point is made), and what lies twice
// on the same place becomes one piece. Only pieces that cross inside both are left as they are; crosses() tells whether
// there are any. Walls of length zero block nothing and are left out.
//
// A piece knows by how much the number of polygons changes across it, and a grid of pieces
// (spatial/obstacles/segment_grid) knows that number at one point of each cell; so a walk inside one cell tells how
// deep inside of polygons a point lies. Without bounds the plane has no end. Build O(n log n + pairs that share a
// cell); 100 bytes a corner.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/base/items_by_key.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "core/plane/geometry.hpp"
#include "core/plane/polygon.hpp"
#include "core/run/execution.hpp"
#include "spatial/obstacles/segment_grid.hpp"

namespace warren {

/// Number of a point where pieces end.
using PointId = std::uint32_t;

struct Piece {
  PointId a;
  PointId b;
  std::int32_t rise;  ///< polygons left of a -> b minus those on its right; outside of the bounds counts as one
};

/// Immutable; any number of threads may read.
class PlanePieces {
 public:
  /// Throws Stopped at the deadline and the memory limit (walls that lie on each other have many cuts), InputError for
  /// 2^31 corners and more.
  PlanePieces(const PlaneObstacles& obstacles, const Execution& execution);

  /// Different points in the order in which they first appear: corners of the polygons, ends of the walls, and then
  /// corners of the bounds that are nothing else.
  std::span<const Vec2> points() const { return points_; }
  /// How many of them are corners of polygons or ends of walls: the first ones.
  std::size_t corner_count() const { return corner_count_; }
  std::span<const Piece> pieces() const { return pieces_; }
  Segment segment(std::uint32_t piece) const { return {points_[pieces_[piece].a], points_[pieces_[piece].b]}; }
  std::span<const std::uint32_t> pieces_at(PointId p) const { return at_point_.of(p); }
  const SegmentGrid& grid() const { return grid_; }
  /// Do pieces cross inside both?
  bool crosses() const { return crosses_; }
  /// In how many polygons does the point lie that is moved from p by (d, d^2) for all small d > 0?
  int depth_beside(Vec2 p) const;

 private:
  struct Cut {
    std::uint32_t segment;
    PointId at;
  };

  RawVector<Cut> cuts_of(std::span<const Segment> segments, const Execution& execution) const;
  void cut(std::span<const PointId> ends, std::span<const std::int32_t> rises, const Execution& execution);
  void sound_depths(const Execution& execution);
  int rise_in_cell(SegmentGrid::Cell cell, Vec2 from, Vec2 to) const;

  std::vector<Vec2> points_;
  std::size_t corner_count_ = 0;
  RawVector<Piece> pieces_;
  ItemsByKey at_point_;
  SegmentGrid grid_;
  RawVector<std::int32_t> depth_;  // beside the lower left corner of each cell
  std::int32_t outside_depth_ = 0;
  bool crosses_ = false;
};

// Which pieces may be seen from a point? Walks outwards over the cells of the pieces' grid and keeps, for each of 512
// ranges of directions, how far one can see at most: a piece that spans a whole range hides all that lies behind it
// there. Cells that are hidden in all their directions are not entered. So a look costs what can be seen (and what
// lies beside it), not what there is.
//
// Directions and distances are rounded here, always towards "may be seen", so the answer is a superset: every piece
// that is met first by some ray in the open ranges is in it. Who needs the truth compares the pieces exactly.

/// A direction's place in [0, 4) anticlockwise from +x, monotone in the angle (error below 1e-14): cheap, no arc
/// tangent. d is not zero.
double direction_place(Vec2 d);

/// Directions from `first` anticlockwise to `last`, by direction_place, and how far one looks there at most.
struct PlaceRange {
  double first;
  double last;
  double reach = std::numeric_limits<double>::infinity();
};
inline constexpr PlaceRange all_round{0.0, 4.0};

/// Scratch of one thread; refers to the pieces and the execution, which must outlive it. 4 bytes a cell and a piece.
class NearPieces {
 public:
  NearPieces(const PlanePieces& pieces, const Execution& execution);
  /// The pieces that may be seen from p within the ranges, and some more; valid until the next call. Outside of the
  /// grid all pieces. Throws Stopped.
  /// upwards: only directions of places in [0, 2], of those in the ranges, are of interest.
  std::span<const std::uint32_t> look(Vec2 p, std::span<const PlaceRange> ranges, bool upwards = false);

 private:
  static constexpr std::size_t directions = 512;
  static constexpr double scale = static_cast<double>(directions) / 4.0;  // ranges of directions a place
  void open(std::span<const PlaceRange> ranges);
  /// A piece as seen from the eye, anticlockwise from first to last.
  struct View {
    Vec2 first, last;
    double to_line;                      ///< cross(first, last) > 0
    bool steep;                          ///< can distances along it be trusted?
    std::size_t begin, end;              ///< ranges that it spans
    std::size_t outer_begin, outer_end;  ///< ranges that it meets
  };

  void see(std::uint32_t piece);
  void hide_behind(const View& v);
  bool is_hidden(const View& v) const;
  bool is_hidden(SegmentGrid::Cell cell) const;
  double sine(const View& v, std::size_t border) const { return cross(unit_[border % directions], v.last - v.first); }
  void propose(SegmentGrid::Cell cell);
  void propose_beyond(SegmentGrid::Cell from);

  const PlanePieces& pieces_;
  const Execution& execution_;
  std::array<double, directions> sight_{};  // how far one can see at most in these directions
  std::array<Vec2, directions> unit_{};     // the direction where each range begins
  RawVector<std::uint32_t> cell_epoch_;
  RawVector<std::uint32_t> piece_epoch_;
  std::uint32_t epoch_ = 0;
  std::uint32_t entered_ = 0;
  Vec2 eye_;
  SegmentGrid::Cell home_{0, 0};
  std::vector<SegmentGrid::Cell> now_;
  std::vector<SegmentGrid::Cell> next_;
  std::vector<std::uint32_t> seen_;
};

// What can be reached from a point along straight lines (Lee's rotational plane sweep, 1978), exactly, with contact
// allowed. A ray turns once around the eye, anticlockwise from +x; the pieces that it crosses inside them are kept in
// order. On each ray that holds ends of pieces these are walked outwards with the lanes on which the way may still run:
// it is stopped by a piece that crosses the ray; an end with a piece on the left
// stops the left lane, one with a piece on the right the right one; where the ray runs along no piece the lanes are
// one. So a way may pass a corner, run along walls and sides, and not slip through where obstacles touch.
//
// O(k log k) for k pieces without crossings; with crossings O(k * pieces crossed by a ray). Only orient2d and
// comparisons of coordinates decide; rounded angles merely sort in advance.

// The contact rule at one point, exactly: the pieces that meet there cut the plane around it into sectors; a path that
// comes in by a sector must go on in the same one. A sector is free if it lies in no polygon and not outside of the
// bounds. A way that leaves along a piece lies on its left or on its right, in two different sectors (at the free end
// of a wall in the same one, which is how a path turns round it).

/// Sides of a ray on which a path may run, as bits. Where the ray runs along no piece they are the same place.
using Lanes = std::uint8_t;
inline constexpr Lanes no_lane = 0;
inline constexpr Lanes left_lane = 1;
inline constexpr Lanes right_lane = 2;
inline constexpr Lanes both_lanes = left_lane | right_lane;

/// Order of the directions from `at`, anticlockwise from +x; directions are given by points that lie in them, not at
/// `at`. Exact.
class DirectionOrder {
 public:
  explicit DirectionOrder(Vec2 at) : at_(at) {}
  bool operator()(Vec2 p, Vec2 q) const {
    const bool p_low = is_low(p);
    const bool q_low = is_low(q);
    return p_low != q_low ? q_low : orient2d(at_, p, q) > 0;
  }
  bool same(Vec2 p, Vec2 q) const { return is_low(p) == is_low(q) && orient2d(at_, p, q) == 0; }
  bool is_low(Vec2 p) const { return p.y < at_.y || (p.y == at_.y && p.x < at_.x); }

 private:
  Vec2 at_;
};

/// The directions from `first` anticlockwise to `last`; the same direction twice: all round, from a piece to itself.
struct Sector {
  Vec2 first;
  Vec2 last;
  bool whole = false;  ///< no piece ends here: all directions, first and last mean nothing
};

/// Is the sector wider than half a turn? Only there do shortest paths bend.
inline bool is_reflex(Vec2 at, const Sector& s) {
  return !s.whole && (s.first == s.last || orient2d(at, s.first, s.last) < 0);
}

/// The lanes of the ray from `at` towards q that lie in the sector.
Lanes lanes_in_sector(Vec2 at, const Sector& sector, Vec2 q);

/// Does the line from `at` towards q, a direction in the closed sector, leave all that is not of the sector on one
/// side? The sector is reflex.
inline bool is_tangent(Vec2 at, const Sector& s, Vec2 q) {
  return orient2d(at, s.first, q) * orient2d(at, s.last, q) >= 0;
}

/// The free sectors around any point, anticlockwise from +x; none strictly inside of polygons and outside of the
/// bounds. O(pieces in the point's cell).
std::vector<Sector> free_sectors(const PlanePieces& pieces, Vec2 at);
/// A sector at an end of pieces, given by the other ends of the pieces that bound it.
struct SectorOfPoints {
  PointId first;
  PointId last;
  bool reflex;  ///< is_reflex()
};
/// The same around an end of pieces, of which there may be many. Throws Stopped.
std::vector<SectorOfPoints> free_sectors_at(const PlanePieces& pieces, PointId at, const Execution& execution);

// The pieces that a sweep's ray crosses inside them, and whether one of them hides a point of the ray. Two kinds:
//   NearestPieces  where no pieces cross their order along the ray never changes, so an indexed binary heap holds the
//                  nearest one on top: insert, remove O(log n), hides O(1).
//   CrossedPieces  where pieces cross there is no such order: a list, tried from the one that hid last. insert, remove
//                  O(1), hides O(n).

// A piece as the eye sees it runs anticlockwise, so the eye is on its left.

/// Does the piece lie between the eye and q, a point whose direction it spans? Not if q is on it.
inline bool lies_before(const Segment& piece, Vec2 q) { return orient2d(piece.a, piece.b, q) < 0; }

/// Is e nearer to the eye than f, along any ray that crosses both? They don't cross.
inline bool is_nearer(const Segment& e, const Segment& f) {
  const int first = orient2d(e.a, e.b, f.a);
  const int last = orient2d(e.a, e.b, f.b);
  if (first <= 0 && last <= 0) return true;
  if (first >= 0 && last >= 0) return false;
  return orient2d(f.a, f.b, e.a) >= 0 && orient2d(f.a, f.b, e.b) >= 0;
}

/// What both kinds keep: the pieces by number, those that are crossed, and where among these each stands.
class HeldPieces {
 public:
  /// Empty again, for pieces 0 .. pieces.size() - 1, which must outlive the use.
  void reset(std::span<const Segment> pieces) {
    pieces_ = pieces;
    held_.clear();
    if (place_.size() < pieces.size()) place_.resize(pieces.size());
  }

 protected:
  void put(std::size_t at, std::uint32_t piece) {
    held_[at] = piece;
    place_[piece] = static_cast<std::uint32_t>(at);
  }

  std::span<const Segment> pieces_;
  std::vector<std::uint32_t> held_;
  std::vector<std::uint32_t> place_;
};

class NearestPieces : public HeldPieces {
 public:
  void insert(std::uint32_t piece) {
    held_.push_back(piece);
    sift_up(held_.size() - 1, piece);
  }
  /// The piece must be there.
  void remove(std::uint32_t piece) {
    const std::size_t at = place_[piece];
    const std::uint32_t last = held_.back();
    held_.pop_back();
    if (at == held_.size()) return;
    if (at > 0 && nearer(last, held_[(at - 1) / 2])) {
      sift_up(at, last);
    } else {
      sift_down(at, last);
    }
  }
  bool hides(Vec2 q) { return !held_.empty() && lies_before(pieces_[held_.front()], q); }

 private:
  bool nearer(std::uint32_t e, std::uint32_t f) const { return is_nearer(pieces_[e], pieces_[f]); }
  void sift_up(std::size_t at, std::uint32_t piece) {
    for (; at > 0 && nearer(piece, held_[(at - 1) / 2]); at = (at - 1) / 2) put(at, held_[(at - 1) / 2]);
    put(at, piece);
  }
  void sift_down(std::size_t at, std::uint32_t piece) {
    for (;;) {
      std::size_t child = 2 * at + 1;
      if (child >= held_.size()) break;
      if (child + 1 < held_.size() && nearer(held_[child + 1], held_[child])) ++child;
      if (!nearer(held_[child], piece)) break;
      put(at, held_[child]);
      at = child;
    }
    put(at, piece);
  }
};

class CrossedPieces : public HeldPieces {
 public:
  void insert(std::uint32_t piece) {
    place_[piece] = static_cast<std::uint32_t>(held_.size());
    held_.push_back(piece);
  }
  void remove(std::uint32_t piece) {
    put(place_[piece], held_.back());
    held_.pop_back();
  }
  bool hides(Vec2 q) {
    for (std::size_t i = 0; i < held_.size(); ++i) {
      if (!lies_before(pieces_[held_[i]], q)) continue;
      std::swap(held_[i], held_.front());
      place_[held_[i]] = static_cast<std::uint32_t>(i);
      place_[held_.front()] = 0;
      return true;
    }
    return false;
  }
};

/// Scratch of one thread; refers to the pieces and the execution, which must outlive it.
class RotationalSweep {
 public:
  /// What visit() is told instead of a point's number where it reaches the extra target.
  static constexpr PointId target = 0xffffffffU;

  RotationalSweep(const PlanePieces& pieces, const Execution& execution);

  /// upwards: the ray turns half round, and stops before -x. near: pieces among which all that are met first by a ray
  /// of interest, in any order. wanted: one byte a point, is it of interest? extra: one more target. departure(q) tells
  /// on which lanes the way towards q may begin (no_lane: q's direction is of no interest). visit(point, lanes on which
  /// the way arrives) is called for what is reached. Throws Stopped.
  template <class Departure, class Visit>
  void run(Vec2 eye, bool upwards, std::span<const std::uint32_t> near, std::span<const std::uint8_t> wanted,
           std::optional<Vec2> extra, const Departure& departure, const Visit& visit) {
    half_ = upwards;
    prepare(eye, near, extra);
    if (pieces_.crosses()) {
      turn(crossed_, wanted, departure, visit);
    } else {
      turn(nearest_, wanted, departure, visit);
    }
  }

 private:
  static constexpr std::uint32_t none = 0xffffffffU;
  static constexpr std::uint32_t rays_per_poll = 64;  // where pieces cross, one asks each of them

  /// An end of pieces, or the extra target.
  struct Event {
    Vec2 at;
    double place;              // direction_place, rounded
    PointId id;                // `target`: the extra target
    std::uint32_t starts;      // first of the pieces that the ray begins to cross here: a linked list
    std::uint32_t ends;        // first of those that it has crossed
    bool comes_along_a_piece;  // the ray runs along a piece just before it
  };

  /// What the events are sorted by.
  struct Turned {
    double place;
    std::uint32_t event;
  };

  void prepare(Vec2 eye, std::span<const std::uint32_t> near, std::optional<Vec2> extra);
  std::uint32_t event_of(PointId p);
  void add_piece(PointId a, PointId b);
  void add_radial_piece(PointId a, PointId b);
  void sort_events();
  bool is_passed(Vec2 p) const { return !half_ || !DirectionOrder(eye_).is_low(p); }
  bool comes_before(const Event& e, const Event& f) const;
  bool same_ray(const Event& e, const Event& f) const;

  template <class Active, class Departure, class Visit>
  void turn(Active& active, std::span<const std::uint8_t> wanted, const Departure& departure, const Visit& visit) {
    active.reset(seen_);
    for (const std::uint32_t piece : crossed_at_first_) active.insert(piece);
    for (std::size_t first = 0, end = 0; first < order_.size(); first = end) {
      bool worth_it = false;
      if (++rays_ % rays_per_poll == 0) execution_.check();
      for (end = first; end < order_.size() && (end == first || same_ray(event(first), event(end))); ++end) {
        for (std::uint32_t p = event(end).ends; p != none; p = next_end_[p]) active.remove(p);
        worth_it = worth_it || event(end).id == target || wanted[event(end).id] != 0;
      }
      if (worth_it) walk(first, end, active, wanted, departure(event(first).at), visit);
      for (std::size_t i = first; i < end; ++i) {
        for (std::uint32_t p = event(i).starts; p != none; p = next_start_[p]) active.insert(p);
      }
    }
  }

  /// Walks outwards along one ray.
  template <class Active, class Visit>
  void walk(std::size_t first, std::size_t end, Active& active, std::span<const std::uint8_t> wanted, Lanes lanes,
            const Visit& visit) const {
    for (std::size_t i = first; i < end && lanes != no_lane; ++i) {
      const Event& e = event(i);
      if (e.id == target) {
        if (!active.hides(e.at)) visit(e.id, lanes);
        continue;
      }
      if (!e.comes_along_a_piece) lanes = both_lanes;
      if (active.hides(e.at)) return;
      if (wanted[e.id] != 0) visit(e.id, lanes);
      if (e.starts != none) lanes &= static_cast<Lanes>(~left_lane);
      if (e.ends != none) lanes &= static_cast<Lanes>(~right_lane);
    }
  }

  const Event& event(std::size_t i) const { return events_[order_[i].event]; }

  const PlanePieces& pieces_;
  const Execution& execution_;
  Vec2 eye_;
  bool half_ = false;  // no events below
  std::uint32_t rays_ = 0;
  std::vector<Event> events_;
  std::vector<Turned> order_;
  std::vector<Segment> seen_;  // pieces that are not seen end on
  std::vector<std::uint32_t> next_start_;
  std::vector<std::uint32_t> next_end_;
  std::vector<std::uint32_t> crossed_at_first_;
  RawVector<std::uint32_t> event_of_;  // a point's event, if events_ says so too: needs no clearing
  NearestPieces nearest_;
  CrossedPieces crossed_;
};

}  // namespace warren

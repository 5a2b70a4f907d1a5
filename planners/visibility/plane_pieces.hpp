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
#include <span>
#include <vector>

#include "core/base/items_by_key.hpp"
#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
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
  void merge(RawVector<Piece>& pieces, const Execution& execution);
  void list_at_points(const Execution& execution);
  void sound_depths(const Execution& execution);
  int rise_across(std::uint32_t piece, Vec2 from, Vec2 to) const;
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
  void enter(SegmentGrid::Cell cell);
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

}  // namespace warren

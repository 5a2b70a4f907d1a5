// SPDX-License-Identifier: BSD-3-Clause
// Which pieces may be seen from a point? Walks outwards over the cells of the pieces' grid and keeps, for each of 512
// ranges of directions, how far one can see at most: a piece that spans a whole range hides all that lies behind it
// there. Cells that are hidden in all their directions are not entered. So a look costs what can be seen (and what
// lies beside it), not what there is.
//
// Directions and distances are rounded here, always towards "may be seen", so the answer is a superset: every piece
// that is met first by some ray in the open ranges is in it. Who needs the truth compares the pieces exactly.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/raw_vector.hpp"
#include "core/base/types.hpp"
#include "planners/pieces/plane_pieces.hpp"

namespace warren {

/// A direction's place in [0, 4) anticlockwise from +x, monotone in the angle (error below 1e-14): cheap, no arc
/// tangent. d is not zero.
double direction_place(Vec2 d);

/// Directions from `first` anticlockwise to `last`, by direction_place.
struct PlaceRange {
  double first;
  double last;
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
  void open(std::span<const PlaceRange> ranges);
  void close_downwards();
  void next_epoch();
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

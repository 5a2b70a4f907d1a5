// SPDX-License-Identifier: BSD-3-Clause
// Is a body free all along a motion? Proved, not sampled. A body tells its clearance at a state (a lower bound of its
// distance to the nearest obstacle; <= 0: collision) and its travel between two states (an upper bound of the length of
// the curve that any of its points follows). The motion is cut in halves: a piece is free when the clearance at its
// middle m exceeds max(travel(a, m), travel(m, b)), since no point of the body gets that far from where it is at m; it
// is blocked when the clearance at m is <= 0; it is refused when the travel is down to the resolution and neither holds
// (refusing is safe; callers count it). After Schwarzer, Saha, Latombe, IEEE Trans. Robotics 21(3), 2005.
//
// Pieces are looked at breadth first, so that blocked motions are known early: a blocked one of N pieces costs some
// log2 N clearances instead of N / 2. They wait in a ring of fixed size, and where that is full a piece is finished
// depth first, which needs no memory at all: no allocation. A free motion of length L that keeps a distance c costs
// about L / c clearances, and at least one.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace warren {

enum class MotionVerdict : std::uint8_t { free, blocked, refused };

namespace detail {

/// Pieces are numbered like the nodes of a heap: 1 is the whole motion, 2 n and 2 n + 1 are the halves of n.
struct MotionPiece {
  double first;
  double middle;
  double last;

  explicit MotionPiece(std::uint32_t number) {
    const std::uint32_t pieces = std::bit_floor(number);
    const double width = 1.0 / pieces;
    first = (number - pieces) * width;
    middle = first + 0.5 * width;
    last = first + width;
  }
};

/// A piece and the parts of the body, a bit each, that are not proved free on it yet.
struct OpenPiece {
  std::uint32_t number;
  std::uint32_t parts;
};

/// First in, first out, of fixed size.
class PieceQueue {
 public:
  bool empty() const { return count_ == 0; }
  bool full() const { return count_ + 2 > pieces_.size(); }
  void push(const OpenPiece& piece) { pieces_[(first_ + count_++) % pieces_.size()] = piece; }
  OpenPiece pop() {
    const OpenPiece piece = pieces_[first_];
    first_ = (first_ + 1) % pieces_.size();
    --count_;
    return piece;
  }

 private:
  std::array<OpenPiece, 256> pieces_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
};

/// Looks at the piece and its parts, depth first; free when all of them are.
template <class Look>
MotionVerdict finish_depth_first(const OpenPiece& begin, const Look& look) {
  const std::uint32_t root = begin.number;
  std::uint32_t piece = root;
  for (;;) {
    bool split = false;
    std::uint32_t parts = begin.parts;
    const MotionVerdict verdict = look(piece, parts, split);
    if (split) {
      piece *= 2;
      continue;
    }
    if (verdict != MotionVerdict::free) return verdict;
    while (piece != root && piece % 2 == 1) piece /= 2;  // right halves end their parents
    if (piece == root) return MotionVerdict::free;
    ++piece;
  }
}

/// The whole motion, breadth first. look(number, parts, split): the verdict on a piece; takes the bits of parts away
/// that its halves need not look at, and says whether they shall be looked at.
template <class Look>
MotionVerdict judge_pieces(std::uint32_t parts, const Look& look) {
  PieceQueue queue;
  queue.push({1, parts});
  while (!queue.empty()) {
    OpenPiece piece = queue.pop();
    if (queue.full()) {
      const MotionVerdict verdict = finish_depth_first(piece, look);
      if (verdict != MotionVerdict::free) return verdict;
      continue;
    }
    bool split = false;
    const MotionVerdict verdict = look(piece.number, piece.parts, split);
    if (verdict == MotionVerdict::free) continue;
    if (!split) return verdict;
    queue.push({2 * piece.number, piece.parts});
    queue.push({2 * piece.number + 1, piece.parts});
  }
  return MotionVerdict::free;
}

inline constexpr std::uint32_t most_pieces = std::uint32_t{1} << 30;

}  // namespace detail

/// clearance(t, enough): of the body at the share t of the motion; may answer anything above `enough` when it is more.
/// travel(t, u): along the motion from share t to share u >= t. resolution: a length > 0. Both ends are looked at only
/// as ends of pieces, so a free verdict includes them.
template <class Clearance, class Travel>
MotionVerdict certified_motion(const Clearance& clearance, const Travel& travel, double resolution) {
  const auto look = [&](std::uint32_t number, std::uint32_t&, bool& split) {
    const detail::MotionPiece piece(number);
    const double before = travel(piece.first, piece.middle);
    const double after = travel(piece.middle, piece.last);
    const double reach = before > after ? before : after;
    const double room = clearance(piece.middle, reach);
    if (room > reach) return MotionVerdict::free;
    if (room <= 0.0) return MotionVerdict::blocked;
    split = reach > resolution && number < detail::most_pieces;
    return MotionVerdict::refused;
  };
  return detail::judge_pieces(1, look);
}

/// The same for a body of up to 32 parts, a bit of `all` each: what is proved of a part on a piece need not be proved
/// again on its halves. look(middle, half, parts): stays each of these parts free from `middle` for `half` to both
/// sides, as shares of the motion? Takes the bits of those away that do; false where one is blocked. finest: the share
/// down to which pieces are halved, > 0.
template <class Look>
MotionVerdict certified_parts(std::uint32_t all, const Look& look, double finest) {
  const auto judge = [&](std::uint32_t number, std::uint32_t& parts, bool& split) {
    const detail::MotionPiece piece(number);
    const double half = piece.last - piece.middle;
    if (!look(piece.middle, half, parts)) return MotionVerdict::blocked;
    if (parts == 0) return MotionVerdict::free;
    split = half > finest && number < detail::most_pieces;
    return MotionVerdict::refused;
  };
  return detail::judge_pieces(all, judge);
}

}  // namespace warren

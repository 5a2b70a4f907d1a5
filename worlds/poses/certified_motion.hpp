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
// depth first, on a stack of fixed size: no allocation. A free motion of length L that keeps a distance c costs about
// L / c clearances, and at least one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace warren {

enum class MotionVerdict : std::uint8_t { free, blocked, refused };

/// Is it free? Counts what is refused.
inline bool proved_free(MotionVerdict verdict, std::uint64_t& refused) {
  if (verdict == MotionVerdict::refused) ++refused;
  return verdict == MotionVerdict::free;
}

/// The shares middle - half .. middle + half of a motion.
struct OpenPiece {
  static constexpr double finest = 0x1p-31;  ///< half of a piece where bits run out

  double middle;
  double half;

  OpenPiece before() const { return {middle - 0.5 * half, 0.5 * half}; }
  OpenPiece after() const { return {middle + 0.5 * half, 0.5 * half}; }
};

/// The whole motion, breadth first. look(piece, split): the verdict on a piece, and, where it is refused, whether it
/// shall be cut.
template <class Look>
MotionVerdict judge_pieces(const Look& look) {
  std::array<OpenPiece, 256> ring;  // first in, first out
  std::array<OpenPiece, 40> stack;  // halves halve at least: one waits on each of 31 levels
  std::size_t first = 0;
  std::size_t last = 0;
  std::size_t top = 0;
  ring[last++] = {0.5, 0.5};
  while (top > 0 || first < last) {
    const bool is_deep = top > 0 || last - first == ring.size();  // what a piece is cut into comes next
    const OpenPiece piece = top > 0 ? stack[--top] : ring[first++ % ring.size()];
    bool split = false;
    const MotionVerdict verdict = look(piece, split);
    if (verdict == MotionVerdict::free) continue;
    if (!split) return verdict;
    if (is_deep) {
      stack[top++] = piece.after();
      stack[top++] = piece.before();
    } else {
      ring[last++ % ring.size()] = piece.before();
      ring[last++ % ring.size()] = piece.after();
    }
  }
  return MotionVerdict::free;
}

/// clearance(t, enough): of the body at the share t of the motion; may answer anything above `enough` when it is more.
/// travel(t, u): along the motion from share t to share u >= t. resolution: a length > 0. Both ends are looked at only
/// as ends of pieces, so a free verdict includes them.
template <class Clearance, class Travel>
MotionVerdict certified_motion(const Clearance& clearance, const Travel& travel, double resolution) {
  const auto look = [&](const OpenPiece& piece, bool& split) {
    const double before = travel(piece.middle - piece.half, piece.middle);
    const double after = travel(piece.middle, piece.middle + piece.half);
    const double reach = before > after ? before : after;
    const double room = clearance(piece.middle, reach);
    if (room > reach) return MotionVerdict::free;
    if (room <= 0.0) return MotionVerdict::blocked;
    split = reach > resolution && piece.half > OpenPiece::finest;
    return MotionVerdict::refused;
  };
  return judge_pieces(look);
}

}  // namespace warren

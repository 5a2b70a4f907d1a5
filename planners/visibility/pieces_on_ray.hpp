// SPDX-License-Identifier: BSD-3-Clause
// The pieces that a sweep's ray crosses inside them, and whether one of them hides a point of the ray. Two kinds:
//   NearestPieces  where no pieces cross their order along the ray never changes, so an indexed binary heap holds the
//                  nearest one on top: insert, remove O(log n), hides O(1).
//   CrossedPieces  where pieces cross there is no such order: a list, tried from the one that hid last. insert, remove
//                  O(1), hides O(n).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/types.hpp"
#include "core/plane/geometry.hpp"

namespace warren {

/// A piece as the eye sees it: anticlockwise from first to last, so the eye is on its left.
struct SeenPiece {
  Vec2 first;
  Vec2 last;
};

/// Does the piece lie between the eye and q, a point whose direction it spans? Not if q is on it.
inline bool lies_before(const SeenPiece& piece, Vec2 q) { return orient2d(piece.first, piece.last, q) < 0; }

/// Is e nearer to the eye than f, along any ray that crosses both? They don't cross.
inline bool is_nearer(const SeenPiece& e, const SeenPiece& f) {
  const int first = orient2d(e.first, e.last, f.first);
  const int last = orient2d(e.first, e.last, f.last);
  if (first <= 0 && last <= 0) return true;
  if (first >= 0 && last >= 0) return false;
  return orient2d(f.first, f.last, e.first) >= 0 && orient2d(f.first, f.last, e.last) >= 0;
}

class NearestPieces {
 public:
  /// Empty again, for pieces 0 .. pieces.size() - 1, which must outlive the use.
  void reset(std::span<const SeenPiece> pieces) {
    pieces_ = pieces;
    heap_.clear();
    if (place_.size() < pieces.size()) place_.resize(pieces.size());
  }
  void insert(std::uint32_t piece) {
    heap_.push_back(piece);
    sift_up(heap_.size() - 1, piece);
  }
  /// The piece must be there.
  void remove(std::uint32_t piece) {
    const std::size_t at = place_[piece];
    const std::uint32_t last = heap_.back();
    heap_.pop_back();
    if (at == heap_.size()) return;
    if (at > 0 && nearer(last, heap_[(at - 1) / 2])) {
      sift_up(at, last);
    } else {
      sift_down(at, last);
    }
  }
  bool hides(Vec2 q) { return !heap_.empty() && lies_before(pieces_[heap_.front()], q); }

 private:
  bool nearer(std::uint32_t e, std::uint32_t f) const { return is_nearer(pieces_[e], pieces_[f]); }
  void put(std::size_t at, std::uint32_t piece) {
    heap_[at] = piece;
    place_[piece] = static_cast<std::uint32_t>(at);
  }
  void sift_up(std::size_t at, std::uint32_t piece) {
    for (; at > 0 && nearer(piece, heap_[(at - 1) / 2]); at = (at - 1) / 2) put(at, heap_[(at - 1) / 2]);
    put(at, piece);
  }
  void sift_down(std::size_t at, std::uint32_t piece) {
    for (;;) {
      std::size_t child = 2 * at + 1;
      if (child >= heap_.size()) break;
      if (child + 1 < heap_.size() && nearer(heap_[child + 1], heap_[child])) ++child;
      if (!nearer(heap_[child], piece)) break;
      put(at, heap_[child]);
      at = child;
    }
    put(at, piece);
  }

  std::span<const SeenPiece> pieces_;
  std::vector<std::uint32_t> heap_;
  std::vector<std::uint32_t> place_;
};

class CrossedPieces {
 public:
  void reset(std::span<const SeenPiece> pieces) {
    pieces_ = pieces;
    list_.clear();
    if (place_.size() < pieces.size()) place_.resize(pieces.size());
  }
  void insert(std::uint32_t piece) {
    place_[piece] = static_cast<std::uint32_t>(list_.size());
    list_.push_back(piece);
  }
  void remove(std::uint32_t piece) {
    const std::uint32_t last = list_.back();
    list_[place_[piece]] = last;
    place_[last] = place_[piece];
    list_.pop_back();
  }
  bool hides(Vec2 q) {
    for (std::size_t i = 0; i < list_.size(); ++i) {
      if (!lies_before(pieces_[list_[i]], q)) continue;
      std::swap(list_[i], list_.front());
      place_[list_[i]] = static_cast<std::uint32_t>(i);
      place_[list_.front()] = 0;
      return true;
    }
    return false;
  }

 private:
  std::span<const SeenPiece> pieces_;
  std::vector<std::uint32_t> list_;
  std::vector<std::uint32_t> place_;
};

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// The hash of walls that follow each other, wall by wall: a chunk of scene_hash()'s, also for whoever holds no walls.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/base/types.hpp"

namespace warren {

/// Two words in one: the halves of their product.
inline std::uint64_t folded_words(std::uint64_t a, std::uint64_t b) {
  __extension__ using Wide = unsigned __int128;
  const Wide product = static_cast<Wide>(a) * b;
  return static_cast<std::uint64_t>(product) ^ static_cast<std::uint64_t>(product >> 64);
}
/// The words of a double, where -0 is 0; never equal to a secret, which are no doubles of a sane size.
inline std::uint64_t hashed_word(double x) { return std::bit_cast<std::uint64_t>(x + 0.0); }

inline constexpr std::uint64_t fold_secret_a = 0xa0761d6478bd642fU;
inline constexpr std::uint64_t fold_secret_b = 0xe7037ed1a0b428dbU;

/// One chunk of walls.
class WallFold {
 public:
  void add(const Segment& s) {
    first_ = folded_words(hashed_word(s.a.x) ^ fold_secret_a, hashed_word(s.a.y) ^ first_);
    second_ = folded_words(hashed_word(s.b.x) ^ fold_secret_b, hashed_word(s.b.y) ^ second_);
  }
  /// walls: how many were added.
  std::uint64_t value(std::size_t walls) const {
    return folded_words(first_ ^ fold_secret_b, second_ ^ fold_secret_a ^ walls);
  }

 private:
  std::uint64_t first_ = fold_secret_a;
  std::uint64_t second_ = fold_secret_b;
};

}  // namespace warren

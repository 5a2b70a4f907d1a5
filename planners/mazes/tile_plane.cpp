// SPDX-License-Identifier: BSD-3-Clause
#include "planners/mazes/tile_plane.hpp"

#include <algorithm>
#include <cmath>

namespace warren {
namespace {

/// First and one past the last local number, ring included, of lattice points inside [low, high] of `count`.
struct Span {
  int first;
  int end;
};

Span standing(double low, double high, std::uint32_t count, std::uint32_t origin, int ring_end) {
  const double first = std::max(0.0, std::ceil(low) - 1);
  const double end = std::min(static_cast<double>(count), std::floor(high));  // points stand at 1 .. count
  const double from = std::clamp(first - origin, -1.0, static_cast<double>(ring_end));
  return {static_cast<int>(from), static_cast<int>(std::clamp(end - origin, from, static_cast<double>(ring_end)))};
}

using plane_bit::edges, plane_bit::kept;
using Byte = std::uint8_t;

// Compilers turn the loops of these functions into vector code of the instruction set of the function that they are
// inlined in.

[[gnu::always_inline]] inline void find_dead_ends(const Byte* __restrict row, Byte* __restrict found, int width) {
  for (int i = 0; i < width; ++i) {
    const auto open = static_cast<Byte>(row[i] & edges);
    const auto more = static_cast<Byte>(open & (open - 1));
    const auto held = static_cast<Byte>(row[i] & kept);
    found[i] = (more | held) == 0 ? open : Byte{0};
  }
}

[[gnu::always_inline]] inline void peel(Byte* __restrict row, Byte* __restrict above, Byte* __restrict below,
                                        Byte* __restrict ends, int width) {
  find_dead_ends(row, ends, width);
  ends[-1] = 0;
  ends[width] = 0;
  for (int i = 0; i < width; ++i) {
    const auto from_left = static_cast<Byte>((ends[i - 1] & plane_bit::right) << 2);
    const auto from_right = static_cast<Byte>((ends[i + 1] & plane_bit::left) >> 2);
    const auto open = static_cast<Byte>(row[i] & ~(from_left | from_right));
    const auto met = static_cast<Byte>(ends[i] & from_right);  // by the dead end on its right: stays, without edges
    row[i] = (ends[i] ^ met) == 0 ? open : Byte{0};
    above[i] = static_cast<Byte>(above[i] & ~((ends[i] & plane_bit::up) << 2));
    below[i] = static_cast<Byte>(below[i] & ~((ends[i] & plane_bit::down) >> 2));
  }
}

[[gnu::always_inline]] inline void find_keys(const Byte* __restrict row, Byte* __restrict found, int width) {
  for (int i = 0; i < width; ++i) {
    const auto open = static_cast<Byte>(row[i] & edges);
    const auto two = static_cast<Byte>(open & (open - 1));
    const auto three = static_cast<Byte>(two & (two - 1));
    const auto held = static_cast<Byte>(row[i] & kept);
    const auto between = static_cast<Byte>((two != 0 ? 255 : 0) & ((three | held) == 0 ? 255 : 0));
    found[i] = static_cast<Byte>(row[i] & ~between);
  }
}

void peel_any(const PlaneRow& r) { peel(r.row, r.above, r.below, r.found, r.width); }
void dead_ends_any(const PlaneRow& r) { find_dead_ends(r.row, r.found, r.width); }
void keys_any(const PlaneRow& r) { find_keys(r.row, r.found, r.width); }

#if defined(__x86_64__) && !defined(WARREN_PLAIN)
[[gnu::target("avx2")]] void peel_avx2(const PlaneRow& r) { peel(r.row, r.above, r.below, r.found, r.width); }
[[gnu::target("avx2")]] void dead_ends_avx2(const PlaneRow& r) { find_dead_ends(r.row, r.found, r.width); }
[[gnu::target("avx2")]] void keys_avx2(const PlaneRow& r) { find_keys(r.row, r.found, r.width); }

[[gnu::target("avx512f,avx512bw,avx512vl")]] void peel_avx512(const PlaneRow& r) {
  peel(r.row, r.above, r.below, r.found, r.width);
}
[[gnu::target("avx512f,avx512bw,avx512vl")]] void dead_ends_avx512(const PlaneRow& r) {
  find_dead_ends(r.row, r.found, r.width);
}
[[gnu::target("avx512f,avx512bw,avx512vl")]] void keys_avx512(const PlaneRow& r) { find_keys(r.row, r.found, r.width); }
#endif

}  // namespace

void TilePlane::reset(std::size_t tile, const Box& box) {
  tile_ = tile;
  std::fill(bytes_.begin(), bytes_.end(), std::uint8_t{0});
  const Span cols = standing(box.min.x, box.max.x, grid_.cols, grid_.first_col(tile), width() + 1);
  const Span rows = standing(box.min.y, box.max.y, grid_.rows, grid_.first_row(tile), height() + 1);
  if (cols.first >= cols.end) return;
  for (int row = rows.first; row < rows.end; ++row) {
    unsigned bits = plane_bit::edges | plane_bit::milestone;
    if (row == rows.first) bits &= ~unsigned{plane_bit::down};
    if (row + 1 == rows.end) bits &= ~unsigned{plane_bit::up};
    std::fill(at(cols.first, row), at(cols.end, row), static_cast<std::uint8_t>(bits));
    *at(cols.first, row) &= static_cast<std::uint8_t>(~plane_bit::left);
    *at(cols.end - 1, row) &= static_cast<std::uint8_t>(~plane_bit::right);
  }
}

PlaneRowVariants plane_row_variants() {
  PlaneRowVariants variants{};
  variants.list[variants.count++] = {"baseline", peel_any, dead_ends_any, keys_any};
#if defined(__x86_64__) && !defined(WARREN_PLAIN)
  if (__builtin_cpu_supports("avx2")) {
    variants.list[variants.count++] = {"AVX2", peel_avx2, dead_ends_avx2, keys_avx2};
  }
  if (__builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl")) {
    variants.list[variants.count++] = {"AVX-512", peel_avx512, dead_ends_avx512, keys_avx512};
  }
#endif
  return variants;
}

const PlaneRowWork& plane_row_work() {
  static const PlaneRowWork fastest = [] {
    const PlaneRowVariants variants = plane_row_variants();
    return variants.list[variants.count - 1];
  }();
  return fastest;
}

}  // namespace warren

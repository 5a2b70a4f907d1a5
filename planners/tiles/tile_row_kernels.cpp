// SPDX-License-Identifier: BSD-3-Clause
// Compilers turn the loops of these functions into vector code of the instruction set of the function that they are
// inlined in.
#include "planners/tiles/tile_row_kernels.hpp"

#include "planners/tiles/tile_plane.hpp"

namespace warren {
namespace {

using plane_bit::edges;
using plane_bit::kept;
using Byte = std::uint8_t;

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

// SPDX-License-Identifier: BSD-3-Clause
// Work compiled for several instruction sets, all with the same answers: compilers turn loops into vector code of the
// set of the function that they are inlined in. What this machine has is asked of it once.
#pragma once

#include <cstdint>

namespace warren::detail {

enum class InstructionSet : std::uint8_t { baseline, avx2, avx512 };

/// The best one that this machine has; avx512: with what it has for bytes, and for shorter vectors.
inline InstructionSet best_instruction_set() noexcept {
#if defined(__x86_64__) && !defined(WARREN_PLAIN)
  static const InstructionSet best = [] {
    const bool has_avx512 = __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
                            __builtin_cpu_supports("avx512vl") != 0;
    if (has_avx512) return InstructionSet::avx512;
    return __builtin_cpu_supports("avx2") != 0 ? InstructionSet::avx2 : InstructionSet::baseline;
  }();
  return best;
#else
  return InstructionSet::baseline;
#endif
}

/// Those of a function that is always inlined.
template <auto work>
struct VersionsOf;

template <class Result, class... A, Result (*work)(A...)>
struct VersionsOf<work> {
  static Result baseline(A... a) { return work(a...); }
#if defined(__x86_64__) && !defined(WARREN_PLAIN)
  [[gnu::target("avx2")]] static Result avx2(A... a) { return work(a...); }
  [[gnu::target("avx512f,avx512bw,avx512vl")]] static Result avx512(A... a) { return work(a...); }
#else
  static Result avx2(A... a) { return work(a...); }
  static Result avx512(A... a) { return work(a...); }
#endif
  /// Where nothing is gained by AVX-512.
  static auto up_to_avx2(InstructionSet set) { return set == InstructionSet::baseline ? &baseline : &avx2; }
};

}  // namespace warren::detail

// SPDX-License-Identifier: BSD-3-Clause
#include "tools/words/build_facts.hpp"

#include <fmt/format.h>

namespace warren::tools {

std::string build_compiler() {
#ifdef __clang__
  const std::string compiler = fmt::format("clang++ {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  const std::string compiler = fmt::format("g++ {}.{}.{}", __GNUC__, __GNUC_MINOR__, __GNUC_PATCHLEVEL__);
#endif
  return fmt::format("{}, {}", compiler, WARREN_BUILD_TYPE);
}

std::string build_instruction_sets() {
#if defined(__x86_64__) && !defined(WARREN_PLAIN)
  std::string text = "x86-64";
#if defined(__AVX512F__)
  text += " with avx512";
#elif defined(__AVX2__)
  text += " with avx2";
#endif
  const bool avx2 = __builtin_cpu_supports("avx2") != 0;
  const bool avx512 = __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0;
  return text + fmt::format("; used on this processor: sse2{}{}", avx2 ? ", avx2" : "", avx512 ? ", avx512" : "");
#elif defined(__x86_64__)
  return "x86-64, plain code alone";
#elif defined(__aarch64__)
  return "arm64, plain code alone";
#else
  return "plain code alone";
#endif
}

}  // namespace warren::tools

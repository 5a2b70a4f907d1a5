// SPDX-License-Identifier: BSD-3-Clause
// How much dear tests ask. WARREN_SEEDS=all: every seed. Else, by day, a share of them, which WARREN_PICK (any string;
// tools/check gives the commit) chooses: without it the first ones. A failure shows its seed, by SCOPED_TRACE;
// WARREN_SEEDS=all asks that one, too. And what builds with sanitizers can't hold: a small memory.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <vector>

namespace warren::test {

inline std::string_view environment(const char* name) {
  const char* value = std::getenv(name);
  return value != nullptr ? value : "";
}

inline bool asks_all() { return environment("WARREN_SEEDS") == "all"; }

/// FNV-1a: the same in every build.
constexpr std::uint64_t hash_of(std::string_view text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  return hash;
}

/// What is expected of all seeds, and by day of whichever are asked.
inline std::uint64_t share(std::uint64_t all, std::uint64_t by_day) { return asks_all() ? all : by_day; }
inline std::uint64_t share(std::uint64_t all) { return share(all, (all + 7) / 8); }

/// So many from the first one on; by day fewer of them one after the other, and after the last the first: of what
/// differs with a seed's remainder there is as much.
inline std::vector<std::uint64_t> seeds(std::uint64_t all, std::uint64_t by_day, std::uint64_t first = 1) {
  const std::string_view pick = environment("WARREN_PICK");
  const std::uint64_t count = asks_all() ? all : by_day;
  const std::uint64_t before = asks_all() || pick.empty() ? 0 : (hash_of(pick) >> 32U) % all;
  std::vector<std::uint64_t> asked;
  for (std::uint64_t i = 0; i < count; ++i) asked.push_back(first + (before + i) % all);
  return asked;
}

inline std::vector<std::uint64_t> seeds(std::uint64_t all) { return seeds(all, (all + 7) / 8); }

/// Does a process hold what warren asks for, and nothing else? Sanitizers hold more than a small limit.
constexpr bool memory_is_ours() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  return false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
  return false;
#else
  return true;
#endif
#else
  return true;
#endif
}

}  // namespace warren::test

// SPDX-License-Identifier: BSD-3-Clause
#include "spatial/points/disc_points.hpp"

#include <bit>
#include <cstring>
#include <limits>

namespace warren::detail {
namespace {

using Lanes4 = std::int32_t __attribute__((vector_size(16)));
using Lanes8 = std::int32_t __attribute__((vector_size(32)));

/// rank[i] = how many keys are smaller than key[i]: two vectors of keys at a time against each key.
template <class Lanes>
[[gnu::always_inline]] inline void count_smaller(const std::int32_t* key, std::size_t count, std::int32_t* rank) {
  constexpr std::size_t width = sizeof(Lanes) / sizeof(std::int32_t);
  for (std::size_t first = 0; first < count; first += 2 * width) {
    Lanes low;
    Lanes high;
    std::memcpy(&low, key + first, sizeof low);
    std::memcpy(&high, key + first + width, sizeof high);
    Lanes below_low{};
    Lanes below_high{};
    for (std::size_t j = 0; j < count; ++j) {
      const Lanes other = Lanes{} + key[j];
      below_low -= other < low;
      below_high -= other < high;
    }
    std::memcpy(rank + first, &below_low, sizeof below_low);
    std::memcpy(rank + first + width, &below_high, sizeof below_high);
  }
}

}  // namespace

std::size_t DiscPoints::sort_roughly(std::size_t k, double scale, InstructionSet set) noexcept {
  for (std::size_t i = 0; i < count; ++i) {
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(square[i] * scale));
    key[i] = as_whole<std::int32_t>((bits & ~index_mask) | as_whole<std::uint32_t>(i));
  }
  for (std::size_t i = count; i < count + padding; ++i) key[i] = std::numeric_limits<std::int32_t>::max();
  const auto count_all = set == InstructionSet::baseline ? &VersionsOf<&count_smaller<Lanes4>>::baseline
                                                         : &VersionsOf<&count_smaller<Lanes8>>::avx2;
  count_all(key, count, rank);
  for (std::size_t i = 0; i < count; ++i) by_rank[rank[i]] = as_whole<std::uint32_t>(i);
  const std::int32_t limit = (key[by_rank[k - 1]] | as_whole<std::int32_t>(index_mask)) + std::int32_t{capacity};
  while (k < count && key[by_rank[k]] <= limit) ++k;
  return k;
}

}  // namespace warren::detail

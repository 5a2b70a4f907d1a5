// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/scene/is_simple_outline.hpp"

#include <cstdint>

#include "scenes/scene/ring_sweep.hpp"

namespace warren {
namespace {

std::optional<SideContact> compare_all(const RingSides& outline) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    for (std::size_t j = i + 1; j < outline.size(); ++j) {
      if (outline.meet(i, j)) return SideContact{i, j};
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<SideContact> self_contact(std::span<const Vec2> corners, const Execution& execution) {
  constexpr std::size_t few = 24;
  constexpr std::uint32_t one_ring[] = {0};
  const RingSides outline(corners, one_ring);
  if (outline.size() <= few) return compare_all(outline);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    if (outline.fold(i)) return SideContact{outline.previous(i), i};
  }
  return RingSweep(outline, execution).run([](auto, auto, auto) {});
}

}  // namespace warren

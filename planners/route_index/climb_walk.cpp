// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_index/climb_walk.hpp"

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "planners/route_index/mark_walk.hpp"

namespace warren {
namespace {

[[noreturn]] void refuse_climb() { throw InputError("route index", "its trees contradict its pieces: build it again"); }

class ClimbWalk : public MarkWalk {
 public:
  using MarkWalk::MarkWalk;

  void begin(const ClimbLeg& leg) {
    to_ = leg.to;
    MarkWalk::begin(leg.from, leg.steps, leg.first, leg.direction);
  }
  void step() {
    const std::uint64_t* const here = row();
    if ((here[mark_word::core] >> col() & 1U) != 0) [[unlikely]]
      refuse_climb();
    write();
    const bool is_inside = go(static_cast<unsigned>(here[mark_word::low] >> col() & 1U) |
                              static_cast<unsigned>(here[mark_word::high] >> col() & 1U) << 1);
    if (!is_inside || (left() == 0 && place() != to_)) [[unlikely]]
      refuse_climb();
  }

 private:
  LatticePlace to_ = 0;
};

}  // namespace

void write_climbs(const RouteIndex& index, std::span<const ClimbLeg> legs, const Execution& execution) {
  constexpr std::size_t grain = 16;
  for_chunks(legs.size(), grain, execution,
             [&](Range r) { walk_side_by_side<ClimbWalk>(index, legs.subspan(r.first, r.size())); });
}

}  // namespace warren

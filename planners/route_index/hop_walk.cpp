// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_index/hop_walk.hpp"

#include <bit>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "planners/route_index/mark_walk.hpp"

namespace warren {
namespace {

[[noreturn]] void refuse_hop() { throw InputError("route index", "its fronts contradict its marks: build it again"); }

class HopWalk : public MarkWalk {
 public:
  using MarkWalk::MarkWalk;

  void begin(const Hop& hop) {
    hop_ = hop;
    came_from_ = 0;
    MarkWalk::begin(hop.from, hop.length, hop.first, hop.direction);
    if (hop.direction > 0) write();
  }
  void step() {
    unsigned onwards = exits() & ~came_from_;
    if ((one_exit >> onwards & 1U) == 0) [[unlikely]]
      onwards = choice(onwards);
    const auto way = static_cast<unsigned>(std::countr_zero(onwards));
    came_from_ = 1U << (way ^ 2U);
    if (!go(way)) [[unlikely]]
      refuse_hop();
    if (hop_.direction < 0 || left() > 0) write();
    if (left() == 0 && place() != hop_.to) refuse_hop();
  }

 private:
  static constexpr unsigned one_exit = 1U << 1 | 1U << 2 | 1U << 4 | 1U << 8;

  /// Chains that leave the cell: its own marks, and those of the neighbours to the left and below.
  unsigned exits() const {
    const std::uint64_t* const here = row();
    const unsigned own = static_cast<unsigned>(here[mark_word::low] >> col() & 1U) |
                         static_cast<unsigned>(here[mark_word::high] >> col() & 1U) << 1;
    if (col() == 0 || is_lowest_row()) [[unlikely]]
      return own | exits_over_the_rim();
    const std::uint64_t* const below = here - mark_word::count;
    return own | static_cast<unsigned>((here[mark_word::low] & here[mark_word::core]) >> (col() - 1) & 1U) << 2 |
           static_cast<unsigned>((below[mark_word::high] & below[mark_word::core]) >> col() & 1U) << 3;
  }
  unsigned exits_over_the_rim() const {
    const LatticePlace at = place();
    const LatticePlaces& places = index_.places();
    return static_cast<unsigned>(places.col(at) > 0 && goes_on(places.step(at, 2), mark_word::low)) << 2 |
           static_cast<unsigned>(places.row(at) > 0 && goes_on(places.step(at, 3), mark_word::high)) << 3;
  }
  bool goes_on(LatticePlace p, std::size_t word) const {
    index_.look_at_tile(p);
    const std::uint64_t* const row = marks_.tile(0) + std::size_t{p / 64} * mark_word::count;
    return (row[word] & row[mark_word::core] & std::uint64_t{1} << p % 64) != 0;
  }
  unsigned choice(unsigned onwards) {
    if (onwards == 0) refuse_hop();
    return next_turn(onwards, hop_.turns);
  }

  Hop hop_{};
  unsigned came_from_ = 0;  // the motion that leads back, as a bit
};

}  // namespace

void write_hops(const RouteIndex& index, std::span<const Hop> hops, const Execution& execution) {
  constexpr std::size_t grain = 512;
  for_chunks(hops.size(), grain, execution,
             [&](Range r) { walk_side_by_side<HopWalk>(index, hops.subspan(r.first, r.size())); });
}

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
#include "planners/route_index/front_unpacking.hpp"

#include <algorithm>
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

namespace {

[[noreturn]] void refuse_front() {
  throw InputError("route index", "its fronts contradict each other: build it again");
}

}  // namespace

void FrontUnpacking::write(std::span<const FrontStep> steps, CellId* cells, const Execution& execution) {
  todo_.clear();
  hops_.clear();
  for (const FrontStep& step : steps) {
    const auto [low, high] = std::minmax(step.from, step.to);
    const Front& front = index_.front(step.front);
    todo_.push_back({&front, place_in(front, low, high), low, high, step.length, step.from > step.to, cells});
    cells += step.length;
  }
  if (!steps.empty()) *cells = index_.places().cell_of(index_.gate_place(steps.back().to));
  while (!todo_.empty()) {  // ranks become less
    read_ways();
    find_halves();
    open_halves();
  }
  // Along the path neighbours share tiles.
  std::sort(hops_.begin(), hops_.end(), [](const Hop& a, const Hop& b) { return a.first < b.first; });
  write_hops(index_, hops_, execution);
}

/// What goes over a gate becomes a middle.
void FrontUnpacking::read_ways() {
  middles_.clear();
  for (const Entry& entry : todo_) {
    if (entry.length == 0) refuse_front();  // a hop without steps would write beside its cells
    const std::uint64_t way = front_way(fronts_, *entry.front, entry.place);
    if ((way & 1U) != 0) {
      hops_.push_back({index_.gate_place(entry.low), index_.gate_place(entry.high), entry.length,
                       entry.downwards ? -1 : 1, way / 2, entry.downwards ? entry.cells + entry.length : entry.cells});
      continue;
    }
    const std::uint64_t below = way / 2;
    if (below == 0 || below > entry.low) refuse_front();
    const GateRank gate = entry.low - static_cast<GateRank>(below);
    index_.prefetch_front_of(gate);
    middles_.push_back({entry, gate, nullptr, 0, 0});
  }
}

void FrontUnpacking::find_halves() {
  for (Middle& middle : middles_) {
    middle.front = &index_.front(index_.front_of(middle.gate));
    __builtin_prefetch(fronts_.bounds.data() + middle.front->first_bound);
  }
  for (Middle& middle : middles_) {
    middle.low = place_in(*middle.front, middle.gate, middle.whole.low);
    middle.high = place_in(*middle.front, middle.gate, middle.whole.high);
    for (const std::uint64_t place : {middle.low, middle.high}) {
      const std::uint64_t length = middle.front->first_length() + place;
      if (middle.front->is_short()) {
        __builtin_prefetch(fronts_.short_lengths.data() + length);
      } else {
        __builtin_prefetch(fronts_.lengths.data() + length);
      }
      __builtin_prefetch(fronts_.ways.data() + middle.front->first_way() + place * middle.front->way_elements());
    }
  }
}

void FrontUnpacking::open_halves() {
  todo_.clear();
  for (const Middle& middle : middles_) {
    const Entry& whole = middle.whole;
    const std::uint32_t to_low = front_entry(fronts_, *middle.front, middle.low);
    const std::uint32_t to_high = front_entry(fronts_, *middle.front, middle.high);
    if (to_low + to_high != whole.length) refuse_front();
    CellId* const low_cells = whole.downwards ? whole.cells + to_high : whole.cells;
    CellId* const high_cells = whole.downwards ? whole.cells : whole.cells + to_low;
    todo_.push_back({middle.front, middle.low, middle.gate, whole.low, to_low, !whole.downwards, low_cells});
    todo_.push_back({middle.front, middle.high, middle.gate, whole.high, to_high, whole.downwards, high_cells});
  }
}

/// Of the entry between a gate of the front and a gate of higher rank.
std::uint64_t FrontUnpacking::place_in(const Front& front, GateRank gate, GateRank other) const {
  const std::uint64_t column = front_column(fronts_, front, other);
  if (column == std::uint64_t{front.gates} + front.bounds) refuse_front();
  return front_place(front, gate - front.first, column);
}

}  // namespace warren

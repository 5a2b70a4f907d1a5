// SPDX-License-Identifier: BSD-3-Clause
#include "planners/lengths/route_index.hpp"

#include <algorithm>
#include <bit>
#include <span>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "planners/lengths/separator_fronts.hpp"
#include "planners/lengths/tree_routes.hpp"

namespace warren {
namespace {

[[noreturn]] void refuse_length() {
  throw InputError("route index", "a way in it is longer than the lattice, or than its parts: build it again");
}

/// Where the entry of a front for gate i of it and column j > i, its gates, then its bounds, stands in the front.
std::uint64_t front_place(const Front& f, std::uint64_t i, std::uint64_t j) {
  return row_offset(i, f.gates, f.bounds) + (j - i - 1);
}

/// The length that stands there.
std::uint32_t front_entry(const FrontArrays& fronts, const Front& f, std::uint64_t place) {
  const std::uint64_t at = f.first_length() + place;
  if (!f.is_short()) return fronts.lengths[at];
  return fronts.short_lengths[at] == no_short_way ? no_way : fronts.short_lengths[at];
}

/// Column of a gate or a bound of a front, its width if it is neither.
std::uint64_t front_column(const FrontArrays& fronts, const Front& f, GateRank rank) {
  const std::uint64_t width = std::uint64_t{f.gates} + f.bounds;
  if (rank < f.first) return width;
  if (rank - f.first < f.gates) return rank - f.first;
  const std::span<const GateRank> bounds = fronts.bounds.span().subspan(f.first_bound, f.bounds);
  const auto at = std::lower_bound(bounds.begin(), bounds.end(), rank);
  if (at == bounds.end() || *at != rank) return width;
  return f.gates + static_cast<std::uint64_t>(at - bounds.begin());
}

[[noreturn]] void refuse_front() {
  throw InputError("route index", "its fronts contradict each other: build it again");
}

[[noreturn]] void refuse_hop() { throw InputError("route index", "its fronts contradict its marks: build it again"); }

/// A cell that was seen. Steps and the cell it was seen from.
struct SeenCell {
  LatticePlace place;
  std::uint32_t steps;
  std::uint32_t from;  ///< number of a seen cell, its own for the first
};

/// A gate that a search came to.
struct SeenGate {
  GateRank rank;
  std::uint32_t steps;
  LatticePlace place;
};

/// A breadth-first search of the core, cell by cell, that stops at gates: it sees the chain or the leaf that it begins
/// in and nothing else, some hundred cells. Gates come in the order of their distance. Scratch of one thread.
class CoreSearch {
 public:
  explicit CoreSearch(const RouteIndex& index) : index_(index), slots_(1024) {}

  /// Everything that is reached from `start` without passing a gate. A start that is a gate is only itself.
  void search(LatticePlace start) {
    const LatticePlaces& places = index_.places();
    if (places.col(start) >= places.size().cols || places.row(start) >= places.size().rows) {
      throw InputError("route index", "a cell of it lies outside the lattice: build it again");
    }
    index_.look_at_tile(start);
    if (++search_ == 0) {  // after 2^32 searches
      std::fill(slots_.begin(), slots_.end(), Slot{});
      search_ = 1;
    }
    seen_.assign(1, {start, 0, 0});
    gates_.clear();
    enter(start, 0);
    for (std::uint32_t i = 0; i < seen_.size(); ++i) {
      if (index_.is_gate(seen_[i].place)) {
        gates_.push_back({index_.gate_at(seen_[i].place), seen_[i].steps, seen_[i].place});
      } else {
        expand(i);
      }
    }
  }

  std::span<const SeenGate> gates() const { return gates_; }
  /// By no gate but the two ends; no_way: it was not seen.
  std::uint32_t steps_to(LatticePlace p) const {
    const Slot& slot = slots_[slot_of(p)];
    return slot.search == search_ ? seen_[slot.number].steps : no_way;
  }
  /// Writes the cells on the way from the start, not included, to a seen cell, included: each as many places from
  /// `start` as it is steps from the start, in `direction`, 1 or -1.
  void write_way(LatticePlace to, CellId* start, int direction) const {
    for (std::uint32_t i = slots_[slot_of(to)].number; i != 0; i = seen_[i].from) {
      start[std::ptrdiff_t{direction} * seen_[i].steps] = index_.places().cell_of(seen_[i].place);
    }
  }

 private:
  void expand(std::uint32_t number) {
    const SeenCell at = seen_[number];
    const LatticePlaces& places = index_.places();
    for (unsigned open = index_.passages().open_at(places.col(at.place), places.row(at.place)); open != 0;
         open &= open - 1) {
      const LatticePlace next = places.step(at.place, static_cast<unsigned>(std::countr_zero(open)));
      if (next == seen_[at.from].place) continue;
      if (LatticePlaces::tile_of(next) != LatticePlaces::tile_of(at.place)) {
        index_.look_at_tile(next);
        index_.marks().prefetch_tile(LatticePlaces::tile_of(next));
      }
      if (!index_.marks().is_core(next) || !enter(next, static_cast<std::uint32_t>(seen_.size()))) continue;
      seen_.push_back({next, at.steps + 1, number});
    }
  }
  bool enter(LatticePlace p, std::uint32_t number) {
    if (2 * seen_.size() > slots_.size()) grow();
    Slot& slot = slots_[slot_of(p)];
    if (slot.search == search_) return false;
    slot = {search_, number};
    return true;
  }
  /// Where the cell stands, or where it may: a slot of an earlier search.
  std::size_t slot_of(LatticePlace p) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t slot = (p * std::uint64_t{0x9e3779b97f4a7c15U} >> 32) & mask;
    while (slots_[slot].search == search_ && seen_[slots_[slot].number].place != p) slot = (slot + 1) & mask;
    return slot;
  }
  void grow() {
    slots_.assign(2 * slots_.size(), Slot{});
    for (std::uint32_t i = 0; i < seen_.size(); ++i) slots_[slot_of(seen_[i].place)] = {search_, i};
  }

  const RouteIndex& index_;
  std::vector<SeenCell> seen_;
  std::vector<SeenGate> gates_;
  /// Open addressing: number of a seen cell and in which search; at most half full.
  struct Slot {
    std::uint32_t search = 0;
    std::uint32_t number = 0;
  };
  std::vector<Slot> slots_;
  std::uint32_t search_ = 0;
};

/// One entry of a front that a way uses, in the order of the way.
struct FrontStep {
  FrontId front;
  GateRank from;
  GateRank to;
  std::uint32_t length;
};

/// The shortest way between two sets of gates, by climbing the fronts from both: a front's gates are settled one after
/// the other, each lessens the later ones and the bounds by its row, and then it is the parent's turn. A shortest way
/// has a highest gate, which both climbs settle with its exact distance. A gate no nearer than the best way found so
/// far needs no row. The arrays read are those of the fronts above both sets, each once. Scratch of one thread: 8 bytes
/// a gate.
class FrontQuery {
 public:
  explicit FrontQuery(const RouteIndex& index) : index_(index), fronts_(index.arrays().fronts) {
    forward_.distance.assign(fronts_.gate_place.size(), no_way);
    backward_.distance.assign(fronts_.gate_place.size(), no_way);
  }

  /// first and last: indices into starts and goals, where the way begins and ends.
  struct Way {
    std::uint32_t length;
    std::size_t first;
    std::size_t last;
    std::vector<FrontStep> steps;  ///< none if it begins and ends at one gate
  };
  /// The least sum of steps to a start gate, length, steps from a goal gate, if it is less than `below`; else `below`.
  /// Each set's gates bound one leaf or are one gate. traced: with the way itself, where it is less.
  Way way(std::span<const SeenGate> starts, std::span<const SeenGate> goals, std::uint32_t below, bool traced) {
    best_ = below;
    climb(starts, goals);
    Way way{best_, 0, 0, {}};
    if (traced && best_ < below) {
      way.first = trace(forward_, starts, meeting_, way.steps);
      std::reverse(way.steps.begin(), way.steps.end());
      std::vector<FrontStep> down;
      way.last = trace(backward_, goals, meeting_, down);
      for (const FrontStep& step : down) way.steps.push_back({step.front, step.to, step.from, step.length});
    }
    clear(forward_, starts);
    clear(backward_, goals);
    return way;
  }

 private:
  /// What one of both climbs knows.
  struct Half {
    RawVector<std::uint32_t> distance;  // of a gate, no_way where it wasn't reached
    RawVector<std::uint32_t> bounds;    // those of the bounds of the front that is settled
    std::vector<FrontId> climbed;
  };

  FrontId seed(Half& half, std::span<const SeenGate> seeds) const {
    half.climbed.clear();
    GateRank lowest = ~GateRank{0};
    for (const SeenGate& gate : seeds) {
      half.distance[gate.rank] = gate.steps;
      lowest = std::min(lowest, gate.rank);
    }
    return seeds.empty() ? no_front : index_.front_of(lowest);
  }
  void climb(std::span<const SeenGate> starts, std::span<const SeenGate> goals) {
    FrontId up = seed(forward_, starts);
    FrontId down = seed(backward_, goals);
    Half* const halves[] = {&forward_, &backward_};
    const std::span<Half* const> both(halves);
    while (up != no_front && down != no_front) {
      const FrontId front = std::min(up, down);
      settle(front, up == down ? both : up < down ? both.first(1) : both.last(1));
      const FrontId parent = fronts_.fronts[front].parent;
      if (up == front) up = parent;
      if (down == front) down = parent;
    }
  }
  /// For those of both climbs that have come to it.
  void settle(FrontId front, std::span<Half* const> halves) {
    const Front& f = index_.front(front);
    for (Half* const half : halves) {
      half->climbed.push_back(front);
      load_bounds(f, *half);
    }
    for (std::uint32_t i = 0; i < f.gates; ++i) {
      const GateRank gate = f.first + i;
      if (halves.size() == 2 && forward_.distance[gate] + backward_.distance[gate] < best_) {
        best_ = forward_.distance[gate] + backward_.distance[gate];
        meeting_ = gate;
      }
      for (Half* const half : halves) lessen_by(f, i, *half);
    }
    for (Half* const half : halves) store_bounds(f, *half);
  }
  void lessen_by(const Front& f, std::uint32_t gate, Half& half) const {
    const std::uint32_t distance = half.distance[f.first + gate];
    if (distance >= best_) return;
    const std::uint64_t row = f.first_length() + row_offset(gate, f.gates, f.bounds);
    const auto lessen = [&](const auto* lengths, const auto lessen_all) {
      const std::uint32_t later = f.gates - gate - 1;
      lessen_all(half.distance.data() + f.first + gate + 1, lengths, distance, later);
      lessen_all(half.bounds.data(), lengths + later, distance, f.bounds);
    };
    if (f.is_short()) {
      lessen(fronts_.short_lengths.data() + row, lessen_short_);
    } else {
      lessen(fronts_.lengths.data() + row, lessen_);
    }
  }
  void load_bounds(const Front& f, Half& half) const {
    half.bounds.resize(std::max<std::size_t>(half.bounds.size(), f.bounds));
    const GateRank* const rank = fronts_.bounds.data() + f.first_bound;
    for (std::uint32_t i = 0; i < f.bounds; ++i) half.bounds[i] = half.distance[rank[i]];
  }
  void store_bounds(const Front& f, Half& half) const {
    const GateRank* const rank = fronts_.bounds.data() + f.first_bound;
    for (std::uint32_t i = 0; i < f.bounds; ++i) half.distance[rank[i]] = half.bounds[i];
  }
  /// Bounds of a front are gates of fronts above it, which may not all have been climbed.
  void clear(Half& half, std::span<const SeenGate> seeds) const {
    for (const SeenGate& gate : seeds) half.distance[gate.rank] = no_way;
    for (const FrontId front : half.climbed) {
      const Front& f = fronts_.fronts[front];
      std::fill_n(half.distance.begin() + f.first, f.gates, no_way);
      const GateRank* const rank = fronts_.bounds.data() + f.first_bound;
      for (std::uint32_t i = 0; i < f.bounds; ++i) half.distance[rank[i]] = no_way;
    }
  }
  /// Back to a seed: the steps as they were climbed, the last one first. Returns the seed's index.
  std::size_t trace(const Half& half, std::span<const SeenGate> seeds, GateRank from,
                    std::vector<FrontStep>& steps) const {
    for (;;) {
      const auto seed = std::find_if(seeds.begin(), seeds.end(), [&](const SeenGate& gate) {
        return gate.rank == from && gate.steps == half.distance[from];
      });
      if (seed != seeds.end()) return static_cast<std::size_t>(seed - seeds.begin());
      steps.push_back(step_into(half, from));
      from = steps.back().from;
    }
  }
  FrontStep step_into(const Half& half, GateRank to) const {
    for (const FrontId front : half.climbed) {
      const Front& f = fronts_.fronts[front];
      const std::uint64_t column = front_column(fronts_, f, to);
      if (column == std::uint64_t{f.gates} + f.bounds) continue;
      for (std::uint32_t i = 0; i < f.gates && i < column; ++i) {
        const std::uint32_t distance = half.distance[f.first + i];
        if (distance >= half.distance[to]) continue;
        const std::uint32_t length = front_entry(fronts_, f, front_place(f, i, column));
        if (distance + length == half.distance[to]) return {front, f.first + i, to, length};
      }
    }
    refuse_front();
  }

  const RouteIndex& index_;
  const FrontArrays& fronts_;
  const LessenRow<std::uint32_t> lessen_ = lessen_row<std::uint32_t>();
  const LessenRow<std::uint16_t> lessen_short_ = lessen_row<std::uint16_t>();
  Half forward_;
  Half backward_;
  std::uint32_t best_ = no_way;
  GateRank meeting_ = 0;
};

/// Along a hop.
struct Hop : MarkedWay {
  HopTurns turns;
};

/// The cells of a hop (planners/lengths/separator_fronts.hpp) but its last one, as they lie: it is the next hop's
/// first. From marks alone: each cell of a chain says where it goes on, and at junctions the turns do. Refuses marks
/// that lead elsewhere, after as many steps as the hop has, whatever they are. Cost: 3 to 6 ns a cell, on all threads.
class HopWalk : public MarkWalk {
 public:
  using MarkWalk::MarkWalk;

  void begin(const Hop& hop) {
    turns_ = hop.turns;
    came_from_ = 0;
    MarkWalk::begin(hop);
    if (direction_ > 0) write();
  }
  void step() {
    unsigned onwards = exits() & ~came_from_;
    if ((one_exit >> onwards & 1U) == 0) [[unlikely]] {
      if (onwards == 0) refuse_hop();
      onwards = next_turn(onwards, turns_);
    }
    const auto way = static_cast<unsigned>(std::countr_zero(onwards));
    came_from_ = 1U << (way ^ 2U);
    if (!go(way)) [[unlikely]]
      refuse_hop();
    if (direction_ < 0 || left_ > 0) write();
    if (is_astray()) refuse_hop();
  }

 private:
  static constexpr unsigned one_exit = 1U << 1 | 1U << 2 | 1U << 4 | 1U << 8;

  /// Chains that leave the cell: its own marks, and those of the neighbours to the left and below.
  unsigned exits() const {
    const std::uint64_t* const here = row();
    const unsigned own = mark_word::low_and_high(here, col());
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

  HopTurns turns_ = 0;      // those that are left
  unsigned came_from_ = 0;  // the motion that leads back, as a bit
};

/// The cells behind entries of fronts. Beside an entry stands the gate of lower rank that its way goes over, whose row
/// has both halves of it, and so on down to hops, which are then walked. Nothing is searched for. Entries are opened
/// level by level, all of a level in three rounds, each of which asks the memory for what the next one reads: one by
/// one each would wait four times. Scratch of one thread.
class FrontUnpacking {
 public:
  explicit FrontUnpacking(const RouteIndex& index) : index_(index), fronts_(index.arrays().fronts) {}

  /// Writes the cells of the ways, one after the other, from the first gate on, which is `cells` itself: one more than
  /// their lengths together. Throws InputError where fronts contradict each other or the marks, after as many looks as
  /// there are cells at most. Throws Stopped.
  void write(std::span<const FrontStep> steps, CellId* cells, const Execution& execution) {
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
    walk_all<HopWalk>(index_, std::span<const Hop>(hops_), 512, execution);
  }

 private:
  /// An entry whose way's cells have their place: from its lower gate on, or the other way round.
  struct Entry {
    const Front* front;
    std::uint64_t place;
    GateRank low;
    GateRank high;
    std::uint32_t length;
    bool downwards;
    CellId* cells;
  };
  /// An entry whose way goes over a gate: where its halves stand.
  struct Middle {
    Entry whole;
    GateRank gate;
    const Front* front;
    std::uint64_t low;
    std::uint64_t high;
  };
  /// What goes over a gate becomes a middle.
  void read_ways() {
    middles_.clear();
    for (const Entry& entry : todo_) {
      if (entry.length == 0) refuse_front();  // a hop without steps would write beside its cells
      const std::uint64_t way = front_way(fronts_, *entry.front, entry.place);
      if ((way & 1U) != 0) {
        hops_.push_back({{index_.gate_place(entry.low), index_.gate_place(entry.high), entry.length,
                          entry.downwards ? -1 : 1, entry.downwards ? entry.cells + entry.length : entry.cells},
                         way / 2});
        continue;
      }
      const std::uint64_t below = way / 2;
      if (below == 0 || below > entry.low) refuse_front();
      const GateRank gate = entry.low - static_cast<GateRank>(below);
      index_.prefetch_front_of(gate);
      middles_.push_back({entry, gate, nullptr, 0, 0});
    }
  }
  void find_halves() {
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
  void open_halves() {
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
  std::uint64_t place_in(const Front& front, GateRank gate, GateRank other) const {
    const std::uint64_t column = front_column(fronts_, front, other);
    if (column == std::uint64_t{front.gates} + front.bounds) refuse_front();
    return front_place(front, gate - front.first, column);
  }

  const RouteIndex& index_;
  const FrontArrays& fronts_;
  std::vector<Entry> todo_;
  std::vector<Middle> middles_;
  std::vector<Hop> hops_;
};

}  // namespace

class RouteQuery::Scratch {
 public:
  explicit Scratch(const RouteIndex& index)
      : index_(index), trees_(index), near_start_(index), near_goal_(index), fronts_(index), unpacking_(index) {}

  std::optional<std::uint32_t> length(CellId start, CellId goal) {
    const TreeJoin join = trees_.join(checked(start), checked(goal));
    const std::uint32_t between = join.in_tree() ? 0 : core_way(join.start_core, join.goal_core, false).length;
    if (between >= no_way) return std::nullopt;
    return join.start_steps + between + join.goal_steps;
  }

  RawVector<CellId> path(CellId start, CellId goal, const Execution& execution) {
    const LatticePlace a = checked(start);
    const LatticePlace b = checked(goal);
    const TreeJoin join = trees_.join(a, b);
    FrontQuery::Way between{};
    if (!join.in_tree()) between = core_way(join.start_core, join.goal_core, true);
    if (between.length >= no_way) return {};
    for (const std::uint32_t length : {join.start_steps, between.length, join.goal_steps}) {
      if (length > index_.places().place_count()) refuse_length();
    }
    const std::size_t count = std::size_t{join.start_steps} + between.length + join.goal_steps + 1;
    execution.reserve(count * sizeof(CellId));
    RawVector<CellId> cells(count);
    CellId* const core = cells.data() + join.start_steps;
    *core = index_.places().cell_of(join.start_core);
    if (!join.in_tree()) write_core_way(between, join.goal_core, core, execution);
    std::vector<MarkedWay> legs;
    trees_.cut({a, join.start_core, join.start_steps, 1, cells.data()}, legs);
    trees_.cut({b, join.goal_core, join.goal_steps, -1, &cells.back()}, legs);
    write_climbs(index_, legs, execution);
    return cells;
  }

 private:
  LatticePlace checked(CellId cell) const {
    if (cell < index_.passages().cell_count()) return index_.places().place_of(cell);
    throw InputError("cell", "must be below " + std::to_string(index_.passages().cell_count()), std::to_string(cell));
  }
  /// traced: with the way itself, as long as its parts together, or refused.
  FrontQuery::Way core_way(LatticePlace start, LatticePlace goal, bool traced) {
    near_start_.search(start);
    near_goal_.search(goal);
    const std::uint32_t direct = near_start_.steps_to(goal);
    FrontQuery::Way way = fronts_.way(near_start_.gates(), near_goal_.gates(), direct, traced);
    if (!traced || way.length == direct) return way;
    std::size_t length = std::size_t{near_start_.gates()[way.first].steps} + near_goal_.gates()[way.last].steps;
    for (const FrontStep& step : way.steps) length += step.length;
    if (length != way.length) refuse_length();
    return way;
  }
  /// cells: the first one stands already.
  void write_core_way(const FrontQuery::Way& way, LatticePlace goal, CellId* cells, const Execution& execution) {
    if (way.length == near_start_.steps_to(goal)) return near_start_.write_way(goal, cells, 1);
    const SeenGate& first = near_start_.gates()[way.first];
    near_start_.write_way(first.place, cells, 1);
    unpacking_.write(way.steps, cells + first.steps, execution);
    cells[way.length] = index_.places().cell_of(goal);
    near_goal_.write_way(near_goal_.gates()[way.last].place, cells + way.length, -1);
  }

  const RouteIndex& index_;
  TreeRoutes trees_;
  CoreSearch near_start_;
  CoreSearch near_goal_;
  FrontQuery fronts_;
  FrontUnpacking unpacking_;
};

RouteQuery::RouteQuery(const RouteIndex& index) : scratch_(std::make_unique<Scratch>(index)) {}
RouteQuery::~RouteQuery() = default;
RouteQuery::RouteQuery(RouteQuery&&) noexcept = default;

std::optional<std::uint32_t> RouteQuery::length(CellId start, CellId goal) { return scratch_->length(start, goal); }

RawVector<CellId> RouteQuery::path(CellId start, CellId goal, const Execution& execution) {
  return scratch_->path(start, goal, execution);
}

}  // namespace warren

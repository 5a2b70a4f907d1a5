// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/price_field.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "core/base/whole.hpp"
#include "core/search/search_queues.hpp"
#include "parallel/asked_memory.hpp"

namespace warren {

StepWeights::StepWeights(const Bitmap& blocked, Diagonal diagonal, const Execution& execution)
    : StepWeights(blocked, rule_of(diagonal), execution) {
  if (diagonal != Diagonal::unit) return;
  diagonal_at_least_ = units_a_cell;
  for (unsigned s = 0; s < steps_there_are; ++s) lengths_[s] = units_a_cell;
}

StepWeights::StepWeights(const Bitmap& blocked, StepRule rule, const Execution& execution)
    : cells_((execution.reserve(blocked.size() / 8), blocked)),
      allowed_(&allowed_steps(rule)),
      diagonal_at_least_(rule == StepRule::four ? 2 * units_a_cell : units_a_diagonal) {
  const auto stride = static_cast<std::int64_t>(cells_.stride());
  for (unsigned s = 0; s < steps_there_are; ++s) {
    offsets_[s] = static_cast<VertexId>(cell_steps[s][1] * stride + cell_steps[s][0]);  // wraps around for steps back
    lengths_[s] = is_diagonal(s) ? units_a_diagonal : units_a_cell;
  }
}

StepWeights::StepWeights(const Bitmap& blocked, Weigh weigh, const Execution& execution)
    : StepWeights(blocked, StepRule::eight, execution) {
  weigh_ = std::move(weigh);
  known_ = zeros<std::uint32_t>(std::size_t{back_steps} * cells_.number_end(), execution);
}

std::uint64_t StepWeights::first_weight(VertexId from, unsigned step) {
  const bool is_forward = step >= back_steps;
  const Cell lower = cells_.cell(is_forward ? from : from + offsets_[step]);
  const std::uint64_t weight = std::max(weigh_(lower, is_forward ? step : steps_there_are - 1 - step), lengths_[step]);
  if (weight <= std::numeric_limits<std::uint32_t>::max()) {  // dearer ones are asked for again
    known_[place_of(from, step)] = static_cast<std::uint32_t>(weight);
  }
  return weight;
}

PriceField::PriceField(StepWeights& weights, std::span<const Goal> goals, std::span<const Cell> towards,
                       const Execution& execution)
    : weights_(weights),
      towards_(towards.begin(), towards.end()),
      goals_(goals.begin(), goals.end()),
      costs_(zeros<std::uint64_t>(weights.cells().number_end(), execution)),
      buckets_(bucket_count) {
  for (std::size_t i = 0; i < goals_.size(); ++i) {
    const VertexId v = weights_.cells().number(goals_[i].cell);
    goal_cells_.emplace_back(v, i);
    if (weights_.cells().is_free(v) && goals_[i].cost < known(v)) reach(v, goals_[i].cost);
  }
  std::sort(goal_cells_.begin(), goal_cells_.end());
}

std::uint64_t PriceField::estimate(VertexId v) const {
  const Cell cell = weights_.cells().cell(v);
  std::uint64_t least = unreached;
  for (const Cell to : towards_) least = std::min(least, weights_.at_least(cell, to));
  return least;
}

void PriceField::expand(VertexId v) {
  const std::uint64_t here = known(v);
  // A weight may be dear to find: not where the length alone is too much.
  const unsigned cheaper = weights_.may_lower(v, here, [&](VertexId w) { return known(w); });
  for (unsigned rest = cheaper & weights_.allowed(v); rest != 0; rest &= rest - 1) {
    const auto s = static_cast<unsigned>(std::countr_zero(rest));
    const VertexId w = v + weights_.offset(s);
    const std::uint64_t cost = here + weights_.weight(v, s);
    if (cost < known(w)) reach(w, cost);
  }
}

/// is_done(): is the question answered by what is settled?
template <class IsDone>
void PriceField::settle_until(const IsDone& is_done, const Execution& execution) {
  std::uint64_t turns = 0;
  for (; queued_ > 0 && !is_done(); ++current_) {
    std::vector<VertexId>& bucket = buckets_[current_ % bucket_count];
    std::vector<VertexId> later;
    for (std::size_t i = 0; i < bucket.size(); ++i) {  // which grows
      const VertexId v = bucket[i];
      if (++turns % expansions_per_poll == 0) execution.check();
      if (costs_[v] == 0 || (costs_[v] & is_expanded) != 0) continue;  // lost by a repair, or stale
      if (bucket_of(v) > current_) {
        later.push_back(v);
        continue;
      }
      costs_[v] |= is_expanded;
      ++expanded_;
      expand(v);
    }
    queued_ -= bucket.size();
    bucket.clear();
    for (const VertexId v : later) queue(v, known(v));
  }
  if (queued_ == 0) current_ = nothing_left;
}

std::optional<std::uint64_t> PriceField::cost(VertexId v, const Execution& execution) {
  if (!weights_.cells().is_free(v)) return std::nullopt;
  if (!is_settled(v)) settle_until([&] { return is_settled(v); }, execution);
  if (known(v) == unreached) return std::nullopt;
  return known(v);
}

void PriceField::settle_all(const Execution& execution) {
  settle_until([] { return false; }, execution);
}

std::uint64_t PriceField::over_neighbours(VertexId v, std::uint64_t enough) {
  if (!weights_.cells().is_free(v)) return unreached;
  std::uint64_t least = unreached;
  for (auto goal = std::lower_bound(goal_cells_.begin(), goal_cells_.end(), std::pair{v, std::size_t{0}});
       goal != goal_cells_.end() && goal->first == v; ++goal) {
    least = std::min(least, goals_[goal->second].cost);
  }
  for (unsigned rest = weights_.allowed(v); rest != 0 && least > enough; rest &= rest - 1) {
    const auto s = static_cast<unsigned>(std::countr_zero(rest));
    const VertexId w = v + weights_.offset(s);
    if (costs_[w] == 0 || known(w) + weights_.length(s) >= least) continue;
    least = std::min(least, known(w) + weights_.weight(v, s));
  }
  return least;
}

/// Costs are looked at in their order, so that all that a cell's may rest on are decided before it (Ramalingam and
/// Reps, 1996).
bool PriceField::repair(std::span<const Cell> touched, std::uint64_t most, const Execution& execution) {
  const auto dearer = [](const auto& a, const auto& b) { return b < a; };
  std::vector<std::pair<std::uint64_t, VertexId>> doubtful;
  std::vector<VertexId> renewed;
  const auto doubt = [&](VertexId v) {
    if (costs_[v] == 0) return;
    push_asked(doubtful, {known(v), v}, execution);
    std::push_heap(doubtful.begin(), doubtful.end(), dearer);
  };
  for (const Cell c : touched) {
    push_asked(renewed, weights_.cells().number(c), execution);
    doubt(renewed.back());
  }
  for (std::uint64_t lost = 0; !doubtful.empty();) {
    std::pop_heap(doubtful.begin(), doubtful.end(), dearer);
    const auto [cost, v] = doubtful.back();
    doubtful.pop_back();
    if (costs_[v] == 0 || over_neighbours(v, cost) <= cost) continue;
    const bool is_told = (costs_[v] & is_expanded) != 0;  // else others may rest on what it had before
    costs_[v] = 0;
    push_asked(renewed, v, execution);
    if (++lost > most) return false;
    if (lost % expansions_per_poll == 0) execution.check();
    for (unsigned s = 0; s < 8; ++s) {
      const VertexId w = v + weights_.offset(s);
      // What weighs something else now was touched, and is in doubt anyway.
      if (costs_[w] == 0 || known(w) <= cost) continue;
      if (!is_told || weights_.may_weigh(v, s, known(w) - cost)) doubt(w);
    }
  }
  for (const VertexId v : renewed) {
    const std::uint64_t cost = over_neighbours(v, 0);
    if (cost >= known(v)) continue;
    costs_[v] = cost + 1;
    current_ = std::min(current_, bucket_of(v));
    queue(v, known(v));
  }
  return true;
}

std::pair<std::vector<Cell>, std::size_t> PriceField::path(Cell from, const Execution& execution) {
  std::vector<Cell> cells{from};
  VertexId v = weights_.cells().number(from);
  for (;;) {
    if (cells.size() % expansions_per_poll == 0) execution.check();
    for (auto goal = std::lower_bound(goal_cells_.begin(), goal_cells_.end(), std::pair{v, std::size_t{0}});
         goal != goal_cells_.end() && goal->first == v; ++goal) {
      if (goals_[goal->second].cost == known(v)) return {cells, goal->second};
    }
    const VertexId before = v;
    for (unsigned rest = weights_.allowed(v); rest != 0 && v == before; rest &= rest - 1) {
      const auto s = static_cast<unsigned>(std::countr_zero(rest));
      const VertexId w = v + weights_.offset(s);
      if (known(w) < known(v) && known(w) + weights_.weight(v, s) == known(v)) v = w;
    }
    if (v == before) throw std::logic_error("a field's cost rests on none of its neighbours'");
    push_asked(cells, weights_.cells().cell(v), execution);
  }
}

std::optional<VisitingOrder> best_order(const TourCosts& costs) {
  const std::size_t count = costs.from_start.size();
  assert(count >= 1 && count <= most_visited);
  const std::size_t all = (std::size_t{1} << count) - 1;
  // least[left * count + at]: from a place over those that are left to the end. A set is after its subsets.
  std::vector<std::uint64_t> least((all + 1) * count, no_leg);
  const auto over = [&](std::size_t left, std::size_t next, std::uint64_t leg) {
    return std::min(no_leg, leg + least[(left & ~(std::size_t{1} << next)) * count + next]);
  };
  const auto holds = [](std::size_t set, std::size_t place) { return (set >> place & 1U) != 0; };
  for (std::size_t left = 0; left < all; ++left) {
    for (std::size_t at = 0; at < count; ++at) {
      std::uint64_t& best = least[left * count + at];
      if (holds(left, at)) continue;
      if (left == 0) best = costs.to_end[at];
      for (std::size_t next = 0; next < count; ++next) {
        if (holds(left, next)) best = std::min(best, over(left, next, costs.between[at][next]));
      }
    }
  }
  VisitingOrder found;
  for (std::size_t left = all; left != 0;) {
    std::uint64_t best = no_leg;
    std::size_t chosen = 0;
    for (std::size_t next = 0; next < count; ++next) {
      if (!holds(left, next)) continue;
      const std::uint64_t leg = found.order.empty() ? costs.from_start[next] : costs.between[found.order.back()][next];
      const std::uint64_t cost = over(left, next, leg);
      if (cost >= best) continue;
      best = cost;
      chosen = next;
    }
    if (best == no_leg) return std::nullopt;
    if (found.order.empty()) found.cost = best;
    found.order.push_back(chosen);
    left &= ~(std::size_t{1} << chosen);
  }
  return found;
}

namespace {

constexpr std::uint32_t none = 0;  // the first of the states is no cell's
constexpr unsigned left_step = 3;  // of cell_steps
constexpr unsigned right_step = 4;

/// All cells that hang together with one, by sides or corners, taken out of `left`; whether they reach the border.
class Flood {
 public:
  Flood(const Bitmap& blocked, const Execution& execution) : left_(blocked), execution_(execution) {}

  bool is_left(std::uint32_t x, std::uint32_t y) const { return left_.test(x, y); }
  std::uint64_t word(std::uint32_t y, std::size_t i) const { return left_.row(y)[i]; }
  const std::vector<Cell>& from(Cell first) {
    found_.clear();
    take(first.x, first.y);
    for (std::size_t i = 0; i < found_.size(); ++i) {
      if (i % expansions_per_poll == 0) execution_.check();
      const Cell c = found_[i];
      for (const auto& [dx, dy] : cell_steps) {
        const std::int64_t x = std::int64_t{c.x} + dx;
        const std::int64_t y = std::int64_t{c.y} + dy;
        if (left_.holds(x, y)) take(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
      }
    }
    return found_;
  }

 private:
  void take(std::uint32_t x, std::uint32_t y) {
    left_.clear(x, y);
    found_.push_back({x, y});
  }
  Bitmap left_;
  const Execution& execution_;
  std::vector<Cell> found_;
};

}  // namespace

HoleCuts::HoleCuts(const Bitmap& blocked, double least, const Execution& execution) {
  execution.reserve(4 * blocked.bytes() + sizeof(Cell) * blocked.count());
  cells_ = Bitmap(blocked.width(), blocked.height());
  cut_cells_ = cells_;
  Bitmap rim = cells_;  // hangs together with the border
  Flood flood(blocked, execution);
  std::vector<Cell> lowest;
  for (std::uint32_t y = 0; y < blocked.height(); ++y) {
    execution.check();
    for (std::uint32_t x = 0; x < blocked.width(); ++x) {
      if (!flood.is_left(x, y)) {
        if (flood.word(y, x / Bitmap::word_bits) == 0) x |= Bitmap::word_bits - 1;
        continue;
      }
      Hole hole{{x, y}, {x, y}};
      const std::vector<Cell>& found = flood.from({x, y});
      for (const Cell c : found) {
        hole.low = {std::min(hole.low.x, c.x), std::min(hole.low.y, c.y)};
        hole.high = {std::max(hole.high.x, c.x), std::max(hole.high.y, c.y)};
      }
      const bool is_rim = hole.low.x == 0 || hole.low.y == 0 || hole.high.x + 1 == blocked.width() ||
                          hole.high.y + 1 == blocked.height();
      const double across = 1.0 + std::max(hole.high.x - hole.low.x, hole.high.y - hole.low.y);
      if (!is_rim && across < least) continue;
      Bitmap& into = is_rim ? rim : cells_;
      for (const Cell c : found) into.set(c.x, c.y);
      if (is_rim) continue;
      push_asked(holes_, hole, execution);
      push_asked(lowest, {x, y}, execution);
    }
  }
  const auto ends_at = [&](std::uint32_t x, std::uint32_t y) { return rim.test(x, y) || cells_.test(x, y); };
  for (std::size_t i = 0; i < lowest.size(); ++i) {
    const auto [x, top] = lowest[i];
    std::uint32_t low = top;
    while (low > 0 && !ends_at(x, low - 1) && !ends_at(x + 1, low - 1)) cut_cells_.set(x, --low);
    if (low < top) push_asked(cuts_, {x, low, top, as_whole<std::int32_t>(i + 1)}, execution);
  }
  std::sort(cuts_.begin(), cuts_.end(),
            [](const Cut& a, const Cut& b) { return std::tie(a.column, a.low) < std::tie(b.column, b.low); });
}

std::int32_t HoleCuts::hole_at(std::uint32_t column, std::uint32_t row) const {
  if (!cut_cells_.holds(column, row)) return 0;
  const auto after =
      std::upper_bound(cuts_.begin(), cuts_.end(), std::pair{column, row}, [](const auto& at, const Cut& cut) {
        return at < std::pair{cut.column, cut.low};
      });
  return std::prev(after)->hole;
}

std::int32_t HoleCuts::letter(Cell from, unsigned step) const {
  const auto [dx, dy] = cell_steps[step];
  if (dx == 0) return 0;
  const std::uint32_t column = dx > 0 ? from.x : from.x - 1;
  // A diagonal step passes where four free cells meet: no cut ends there, so it crosses both cells' cut or neither's.
  const std::int32_t hole = hole_at(column, from.y);
  return dx > 0 ? hole : -hole;
}

std::vector<std::int32_t> HoleCuts::word(std::span<const Vec2> path) const {
  std::vector<std::int32_t> word;
  const auto add = [&](std::int32_t letter) {
    if (letter == 0) return;
    if (!word.empty() && word.back() == -letter) {
      word.pop_back();
    } else {
      word.push_back(letter);
    }
  };
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Vec2 a = path[i - 1];
    const Vec2 b = path[i];
    const bool to_right = a.x < b.x;
    const double low = std::min(a.x, b.x);
    const double high = std::max(a.x, b.x);
    // Lines low < x <= high: so a place on a line counts as one to its right, whichever leg it ends.
    const auto column = [&](double x) {
      return bounded_whole<std::uint32_t>(std::floor(x), 0.0, static_cast<double>(cut_cells_.width()));
    };
    const std::uint32_t first = column(low);
    const std::uint32_t last = column(high);  // lines first + 1 .. last
    for (std::uint32_t n = 0; n < last - first; ++n) {
      const std::uint32_t line = to_right ? first + 1 + n : last - n;
      const double y = a.y + (b.y - a.y) * ((static_cast<double>(line) - a.x) / (b.x - a.x));
      const auto row = bounded_whole<std::uint32_t>(std::floor(y), 0.0, static_cast<double>(cut_cells_.height()));
      const std::int32_t hole = hole_at(line - 1, row);
      add(to_right ? hole : -hole);
    }
  }
  return word;
}

namespace {

/// All words that were met; a word is the number of its last letter. 0 is the empty one.
class Words {
 public:
  /// Throws Stopped.
  std::uint32_t followed(std::uint32_t word, std::int32_t letter, const Execution& execution) {
    constexpr std::size_t batch = 1 << 12;
    constexpr std::size_t bytes_a_word = 80;  // its place in the map, and twice its letter
    if (letter == 0) return word;
    if (word != 0 && letters_[word].letter == -letter) return letters_[word].before;
    const auto [at, is_new] = known_.emplace(std::pair{word, letter}, as_whole<std::uint32_t>(letters_.size()));
    if (!is_new) return at->second;
    if (letters_.size() % batch == 0) execution.reserve(batch * bytes_a_word);
    letters_.push_back({word, letter});
    return at->second;
  }
  std::vector<std::int32_t> spelled(std::uint32_t word) const {
    std::vector<std::int32_t> letters;
    for (; word != 0; word = letters_[word].before) letters.push_back(letters_[word].letter);
    std::reverse(letters.begin(), letters.end());
    return letters;
  }

 private:
  struct Letter {
    std::uint32_t before;
    std::int32_t letter;
  };
  std::vector<Letter> letters_{{0, 0}};
  std::map<std::pair<std::uint32_t, std::int32_t>, std::uint32_t> known_;
};

class ClassSearch {
 public:
  ClassSearch(StepWeights& weights, PriceField& field, const HoleCuts& cuts, const ClassChoice& choice,
              const Execution& execution)
      : weights_(weights),
        field_(field),
        cuts_(cuts),
        choice_(choice),
        execution_(execution),
        first_(zeros<std::uint32_t>(weights.cells().number_end(), execution)),
        settled_(zeros<std::uint8_t>(weights.cells().number_end(), execution)) {}

  std::vector<ClassPath> find(Cell start, Cell goal) {
    std::vector<ClassPath> found;
    const VertexId begin = weights_.cells().number(start);
    const auto least = field_.cost(begin, execution_);
    if (!least) return found;
    limit_ = static_cast<double>(*least) * choice_.stretch;
    const VertexId end = weights_.cells().number(goal);
    reach({0, *least, begin, none, none, 0, 0});
    for (std::uint64_t turns = 1; !open_.empty(); ++turns) {
      if (turns % expansions_per_poll == 0) execution_.check();
      const std::uint32_t at = open_.pop().vertex;  // for the least it cost; then, for more, it is settled
      State& state = state_at(at);
      if (state.is_settled || settled_[state.cell] >= choice_.count) continue;
      ++settled_[state.cell];
      state.is_settled = true;
      if (state.cell == end) {
        found.push_back({cells_to(at), state.cost, words_.spelled(state.word)});
        if (found.size() == choice_.count) break;
      }
      expand(at);
    }
    return found;
  }

 private:
  struct State {
    std::uint64_t cost;
    std::uint64_t onward;  // from the cell to the goal
    VertexId cell;
    std::uint32_t before;
    std::uint32_t next;  // of the same cell
    std::uint32_t word : 31;
    std::uint32_t is_settled : 1;
  };
  static constexpr std::uint32_t piece = 1 << 14;  // states, which stay where they are
  State& state_at(std::uint32_t at) { return pieces_[at / piece][at % piece]; }

  void reach(State state) {
    if (count_ / piece == pieces_.size()) {
      execution_.reserve(sizeof(State) * piece);
      pieces_.push_back(std::make_unique_for_overwrite<State[]>(piece));
    }
    state.next = std::exchange(first_[state.cell], count_);
    open_.push(count_, static_cast<double>(state.cost + state.onward));
    state_at(count_++) = state;
  }
  void expand(std::uint32_t at) {
    const State from = state_at(at);
    const Cell here = weights_.cells().cell(from.cell);
    const auto followed = [&](unsigned step) {
      return words_.followed(from.word, cuts_.letter(here, step), execution_);
    };
    // A diagonal step crosses what the one to its side does.
    const std::array<std::uint32_t, 3> words{followed(left_step), from.word, followed(right_step)};
    for (unsigned rest = weights_.allowed(from.cell); rest != 0; rest &= rest - 1) {
      const auto step = as_whole<unsigned>(std::countr_zero(rest));
      const VertexId to = from.cell + weights_.offset(step);
      if (settled_[to] >= choice_.count) continue;
      const std::uint32_t word = words[as_whole<unsigned>(1 + cell_steps[step][0])];
      const std::uint32_t first = first_[to];
      std::uint32_t known = first;
      while (known != none && state_at(known).word != word) known = state_at(known).next;
      // A weight may be dear to find: not where the length alone is too much.
      if (known != none && state_at(known).cost <= from.cost + weights_.length(step)) continue;
      const auto onward = first != none ? std::optional(state_at(first).onward) : field_.cost(to, execution_);
      if (!onward) continue;
      const std::uint64_t cost = from.cost + weights_.weight(from.cell, step);
      if (static_cast<double>(cost + *onward) > limit_) continue;
      if (known == none) {
        reach({cost, *onward, to, at, none, word, 0});
      } else if (cost < state_at(known).cost) {
        state_at(known).cost = cost;
        state_at(known).before = at;
        open_.push(known, static_cast<double>(cost + *onward));
      }
    }
  }
  std::vector<Cell> cells_to(std::uint32_t at) {
    std::vector<Cell> cells;
    for (; at != none; at = state_at(at).before)
      push_asked(cells, weights_.cells().cell(state_at(at).cell), execution_);
    std::reverse(cells.begin(), cells.end());
    return cells;
  }

  StepWeights& weights_;
  PriceField& field_;
  const HoleCuts& cuts_;
  const ClassChoice& choice_;
  const Execution& execution_;
  double limit_ = 0.0;
  Words words_;
  std::vector<std::unique_ptr<State[]>> pieces_;
  std::uint32_t count_ = none + 1;   // of states
  ZeroPages<std::uint32_t> first_;   // state of each cell
  ZeroPages<std::uint8_t> settled_;  // states of each cell, as many as there are classes
  BucketQueue open_{static_cast<double>(units_a_cell) / 64.0};
};

}  // namespace

std::vector<ClassPath> cheapest_classes(StepWeights& weights, PriceField& field, const HoleCuts& cuts, Cell start,
                                        Cell goal, const ClassChoice& choice, const Execution& execution) {
  return ClassSearch(weights, field, cuts, choice, execution).find(start, goal);
}

}  // namespace warren

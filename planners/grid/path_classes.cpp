// SPDX-License-Identifier: BSD-3-Clause
#include "planners/grid/path_classes.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include "core/base/whole.hpp"
#include "core/search/search_queues.hpp"
#include "parallel/asked_memory.hpp"

namespace warren {
namespace {

constexpr std::uint32_t none = 0;  // the first of the states is no cell's
constexpr unsigned left_step = 3;  // of cell_steps
constexpr unsigned right_step = 4;

/// All cells that hang together with one, by sides or corners, taken out of `left`.
void flood(Bitmap& left, Cell first, std::vector<Cell>& found, const Execution& execution) {
  const auto take = [&](std::uint32_t x, std::uint32_t y) {
    left.clear(x, y);
    found.push_back({x, y});
  };
  found.clear();
  take(first.x, first.y);
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (i % expansions_per_poll == 0) execution.check();
    const Cell c = found[i];
    for (const auto& [dx, dy] : cell_steps) {
      const std::int64_t x = std::int64_t{c.x} + dx;
      const std::int64_t y = std::int64_t{c.y} + dy;
      if (left.holds(x, y)) take(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
    }
  }
}

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

HoleCuts::HoleCuts(const Bitmap& blocked, double least, const Execution& execution) {
  execution.reserve(4 * blocked.bytes() + sizeof(Cell) * blocked.count());
  cells_ = Bitmap(blocked.width(), blocked.height());
  cut_cells_ = cells_;
  Bitmap rim = cells_;  // hangs together with the border
  Bitmap left = blocked;
  std::vector<Cell> found;
  std::vector<Cell> lowest;
  for (std::uint32_t y = 0; y < blocked.height(); ++y) {
    execution.check();
    for (std::uint32_t x = 0; x < blocked.width(); ++x) {
      if (!left.test(x, y)) {
        if (left.row(y)[x / Bitmap::word_bits] == 0) x |= Bitmap::word_bits - 1;
        continue;
      }
      Hole hole{{x, y}, {x, y}};
      flood(left, {x, y}, found, execution);
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
  std::ranges::sort(cuts_, {}, &Cut::begin);
}

std::int32_t HoleCuts::hole_at(std::uint32_t column, std::uint32_t row) const {
  if (!cut_cells_.holds(column, row)) return 0;
  return std::prev(std::ranges::upper_bound(cuts_, std::pair{column, row}, {}, &Cut::begin))->hole;
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
    // Lines beyond the left end and up to the right one: so a place on a line counts as one to its right, whichever leg
    // it ends.
    const auto column = [&](double x) {
      return bounded_whole<std::uint32_t>(std::floor(x), 0.0, static_cast<double>(cut_cells_.width()));
    };
    const std::uint32_t first = column(std::min(a.x, b.x));
    const std::uint32_t last = column(std::max(a.x, b.x));  // lines first + 1 .. last
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

std::vector<ClassPath> cheapest_classes(StepWeights& weights, PriceField& field, const HoleCuts& cuts, Cell start,
                                        Cell goal, const ClassChoice& choice, const Execution& execution) {
  return ClassSearch(weights, field, cuts, choice, execution).find(start, goal);
}

}  // namespace warren

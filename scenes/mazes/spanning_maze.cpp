// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/mazes/spanning_maze.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/raw_vector.hpp"
#include "core/search/union_find.hpp"
#include "parallel/sort.hpp"

namespace warren::maze {
namespace {

constexpr std::uint32_t no_edge = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint16_t off_the_rim = std::numeric_limits<std::uint16_t>::max();
constexpr std::uint32_t not_on_rim = std::numeric_limits<std::uint32_t>::max();

/// found[i] becomes the bit of the one of four numbers that is the greatest, or least; 0 where several are.
template <bool greatest>
void mark_single(const std::array<const std::uint32_t*, 4>& of, std::uint8_t* __restrict found, std::size_t count) {
  const std::uint32_t* __restrict const a = of[0];
  const std::uint32_t* __restrict const b = of[1];
  const std::uint32_t* __restrict const c = of[2];
  const std::uint32_t* __restrict const d = of[3];
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t ab = greatest ? std::max(a[i], b[i]) : std::min(a[i], b[i]);
    const std::uint32_t cd = greatest ? std::max(c[i], d[i]) : std::min(c[i], d[i]);
    const std::uint32_t m = greatest ? std::max(ab, cd) : std::min(ab, cd);
    const unsigned bits = (a[i] == m ? 1U : 0U) | (b[i] == m ? 2U : 0U) | (c[i] == m ? 4U : 0U) | (d[i] == m ? 8U : 0U);
    found[i] = static_cast<std::uint8_t>((bits & (bits - 1)) == 0 ? bits : 0U);
  }
}

/// The tree of one tile: scratch of one thread.
class SpanningTile {
 public:
  static constexpr std::uint32_t largest_side = 256;

  explicit SpanningTile(std::uint64_t seed) : weights_(seed) {}

  /// width, height: 1 .. largest_side.
  void make(const GridPiece& piece) {
    assert(piece.width >= 1 && piece.width <= largest_side && piece.height >= 1 && piece.height <= largest_side);
    decide_early(piece);
    contract();
    collect();
    sort();
    join();
  }

  /// How the edges were decided that are neither least nor greatest around a corner: a bit each, in the order of the
  /// cells, 0.6 a cell.
  void choices(std::vector<std::uint64_t>& bits) const {
    bits.assign(2 * cells_ / 64 + 1, 0);
    std::size_t n = 0;
    for (std::size_t i = 0; i < cells_; ++i) {
      const unsigned contested = contested_[i];
      const unsigned open = open_[i];
      bits[n / 64] |= std::uint64_t{contested & open & 1U} << n % 64;
      n += contested & 1U;
      bits[n / 64] |= std::uint64_t{(contested & open) >> 1U} << n % 64;
      n += contested >> 1U;
    }
    bits.resize(n / 64 + 1);
    bits.shrink_to_fit();
  }

  /// As make(), of the same piece, from its choices: nothing is sorted, a fourth of the time. There are no rim_edges.
  void remake(const GridPiece& piece, std::span<const std::uint64_t> choices) {
    decide_early(piece);
    std::size_t n = 0;
    for (std::size_t i = 0; i < cells_; ++i) {
      const unsigned contested = contested_[i];
      const unsigned first = static_cast<unsigned>(choices[n / 64] >> n % 64) & contested & 1U;
      n += contested & 1U;
      const unsigned second = static_cast<unsigned>(choices[n / 64] >> n % 64) & contested >> 1U;
      n += contested >> 1U;
      open_[i] = static_cast<std::uint8_t>(open_[i] | first | second << 1U);
    }
  }

  /// Edges of the tree, cell by cell (row * width + col), as bits of the cell on whose right or upper side they lie.
  std::span<const std::uint8_t> open() const { return {open_.data(), cells_}; }
  /// By weight, ascending; with no neighbour beyond: none.
  std::span<const RimEdge> rim_edges() const { return rim_edges_; }

 private:
  static constexpr std::uint8_t right = 1, up = 2;

  struct Candidate {
    std::uint32_t weight;  // its upper half
    std::uint32_t place;   // 2 * cell + direction
  };

  /// What the least and the greatest edges decide.
  void decide_early(const GridPiece& piece) {
    piece_ = piece;
    cells_ = std::size_t{piece.width} * piece.height;
    weigh();
    find_least();
    find_greatest();
    mark();
  }

  std::uint64_t number_of(std::uint32_t place) const {
    const std::uint32_t cell = place / 2;
    return edge_number(piece_.first_col + cell % piece_.width, piece_.first_row + cell / piece_.width, place % 2);
  }

  void weigh() {
    const std::size_t width = piece_.width;
    right_.assign(cells_ + 2 * width, no_edge);
    up_.assign(cells_ + 2 * width, no_edge);
    for (std::uint32_t row = 0; row < piece_.height; ++row) {
      std::uint32_t* const right = right_.data() + (row + 1) * width;
      std::uint32_t* const up = up_.data() + (row + 1) * width;
      const std::uint64_t first = edge_number(piece_.first_col, std::uint64_t{piece_.first_row} + row, 0);
      for (std::uint32_t col = 0; col < width; ++col) {
        right[col] = static_cast<std::uint32_t>(weights_(first + 2 * col) >> 32);
        up[col] = static_cast<std::uint32_t>(weights_(first + 2 * col + 1) >> 32);
      }
      right[width - 1] = no_edge;
    }
    std::fill_n(up_.begin() + static_cast<std::ptrdiff_t>(cells_), width, no_edge);
  }

  /// Cells of the rim choose nothing and are not chosen.
  void find_least() {
    const std::size_t width = piece_.width;
    least_.assign(cells_ + 2 * width, 0);
    mark_single<false>({right_.data() + width, up_.data() + width, right_.data() + width - 1, up_.data()},
                       least_.data() + width, cells_);
    std::uint8_t* const least = least_.data() + width;
    const auto cut = [&](unsigned side, std::size_t cell, bool has_inner, std::size_t inner) {
      if ((piece_.more & side) == 0) return;
      least[cell] = 0;
      if (has_inner) least[inner] = static_cast<std::uint8_t>(least[inner] & ~side);
    };
    for (std::size_t row = 0; row < piece_.height; ++row) {
      cut(4, row * width, width > 1, row * width + 1);
      cut(1, row * width + width - 1, width > 1, row * width + width - 2);
    }
    for (std::size_t col = 0; col < width; ++col) {
      cut(8, col, piece_.height > 1, width + col);
      cut(2, cells_ - width + col, piece_.height > 1, cells_ - 2 * width + col);
    }
  }

  /// Corners on the tile's sides have an edge that is none, which is the greatest and marks nothing.
  void find_greatest() {
    const std::size_t width = piece_.width;
    greatest_.assign(cells_ + width + 1, 0);
    mark_single<true>({right_.data() + width, up_.data() + width, right_.data() + 2 * width, up_.data() + width + 1},
                      greatest_.data() + width, cells_);
  }

  /// Opens the least edges, and finds those that neither rule decides.
  void mark() {
    const std::size_t width = piece_.width;
    open_.resize(cells_);
    contested_.resize(cells_);
    const std::uint8_t* const least = least_.data() + width;
    const std::uint8_t* const greatest = greatest_.data() + width;
    std::uint8_t* __restrict const open = open_.data();
    std::uint8_t* __restrict const contested = contested_.data();
    const auto below = static_cast<std::ptrdiff_t>(width);
    for (std::ptrdiff_t i = 0; i < static_cast<std::ptrdiff_t>(cells_); ++i) {
      const unsigned in = (least[i] & 3U) | (least[i + 1] >> 2U & 1U) | (least[i + below] >> 2U & 2U);
      const unsigned out = (greatest[i] & 3U) | (greatest[i - below] >> 2U & 1U) | (greatest[i - 1] >> 2U & 2U);
      open[i] = static_cast<std::uint8_t>(in);
      contested[i] = static_cast<std::uint8_t>(~(in | out) & 3U);
    }
    for (std::size_t row = 0; row < piece_.height; ++row) contested[row * width + width - 1] &= up;
    for (std::size_t col = 0; col < width; ++col) contested[cells_ - width + col] &= right;
  }

  /// Every cell points at where its least edge leads; of two that point at each other the first is the root.
  void contract() {
    const std::int32_t above = static_cast<std::int32_t>(piece_.width);
    const std::array<std::int32_t, 9> step{0, 1, above, 0, -1, 0, 0, 0, -above};
    parent_.resize(cells_);
    std::uint16_t* const parent = parent_.data();
    const std::uint8_t* const least = least_.data() + piece_.width;
    for (std::size_t i = 0; i < cells_; ++i) {
      parent[i] = static_cast<std::uint16_t>(static_cast<std::int32_t>(i) + step[least[i]]);
    }
    for (std::size_t i = 0; i < cells_; ++i) {
      const std::size_t next = parent[i];
      const bool is_root = (next > i) & (parent[next] == i);
      parent[i] = static_cast<std::uint16_t>(is_root ? i : next);
    }
    for (bool changed = true; changed;) {
      unsigned differences = 0;
      for (std::size_t i = 0; i < cells_; ++i) {
        const std::uint16_t next = parent[i];
        const std::uint16_t after = parent[next];
        differences |= static_cast<unsigned>(next) ^ after;
        parent[i] = after;
      }
      changed = differences != 0;
    }
  }

  void collect() {
    const std::size_t width = piece_.width;
    candidates_.resize(2 * cells_ + 1);
    Candidate* out = candidates_.data();
    const std::uint32_t* const right_weight = right_.data() + width;
    const std::uint32_t* const up_weight = up_.data() + width;
    for (std::size_t i = 0; i < cells_; ++i) {
      const std::size_t beside = std::min(i + 1, cells_ - 1);
      const std::size_t above = std::min(i + width, cells_ - 1);
      *out = {right_weight[i], static_cast<std::uint32_t>(2 * i)};
      out += (contested_[i] & right) & (parent_[i] != parent_[beside] ? 1U : 0U);
      *out = {up_weight[i], static_cast<std::uint32_t>(2 * i + 1)};
      out += (contested_[i] >> 1U) & (parent_[i] != parent_[above] ? 1U : 0U);
    }
    candidate_count_ = static_cast<std::size_t>(out - candidates_.data());
  }

  void sort() {
    sorted_.resize(candidates_.size());
    pass(0, 0x7ff);
    pass(11, 0x7ff);
    pass(22, 0x3ff);
    sort_ties();
  }

  void pass(unsigned shift, std::uint32_t mask) {
    std::array<std::uint32_t, 2048> count{};
    for (std::size_t k = 0; k < candidate_count_; ++k) ++count[candidates_[k].weight >> shift & mask];
    std::uint32_t first = 0;
    for (std::uint32_t& n : count) first += std::exchange(n, first);
    for (std::size_t k = 0; k < candidate_count_; ++k)
      sorted_[count[candidates_[k].weight >> shift & mask]++] = candidates_[k];
    candidates_.swap(sorted_);
  }

  void sort_ties() {
    const auto by_weight = [&](const Candidate& x, const Candidate& y) {
      return weights_(number_of(x.place)) < weights_(number_of(y.place));
    };
    for (std::size_t k = 0; k + 1 < candidate_count_; ++k) {
      if (candidates_[k].weight != candidates_[k + 1].weight) continue;
      std::size_t end = k + 1;
      while (end < candidate_count_ && candidates_[end].weight == candidates_[k].weight) ++end;
      std::sort(candidates_.begin() + static_cast<std::ptrdiff_t>(k),
                candidates_.begin() + static_cast<std::ptrdiff_t>(end), by_weight);
      k = end - 1;
    }
  }

  void join() {
    on_rim_.assign(cells_, off_the_rim);
    piece_.each_on_sides([&](std::uint32_t col, std::uint32_t row) {
      if (!piece_.on_rim(col, row)) return;
      on_rim_[std::size_t{row} * piece_.width + col] = static_cast<std::uint16_t>(piece_.side_number(col, row));
    });
    rim_edges_.clear();
    const std::array<std::uint32_t, 2> offset{1, piece_.width};
    for (std::size_t k = 0; k < candidate_count_; ++k) {
      const std::uint32_t place = candidates_[k].place;
      const auto cell = static_cast<std::uint16_t>(place / 2);
      const std::uint16_t a = root_of(parent_, cell);
      const std::uint16_t b = root_of(parent_, static_cast<std::uint16_t>(cell + offset[place % 2]));
      if (a == b) continue;
      open_[cell] = static_cast<std::uint8_t>(open_[cell] | (1U << (place % 2)));
      const std::uint16_t kept = std::min(a, b);
      const std::uint16_t gone = std::max(a, b);
      parent_[gone] = kept;
      if (on_rim_[gone] == off_the_rim) continue;
      if (on_rim_[kept] == off_the_rim) {
        on_rim_[kept] = on_rim_[gone];
      } else {
        rim_edges_.push_back({on_rim_[kept], on_rim_[gone], number_of(place)});
      }
    }
  }

  EdgeWeights weights_;
  GridPiece piece_{};
  std::size_t cells_ = 0;
  std::vector<std::uint32_t> right_, up_;  // upper halves of weights; a row of none before and after the tile's
  std::vector<std::uint8_t> least_;        // bits: right, up, left, down; a row of 0 before and after
  std::vector<std::uint8_t> greatest_;  // of the corner above right of a cell, bits: its lower edge, left, upper, right
  std::vector<std::uint8_t> open_;
  std::vector<std::uint8_t> contested_;
  std::vector<std::uint16_t> parent_;
  std::vector<std::uint16_t> on_rim_;  // of a part's root: a side number, or none
  std::vector<Candidate> candidates_, sorted_;
  std::size_t candidate_count_ = 0;
  std::vector<RimEdge> rim_edges_;
};

/// Joins a rectangle of parts to one.
class Joining {
 public:
  Joining(std::uint64_t seed, std::span<RimPart> parts, std::size_t cols, unsigned side_log2)
      : weights_(seed), parts_(parts), cols_(cols), last_((1U << side_log2) - 1) {}

  JoinedParts run(const Execution& execution) {
    JoinedParts joined;
    const GridPiece& low = parts_.front().at;
    const GridPiece& high = parts_.back().at;
    joined.whole.at = {low.first_col, low.first_row, high.first_col + high.width - low.first_col,
                       high.first_row + high.height - low.first_row, (low.more & 12U) | (high.more & 3U)};
    number_vertices(joined.whole.at);
    take_edges();
    polled_sort(edges_.begin(), edges_.end(), execution,
                [](const Edge& a, const Edge& b) { return a.weight < b.weight; });
    RawVector<std::uint32_t> regions(first_.back());
    for_each_index<std::uint32_t>(regions.size(), 65536, {1, execution.deadline},
                                  [&](std::uint32_t v) { regions[v] = v; });
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      if (i % 65536 == 0) execution.check();
      join(edges_[i], regions, joined);
    }
    return joined;
  }

 private:
  struct Edge {
    std::uint64_t weight;
    RimEdge between;  // vertices
  };

  /// A vertex is a cell on a side of a part; on_rim_ says which of the whole's it is.
  void number_vertices(const GridPiece& whole) {
    first_.assign(1, 0);
    for (const RimPart& part : parts_) first_.push_back(first_.back() + 2 * (part.at.width + part.at.height));
    on_rim_.assign(first_.back(), not_on_rim);
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const GridPiece& at = parts_[p].at;
      at.each_on_sides([&](std::uint32_t col, std::uint32_t row) {
        const std::uint32_t whole_col = at.first_col - whole.first_col + col;
        const std::uint32_t whole_row = at.first_row - whole.first_row + row;
        if (!whole.on_rim(whole_col, whole_row)) return;
        on_rim_[first_[p] + at.side_number(col, row)] = whole.side_number(whole_col, whole_row);
      });
    }
  }

  void add(std::uint32_t a, std::uint32_t b, std::uint64_t edge) { edges_.push_back({weights_(edge), {a, b, edge}}); }

  void take_edges() {
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      RimPart& part = parts_[p];
      const GridPiece& at = part.at;
      for (const RimEdge& e : part.edges) add(first_[p] + e.a, first_[p] + e.b, e.edge);
      let_go(part.edges);
      if ((p + 1) % cols_ != 0) {
        const GridPiece& other = parts_[p + 1].at;
        for (std::uint32_t row = 0; row < at.height; ++row) {
          add(first_[p] + at.side_number(at.width - 1, row), first_[p + 1] + other.side_number(0, row),
              edge_number(at.first_col + at.width - 1, at.first_row + row, 0));
        }
      }
      if (p + cols_ < parts_.size()) {
        const GridPiece& other = parts_[p + cols_].at;
        for (std::uint32_t col = 0; col < at.width; ++col) {
          add(first_[p] + at.side_number(col, at.height - 1), first_[p + cols_] + other.side_number(col, 0),
              edge_number(at.first_col + col, at.first_row + at.height - 1, 1));
        }
      }
    }
  }

  void join(const Edge& edge, RawVector<std::uint32_t>& regions, JoinedParts& joined) {
    const std::uint32_t a = root_of(regions, edge.between.a);
    const std::uint32_t b = root_of(regions, edge.between.b);
    if (!unite(regions, a, b)) return note(edge.between.edge, false, joined);
    const std::uint32_t kept = std::min(a, b);
    const std::uint32_t gone = std::max(a, b);
    if (on_rim_[kept] != not_on_rim && on_rim_[gone] != not_on_rim) {
      joined.whole.edges.push_back({on_rim_[kept], on_rim_[gone], edge.between.edge});
      return;
    }
    on_rim_[kept] = std::min(on_rim_[kept], on_rim_[gone]);
    note(edge.between.edge, true, joined);
  }
  void note(std::uint64_t edge, bool is_in, JoinedParts& joined) const {
    const bool leaves = ((edge_direction(edge) == 0 ? edge_col(edge) : edge_row(edge)) & last_) == last_;
    if (leaves == is_in) joined.turned.push_back(edge);
  }

  const EdgeWeights weights_;
  std::span<RimPart> parts_;
  std::size_t cols_;
  const std::uint32_t last_;  // column or row of a tile
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> on_rim_;  // of a region's root: the side number of one of its cells, or none
  std::vector<Edge> edges_;
};

}  // namespace

void RimPart::pack(ValuePacker& to) const {
  to.add(at);
  to.add_list(edges);
}

RimPart RimPart::unpack(ValueUnpacker& from) {
  RimPart part{from.take<GridPiece>(), from.take_list<RimEdge>()};
  const std::uint64_t cells = 2 * (std::uint64_t{part.at.width} + part.at.height);
  const auto is_beyond = [&](const RimEdge& edge) { return edge.a >= cells || edge.b >= cells; };
  if (std::any_of(part.edges.begin(), part.edges.end(), is_beyond)) from.refuse();
  return part;
}

JoinedParts join_parts(std::uint64_t seed, std::span<RimPart> parts, std::size_t cols, unsigned side_log2,
                       const Execution& execution) {
  return Joining(seed, parts, cols, side_log2).run(execution);
}

}  // namespace warren::maze

namespace warren {
namespace {

using maze::edge_col, maze::edge_direction, maze::edge_number, maze::edge_row, maze::EdgeWeights, maze::GridPiece,
    maze::JoinedParts, maze::RimPart;

constexpr std::uint32_t group_side = 8;  // pieces that are joined at once, along a side

/// SpanningMaze::open_below_.
std::uint64_t open_below(std::uint32_t rows, std::uint32_t cols, double loops) {
  check_spanning_maze(rows, cols, loops);
  return static_cast<std::uint64_t>(std::ceil(loops * 0x1.0p53));
}

/// Groups of `group_side` parts in a row.
std::size_t groups_of(std::size_t parts) { return (parts - 1) / group_side + 1; }

/// The rectangle of parts that group g of 8 x 8 is made of.
struct Group {
  std::size_t first_col, first_row, cols, rows;
  static Group of(std::size_t g, std::size_t cols, std::size_t rows) {
    const std::size_t col = g % groups_of(cols) * group_side;
    const std::size_t row = g / groups_of(cols) * group_side;
    return {col, row, std::min<std::size_t>(group_side, cols - col), std::min<std::size_t>(group_side, rows - row)};
  }
  std::size_t size() const { return cols * rows; }
};

}  // namespace

void check_spanning_maze(std::uint32_t rows, std::uint32_t cols, double loops) {
  const std::uint32_t most = SpanningMaze::most_side;
  if (rows < 1 || cols < 1 || rows > most || cols > most) {
    throw InputError("maze", fmt::format("rows and columns must be from 1 to {}", most),
                     fmt::format("{}x{}", rows, cols));
  }
  if (!(loops >= 0.0 && loops <= 1.0)) {
    throw InputError("maze", "loops must be a fraction from 0 to 1", fmt::format("{}", loops));
  }
}

/// Goes through the levels of some rows of tiles and notes what is turned.
class SpanningMaze::Builder {
 public:
  Builder(SpanningMaze& maze, Range rows, KeptParts* kept, const Execution& execution)
      : maze_(maze), first_tile_(rows.first * maze.tile_cols()), kept_(kept), execution_(execution) {}

  RimPart run(std::size_t rows) {
    const std::size_t cols = maze_.tile_cols();
    const std::uint64_t side = std::uint64_t{1} << maze_.side_log2();
    // choices, turned edges, what levels hand on
    execution_.reserve(cols * rows * (side * side / 12 + side * 16 + 128) + 48 * maze_.tile_count());
    maze_.turned_.resize(maze_.tile_count());
    maze_.choices_.resize(maze_.tile_count());
    std::vector<RimPart> parts =
        join_all(cols, rows, [&](const Group& group, std::size_t number) { return tiles(group, number); });
    for (std::size_t width = groups_of(cols); parts.size() > 1; width = groups_of(width)) {
      parts = join_all(width, parts.size() / width, [&](const Group& group, std::size_t) {
        std::vector<RimPart> taken;
        for (std::size_t row = 0; row < group.rows; ++row) {
          const auto first =
              parts.begin() + static_cast<std::ptrdiff_t>((group.first_row + row) * width + group.first_col);
          std::move(first, first + static_cast<std::ptrdiff_t>(group.cols), std::back_inserter(taken));
        }
        return join_parts(maze_.seed_, taken, group.cols, maze_.side_log2(), execution_);
      });
    }
    return std::move(parts.front());
  }

 private:
  /// One level: join(group, number) makes one part of a group. A group decides edges of its own tiles alone, so no two
  /// threads meet.
  template <class Join>
  std::vector<RimPart> join_all(std::size_t cols, std::size_t rows, const Join& join) {
    std::vector<RimPart> joined(groups_of(cols) * groups_of(rows));
    for_chunks(joined.size(), 1, execution_, [&](Range r) {
      JoinedParts group = join(Group::of(r.first, cols, rows), r.first);
      maze_.turn(group.turned);
      joined[r.first] = std::move(group.whole);
    });
    return joined;
  }

  std::size_t tile_of(const Group& group, std::size_t i) const {
    return first_tile_ + (group.first_row + i / group.cols) * maze_.tile_cols() + group.first_col + i % group.cols;
  }

  /// The first level is nearly all of the work, and what is kept.
  JoinedParts tiles(const Group& group, std::size_t number) {
    if (kept_ == nullptr) return make_tiles(group);
    if (const auto bytes = kept_->find(PartKind::maze_group, number)) {
      ValueUnpacker from(*bytes, "a kept part of the maze");
      JoinedParts kept{RimPart::unpack(from), from.take_list<std::uint64_t>()};
      for (std::size_t i = 0; i < group.size(); ++i) {
        maze_.choices_[tile_of(group, i)] = from.take_list<std::uint64_t>();
      }
      return kept;
    }
    JoinedParts made = make_tiles(group);
    ValuePacker packer;
    made.whole.pack(packer);
    packer.add_list(made.turned);
    for (std::size_t i = 0; i < group.size(); ++i) packer.add_list(maze_.choices_[tile_of(group, i)]);
    kept_->keep(PartKind::maze_group, number, packer.bytes());
    return made;
  }

  JoinedParts make_tiles(const Group& group) {
    std::vector<RimPart> made;
    maze::SpanningTile scratch(maze_.seed_);
    for (std::size_t i = 0; i < group.size(); ++i) {
      const GridPiece at = maze_.piece(tile_of(group, i));
      execution_.check();
      scratch.make(at);
      scratch.choices(maze_.choices_[tile_of(group, i)]);
      made.push_back({at, {scratch.rim_edges().begin(), scratch.rim_edges().end()}});
    }
    return join_parts(maze_.seed_, made, group.cols, maze_.side_log2(), execution_);
  }

  SpanningMaze& maze_;
  const std::size_t first_tile_;
  KeptParts* const kept_;
  const Execution& execution_;
};

class SpanningMaze::Reader : public CellWallReader {
 public:
  explicit Reader(const SpanningMaze& maze) : maze_(maze), weights_(maze.seed_), tree_(maze.seed_) {}

  void read(std::size_t number, CellTile& tile) override {
    maze_.place(number, tile);
    open_tree(number, tile);
    for (const std::uint32_t place : maze_.turned_[number]) turn(tile, column_of(place), row_of(place), place & 1U);
    const std::uint32_t last = (1U << maze_.side_log2()) - 1;
    if (tile.first_col > 0) {
      for (const std::uint32_t place : maze_.turned_[number - 1]) {
        if ((place & 1U) == 0 && column_of(place) == last) turn(tile, -1, row_of(place), 0);
      }
    }
    if (tile.first_row > 0) {
      for (const std::uint32_t place : maze_.turned_[number - maze_.tile_cols()]) {
        if ((place & 1U) == 1 && row_of(place) == last) turn(tile, column_of(place), -1, 1);
      }
    }
    if (maze_.open_below_ > 0) open_loops(tile);
    if (number == 0) turn(tile, -1, 0, 0);
    if (number + 1 == maze_.tile_count()) turn(tile, tile.width - 1, tile.height - 1, 0);
  }

 private:
  static std::uint32_t column_of(std::uint32_t place) { return place >> 1U & 0xffU; }
  static std::uint32_t row_of(std::uint32_t place) { return place >> 9U; }
  static void turn(CellTile& tile, std::ptrdiff_t col, std::ptrdiff_t row, unsigned direction) {
    std::uint8_t& walls = tile.walls[tile.index(col, row)];
    walls = static_cast<std::uint8_t>(walls ^ (1U << direction));
  }

  void open_tree(std::size_t number, CellTile& tile) {
    tree_.remake(maze_.piece(number), maze_.choices_[number]);
    const std::uint8_t* open = tree_.open().data();
    for (std::uint32_t row = 0; row < tile.height; ++row) {
      std::uint8_t* const walls = tile.walls.data() + tile.index(0, row);
      for (std::uint32_t col = 0; col < tile.width; ++col) walls[col] = static_cast<std::uint8_t>(walls[col] ^ *open++);
    }
  }

  void open_loops(CellTile& tile) const {
    for (std::ptrdiff_t row = -1; row < std::ptrdiff_t{tile.height}; ++row) {
      for (std::ptrdiff_t col = -1; col < std::ptrdiff_t{tile.width}; ++col) {
        if (row >= 0) draw(tile, col, row, 0);
        if (col >= 0) draw(tile, col, row, 1);
      }
    }
  }
  /// Only walls between two cells fall.
  void draw(CellTile& tile, std::ptrdiff_t col, std::ptrdiff_t row, unsigned direction) const {
    const std::ptrdiff_t maze_col = std::ptrdiff_t{tile.first_col} + col;
    const std::ptrdiff_t maze_row = std::ptrdiff_t{tile.first_row} + row;
    if (maze_col < 0 || maze_row < 0) return;
    if (direction == 0 ? maze_col + 1 == maze_.cols() : maze_row + 1 == maze_.rows()) return;
    if ((tile.walls[tile.index(col, row)] >> direction & 1U) == 0) return;
    const std::uint64_t number =
        edge_number(static_cast<std::uint64_t>(maze_col), static_cast<std::uint64_t>(maze_row), direction);
    if (mix64(~weights_(number)) >> 11 < maze_.open_below_) turn(tile, col, row, direction);
  }

  const SpanningMaze& maze_;
  const EdgeWeights weights_;
  maze::SpanningTile tree_;
};

SpanningMaze::SpanningMaze(std::uint32_t rows, std::uint32_t cols, std::uint64_t seed, double loops,
                           const Execution& execution, unsigned side_log2, KeptParts* kept)
    : CellWallSource(rows, cols, side_log2), seed_(seed), open_below_(open_below(rows, cols, loops)) {
  const std::size_t tile_rows = tile_count() / tile_cols();
  Builder(*this, {0, tile_rows}, kept, execution).run(tile_rows);
}

SpanningMaze::SpanningMaze(std::uint32_t rows, std::uint32_t cols, std::uint64_t seed, double loops, Range own,
                           RimPart& rim, const Execution& execution, unsigned side_log2)
    : CellWallSource(rows, cols, side_log2), seed_(seed), open_below_(open_below(rows, cols, loops)) {
  rim = Builder(*this, own, nullptr, execution).run(own.last - own.first);
}

void SpanningMaze::turn(std::span<const std::uint64_t> edges) {
  const std::uint32_t last = (1U << side_log2()) - 1;
  for (const std::uint64_t edge : edges) {
    const std::uint32_t col = edge_col(edge);
    const std::uint32_t row = edge_row(edge);
    if (col >= cols() || row >= rows()) throw InputError("maze", "an edge lies beyond it");
    turned_[tile_of(col, row)].push_back(((row & last) << 8U | (col & last)) << 1U | edge_direction(edge));
  }
}

std::unique_ptr<CellWallReader> SpanningMaze::reader() const { return std::make_unique<Reader>(*this); }

maze::GridPiece SpanningMaze::piece(std::size_t tile) const {
  const std::uint32_t side = 1U << side_log2();
  const std::uint32_t col = static_cast<std::uint32_t>(tile % tile_cols()) * side;
  const std::uint32_t row = static_cast<std::uint32_t>(tile / tile_cols()) * side;
  const std::uint32_t width = std::min(side, cols() - col);
  const std::uint32_t height = std::min(side, rows() - row);
  const unsigned more =
      (col + width < cols() ? 1U : 0U) | (row + height < rows() ? 2U : 0U) | (col > 0 ? 4U : 0U) | (row > 0 ? 8U : 0U);
  return {col, row, width, height, more};
}

}  // namespace warren

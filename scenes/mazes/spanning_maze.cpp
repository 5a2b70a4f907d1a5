// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/mazes/spanning_maze.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/raw_vector.hpp"
#include "parallel/chunks.hpp"
#include "scenes/mazes/maze_carving.hpp"

namespace warren {
namespace {

using maze::edge_col, maze::edge_direction, maze::edge_number, maze::edge_row, maze::EdgeWeights, maze::GridPiece,
    maze::JoinedParts, maze::RimPart;

constexpr std::uint32_t group_side = 8;  // pieces that are joined at once, along a side

std::uint32_t local_place(std::uint32_t col, std::uint32_t row, unsigned direction) {
  return (row << 8U | col) << 1U | direction;
}

/// A rectangle of parts, in rows.
struct Parts {
  std::size_t cols = 0;
  std::vector<RimPart> list;
};

/// The rectangle of parts that group g of 8 x 8 is made of.
struct Group {
  std::size_t first_col, first_row, cols, rows;
  static Group of(std::size_t g, std::size_t cols, std::size_t rows) {
    const std::size_t across = (cols - 1) / group_side + 1;
    const std::size_t col = g % across * group_side;
    const std::size_t row = g / across * group_side;
    return {col, row, std::min<std::size_t>(group_side, cols - col), std::min<std::size_t>(group_side, rows - row)};
  }
  std::size_t size() const { return cols * rows; }
  static std::size_t count(std::size_t cols, std::size_t rows) {
    return ((cols - 1) / group_side + 1) * ((rows - 1) / group_side + 1);
  }
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
  Builder(SpanningMaze& maze, TileRows rows, KeptParts* kept, const Execution& execution)
      : maze_(maze), first_tile_(rows.first * maze.tile_cols()), kept_(kept), execution_(execution) {}

  RimPart run(std::size_t rows) {
    const std::size_t cols = maze_.tile_cols();
    const std::uint64_t side = std::uint64_t{1} << maze_.side_log2();
    // choices, turned edges, what levels hand on
    execution_.reserve(cols * rows * (side * side / 12 + side * 16 + 128) + 48 * maze_.tile_count());
    maze_.turned_.resize(maze_.tile_count());
    maze_.choices_.resize(maze_.tile_count());
    Parts parts = join_all(cols, rows, [&](const Group& group, std::size_t number) { return tiles(group, number); });
    while (parts.list.size() > 1) {
      const std::size_t width = parts.cols;
      parts = join_all(width, parts.list.size() / width, [&](const Group& group, std::size_t) {
        std::vector<RimPart> taken;
        for (std::size_t row = 0; row < group.rows; ++row) {
          const auto first =
              parts.list.begin() + static_cast<std::ptrdiff_t>((group.first_row + row) * width + group.first_col);
          std::move(first, first + static_cast<std::ptrdiff_t>(group.cols), std::back_inserter(taken));
        }
        return join_parts(maze_.seed_, taken, group.cols, maze_.side_log2(), execution_);
      });
    }
    return std::move(parts.list.front());
  }

 private:
  /// One level: join(group, number) makes one part of a group. A group decides edges of its own tiles alone, so no two
  /// threads meet.
  template <class Join>
  Parts join_all(std::size_t cols, std::size_t rows, const Join& join) {
    Parts joined{(cols - 1) / group_side + 1, std::vector<RimPart>(Group::count(cols, rows))};
    for_chunks(joined.list.size(), 1, execution_, [&](Range r) {
      JoinedParts group = join(Group::of(r.first, cols, rows), r.first);
      maze_.turn(group.turned);
      joined.list[r.first] = std::move(group.whole);
    });
    return joined;
  }

  std::size_t tile_of(const Group& group, std::size_t i) const {
    return first_tile_ + (group.first_row + i / group.cols) * maze_.tile_cols() + group.first_col + i % group.cols;
  }

  /// The first level is nearly all of the work, and what is kept.
  JoinedParts tiles(const Group& group, std::size_t number) {
    if (kept_ == nullptr) return make_tiles(group);
    if (const auto bytes = kept_->find(PartKind::maze_group, number)) return unpack(group, *bytes);
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

  JoinedParts unpack(const Group& group, std::span<const std::byte> bytes) {
    ValueUnpacker from(bytes, "a kept part of the maze");
    JoinedParts kept;
    kept.whole = RimPart::unpack(from);
    kept.turned = from.take_list<std::uint64_t>();
    for (std::size_t i = 0; i < group.size(); ++i) {
      maze_.choices_[tile_of(group, i)] = from.take_list<std::uint64_t>();
    }
    return kept;
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
    if (maze_.loops_.any()) open_loops(tile);
    if (number == 0) turn(tile, -1, 0, 0);
    if (number + 1 == maze_.tile_count())
      turn(tile, std::ptrdiff_t{tile.width} - 1, std::ptrdiff_t{tile.height} - 1, 0);
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
    if (maze_.loops_(weights_(number))) turn(tile, col, row, direction);
  }

  const SpanningMaze& maze_;
  const EdgeWeights weights_;
  maze::SpanningTile tree_;
};

SpanningMaze::SpanningMaze(std::uint32_t rows, std::uint32_t cols, std::uint64_t seed, double loops,
                           const Execution& execution, unsigned side_log2, KeptParts* kept)
    : CellWallSource(rows, cols, side_log2), seed_(seed), loops_(loops) {
  check_spanning_maze(rows, cols, loops);
  const std::size_t tile_rows = tile_count() / tile_cols();
  Builder(*this, {0, tile_rows}, kept, execution).run(tile_rows);
}

SpanningMaze::SpanningMaze(std::uint32_t rows, std::uint32_t cols, std::uint64_t seed, double loops, TileRows own,
                           RimPart& rim, const Execution& execution, unsigned side_log2)
    : CellWallSource(rows, cols, side_log2), seed_(seed), loops_(loops) {
  check_spanning_maze(rows, cols, loops);
  rim = Builder(*this, own, nullptr, execution).run(own.last - own.first);
}

void SpanningMaze::turn(std::span<const std::uint64_t> edges) {
  const std::uint32_t last = (1U << side_log2()) - 1;
  for (const std::uint64_t edge : edges) {
    const std::uint32_t col = edge_col(edge);
    const std::uint32_t row = edge_row(edge);
    if (col >= cols() || row >= rows()) throw InputError("maze", "an edge lies beyond it");
    turned_[tile_of(col, row)].push_back(local_place(col & last, row & last, edge_direction(edge)));
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

namespace warren::maze {
namespace {

constexpr std::uint32_t not_on_rim = std::numeric_limits<std::uint32_t>::max();

/// Joins a rectangle of parts to one.
class Joining {
 public:
  Joining(std::uint64_t seed, std::span<RimPart> parts, std::size_t cols, unsigned side_log2)
      : weights_(seed), parts_(parts), cols_(cols), last_((1U << side_log2) - 1) {}

  JoinedParts run(const Execution& execution) {
    JoinedParts joined;
    RimPart& whole = joined.whole;
    whole.at = frame();
    number_vertices(whole.at);
    take_edges();
    std::sort(edges_.begin(), edges_.end(), [](const Edge& a, const Edge& b) { return a.weight < b.weight; });
    execution.check();
    Regions<std::uint32_t> regions(first_.back(), {1, execution.deadline});
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

  GridPiece frame() const {
    const GridPiece& low = parts_.front().at;
    const GridPiece& high = parts_.back().at;
    return {low.first_col, low.first_row, high.first_col + high.width - low.first_col,
            high.first_row + high.height - low.first_row, (low.more & 12U) | (high.more & 3U)};
  }

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

  void join(const Edge& edge, Regions<std::uint32_t>& regions, JoinedParts& joined) {
    const std::uint32_t a = regions.root(edge.between.a);
    const std::uint32_t b = regions.root(edge.between.b);
    if (!regions.join(a, b)) return note(edge.between.edge, false, joined);
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

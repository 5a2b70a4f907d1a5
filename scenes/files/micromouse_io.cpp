// SPDX-License-Identifier: BSD-3-Clause
// Micromouse mazes as text: posts `o`, walls `---` and `|`, S and G in the middle of cells, the top line is the north.
// 2 H + 1 lines of 4 W + 1 characters; blanks at the ends of lines may be missing. Read as a maze of unit walls. Or as
// numbers (.num): a line X Y N E S W a cell, counted from 0 in the lower left corner, 1 where a wall is; such mazes
// begin in that corner and end in one of the middle cells.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/asked_memory.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {
namespace {

bool is_post(char c) { return c == 'o' || c == '+'; }

std::string_view without_trailing_blanks(std::string_view line) {
  return line.substr(0, line.find_last_not_of("\r ") + 1);  // npos + 1 is 0
}

/// The picture, and the walls that it shows.
class Picture {
 public:
  Picture(const InputFile& file, const Execution& execution) : name_(file.name()), execution_(execution) {
    TextLines lines(file, execution);
    while (lines.next()) push_asked(lines_, without_trailing_blanks(lines.line()), execution);
    while (!lines_.empty() && lines_.back().empty()) lines_.pop_back();
    cols_ = (lines_.front().size() - 1) / 4;
    rows_ = (lines_.size() - 1) / 2;
  }

  void check() const {
    if (lines_.size() % 2 == 0 || lines_.size() < 3) {
      throw InputError(name_, "expected 2 H + 1 lines for H rows of cells", fmt::format("{} lines", lines_.size()));
    }
    if (!is_post(lines_.back().empty() ? ' ' : lines_.back().front()))
      fail(lines_.size() - 1, "expected a row of posts");
    bool has_start = false;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (lines_[i].size() > 4 * cols_ + 1) {
        fail(i, fmt::format("expected at most {} characters, as many as the first line has", 4 * cols_ + 1));
      }
      if (const auto tab = lines_[i].find('\t'); tab != lines_[i].npos) {  // it would shift what follows
        fail(i, fmt::format("expected blanks, not a tab, at column {}", tab + 1));
      }
      for (std::size_t c = 0; c <= cols_; ++c) {
        execution_.poll(c);
        i % 2 == 0 ? check_posts(i, c) : check_cells(i, c);
        if (i % 2 == 0 || c == cols_ || at(i, 4 * c + 2) != 'S') continue;
        if (has_start) fail(i, "a second `S`: one cell is the start");
        has_start = true;
      }
    }
  }

  Scene scene() const {
    std::vector<Segment> walls;
    for (std::size_t i = 0; i < lines_.size(); i += 2) {
      add_runs(
          walls, cols_, [&](std::size_t c) { return at(i, 4 * c + 2) == '-'; },
          [&](double x) {
            return Vec2{x, line_y(i)};
          });
    }
    for (std::size_t c = 0; c <= cols_; ++c) {
      const double x = static_cast<double>(c) + 0.5;
      add_runs(
          walls, rows_, [&](std::size_t r) { return at(lines_.size() - 2 - 2 * r, 4 * c) == '|'; },
          [&](double y) {
            return Vec2{x, y};
          });
    }
    execution_.reserve(walls.size() * sizeof(DoubleWall));
    Scene scene;
    scene.walls = WallSet::narrowest(walls);
    scene.maze = MazeHint{static_cast<std::uint32_t>(rows_), static_cast<std::uint32_t>(cols_)};
    scene.start = find('S');
    scene.goal = nearest_goal();
    scene.source = name_;
    return scene;
  }

 private:
  [[noreturn]] void fail(std::size_t line, std::string_view what, std::string_view found = {}) const {
    scene_text::Place{name_, line + 1}.fail(what, found);
  }
  char at(std::size_t line, std::size_t column) const {
    return column < lines_[line].size() ? lines_[line][column] : ' ';
  }
  double line_y(std::size_t line) const { return static_cast<double>(lines_.size() - 1 - line) / 2 + 0.5; }

  void check_posts(std::size_t line, std::size_t c) const {
    const char post = at(line, 4 * c);
    if (!is_post(post)) fail(line, fmt::format("expected a post `o` at column {}", 4 * c + 1), std::string(1, post));
    if (c == cols_) return;
    const std::string wall{at(line, 4 * c + 1), at(line, 4 * c + 2), at(line, 4 * c + 3)};
    if (wall != "---" && wall != "   ") {
      fail(line, fmt::format("expected `---` or three blanks at column {}", 4 * c + 2), wall);
    }
  }
  void check_cells(std::size_t line, std::size_t c) const {
    const char wall = at(line, 4 * c);
    if (wall != '|' && wall != ' ') {
      fail(line, fmt::format("expected `|` or a blank at column {}", 4 * c + 1), std::string(1, wall));
    }
    for (std::size_t column = 4 * c + 1; c < cols_ && column < 4 * c + 4; ++column) {
      const char found = at(line, column);
      if (found != '|' && !(found == '-' && at(line, column + 1) == '-')) continue;
      fail(line, fmt::format("expected no wall within a cell, at column {}", column + 1), std::string(1, found));
    }
  }

  /// A wall for each run of them, from first - 0.5 to last + 0.5 in cell coordinates; end(coordinate): where that is.
  template <class IsWall, class End>
  void add_runs(std::vector<Segment>& walls, std::size_t count, const IsWall& is_wall, const End& end) const {
    for (std::size_t first = 0; first < count; ++first) {
      execution_.poll(first);
      if (!is_wall(first)) continue;
      std::size_t last = first + 1;
      while (last < count && is_wall(last)) ++last;
      push_asked(walls, {end(static_cast<double>(first) + 0.5), end(static_cast<double>(last) + 0.5)}, execution_);
      first = last;
    }
  }

  // Cells are numbered in reading order.
  char mark(std::size_t cell) const { return at(2 * (cell / cols_) + 1, 4 * (cell % cols_) + 2); }
  std::vector<double> middle(std::size_t cell) const {
    return {static_cast<double>(cell % cols_ + 1), line_y(2 * (cell / cols_) + 1)};
  }
  std::size_t first_cell(char wanted) const {
    std::size_t cell = 0;
    while (cell < rows_ * cols_ && mark(cell) != wanted) execution_.poll(++cell);
    return cell;
  }
  std::vector<double> find(char wanted) const {
    const std::size_t cell = first_cell(wanted);
    return cell < rows_ * cols_ ? middle(cell) : std::vector<double>{};
  }

  template <class Visit>
  void for_each_open_neighbour(std::size_t cell, const Visit& visit) const {
    const std::size_t line = 2 * (cell / cols_) + 1;
    const std::size_t column = 4 * (cell % cols_);
    if (line > 1 && at(line - 1, column + 2) != '-') visit(cell - cols_);
    if (column > 0 && at(line, column) != '|') visit(cell - 1);
    if (cell % cols_ + 1 < cols_ && at(line, column + 4) != '|') visit(cell + 1);
    if (line + 2 < lines_.size() && at(line + 1, column + 2) != '-') visit(cell + cols_);
  }

  /// The G that takes the fewest cells from S, the first of these in reading order; the first of all where none can be
  /// reached.
  std::vector<double> nearest_goal() const {
    const std::size_t count = rows_ * cols_;
    const std::size_t start = first_cell('S');
    if (start == count) return find('G');
    execution_.reserve(count + 2 * (rows_ + cols_) * sizeof(std::size_t));
    std::vector<char> seen(count, 0);
    std::vector<std::size_t> level{start};
    std::vector<std::size_t> next;
    for (seen[start] = 1; !level.empty(); level.swap(next)) {
      execution_.check();
      std::size_t goal = count;
      next.clear();
      for (const std::size_t cell : level) {
        if (mark(cell) == 'G') goal = std::min(goal, cell);
        for_each_open_neighbour(cell, [&](std::size_t to) {
          if (seen[to] == 0) next.push_back(to);
          seen[to] = 1;
        });
      }
      if (goal < count) return middle(goal);
    }
    return find('G');
  }

  const std::string& name_;
  const Execution& execution_;
  std::vector<std::string_view> lines_;
  std::size_t cols_ = 0;
  std::size_t rows_ = 0;
};

/// The cells of a file of numbers, drawn as the other kind of file has them.
class NumberedCells {
 public:
  NumberedCells(const InputFile& file, const Execution& execution) : name_(file.name()), execution_(execution) {
    TextLines lines(file, execution);
    while (lines.next()) {
      scene_text::Fields fields = lines.fields();
      if (fields.done()) continue;
      Cell cell{.line = lines.number()};
      for (std::uint32_t* number : {&cell.x, &cell.y, &cell.north, &cell.east, &cell.south, &cell.west}) {
        *number = read(fields, number == &cell.x || number == &cell.y ? 0x7fffffff : 1);
      }
      if (!fields.done()) fail(cell, "expected X Y N E S W and no more");
      push_asked(cells_, cell, execution);
      cols_ = std::max<std::size_t>(cols_, cell.x + 1);
      rows_ = std::max<std::size_t>(rows_, cell.y + 1);
    }
    if (cells_.empty() || cells_.size() != rows_ * cols_) {
      throw InputError(name_, fmt::format("expected a line X Y N E S W for each of {} x {} cells", rows_, cols_),
                       fmt::format("{} lines", cells_.size()));
    }
    check();
  }

  std::string picture() const {
    const std::size_t width = 4 * cols_ + 2;
    execution_.reserve(width * (2 * rows_ + 1));
    std::string text(width * (2 * rows_ + 1), ' ');
    for (std::size_t row = 0; row <= 2 * rows_; ++row) {
      for (std::size_t c = 0; c <= cols_ && row % 2 == 0; ++c) text[row * width + 4 * c] = 'o';
      text[row * width + width - 1] = '\n';
      execution_.check();
    }
    for_cells([&](const Cell& cell) {
      const std::size_t at = 2 * (rows_ - 1 - cell.y) * width + 4 * std::size_t{cell.x};  // its upper left post
      if (cell.north != 0) text.replace(at + 1, 3, "---");
      if (cell.south != 0) text.replace(at + 2 * width + 1, 3, "---");
      if (cell.west != 0) text[at + width] = '|';
      if (cell.east != 0) text[at + width + 4] = '|';
      const auto is_middle = [](std::size_t i, std::size_t count) { return i == (count - 1) / 2 || i == count / 2; };
      if (is_middle(cell.x, cols_) && is_middle(cell.y, rows_)) text[at + width + 2] = 'G';
      if (cell.x == 0 && cell.y == 0) text[at + width + 2] = 'S';
    });
    return text;
  }

 private:
  struct Cell {
    std::size_t line = 0;
    std::uint32_t x = 0, y = 0, north = 0, east = 0, south = 0, west = 0;
  };

  [[noreturn]] void fail(const Cell& cell, std::string_view what) const {
    scene_text::Place{name_, cell.line}.fail(what, {});
  }
  static std::uint32_t read(scene_text::Fields& fields, std::uint32_t most) {
    const std::string_view word = fields.word();
    const auto number = scene_text::number_in_full<std::uint32_t>(word);
    if (!number || *number > most) {
      fields.place().fail("expected X Y N E S W: a cell of a micromouse maze, whole numbers, and 1 where a wall is",
                          word);
    }
    return *number;
  }
  template <class Visit>
  void for_cells(const Visit& visit) const {
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      execution_.poll(i);
      visit(cells_[i]);
    }
  }
  /// No cell is there twice, and two that lie side by side say the same of what is between them.
  void check() const {
    execution_.reserve(cells_.size() * sizeof(void*));
    std::vector<const Cell*> at(cells_.size(), nullptr);
    for_cells([&](const Cell& cell) {
      const Cell*& here = at[cell.y * cols_ + cell.x];
      if (here != nullptr) fail(cell, fmt::format("the cell {} {} is there twice", cell.x, cell.y));
      here = &cell;
    });
    for_cells([&](const Cell& cell) {
      const std::size_t place = cell.y * cols_ + cell.x;
      const bool fits =
          (cell.x == 0 || at[place - 1]->east == cell.west) && (cell.y == 0 || at[place - cols_]->north == cell.south);
      if (!fits) fail(cell, "a neighbour says otherwise of the wall in the west or south");
    });
  }

  const std::string& name_;
  const Execution& execution_;
  std::vector<Cell> cells_;
  std::size_t cols_ = 0;
  std::size_t rows_ = 0;
};

/// Two whole numbers and four of 0 and 1, as the first line's beginning tells?
bool are_numbers(std::string_view bytes) {
  const std::string no_file;
  const std::string_view line = bytes.substr(0, std::min(bytes.find('\n'), bytes_that_tell));
  scene_text::Fields fields(line, {no_file, 1});
  std::string_view word = fields.word();
  for (int i = 0; i < 6; ++i, word = fields.word()) {
    if (word.empty() || word.find_first_not_of(i < 2 ? "0123456789" : "01") != word.npos) return false;
    if (i >= 2 && word.size() != 1) return false;
  }
  return word.empty();
}

}  // namespace

bool is_micromouse(std::string_view bytes) {
  if (are_numbers(bytes)) return true;
  const std::string_view head = bytes.substr(0, bytes_that_tell);
  const std::size_t end = head.find('\n');
  const bool whole = end != head.npos || head.size() == bytes.size();
  const std::string_view line = whole ? without_trailing_blanks(head.substr(0, end)) : head;
  if (line.size() < 5 || (whole && line.size() % 4 != 1)) return false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const bool fits = i % 4 == 0 ? is_post(line[i]) : line[i] == '-' || line[i] == ' ';
    if (!fits) return false;
  }
  return true;
}

Scene read_micromouse(const InputFile& file, const Execution& execution) {
  if (are_numbers(file.bytes()) || (file.name().ends_with(".num") && !is_micromouse(file.bytes()))) {
    return read_micromouse(InputFile::of_bytes(file.name(), NumberedCells(file, execution).picture()), execution);
  }
  if (!is_micromouse(file.bytes())) {
    scene_text::Place{file.name(), 1}.fail("expected a row of posts, o---o---o", file.bytes().substr(0, 40));
  }
  const Picture picture(file, execution);
  picture.check();
  return picture.scene();
}

}  // namespace warren

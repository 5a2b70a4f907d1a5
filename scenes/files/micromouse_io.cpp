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
    WallCollector walls(execution_);
    for (std::size_t i = 0; i < lines_.size(); i += 2) {
      add_runs(walls, cols_, {0.5, line_y(i)}, {1.0, 0.0}, [&](std::size_t c) { return at(i, 4 * c + 2) == '-'; });
    }
    for (std::size_t c = 0; c <= cols_; ++c) {
      add_runs(walls, rows_, {static_cast<double>(c) + 0.5, 0.5}, {0.0, 1.0},
               [&](std::size_t r) { return at(lines_.size() - 2 - 2 * r, 4 * c) == '|'; });
    }
    Scene scene;
    scene.walls = walls.take();
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

  /// A wall for each run of them; the first of `count` would begin at `begin`, and each is a step long.
  template <class IsWall>
  void add_runs(WallCollector& walls, std::size_t count, Vec2 begin, Vec2 step, const IsWall& is_wall) const {
    for (std::size_t first = 0; first < count; ++first) {
      execution_.poll(first);
      if (!is_wall(first)) continue;
      std::size_t last = first + 1;
      while (last < count && is_wall(last)) ++last;
      const Vec2 ends[] = {begin + static_cast<double>(first) * step, begin + static_cast<double>(last) * step};
      walls.add_chain(ends);
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
        const auto visit = [&](std::size_t to) {
          if (seen[to] == 0) next.push_back(to);
          seen[to] = 1;
        };
        const std::size_t line = 2 * (cell / cols_) + 1;
        const std::size_t column = 4 * (cell % cols_);
        if (line > 1 && at(line - 1, column + 2) != '-') visit(cell - cols_);
        if (column > 0 && at(line, column) != '|') visit(cell - 1);
        if (cell % cols_ + 1 < cols_ && at(line, column + 4) != '|') visit(cell + 1);
        if (line + 2 < lines_.size() && at(line + 1, column + 2) != '-') visit(cell + cols_);
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

struct NumberedCell {
  std::size_t line = 0;
  std::uint32_t x = 0, y = 0, north = 0, east = 0, south = 0, west = 0;
};

std::vector<NumberedCell> numbered_cells(const InputFile& file, const Execution& execution) {
  std::vector<NumberedCell> cells;
  TextLines lines(file, execution);
  while (lines.next()) {
    scene_text::Fields fields = lines.fields();
    if (fields.done()) continue;
    NumberedCell cell{.line = lines.number()};
    for (std::uint32_t* number : {&cell.x, &cell.y, &cell.north, &cell.east, &cell.south, &cell.west}) {
      const std::string_view word = fields.word();
      const auto read = scene_text::number_in_full<std::uint32_t>(word);
      if (!read || *read > (number == &cell.x || number == &cell.y ? 0x7fffffffU : 1U)) {
        fields.place().fail("expected X Y N E S W: a cell of a micromouse maze, whole numbers, and 1 where a wall is",
                            word);
      }
      *number = *read;
    }
    if (!fields.done()) fields.place().fail("expected X Y N E S W and no more");
    push_asked(cells, cell, execution);
  }
  return cells;
}

/// The cells of a file of numbers, drawn as the other kind of file has them. No cell is there twice, and two that lie
/// side by side say the same of what is between them.
std::string picture_of_numbers(const InputFile& file, const Execution& execution) {
  const std::vector<NumberedCell> cells = numbered_cells(file, execution);
  const auto for_cells = [&](const auto& visit) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      execution.poll(i);
      visit(cells[i]);
    }
  };
  const auto fail = [&](const NumberedCell& cell, std::string_view what) {
    scene_text::Place{file.name(), cell.line}.fail(what);
  };
  std::size_t cols = 0;
  std::size_t rows = 0;
  for_cells([&](const NumberedCell& cell) {
    cols = std::max<std::size_t>(cols, cell.x + 1);
    rows = std::max<std::size_t>(rows, cell.y + 1);
  });
  if (cells.empty() || cells.size() != rows * cols) {
    throw InputError(file.name(), fmt::format("expected a line X Y N E S W for each of {} x {} cells", rows, cols),
                     fmt::format("{} lines", cells.size()));
  }
  execution.reserve(cells.size() * sizeof(void*));
  std::vector<const NumberedCell*> at(cells.size(), nullptr);
  for_cells([&](const NumberedCell& cell) {
    const NumberedCell*& here = at[cell.y * cols + cell.x];
    if (here != nullptr) fail(cell, fmt::format("the cell {} {} is there twice", cell.x, cell.y));
    here = &cell;
  });
  const std::size_t width = 4 * cols + 2;
  execution.reserve(width * (2 * rows + 1));
  std::string text(width * (2 * rows + 1), ' ');
  for (std::size_t row = 0; row <= 2 * rows; ++row) {
    for (std::size_t c = 0; c <= cols && row % 2 == 0; ++c) text[row * width + 4 * c] = 'o';
    text[row * width + width - 1] = '\n';
    execution.check();
  }
  for_cells([&](const NumberedCell& cell) {
    const std::size_t place = cell.y * cols + cell.x;
    const bool fits =
        (cell.x == 0 || at[place - 1]->east == cell.west) && (cell.y == 0 || at[place - cols]->north == cell.south);
    if (!fits) fail(cell, "a neighbour says otherwise of the wall in the west or south");
    const std::size_t corner = 2 * (rows - 1 - cell.y) * width + 4 * std::size_t{cell.x};  // its upper left post
    if (cell.north != 0) text.replace(corner + 1, 3, "---");
    if (cell.south != 0) text.replace(corner + 2 * width + 1, 3, "---");
    if (cell.west != 0) text[corner + width] = '|';
    if (cell.east != 0) text[corner + width + 4] = '|';
    const auto is_middle = [](std::size_t i, std::size_t count) { return i == (count - 1) / 2 || i == count / 2; };
    if (is_middle(cell.x, cols) && is_middle(cell.y, rows)) text[corner + width + 2] = 'G';
    if (cell.x == 0 && cell.y == 0) text[corner + width + 2] = 'S';
  });
  return text;
}

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
    return read_micromouse(InputFile::of_bytes(file.name(), picture_of_numbers(file, execution)), execution);
  }
  if (!is_micromouse(file.bytes())) {
    scene_text::Place{file.name(), 1}.fail("expected a row of posts, o---o---o", file.bytes().substr(0, 40));
  }
  const Picture picture(file, execution);
  picture.check();
  return picture.scene();
}

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// Moving AI's grid maps (`type octile`) and scenario files. In the files row 0 is the top row; in an OccupancyMap it is
// the bottom row, so a scenario's (x, y) is the cell (x, height - 1 - y). LF or CRLF; blanks may follow a line.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "core/base/error.hpp"
#include "parallel/asked_memory.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/text/output_file_io.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {
namespace {

/// Without what is left of its end.
std::string_view text_of(const TextLines& lines) {
  std::string_view line = lines.line();
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

constexpr std::size_t longest_line = 1 << 16;  // of words: a row of a map may be longer

bool is_blank(std::string_view line) { return line.find_first_not_of(" \t\r") == std::string_view::npos; }

/// Fields between any of these marks, blanks around them left out.
std::vector<std::string_view> split(const TextLines& lines, std::string_view marks) {
  std::vector<std::string_view> fields;
  std::string_view line = text_of(lines);
  if (line.size() > longest_line) lines.place().fail("expected a line of at most 65536 characters", line);
  while (!line.empty()) {
    const std::size_t end = std::min(line.find_first_of(marks), line.size());
    std::string_view field = line.substr(0, end);
    while (field.ends_with(' ')) field.remove_suffix(1);
    while (field.starts_with(' ')) field.remove_prefix(1);
    if (!field.empty()) fields.push_back(field);
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return fields;
}

/// Words of a header's next line; none at the end.
std::vector<std::string_view> next_words(TextLines& lines) {
  return lines.next() ? split(lines, " \t") : std::vector<std::string_view>{};
}

/// Fields between tabs, since names of maps may have blanks; between blanks where the line has no tab.
std::vector<std::string_view> fields_of(const TextLines& lines) {
  return split(lines, lines.line().find('\t') != std::string_view::npos ? "\t" : " ");
}

template <class T>
T number(std::string_view field, const scene_text::Place& place, std::string_view what) {
  const auto value = scene_text::number_in_full<T>(field);
  if (!value) place.fail(fmt::format("expected {}", what), field);
  return *value;
}

std::uint32_t size_line(TextLines& lines, std::string_view word) {
  const std::vector<std::string_view> fields = next_words(lines);
  const bool has_word = fields.size() == 2 && fields[0] == word;
  const auto value = has_word ? scene_text::number_in_full<std::uint32_t>(fields[1]) : std::nullopt;
  if (value && *value >= 1 && *value <= 0x7fffffffU) return *value;
  lines.place().fail(fmt::format("expected `{} N`, N from 1 to 2147483647", word),
                     fields.empty() ? "" : fields[has_word ? 1 : 0]);
}

/// Fills one row; returns how many cells are free.
std::uint64_t fill_row(std::string_view line, std::uint32_t y, const scene_text::Place& place, OccupancyMap& map,
                       const Execution& execution) {
  std::uint64_t free = 0;
  for (std::uint32_t x = 0; x < map.width(); ++x) {
    execution.poll(x);
    const char c = line[x];
    if (c == '.' || c == 'G' || c == 'S') {
      ++free;
      continue;
    }
    if (c != '@' && c != 'O' && c != 'T' && c != 'W')
      place.fail(fmt::format("expected one of . G S W @ O T at column {}", x + 1), line.substr(x, 1));
    if (c == 'W' && map.water.empty()) map.water = cell_bitmap(map.width(), map.height(), execution);
    if (c == 'W') map.water.set(x, y);
    map.blocked.set(x, y);
  }
  return free;
}

/// What follows a blank line and is no row is somebody's note: where the map is from, what to cite.
void refuse_more_rows(TextLines& lines, std::uint32_t width, std::uint32_t height) {
  bool is_note = false;
  while (lines.next()) {
    const std::string_view line = text_of(lines);
    is_note = is_note || is_blank(line);
    const bool is_row = line.size() == width && line.find_first_not_of(".GSW@OT") == std::string_view::npos;
    if (is_row || !is_note) lines.place().fail(fmt::format("expected nothing after {} rows", height));
  }
}

/// What is behind the `e` of a number; 0 where there is none.
int exponent_of(std::string_view digits) {
  int exponent = 0;
  digits.remove_prefix(std::min(digits.find_first_of("eE"), digits.size()));
  digits.remove_prefix(std::min(digits.find_first_not_of("eE+"), digits.size()));
  std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
  return exponent;
}

/// Half a unit of the last digit of a number >= 0 as it is written. Where it is whole, writers of six digits have left
/// out the zeros behind the point.
double half_unit_of(std::string_view digits, double value) {
  constexpr int usual_digits = 6;
  const std::size_t mantissa_end = std::min(digits.find_first_of("eE"), digits.size());
  const std::size_t point = std::min(digits.find('.'), mantissa_end);
  // 18 digits: more than tell a double from the next
  int last = value > 0.0 ? exponent_of(fmt::format("{:.17e}", value)) - (usual_digits - 1) : -usual_digits;
  if (point < mantissa_end) {
    constexpr int beyond_all = 1000;  // of a double
    last = std::clamp(exponent_of(digits), -beyond_all, beyond_all) - static_cast<int>(mantissa_end - point - 1);
  }
  const std::string half = fmt::format("5e{}", last - 1);
  double result = last > 0 ? std::numeric_limits<double>::infinity() : 0.0;  // kept where it is beyond all doubles
  std::from_chars(half.data(), half.data() + half.size(), result);
  return result;
}

Scenario scenario_of(const TextLines& lines, bool has_sizes) {
  const scene_text::Place place = lines.place();
  const std::vector<std::string_view> fields = fields_of(lines);
  const std::size_t expected = has_sizes ? 9 : 7;
  if (fields.size() != expected) {
    place.fail(has_sizes ? "expected bucket, map, its width and height, start x y, goal x y, optimal length"
                         : "expected bucket, map, start x y, goal x y, optimal length (version 0)",
               fmt::format("{} fields", fields.size()));
  }
  std::size_t next = 0;
  const auto whole = [&](std::string_view what) {
    return number<std::uint32_t>(fields[next++], place, fmt::format("{}, a whole number that is not negative", what));
  };
  Scenario scenario;
  scenario.line = place.line;
  scenario.bucket = whole("the bucket");
  scenario.map = fields[next++];
  if (has_sizes) {
    scenario.map_width = whole("the map's width");
    scenario.map_height = whole("the map's height");
  }
  for (std::uint32_t* coordinate : {&scenario.start.x, &scenario.start.y, &scenario.goal.x, &scenario.goal.y}) {
    *coordinate = whole("a coordinate");
  }
  scenario.length = number<double>(fields[next], place, "the optimal length");
  if (!(scenario.length >= 0.0 && std::isfinite(scenario.length))) {
    place.fail("expected the optimal length, not negative", fields[next]);
  }
  scenario.half_unit = half_unit_of(fields[next], scenario.length);
  return scenario;
}

std::uint32_t scaled(std::uint32_t coordinate, std::uint32_t map_size, std::uint32_t scenario_size) {
  if (scenario_size == 0 || scenario_size == map_size) return coordinate;
  return static_cast<std::uint32_t>(std::uint64_t{coordinate} * map_size / scenario_size);
}

}  // namespace

OccupancyMap read_moving_ai_map(const InputFile& file, const Execution& execution) {
  TextLines lines(file, execution);
  const std::vector<std::string_view> type = next_words(lines);
  if (type.size() != 2 || type[0] != "type" || type[1] != "octile") {
    lines.place().fail("expected `type octile`", type.empty() ? "" : type.back());
  }
  const std::uint32_t height = size_line(lines, "height");
  const std::uint32_t width = size_line(lines, "width");
  check_map_size(file.name(), width, height);
  if (next_words(lines) != std::vector<std::string_view>{"map"}) lines.place().fail("expected `map`");
  OccupancyMap map;
  map.format = MapFormat::moving_ai;
  map.source = file.name();
  if (file.bytes().size() / width < height) {
    throw InputError(file.name(), fmt::format("expected {} rows of {} cells; the file is too short", height, width));
  }
  map.blocked = cell_bitmap(width, height, execution);
  for (std::uint32_t row = 0; row < height; ++row) {
    if (!lines.next()) {
      throw InputError(file.name(), fmt::format("expected {} rows after `map`", height), fmt::format("{}", row));
    }
    std::string_view line = text_of(lines);  // editors leave blanks behind it; npos + 1 is 0
    line = line.substr(0, std::max<std::size_t>(width, line.find_last_not_of(" \t\r") + 1));
    if (line.size() != width) {
      lines.place().fail(fmt::format("expected a row of {} cells", width), fmt::format("{} characters", line.size()));
    }
    map.free += fill_row(line, height - 1 - row, lines.place(), map, execution);
  }
  refuse_more_rows(lines, width, height);
  map.occupied = map.blocked.size() - map.free;
  return map;
}

void write_moving_ai_map(const OccupancyMap& map, const std::string& path, const Execution& execution) {
  OutputFile file(path, execution);
  file.write(fmt::format("type octile\nheight {}\nwidth {}\nmap\n", map.height(), map.width()));
  execution.reserve(map.width());
  std::string line(map.width() + std::size_t{1}, '\n');
  for (std::uint32_t y = map.height(); y-- > 0;) {
    for (std::uint32_t x = 0; x < map.width(); ++x) {
      execution.poll(x);
      line[x] = map.water.holds(x, y) ? 'W' : map.blocked.test(x, y) ? '@' : '.';
    }
    file.write(line);
  }
  file.commit();
}

std::vector<Scenario> read_scenarios(const InputFile& file, const Execution& execution) {
  TextLines lines(file, execution);
  std::vector<Scenario> scenarios;
  bool has_sizes = false;
  bool first = true;
  while (lines.next()) {
    const std::string_view line = text_of(lines);
    if (is_blank(line)) continue;
    if (first && line.starts_with("version")) {
      const std::vector<std::string_view> fields = fields_of(lines);
      const double version = fields.size() == 2 ? number<double>(fields[1], lines.place(), "`version 1`") : -1.0;
      if (version != 0.0 && version != 1.0) lines.place().fail("expected `version 1` or `version 0`", line);
      has_sizes = version == 1.0;
    } else {
      push_asked(scenarios, scenario_of(lines, has_sizes), execution);
    }
    first = false;
  }
  if (scenarios.empty()) throw InputError(file.name(), "expected scenarios: a line each, fields between tabs");
  return scenarios;
}

Cell cell_of(const OccupancyMap& map, const Scenario& scenario, Cell from, const std::string& file) {
  const std::uint32_t x = scaled(from.x, map.width(), scenario.map_width);
  const std::uint32_t y = scaled(from.y, map.height(), scenario.map_height);
  if (x >= map.width() || y >= map.height()) {
    throw InputError(fmt::format("{}:{}", file, scenario.line),
                     fmt::format("expected a cell of the {} x {} map", map.width(), map.height()),
                     fmt::format("{}, {}", from.x, from.y));
  }
  return {x, map.height() - 1 - y};
}

Bitmap blocked_from(const OccupancyMap& map, Cell start) {
  if (map.water.empty() || !map.water.test(start.x, start.y)) return map.blocked;
  Bitmap blocked(map.width(), map.height(), true);
  blocked.remove(map.water);
  return blocked;
}

}  // namespace warren

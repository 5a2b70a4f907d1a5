// SPDX-License-Identifier: BSD-3-Clause
// Well-known text, in and out: POLYGON and MULTIPOLYGON are obstacles, LINESTRING and MULTILINESTRING walls, POINTs
// mark nothing, GEOMETRYCOLLECTION holds any of them, EMPTY is nothing. Any number of geometries, apart by blanks,
// lines or `;`; upper or lower case; `SRID=n;` and Z, M, ZM are understood and dropped. A polygon with holes becomes
// several that touch (scenes/scene/plane_obstacles). Rings of either orientation, closed.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/asked_memory.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "scenes/text/human_units.hpp"
#include "scenes/text/output_file_io.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {
namespace {

constexpr std::array<std::string_view, 7> type_names{
    "POINT", "LINESTRING", "POLYGON", "MULTIPOINT", "MULTIPOLYGON", "MULTILINESTRING", "GEOMETRYCOLLECTION"};
enum class Type : std::uint8_t { point, line, polygon, points, polygons, lines, collection };

bool is_wkt_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

/// Words, numbers and marks, with their lines.
class Tokens {
 public:
  Tokens(const std::string& name, std::string_view text, const Execution& execution)
      : name_(name), text_(without_byte_order_mark(text)), execution_(execution) {}
  std::size_t line() const { return line_; }
  [[noreturn]] void fail(std::string_view expected) const {
    const std::string_view found = text_.substr(0, text_.find_first_of("\r\n"));
    scene_text::Place{name_, line_}.fail(fmt::format("expected {}", expected), found.empty() ? "the end" : found);
  }
  bool done() {
    skip();
    return text_.empty();
  }
  bool next_is(char c) {
    skip();
    return !text_.empty() && text_.front() == c;
  }
  bool take(char c) {
    if (!next_is(c)) return false;
    text_.remove_prefix(1);
    return true;
  }
  void expect(char c) {
    if (!take(c)) fail(fmt::format("`{}`", c));
  }
  /// The next word in capitals; empty if none follows, cut off where it is longer than any that means something.
  std::string word() {
    constexpr std::size_t longest = 32;
    skip();
    std::string word;
    while (!text_.empty() && is_letter(text_.front()) && word.size() < longest) {
      word += upper(text_.front());
      text_.remove_prefix(1);
    }
    return word;
  }
  /// What says that more coordinates follow x and y, if it is there.
  void take_dimensions() {
    for (const std::string_view tag : {"ZM", "Z", "M"}) {
      if (take_word(tag)) return;
    }
  }
  bool take_word(std::string_view wanted) {
    const Tokens before = *this;
    if (word() == wanted) return true;
    text_ = before.text_;
    line_ = before.line_;
    return false;
  }
  bool number_follows() {
    skip();
    return !text_.empty() && ((text_.front() >= '0' && text_.front() <= '9') ||
                              std::string_view("+-.").find(text_.front()) != std::string_view::npos);
  }
  double number() {
    if (!number_follows()) fail("a number");
    double value = 0.0;
    constexpr std::size_t longest = 1 << 16;
    const char* begin = scene_text::without_plus(text_).data();
    const auto [end, error] = std::from_chars(begin, text_.data() + std::min(longest, text_.size()), value);
    if (end == text_.data() + longest) fail("a number of at most 65536 characters");
    const std::size_t length = static_cast<std::size_t>(end - text_.data());
    const bool tiny = error == std::errc::result_out_of_range && scene_text::rounds_to_zero(text_.substr(0, length));
    if ((error != std::errc() && !tiny) || !(std::abs(value) <= largest_coordinate))
      fail("a finite number of at most 1e60");
    const bool ends =
        length == text_.size() || is_wkt_space(*end) || std::string_view(",();").find(*end) != std::string_view::npos;
    if (!ends) fail("a number");
    text_.remove_prefix(length);
    return std::abs(value) < smallest_coordinate ? 0.0 : value;
  }
  /// Looks at the deadline now and then, and asks for the memory of what small rings follow.
  void look() {
    constexpr std::size_t batch = 1 << 14;
    constexpr std::size_t bytes_an_item = 128;
    if (++looks_ % batch == 0) execution_.reserve(batch * bytes_an_item);
  }

 private:
  void skip() {
    for (std::size_t steps = 1; !text_.empty() && is_wkt_space(text_.front()); ++steps) {
      execution_.poll(steps);
      if (text_.front() == '\n') ++line_;
      text_.remove_prefix(1);
    }
  }

  const std::string& name_;
  std::string_view text_;
  const Execution& execution_;
  std::size_t line_ = 1;
  std::size_t looks_ = 0;
};

class WktReader {
 public:
  WktReader(const InputFile& file, const Execution& execution)
      : name_(file.name()), execution_(execution), tokens_(file.name(), file.bytes(), execution), walls_(execution) {
    scene_.source = name_;
  }

  Scene read() {
    while (!tokens_.done()) {
      if (tokens_.take(';')) continue;
      if (tokens_.take_word("SRID")) {
        tokens_.expect('=');
        tokens_.number();
        tokens_.expect(';');
      }
      geometry(0);
    }
    scene_.walls = walls_.take();
    if (scene_.walls.size() == 0 && scene_.polygons.empty()) {
      throw InputError(name_, "there is no polygon and no line in it; expected WKT with some");
    }
    return std::move(scene_);
  }

 private:
  void geometry(int depth) {
    constexpr int deepest = 64;
    if (depth > deepest) tokens_.fail("geometry collections that are nested less deeply");
    const Type type = read_type();
    if (tokens_.take_word("EMPTY")) return;
    if (type == Type::point) chain();
    if (type == Type::points)
      list([&] { tokens_.next_is('(') ? static_cast<void>(chain()) : static_cast<void>(position()); });
    if (type == Type::line) line();
    if (type == Type::lines) list([&] { line(); });
    if (type == Type::polygon) polygon();
    if (type == Type::polygons) list([&] { polygon(); });
    if (type == Type::collection) list([&] { geometry(depth + 1); });
  }

  Type read_type() {
    const Tokens before = tokens_;
    std::string word = tokens_.word();
    for (const std::string_view tail : {"", "Z", "M", "ZM"}) {
      for (std::size_t i = 0; i < type_names.size(); ++i) {
        if (word != std::string{type_names[i]} + std::string{tail}) continue;
        if (tail.empty()) tokens_.take_dimensions();
        return static_cast<Type>(i);
      }
    }
    before.fail(fmt::format("one of {}", fmt::join(type_names, ", ")));
  }

  /// ( item , item , ... )
  template <class Item>
  void list(const Item& item) {
    tokens_.expect('(');
    do {
      tokens_.look();
      item();
    } while (tokens_.take(','));
    tokens_.expect(')');
  }

  Vec2 position() {
    const double x = tokens_.number();
    const double y = tokens_.number();
    for (int more = 0; more < 2 && tokens_.number_follows(); ++more) tokens_.number();
    return {x, y};
  }
  /// Points in brackets, with the line of the first.
  ScenePolygon chain() {
    ScenePolygon chain{{}, tokens_.line()};
    if (tokens_.take_word("EMPTY")) return chain;
    list([&] {
      if (chain.corners.empty()) chain.line = tokens_.line();
      push_asked(chain.corners, position(), execution_);
    });
    return chain;
  }
  void line() {
    const ScenePolygon read = chain();
    if (read.corners.size() == 1) place(read.line).fail("a LINESTRING needs two positions or more");
    walls_.add_chain(read.corners);
  }
  /// The first ring; the others are its holes.
  void polygon() {
    if (tokens_.take_word("EMPTY")) return;
    ScenePolygon outline{{}, tokens_.line()};
    std::vector<std::vector<Vec2>> holes;
    list([&] {
      ScenePolygon ring = chain();
      if (ring.corners.empty()) return;
      const bool closed = ring.corners.front() == ring.corners.back();
      if (ring.corners.size() < 4 || !closed) {
        place(ring.line).fail("a ring needs four positions or more, the last one equal to the first",
                              closed ? counted(ring.corners.size(), "position", "positions") : "an open ring");
      }
      ring.corners.pop_back();
      if (outline.corners.empty()) {
        outline = std::move(ring);
      } else {
        push_asked(holes, std::move(ring.corners), execution_);
      }
    });
    if (outline.corners.empty()) return;
    add_without_holes(scene_, outline.line, std::move(outline.corners), holes, execution_);
  }
  scene_text::Place place(std::size_t line) const { return {name_, line}; }

  const std::string& name_;
  const Execution& execution_;
  Tokens tokens_;
  WallCollector walls_;
  Scene scene_;
};

std::string position_text(Vec2 p) { return fmt::format("{} {}", p.x + 0.0, p.y + 0.0); }

}  // namespace

bool is_wkt(std::string_view bytes) {
  const std::string nameless;
  const Execution unlimited;
  Tokens head(nameless, bytes.substr(0, bytes_that_tell), unlimited);
  if (head.take_word("SRID")) return head.next_is('=');
  std::string type = head.word();
  while (type.ends_with('Z') || type.ends_with('M')) type.pop_back();
  if (std::find(type_names.begin(), type_names.end(), type) == type_names.end()) return false;
  head.take_dimensions();
  return head.take_word("EMPTY") || head.next_is('(');
}

Scene read_wkt(const InputFile& file, const Execution& execution) { return WktReader(file, execution).read(); }

void write_wkt(const Scene& scene, const std::string& path, const Execution& execution) {
  if (has_solids(scene) || scene.bounds) {
    throw InputError(path, "WKT holds polygons and walls alone; write bounds and solids to a .scene or .geojson file");
  }
  OutputFile file(path, execution);
  std::size_t written = 0;
  for (const ScenePolygon& polygon : scene.polygons) {
    execution.poll(++written);
    std::string text = "POLYGON ((";
    const std::vector<Vec2> corners = anticlockwise(polygon.corners);
    for (const Vec2 p : corners) {
      execution.poll(++written);
      text += position_text(p) + ", ";
    }
    file.write(text + position_text(corners.front()) + "))\n");
  }
  scene.walls.visit([&](auto walls) {
    for (const auto& wall : walls) {
      execution.poll(++written);
      const Segment s = wall.segment();
      file.write("LINESTRING (" + position_text(s.a) + ", " + position_text(s.b) + ")\n");
    }
  });
  file.commit();
}

}  // namespace warren

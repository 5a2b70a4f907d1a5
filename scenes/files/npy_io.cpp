// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/npy_io.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <set>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/base/error.hpp"
#include "parallel/chunks.hpp"
#include "scenes/text/output_file_io.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in the file");

constexpr std::string_view npy_magic = "\x93NUMPY";
constexpr std::size_t longest_header = 65535;  // all that version 1 can say, and a hundred times what walls need
constexpr std::size_t npy_grain = std::size_t{1} << 16;

/// Reads the header's dictionary, {'descr': '<f4', 'fortran_order': False, 'shape': (28, 4), }.
class HeaderParser {
 public:
  explicit HeaderParser(const InputFile& file) : name_(file.name()), bytes_(file.bytes()) {}

  NpyWalls parse() {
    const NpyWalls header = parsed();
    if (shape_.size() != 2 || shape_[1] != 4) fail("expected shape (n, 4), a wall x1 y1 x2 y2 a row", shape_text_);
    return {header.is_float, shape_[0], header.data};
  }
  /// Where the numbers of a potential begin, and its rows and columns of corners.
  std::array<std::size_t, 3> parse_potential() {
    const NpyWalls header = parsed();
    if (header.is_float) fail("expected numbers of type <f8", "<f4");
    if (shape_.size() != 3 || shape_[0] != 2 || shape_[1] < 2 || shape_[2] < 2) {
      fail("expected a certificate, of shape (2, rows + 1, columns + 1)", shape_text_);
    }
    return {header.data, shape_[1], shape_[2]};
  }

 private:
  NpyWalls parsed() {
    if (!is_npy(bytes_)) fail("expected a .npy file, which begins with \\x93NUMPY", bytes_.substr(0, 8));
    NpyWalls header;
    rest_ = dictionary(header.data);
    parse_entries(header);
    if (seen_.size() < 3) fail("the header must have descr, fortran_order and shape", rest_);
    return header;
  }
  [[noreturn]] void fail(std::string_view what, std::string_view found) const {
    scene_text::Place{name_, 0}.fail(what, found);
  }
  std::string_view dictionary(std::size_t& data) const {
    const std::size_t version =
        bytes_.size() > npy_magic.size() ? static_cast<unsigned char>(bytes_[npy_magic.size()]) : 0;
    if (version < 1 || version > 3) fail("expected .npy version 1, 2 or 3", fmt::format("version {}", version));
    const std::size_t length_bytes = version == 1 ? 2 : 4;
    const std::size_t begin = npy_magic.size() + 2 + length_bytes;
    std::uint32_t length = 0;
    if (bytes_.size() >= begin) std::memcpy(&length, bytes_.data() + begin - length_bytes, length_bytes);
    if (length > longest_header) fail("expected a header of at most 65535 bytes", fmt::format("{} bytes", length));
    if (bytes_.size() < begin || bytes_.size() - begin < length) {
      fail("the file ends within its header", fmt::format("{} bytes", bytes_.size()));
    }
    data = begin + length;
    return bytes_.substr(begin, length);
  }

  void parse_entries(NpyWalls& header) {
    expect('{');
    while (!accept('}')) {
      const std::string_view key = quoted();
      expect(':');
      if (key == "descr") {
        parse_type(header);
      } else if (key == "fortran_order") {
        parse_order();
      } else if (key == "shape") {
        parse_shape();
      } else {
        fail("unknown entry in the header", key);
      }
      seen_.insert(key);
      if (!accept(',') && !rest_.starts_with('}')) fail("expected `,` or `}` in the header", rest_);
    }
  }
  void parse_type(NpyWalls& header) {
    if (!rest_.starts_with('\'') && !rest_.starts_with('"')) fail("expected numbers of type <f4 or <f8", rest_);
    const std::string_view type = quoted();
    if (type != "<f4" && type != "<f8") fail("expected numbers of type <f4 or <f8", type);
    header.is_float = type == "<f4";
  }
  void parse_order() {
    if (rest_.starts_with("True"))
      fail("expected C order, not Fortran order: save numpy.ascontiguousarray(walls)", rest_);
    if (!rest_.starts_with("False")) fail("expected fortran_order False", rest_);
    rest_.remove_prefix(5);
  }
  void parse_shape() {
    shape_text_ = rest_.substr(0, rest_.find(')') + 1);
    shape_.clear();
    expect('(');
    while (!accept(')')) {
      std::size_t& extent = shape_.emplace_back();
      const auto [last, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), extent);
      if (error != std::errc()) fail("expected a whole number in the shape", rest_);
      rest_.remove_prefix(static_cast<std::size_t>(last - rest_.data()));
      if (!accept(',') && !rest_.starts_with(')')) fail("expected a shape like (28, 4)", shape_text_);
    }
  }

  void skip_blanks() {
    while (!rest_.empty() && (rest_.front() == ' ' || rest_.front() == '\n')) rest_.remove_prefix(1);
  }
  bool accept(char c) {
    skip_blanks();
    if (!rest_.starts_with(c)) return false;
    rest_.remove_prefix(1);
    skip_blanks();
    return true;
  }
  void expect(char c) {
    if (!accept(c)) fail(fmt::format("expected `{}` in the header", c), rest_);
  }
  std::string_view quoted() {
    const char quote = rest_.empty() ? '\0' : rest_.front();
    const std::size_t end = quote == '\'' || quote == '"' ? rest_.find(quote, 1) : std::string_view::npos;
    if (end == std::string_view::npos) fail("expected a quoted word in the header", rest_);
    const std::string_view word = rest_.substr(1, end - 1);
    rest_.remove_prefix(end + 1);
    return word;
  }

  const std::string& name_;
  std::string_view bytes_;
  std::string_view rest_;
  std::string_view shape_text_;
  std::vector<std::size_t> shape_;
  std::set<std::string_view> seen_;  ///< keys of the header
};

template <class In>
WallOf<In> row_of(const InputFile& file, const NpyWalls& array, std::size_t i) {
  WallOf<In> wall;
  std::memcpy(&wall, file.bytes().data() + array.data + i * sizeof wall, sizeof wall);
  return wall;
}

template <class Wall, class In>
bool holds(const WallOf<In>& w) {
  const auto all = [&](const auto& test) { return test(w.x1) && test(w.y1) && test(w.x2) && test(w.y2); };
  if constexpr (std::is_same_v<Wall, PackedWall>) return PackedWall::fits(w.x1, w.y1, w.x2, w.y2);
  if constexpr (std::is_same_v<Wall, FloatWall>) return all(exact_as_float<In>);
  return all([](double x) { return std::abs(x) <= largest_coordinate; });
}

/// In is what the file holds. None where the type of walls does not hold all: then `bad` is the first of those. Each
/// chunk ends at its first one.
template <class Wall, class In>
std::optional<WallSet> copied(const InputFile& file, const NpyWalls& array, const Execution& execution,
                              std::size_t& bad) {
  const auto number = [](double x) { return std::abs(x) < smallest_coordinate ? 0.0 : x; };
  if (Progress* told = execution.progress) told->set_total(told->done() + array.walls);  // beside what did not fit
  execution.reserve(array.walls * sizeof(Wall));
  RawVector<Wall> walls(array.walls);
  bad = first_in_chunks(array.walls, npy_grain, execution.quiet(), [&](Range r) {
    std::size_t i = r.first;
    for (; i < r.last; ++i) {
      const WallOf<In> w = row_of<In>(file, array, i);
      if (!holds<Wall>(w)) break;
      walls[i] = Wall::of(number(w.x1), number(w.y1), number(w.x2), number(w.y2));
    }
    file.forget(array.data + r.first * sizeof(WallOf<In>), array.data + r.last * sizeof(WallOf<In>));
    if (i == r.last) execution.advance(r.size());
    return i;
  });
  if (bad < array.walls) return std::nullopt;
  return WallSet(std::move(walls));
}

/// In the narrowest type that holds all of them.
template <class In>
WallSet walls_of(const InputFile& file, const NpyWalls& array, const Execution& execution) {
  std::size_t bad = 0;
  if (execution.progress != nullptr) execution.progress->begin("read", array.walls);
  if (auto walls = copied<PackedWall, In>(file, array, execution, bad)) return std::move(*walls);
  if (auto walls = copied<FloatWall, In>(file, array, execution, bad)) return std::move(*walls);
  if (auto walls = copied<WallOf<In>, In>(file, array, execution, bad)) return std::move(*walls);
  const Segment s = row_of<In>(file, array, bad).segment();
  throw InputError(fmt::format("{}: row {}", file.name(), bad), "numbers must be finite and at most 1e60 in magnitude",
                   fmt::format("{} {} {} {}", s.a.x, s.a.y, s.b.x, s.b.y));
}

std::string header_of(bool is_float, std::uint64_t walls) {
  return npy_header(is_float ? "<f4" : "<f8", std::array<std::uint64_t, 2>{walls, 4});
}

}  // namespace

bool is_npy(std::string_view bytes) { return bytes.starts_with(npy_magic); }

NpyWalls npy_walls(const InputFile& file) {
  const NpyWalls header = HeaderParser(file).parse();
  const std::size_t wall_bytes = header.is_float ? sizeof(FloatWall) : sizeof(DoubleWall);
  const std::size_t held = file.bytes().size() - header.data;
  if (header.walls == 0) throw InputError(file.name(), "the array has no rows; expected at least one wall");
  if (held / wall_bytes != header.walls || held % wall_bytes != 0) {
    throw InputError(file.name(),
                     fmt::format("expected {} bytes for each of {} rows behind the header", wall_bytes, header.walls),
                     fmt::format("{} bytes", held));
  }
  return header;
}

Scene read_npy(const InputFile& file, const Execution& execution) {
  const NpyWalls header = npy_walls(file);
  Scene scene;
  scene.walls = header.is_float ? walls_of<float>(file, header, execution) : walls_of<double>(file, header, execution);
  scene.source = file.name();
  if (const auto maze = maze_of_walls(scene.walls, {execution.threads, execution.deadline})) {
    set_maze(scene, *maze);
  }
  return scene;
}

void write_npy(const WallStrips& walls, const std::string& path, const Execution& execution) {
  OutputFile file(path, execution);
  file.write(header_of(walls.holds_floats(), walls.wall_count()));
  walls.write([&](std::string_view bytes) { file.write(bytes); }, execution);
  file.commit();
}

void write_npy(const Scene& scene, const std::string& path, const Execution& execution) {
  if (!scene.polygons.empty() || has_solids(scene) || scene.bounds) {
    throw InputError(path, "a .npy file holds walls alone; write polygons, solids and bounds to a .scene file");
  }
  constexpr std::size_t block = std::size_t{1} << 16;  // walls
  if (execution.progress != nullptr) execution.progress->begin("write", scene.walls.size());
  OutputFile file(path, execution);
  scene.walls.visit([&]<class Wall>(std::span<const Wall> walls) {
    using Row = WallOf<typename Wall::Number>;
    file.write(header_of(std::is_same_v<typename Wall::Number, float>, walls.size()));
    std::vector<Row> rows;
    for (std::size_t first = 0; first < walls.size(); first += rows.size()) {
      const auto some = walls.subspan(first, std::min(block, walls.size() - first));
      rows.resize(some.size());
      std::transform(some.begin(), some.end(), rows.begin(), [](const Wall& wall) { return unpacked(wall); });
      file.write({reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof(Row)});  // NOLINT: the rows' bytes
      execution.advance(rows.size());
    }
  });
  file.commit();
}

void write_npy(const CellPotential& potential, const std::string& path, const Execution& execution) {
  const std::uint64_t shape[] = {2, std::uint64_t{potential.height} + 1, std::uint64_t{potential.width} + 1};
  OutputFile file(path, execution);
  file.write(npy_header("<f8", shape));
  const auto bytes = std::as_bytes(std::span(potential.values));
  file.write({reinterpret_cast<const char*>(bytes.data()), bytes.size()});  // NOLINT: the numbers' bytes
  file.commit();
}

CellPotential read_potential_npy(const InputFile& file, const Execution& execution) {
  const auto [data, rows, columns] = HeaderParser(file).parse_potential();
  constexpr std::size_t most = std::size_t{1} << 32U;
  const std::size_t held = file.bytes().size() - data;
  if (columns >= most || rows >= most || held / sizeof(double) / 2 / columns != rows ||
      held != 2 * rows * columns * sizeof(double)) {
    throw InputError(file.name(),
                     fmt::format("expected 2 x {} x {} numbers of 8 bytes behind the header", rows, columns),
                     fmt::format("{} bytes", held));
  }
  execution.reserve(held);
  CellPotential potential{static_cast<std::uint32_t>(columns - 1), static_cast<std::uint32_t>(rows - 1),
                          std::vector<double>(2 * rows * columns)};
  std::memcpy(potential.values.data(), file.bytes().data() + data, held);
  return potential;
}

std::string npy_header(std::string_view type, std::span<const std::uint64_t> shape) {
  constexpr std::size_t alignment = 64;
  std::string dictionary = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}{}), }}", type,
                                       fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
  std::string header("\x93NUMPY\1\0", 8);
  const std::size_t unpadded = header.size() + 2 + dictionary.size() + 1;
  dictionary.append((alignment - unpadded % alignment) % alignment, ' ').push_back('\n');
  header.append({static_cast<char>(dictionary.size() & 0xffU), static_cast<char>(dictionary.size() >> 8U)});
  return header + dictionary;
}

}  // namespace warren

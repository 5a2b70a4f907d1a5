// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/files/maze_file_io.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <span>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/mazes/maze_generator.hpp"
#include "scenes/text/output_file_io.hpp"

namespace warren {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are copied as they lie in the file");

constexpr std::string_view magic = "\x89WRMAZE\n";
constexpr std::uint32_t version = 1;
constexpr std::uint32_t rows_a_band = 1U << CellBits::usual_side_log2;  // a row of tiles has a checksum
constexpr std::size_t header_bytes = 64;

std::size_t bands_of(std::uint64_t rows) { return static_cast<std::size_t>((rows - 1) / rows_a_band + 1); }

/// As it lies in the file.
struct FileHeader {
  std::array<char, 8> magic;
  std::uint32_t version;
  std::uint32_t band;  ///< rows that have a checksum together
  std::uint64_t rows;
  std::uint64_t cols;
  std::uint64_t row_bytes;
  std::uint64_t sums;  ///< where the checksums begin
  std::array<char, 12> nothing;
  std::uint32_t sum;  ///< of the bytes before
};
static_assert(sizeof(FileHeader) == header_bytes);

std::string_view bytes_of(const FileHeader& header) {
  return {reinterpret_cast<const char*>(&header), sizeof header};  // NOLINT: the header's bytes
}
std::uint32_t crc32(std::string_view bytes) {
  const auto* const first = reinterpret_cast<const Bytef*>(bytes.data());  // NOLINT: numbers of the bytes
  return static_cast<std::uint32_t>(::crc32_z(0, first, bytes.size()));
}

std::uint32_t sum_of(const FileHeader& header) { return crc32(bytes_of(header).substr(0, header_bytes - 4)); }

FileHeader header_for(std::uint32_t rows, std::uint32_t cols) {
  FileHeader header{};
  std::copy(magic.begin(), magic.end(), header.magic.begin());
  header.version = version;
  header.band = rows_a_band;
  header.rows = rows;
  header.cols = cols;
  header.row_bytes = bytes_a_row(cols);
  header.sums = header_bytes + header.rows * header.row_bytes;
  header.sum = sum_of(header);
  return header;
}

/// A maze's description, but for the walls.
Scene scene_of(MazeHint maze, const std::string& name, std::optional<std::uint64_t> hash) {
  Scene scene;
  set_maze(scene, maze);
  scene.source = name;
  scene.packed = PackedMaze{name, hash};
  return scene;
}
Scene scene_of(const MazeFile& maze, const std::string& name) {
  return scene_of(MazeHint{maze.rows(), maze.cols()}, name, maze.hash());
}

MazeHint size_in_header(const InputFile& file) {
  const std::string_view bytes = file.bytes();
  const auto refuse = [&](const std::string& what, const std::string& found) {
    throw InputError(file.name(), what, found);
  };
  if (!is_maze_file(bytes)) {
    refuse("expected a .maze file, which begins with \\x89WRMAZE", std::string(bytes.substr(0, magic.size())));
  }
  FileHeader header{};
  if (bytes.size() < sizeof header) refuse("the file ends within its header", fmt::format("{} bytes", bytes.size()));
  std::memcpy(&header, bytes.data(), sizeof header);
  if (header.sum != sum_of(header)) {
    refuse("the header is damaged: its checksum is another", fmt::format("{:08x}", header.sum));
  }
  if (header.version != version) refuse("expected a .maze file of version 1", fmt::format("{}", header.version));
  if (header.rows < 1 || header.cols < 1 || header.rows > MazeFile::most_side || header.cols > MazeFile::most_side) {
    refuse(fmt::format("rows and columns must be from 1 to {}", MazeFile::most_side),
           fmt::format("{} x {}", header.rows, header.cols));
  }
  const auto rows = static_cast<std::uint32_t>(header.rows);
  const auto cols = static_cast<std::uint32_t>(header.cols);
  const FileHeader expected = header_for(rows, cols);
  if (bytes_of(header) != bytes_of(expected)) {
    refuse(fmt::format("the header of a maze of {} x {} cells contradicts itself", rows, cols), "");
  }
  const std::uint64_t size = header.sums + 4 * bands_of(rows);
  if (bytes.size() != size) {
    refuse(fmt::format("expected {} bytes for {} x {} cells", size, rows, cols), fmt::format("{} bytes", bytes.size()));
  }
  return {rows, cols};
}

}  // namespace

bool is_maze_file(std::string_view bytes) { return bytes.starts_with(magic); }

MazeFile::MazeFile(const InputFile& file) : MazeFile(file, size_in_header(file)) {}

MazeFile::MazeFile(const InputFile& file, MazeHint size)
    : CellBits(
          size.rows, size.cols,
          reinterpret_cast<const std::uint8_t*>(file.bytes().data()) + header_bytes,  // NOLINT: the cells' bytes
          [&file](std::size_t first, std::size_t last) { file.forget(header_bytes + first, header_bytes + last); }),
      file_(file) {}

std::string_view MazeFile::band(std::size_t number) const {
  const std::size_t bytes = rows_a_band * bytes_a_row(cols());
  const std::size_t end = std::size_t{rows()} * bytes_a_row(cols());
  return file_.bytes().substr(header_bytes + number * bytes, std::min(bytes, end - number * bytes));
}

/// Rows first_row .. last_row - 1: does the outline stand, but for the doors, and is nothing behind the last cell?
bool MazeFile::has_outline(std::uint32_t first_row, std::uint32_t last_row) const {
  const std::size_t stride = bytes_a_row(cols());
  const unsigned place = 2 * ((cols() - 1) % 4);  // of the last cell in its byte
  bool stands = true;
  for (std::uint32_t row = first_row; row < last_row; ++row) {
    const std::string_view line = file_.bytes().substr(header_bytes + row * stride, stride);
    const unsigned last = static_cast<unsigned char>(line.back()) >> place;
    const bool is_door = row + 1 == rows();
    stands = stands && (last & 1U) == (is_door ? 0U : 1U) && last < 4;
    for (std::uint32_t col = 0; is_door && col < cols(); ++col) {
      stands = stands && (static_cast<unsigned char>(line[col / 4]) >> (2 * (col % 4)) & 2U) != 0;
    }
  }
  return stands;
}

void MazeFile::check(Range tile_rows, const Execution& execution) const {
  if (execution.progress != nullptr) execution.progress->begin("read", tile_rows.size());
  enum : std::uint8_t { good, damaged, open };
  const auto found = parts_of_chunks(tile_rows.size(), 1, execution, [&](Range r) {
    const std::size_t number = tile_rows.first + r.first;
    const auto first_row = static_cast<std::uint32_t>(number * rows_a_band);
    const std::string_view bytes = band(number);
    std::uint32_t sum = 0;
    std::memcpy(&sum, file_.bytes().data() + file_.bytes().size() - 4 * (bands_of(rows()) - number), sizeof sum);
    const bool is_whole = crc32(bytes) == sum;
    const bool is_closed = is_whole && has_outline(first_row, std::min(rows(), first_row + rows_a_band));
    const auto at = static_cast<std::size_t>(bytes.data() - file_.bytes().data());
    file_.forget(at, at + bytes.size());
    return !is_whole ? damaged : is_closed ? good : open;
  });
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (found[i] == good) continue;
    const std::uint64_t first = (tile_rows.first + i) * std::uint64_t{rows_a_band};
    const std::string where =
        fmt::format("{}: rows {} to {}", file_.name(), first, std::min<std::uint64_t>(rows(), first + rows_a_band) - 1);
    throw InputError(where, found[i] == damaged
                                ? "are damaged: their checksum is another"
                                : "do not close the maze's outline, which is open left of the first cell and right of "
                                  "the last one alone");
  }
}

std::uint64_t MazeFile::wall_count(const Execution& execution) const {
  const std::uint64_t standing = sum_of_chunks(bands_of(rows()), 1, execution, [&](Range r) {
    const std::string_view bytes = band(r.first);
    std::uint64_t sum = 0;
    for (const char byte : bytes) sum += static_cast<unsigned>(std::popcount(static_cast<unsigned char>(byte)));
    const auto at = static_cast<std::size_t>(bytes.data() - file_.bytes().data());
    file_.forget(at, at + bytes.size());
    return sum;
  });
  return 4 + standing - (rows() - 1) - cols();  // the outline stands in the bits as well, but for the door
}

std::uint64_t MazeFile::hash() const {
  const std::string_view bytes = file_.bytes();
  const std::size_t sums = 4 * bands_of(rows());
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a
  const auto add = [&](std::string_view part) {
    for (const char byte : part) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  };
  add(bytes.substr(0, header_bytes));
  add(bytes.substr(bytes.size() - sums));
  return hash;
}

Scene read_maze_file(const InputFile& file, const Execution& execution) {
  const MazeFile maze(file);
  maze.check(execution);
  Scene scene = scene_of(maze, file.name());
  const std::uint64_t cells = std::uint64_t{maze.rows()} * maze.cols();
  execution.reserve(cells + (maze.rows() - std::size_t{1}) * (maze.cols() - std::size_t{1}) *
                                maze_wall_bytes(maze.rows(), maze.cols()));
  scene.walls = maze_walls(cells_from(maze, execution), false, execution);
  return scene;
}

void write_maze_file(const CellWallSource& cells, const std::string& path, const Execution& execution) {
  assert(cells.side_log2() == CellBits::usual_side_log2);
  constexpr std::size_t grain = 8;  // a reader's scratch is large
  const FileHeader header = header_for(cells.rows(), cells.cols());
  const std::size_t band_bytes = std::min(rows_a_band, cells.rows()) * bytes_a_row(cells.cols());
  execution.reserve(band_bytes + 4 * bands_of(cells.rows()));
  RawVector<std::uint8_t> band(band_bytes);
  std::vector<std::uint32_t> sums;
  OutputFile file(path, execution);
  file.write(bytes_of(header));
  if (execution.progress != nullptr) execution.progress->begin("write", cells.tile_count());
  for (std::size_t number = 0; number < bands_of(cells.rows()); ++number) {
    std::uint32_t height = 0;
    for_chunks(cells.tile_cols(), grain, execution, [&](Range r) {
      const auto reader = cells.reader();
      CellTile tile;
      for (std::size_t col = r.first; col < r.last; ++col) {
        reader->read(number * cells.tile_cols() + col, tile);
        pack_tile(tile, bytes_a_row(cells.cols()), band.data());
      }
      if (r.first == 0) height = tile.height;
    });
    const std::string_view bytes(reinterpret_cast<const char*>(band.data()),  // NOLINT: the cells' bytes
                                 height * bytes_a_row(cells.cols()));
    sums.push_back(crc32(bytes));
    file.write(bytes);
  }
  file.write({reinterpret_cast<const char*>(sums.data()), 4 * sums.size()});  // NOLINT: the numbers' bytes
  file.commit();
}

void write_maze_file(const Scene& scene, const std::string& path, const Execution& execution) {
  const bool is_alone = scene.polygons.empty() && !has_solids(scene) && !scene.bounds && !scene.map;
  const auto maze = is_alone && scene.walls.size() > 0 ? maze_of_walls(scene.walls, execution) : std::nullopt;
  if (!maze) {
    throw InputError(path,
                     "a .maze file holds a maze alone, closed but for its two doors, whose walls are all on the unit "
                     "grid; write other worlds to .npy, .walls or .scene");
  }
  const HeldCells cells(cells_of_walls(scene.walls, *maze, execution), CellBits::usual_side_log2);
  write_maze_file(cells, path, execution);
}

namespace {

template <class T>
std::span<const WallOf<T>> walls_in(const InputFile& file, const NpyWalls& array) {
  const void* const data = file.bytes().data() + array.data;  // numbers lie on a multiple of 64 bytes
  return {static_cast<const WallOf<T>*>(data), array.walls};
}

/// Rows and columns of an outline in the order of the generator: below, above, left, right.
template <class T>
std::optional<MazeHint> size_of(std::span<const WallOf<T>> walls) {
  if (walls.size() < 4) return std::nullopt;
  const double cols = walls[0].x2 - 0.5;
  const double rows = walls[1].y1 - 0.5;
  const auto is_side = [](double x) { return x >= 1 && x <= MazeFile::most_side && x == std::floor(x); };
  if (!is_side(cols) || !is_side(rows)) return std::nullopt;
  const MazeHint maze{static_cast<std::uint32_t>(rows), static_cast<std::uint32_t>(cols)};
  const auto outline = maze_outline<WallOf<T>>(maze.rows, maze.cols);
  return std::equal(outline.begin(), outline.end(), walls.begin()) ? std::optional(maze) : std::nullopt;
}

/// With the row below the first.
Range cell_rows(MazeHint maze, std::optional<Range> held) {
  if (!held) return {0, maze.rows};
  const std::size_t first = held->first << CellBits::usual_side_log2;
  return {first > 0 ? first - 1 : 0, std::min<std::size_t>(maze.rows, held->last << CellBits::usual_side_log2)};
}

RawVector<std::uint8_t> empty_maze(Range rows, std::uint32_t cols, const Execution& execution) {
  const std::size_t bytes = rows.size() * bytes_a_row(cols);
  execution.reserve(bytes);
  RawVector<std::uint8_t> bits;
  assign_polled(bits, bytes, std::uint8_t{0}, [&] { execution.check(); });
  return bits;
}

}  // namespace

NpyMaze::NpyMaze(const InputFile& file, MazeHint maze, const Execution& execution, std::optional<Range> held)
    : array_(npy_walls(file)),
      maze_(maze),
      rows_(cell_rows(maze, held)),
      bits_(empty_maze(rows_, maze.cols, execution)),
      cells_(maze.rows, maze.cols, bits_.data(), {}, static_cast<std::uint32_t>(rows_.first)) {
  for (std::uint32_t row = 0; row + 1 < maze.rows; ++row) stand(maze.cols - 1, row, CellTile::right_wall);
  for (std::uint32_t col = 0; col < maze.cols; ++col) stand(col, maze.rows - 1, CellTile::upper_wall);
  if (execution.progress != nullptr) execution.progress->begin("read", array_.walls);
  array_.is_float ? read<float>(file, execution) : read<double>(file, execution);
}

/// A window's chunks are hashed by all threads, which brings them into memory; then one thread sets its bits, of which
/// several may share a byte.
template <class T>
void NpyMaze::read(const InputFile& file, const Execution& execution) {
  constexpr std::size_t window = 8 * WallsHash::grain;  // walls: of the file no more is held at once
  const std::span<const WallOf<T>> walls = walls_in<T>(file, array_);
  WallsHash hash(walls.size());
  for (std::size_t first = 0; first < walls.size(); first += window) {
    const std::span<const WallOf<T>> some = walls.subspan(first, std::min(window, walls.size() - first));
    hash.add(some, execution);
    for (std::size_t i = 0; i < some.size(); ++i) {
      execution.poll(i);
      if (first + i >= 4) add<T>(file, first + i, some[i], execution);
    }
    file.forget(array_.data + first * sizeof(WallOf<T>), array_.data + (first + some.size()) * sizeof(WallOf<T>));
  }
  hash_ = hash.text();
}

/// Any number of walls may be as long as the maze is wide, so that units are counted, not walls.
template <class T>
void NpyMaze::add(const InputFile& file, std::size_t row, const WallOf<T>& wall, const Execution& execution) {
  const double low_x = std::min(wall.x1, wall.x2) - 0.5;  // grid lines, from 0
  const double high_x = std::max(wall.x1, wall.x2) - 0.5;
  const double low_y = std::min(wall.y1, wall.y2) - 0.5;
  const double high_y = std::max(wall.y1, wall.y2) - 0.5;
  const auto refuse = [&](const char* what) {
    throw InputError(fmt::format("{}: row {}", file.name(), row), what,
                     fmt::format("{} {} {} {}", wall.x1, wall.y1, wall.x2, wall.y2));
  };
  const auto is_line = [](double x, double last) { return x >= 0 && x <= last && x == std::floor(x); };
  const bool on_grid = is_line(low_x, maze_.cols) && is_line(high_x, maze_.cols) && is_line(low_y, maze_.rows) &&
                       is_line(high_y, maze_.rows);
  if (!on_grid || (low_x == high_x) == (low_y == high_y)) {
    refuse("is no wall on the unit grid of the maze; only such walls are read tile by tile, others must fit in memory");
  }
  const auto col = static_cast<std::uint32_t>(low_x);
  const auto last_col = static_cast<std::uint32_t>(high_x);
  const auto first_row = static_cast<std::uint32_t>(low_y);
  const auto last_row = static_cast<std::uint32_t>(high_y);
  if (col == last_col) {
    if ((col == 0 && first_row == 0) || (col == maze_.cols && last_row == maze_.rows)) {
      refuse("closes a door of the maze; such walls are not read tile by tile, they must fit in memory");
    }
    for (std::uint32_t r = first_row; col > 0 && r < last_row; ++r) {
      execution.poll(++units_);
      stand(col - 1, r, CellTile::right_wall);
    }
  } else {
    for (std::uint32_t c = col; first_row > 0 && c < last_col; ++c) {
      execution.poll(++units_);
      stand(c, first_row - 1, CellTile::upper_wall);
    }
  }
}

std::optional<Scene> unmade_maze(const std::string& source) {
  const MazeOptions maze = parse_maze_source(source);
  if (maze.algorithm != MazeAlgorithm::mst) return std::nullopt;
  Scene scene = unmade_maze_scene(maze);
  scene.source = source;
  return scene;
}

std::optional<Scene> unmade_maze(const InputFile& file) {
  if (is_maze_file(file.bytes())) return scene_of(MazeFile(file), file.name());
  if (!is_npy(file.bytes())) return std::nullopt;
  const NpyWalls array = npy_walls(file);
  const auto place = reinterpret_cast<std::uintptr_t>(file.bytes().data() + array.data);  // NOLINT: a place
  if (place % alignof(double) != 0) return std::nullopt;
  const auto maze = array.is_float ? size_of(walls_in<float>(file, array)) : size_of(walls_in<double>(file, array));
  return maze ? std::optional(scene_of(*maze, file.name(), std::nullopt)) : std::nullopt;
}

}  // namespace warren

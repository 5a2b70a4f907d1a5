// SPDX-License-Identifier: BSD-3-Clause
// What a file of n bytes may cost its reader, as docs/file_formats.md states it. No clock decides: a signal that has
// come already must be seen before the mistake at a long file's end, a limit on memory must be met by a question and
// not by a page, and a promise that the file can't keep is refused before anything is held for it.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <limits>
#include <string>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/arms/arm_files_io.hpp"
#include "scenes/files/image_io.hpp"
#include "scenes/files/npy_io.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "tests/memory_limit.hpp"
#include "tests/scenes/files/test_images.hpp"
#include "tests/seeds.hpp"

namespace warren {
namespace {

using FileReader = void (*)(const InputFile&, const Execution&);

template <auto reader>
void read_with(const InputFile& file, const Execution& execution) {
  static_cast<void>(reader(file, execution));
}

constexpr FileReader scene = read_with<read_scene_text>;
constexpr FileReader npy_reader = read_with<read_npy>;
constexpr FileReader geojson = read_with<read_geojson>;
constexpr FileReader wkt = read_with<read_wkt>;
constexpr FileReader ring_list = read_with<read_ring_list>;
constexpr FileReader micromouse = read_with<read_micromouse>;
constexpr FileReader moving_ai = read_with<read_moving_ai_map>;
constexpr FileReader scenarios = read_with<read_scenarios>;
constexpr FileReader image = read_with<read_maze_image>;
constexpr FileReader dh_table = read_with<read_dh_table>;
constexpr FileReader ros_map = [](const InputFile& file, const Execution& execution) {
  static_cast<void>(read_ros_map(file, execution));
};

constexpr std::size_t mebi = std::size_t{1} << 20;

struct LongFile {
  std::string_view what;
  FileReader read;
  std::string head;
  std::string again;  ///< stands as often as fits
  std::string tail;

  std::string bytes(std::size_t size) const {
    std::string text = head;
    text.reserve(size + again.size() + tail.size());
    while (text.size() < size) text += again;
    return text + tail;
  }
};

/// A chunk that libpng knows and nobody needs; its checksum is not looked at where it is skipped.
std::string small_png_chunk() { return std::string("\0\0\0\5zTXtT\0\0xx....", 17); }

/// How a file begins whose end is far away; each ends in a mistake.
std::vector<LongFile> long_files() {
  const std::string grey = png_bytes({}, 8, 8, [](unsigned, unsigned, unsigned) { return 0U; });
  const std::string chunks_begin = grey.substr(0, 33);  // signature and IHDR
  return {
      {"walls", scene, "", "0 0 1 1\n", "x"},
      {"blanks before an item", scene, "wall", " ", "x"},
      {"a word", scene, "", "w", ""},
      {"corners of a polygon", scene, "polygon", " 1 2", " x"},
      {"corners of a body", scene, "robot car polygon", " 1 2", " x"},
      {"blanks in JSON", geojson, "{", " ", "x"},
      {"a word in JSON", geojson, R"({"type": ")", "w", ""},
      {"lists in JSON", geojson, R"({"a": )", "[", "x"},
      {"positions", geojson, R"({"type": "LineString", "coordinates": [[0,0])", ",[0,0]", "x"},
      {"rings of GeoJSON", geojson, R"({"type": "MultiLineString", "coordinates": [[[0,0]])", ",[[0,0]]", "x"},
      {"blanks in WKT", wkt, "LINESTRING (", " ", "x"},
      {"positions of WKT", wkt, "LINESTRING (0 0", ",0 0", "x"},
      {"polygons of WKT", wkt, "", "POLYGON((0 0,1 0,1 1,0 0))", "x"},
      {"rings of one corner", ring_list, "//\n", "0 0\n//\n", "0 x"},
      {"a ring on one line", ring_list, "poly\n1\n1\n4294967295\n", " 0 0", " x"},
      {"blanks in a ring", ring_list, "0 0\n0", " ", "x"},
      {"rows of posts", micromouse, "o---o\n", "\n", "x"},
      {"one row of posts", micromouse, "o", "---o", "\nx"},
      {"cells in numbers", micromouse, "", "0 0 0 0 0 0\n", "x"},
      {"rows of one cell", moving_ai, "type octile\nheight 1000000\nwidth 1\nmap\n", ".\n", "x"},
      {"one row of cells", moving_ai, "type octile\nheight 1\nwidth 1000000\nmap\n", ".", "x"},
      {"queries", scenarios, "version 0\n", "0 a 1 1 1 1 1\n", "x"},
      {"pixels in decimals", image, "P2 1 500000 1\n", " 01", " x"},
      {"one row of pixels", image, "P2 500000 1 1\n", " 01", " x"},
      {"blanks among pixels", image, "P2", " ", "x"},
      {"comments among pixels", image, "P2", "#\n", "x"},
      {"chunks of a PNG", image, chunks_begin, small_png_chunk(), ""},
      {"lines of a table", dh_table, "", "# a comment\n", "x"},
      {"blanks in a table", dh_table, "angles", " ", "x"},
  };
}

TEST(ReaderCosts, ASignalIsSeenWhateverTheFileIsFullOf) {
  const SignalFlag signal{SIGINT};
  const Deadline deadline(std::numeric_limits<double>::infinity(), std::numeric_limits<std::size_t>::max(), &signal);
  const Execution execution{1, &deadline};
  const auto files = long_files();
  for (const std::uint64_t i : test::seeds(std::size(files), std::size(files) / 3, 0)) {
    const LongFile& file = files[i];
    SCOPED_TRACE(file.what);
    const InputFile input = InputFile::of_bytes("long", file.bytes(mebi));
    EXPECT_THROW(file.read(input, {}), InputError) << "it ends in a mistake";
    EXPECT_THROW(file.read(input, execution), Stopped);
  }
}

TEST(ReaderCosts, MemoryIsAskedForBeforeItIsTaken) {
  const LongFile files[] = {
      LongFile{"walls", scene, "", "0 0 1 1\n", ""},
      LongFile{"corners of a polygon", scene, "polygon", " 1 2", "\n"},
      LongFile{"spheres", scene, "", "sphere 0 0 0 0\n", ""},
      LongFile{"polygons", scene, "", "polygon 0 0 1 0 0 1\n", ""},
      LongFile{"a text in JSON", geojson, R"({"a": ")", "w", "\"}"},
      LongFile{"rings of GeoJSON", geojson, R"({"type": "MultiLineString", "coordinates": [[[0,0]])", ",[[0,0]]", "]}"},
      LongFile{"positions of WKT", wkt, "LINESTRING (0 0", ",0 0", ")"},
      LongFile{"polygons of WKT", wkt, "", "POLYGON((0 0,1 0,1 1,0 0))", ""},
      LongFile{"rings of one corner", ring_list, "//\n", "0 0\n//\n", ""},
      LongFile{"rows of posts", micromouse, "o---o\n", "\n", ""},
      LongFile{"cells in numbers", micromouse, "", "0 0 0 0 0 0\n", ""},
      LongFile{"rows of one cell", moving_ai, "type octile\nheight 4194000\nwidth 1\nmap\n", ".\n", ""},
      LongFile{"queries", scenarios, "version 0\n", "0 a 1 1 1 1 1\n", ""},
      LongFile{"pixels in decimals", image, "P2 1 4194000 1\n", " 1", ""},
      LongFile{"pixels in bytes", image, "P5 1 8388500 1\n", "1", ""},
  };
  for (const std::uint64_t i : test::seeds(std::size(files), 5, 0)) {
    const LongFile& file = files[i];
    SCOPED_TRACE(file.what);
    const InputFile input = InputFile::of_bytes("long", file.bytes(8 * mebi));
    const Deadline deadline = test::limit_from_here(10 * mebi);
    EXPECT_THROW(file.read(input, Execution{1, &deadline}), Stopped);
  }
}

TEST(ReaderCosts, AMapServersYamlIsSmall) {
  const LongFile yaml{"keys", ros_map, "image: a\n", "a: b\n", ""};
  const Deadline deadline = test::limit_from_here(64 * mebi);
  EXPECT_THROW(yaml.read(InputFile::of_bytes("a.yaml", yaml.bytes(mebi + 1)), {}), InputError);
  EXPECT_THROW(yaml.read(InputFile::of_bytes("a.yaml", yaml.bytes(mebi / 2)), Execution{1, &deadline}), Stopped);
  const SignalFlag signal{SIGINT};
  const Deadline stopping(std::numeric_limits<double>::infinity(), std::numeric_limits<std::size_t>::max(), &signal);
  EXPECT_THROW(yaml.read(InputFile::of_bytes("a.yaml", yaml.bytes(mebi / 64)), Execution{1, &stopping}), Stopped);
}

TEST(ReaderCosts, WhatAHeaderPromisesMustFitIntoItsFile) {
  const std::string big_png = png_bytes({.depth = 1}, 1, 1, [](unsigned, unsigned, unsigned) { return 0U; });
  std::string promising_png = big_png;
  promising_png.replace(16, 8, std::string("\0\0\xea\x60\0\0\xea\x60", 8));  // 60000 x 60000
  promising_png.replace(29, 4, std::string("\xa8\xa9\x48\xef", 4));
  const std::string npy_header = "{'descr': '<f4', 'fortran_order': False, 'shape': (1000000000000, 4), }";
  struct Promise {
    std::string_view what;
    FileReader read;
    std::string bytes;
  };
  for (const Promise& promise : {
           Promise{"pixels in decimals", image, "P2 1 300000000 1 1"},
           Promise{"pixels in bytes", image, "P5 65535 65535 255 x"},
           Promise{"pixels of a PNG", image, promising_png},
           Promise{"cells", moving_ai, "type octile\nheight 1\nwidth 2147483647\nmap\n.\n"},
           Promise{"rings", ring_list, "poly\n1\n4294967295\n4294967295\n0 0\n"},
           Promise{"rows of numbers", npy_reader,
                   std::string("\x93NUMPY\x01\0", 8) + static_cast<char>(npy_header.size()) + std::string(1, '\0') +
                       npy_header + std::string(16, '\0')},
       }) {
    SCOPED_TRACE(promise.what);
    const Deadline deadline = test::limit_from_here(4 * mebi);
    EXPECT_THROW(promise.read(InputFile::of_bytes("small", promise.bytes), Execution{1, &deadline}), InputError);
  }
}

TEST(ReaderCosts, NestingIsRefusedWhereItIsDeep) {
  for (const LongFile& file : {
           LongFile{"objects", geojson, "", R"({"a":)", ""},
           LongFile{"coordinates", geojson, R"({"type":"Polygon","coordinates":)", "[", ""},
           LongFile{"collections", wkt, "", "GEOMETRYCOLLECTION(", ""},
           LongFile{"lists in YAML", ros_map, "image: ", "[", ""},
           LongFile{"keys in YAML", ros_map, "image: ", "{a: ", ""},
           LongFile{"lines of lists in YAML", ros_map, "image: a\nb:\n  ", "- ", ""},
       }) {
    SCOPED_TRACE(file.what);
    EXPECT_THROW(file.read(InputFile::of_bytes("deep", file.bytes(mebi / 4)), {}), InputError);
  }
}

TEST(ReaderCosts, AliasesInYamlAreSharedAndNotCopied) {
  std::string yaml = "a0: &a0 [x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 40; ++i) {
    yaml += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 9; ++k) yaml += (k == 0 ? "*a" : ", *a") + std::to_string(i - 1);
    yaml += "]\n";
  }
  const Deadline deadline = test::limit_from_here(64 * mebi);
  for (const std::string_view key :
       {"image: *a39\n", "image: i\nresolution: *a39\n", "image: i\nresolution: 1\norigin: *a39\n"}) {
    SCOPED_TRACE(key);
    EXPECT_THROW(read_ros_map(InputFile::of_bytes("a.yaml", yaml + std::string{key}), Execution{1, &deadline}),
                 InputError);
  }
}

TEST(ReaderCosts, ANumberHasNoMoreDigitsThanAnyoneWrites) {
  const std::string digits(100'000, '1');
  for (const auto& [what, read, bytes] : std::initializer_list<std::tuple<std::string_view, FileReader, std::string>>{
           {"a scene", scene, digits + " 0 0 0\n"},
           {"WKT", wkt, "LINESTRING (0 " + digits + ", 1 1)"},
           {"GeoJSON", geojson, R"({"type": "Point", "coordinates": [0, )" + digits + digits + "]}"},
       }) {
    SCOPED_TRACE(what);
    EXPECT_THROW(read(InputFile::of_bytes("long", bytes), {}), InputError);
  }
}

}  // namespace
}  // namespace warren

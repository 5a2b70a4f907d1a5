// SPDX-License-Identifier: BSD-3-Clause
// Maps of ROS's map_server: a YAML file with resolution, origin (yaw included), thresholds, negate and mode, and the
// PGM or PNG image that it names. A cell is free, occupied, unknown, or (modes scale and raw) between; only free cells
// may be driven on. Cells that are not free are blocked. The rules differ between ROS 1 and Nav2 at equality and for
// pictures with alpha, so they are an option.
//
// The files that prices name, read: masks of map servers, and polygons that are kept out of.
//
// A pixel's class depends on one number (and its alpha), so classes are looked up in a table, made once. Of Nav2 the
// number is the grey of 8 bits that GraphicsMagick makes of the pixel, which Nav2's map_io looks at alone: the luma,
// rounded to 16 bits and then down to 8 (n / 257). Of ROS 1 it is the sum of the colours, for their mean: at
// most 4 x 65535 + 1 entries.
#include <fmt/format.h>
#include <pwd.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <numeric>
#include <system_error>
#include <utility>
#include <vector>

#include "core/base/enum_names.hpp"
#include "core/base/error.hpp"
#include "parallel/asked_memory.hpp"
#include "scenes/files/image_io.hpp"
#include "scenes/files/plane_formats_io.hpp"
#include "scenes/files/read_world_io.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "scenes/text/output_file_io.hpp"
#include "scenes/text/yaml_file_io.hpp"

namespace warren {
namespace {

enum class Mode : std::uint8_t { trinary, scale, raw };
constexpr auto enum_names(Mode) { return std::array<std::string_view, 3>{"trinary", "scale", "raw"}; }

// A cell's value, as a map server publishes it: 0 free, 100 occupied, -1 unknown, else between.
constexpr std::int8_t free_value = 0;
constexpr std::int8_t occupied_value = 100;
constexpr std::int8_t unknown_value = -1;

struct Description {
  std::string image;
  double resolution = 1.0;
  std::array<double, 3> origin{};
  double occupied_thresh = 0.0;
  double free_thresh = 0.0;
  bool negate = false;
  Mode mode = Mode::trinary;
};

/// Each error names file, line and what was expected.
Description read_description(const InputFile& file, const Execution& execution) {
  const YamlFile yaml(file, "a map server's YAML", 1, execution);
  const auto needed = [&](const char* key) {
    const YAML::Node node = yaml.root()[key];
    if (!node) throw InputError(file.name(), fmt::format("the key `{}` is missing: a map server needs it", key));
    return node;
  };
  const auto convert = [&]<class T>(const YAML::Node& node, const char* key, std::string_view expected, T& to) {
    try {
      to = node.as<T>();
    } catch (const YAML::Exception&) {
      yaml.fail(node, fmt::format("`{}` must be {}", key, expected));
    }
  };
  const auto is_fraction = [](double x) { return x >= 0.0 && x <= 1.0; };
  Description d;
  const YAML::Node image = needed("image");
  convert(image, "image", "the name of an image", d.image);
  if (d.image.empty()) yaml.fail(image, "`image` must be the name of an image");
  d.resolution = yaml.number(needed("resolution"), "resolution", "a number above 0",
                             [](double x) { return x > smallest_coordinate && x < largest_coordinate; });
  const YAML::Node origin = needed("origin");
  constexpr std::string_view place = "three numbers, [x, y, yaw]";
  if (!origin.IsSequence() || origin.size() != 3) yaml.fail(origin, fmt::format("`origin` must be {}", place));
  for (std::size_t i = 0; i < d.origin.size(); ++i)
    d.origin[i] = yaml.number(origin[i], "origin", place, [](double x) { return std::abs(x) <= largest_coordinate; });
  d.occupied_thresh = yaml.number(needed("occupied_thresh"), "occupied_thresh", "a number from 0 to 1", is_fraction);
  d.free_thresh = yaml.number(needed("free_thresh"), "free_thresh", "a number from 0 to 1", is_fraction);
  const YAML::Node negate = needed("negate");
  d.negate = YamlFile::text_of(negate) == "1";
  if (!d.negate && YamlFile::text_of(negate) != "0") convert(negate, "negate", "0 or 1", d.negate);
  if (const YAML::Node node = yaml.root()["mode"]) {
    std::string mode;
    convert(node, "mode", "trinary, scale or raw", mode);
    for (char& c : mode) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    const auto known = enum_named<Mode>(mode);
    if (!known) yaml.fail(node, "`mode` must be trinary, scale or raw");
    d.mode = *known;
  }
  if (d.mode != Mode::raw && d.free_thresh > d.occupied_thresh) {
    throw InputError(file.name(), "`free_thresh` must not be above `occupied_thresh`",
                     fmt::format("{} > {}", d.free_thresh, d.occupied_thresh));
  }
  return d;
}

/// The value of a pixel of brightness 0 … 1, its alpha apart.
std::int8_t value_of(double brightness, const Description& d, MapServerRules rules) {
  const bool ros1 = rules == MapServerRules::ros1;
  if (d.mode == Mode::raw) {
    const double value = 255.0 * (d.negate && ros1 ? 1.0 - brightness : brightness);
    const double whole = ros1 ? std::floor(value) : std::round(value);
    return whole > occupied_value ? unknown_value : static_cast<std::int8_t>(whole);
  }
  const double p = d.negate ? brightness : 1.0 - brightness;
  if (!ros1 && p <= d.free_thresh) return free_value;  // applied last there, so it wins
  if (ros1 ? p > d.occupied_thresh : p >= d.occupied_thresh) return occupied_value;
  if (p < d.free_thresh) return free_value;
  if (d.mode == Mode::trinary) return unknown_value;
  const double ratio = (p - d.free_thresh) / (d.occupied_thresh - d.free_thresh);
  const double value = ros1 ? std::floor(1.0 + 98.0 * ratio) : std::round(100.0 * ratio);
  return static_cast<std::int8_t>(std::clamp(value, 0.0, 100.0));
}

/// The values of an image's pixels.
class PixelValues {
 public:
  PixelValues(const Description& description, MapServerRules rules) : description_(description), rules_(rules) {}

  void begin(const ImageHeader& header) {
    header_ = header;
    const bool alpha_is_colour = rules_ == MapServerRules::ros1 && description_.mode == Mode::trinary;
    colours_ = header.channels - (header.has_alpha() && !alpha_is_colour ? 1 : 0);
    const bool looks_at_alpha =
        rules_ == MapServerRules::nav2 ? description_.mode != Mode::raw : description_.mode == Mode::scale;
    judges_alpha_ = header.has_alpha() && looks_at_alpha;
    const bool by_luma = rules_ == MapServerRules::nav2 && colours_ > 1;
    const std::size_t brightest = by_luma ? 255 : std::size_t{colours_} * header.maximum;
    values_.resize(brightest + 1);
    for (std::size_t i = 0; i <= brightest; ++i) {
      double brightness = static_cast<double>(i) / static_cast<double>(brightest);
      if (rules_ == MapServerRules::nav2) brightness = high_byte((i * 65535 + brightest / 2) / brightest) / 255.0;
      values_[i] = value_of(brightness, description_, rules_);
    }
  }

  /// take(x, y, value, is it what map_saver writes of the unknown?) for each pixel of the run, y from the bottom.
  template <class Take>
  void row(const PixelRun& run, const Execution& execution, const Take& take) const {
    const std::uint32_t y = header_.height - 1 - run.y;
    std::uint32_t x = run.first_x;
    for (const std::uint16_t* pixel = run.samples.data(); pixel != run.samples.data() + run.samples.size();
         pixel += header_.channels, x += run.step_x) {
      execution.poll(static_cast<std::size_t>(pixel - run.samples.data()));
      take(x, y, value_at(pixel), is_saved_unknown(pixel));
    }
  }

 private:
  bool is_saved_unknown(const std::uint16_t* pixel) const {
    constexpr unsigned grey = 205;
    return header_.maximum == 255 && !description_.negate && description_.mode != Mode::raw &&
           std::all_of(pixel, pixel + colours_, [](unsigned value) { return value == grey; });
  }
  static unsigned high_byte(std::uint64_t deep) { return static_cast<unsigned>(deep / 257); }
  unsigned number_of(const std::uint16_t* pixel) const {
    if (colours_ == 1) return pixel[0];
    if (rules_ == MapServerRules::ros1) return std::accumulate(pixel, pixel + colours_, 0U);
    const unsigned deep = 65535 / header_.maximum;  // coloured images have 255 or 65535
    return high_byte((std::uint64_t{deep} * (299U * pixel[0] + 587U * pixel[1] + 114U * pixel[2]) + 500) / 1000);
  }
  std::int8_t value_at(const std::uint16_t* pixel) const {
    const std::int8_t value = values_[number_of(pixel)];
    if (!judges_alpha_) return value;
    const unsigned alpha = pixel[header_.channels - 1];
    if (rules_ == MapServerRules::nav2) return alpha < header_.maximum ? unknown_value : value;
    const bool is_between = value > free_value && value < occupied_value;
    return alpha == 0 && is_between ? unknown_value : value;
  }

  const Description& description_;
  MapServerRules rules_;
  ImageHeader header_;
  unsigned colours_ = 1;
  bool judges_alpha_ = false;
  std::vector<std::int8_t> values_;
};

/// Of a map or a mask: where its cells are, and begin(header) once, then take() as PixelValues::row() has it.
template <class Cells, class Begin, class Take>
void read_values(const InputFile& yaml, MapServerRules rules, Cells& to, const Begin& begin, const Take& take,
                 const Execution& execution) {
  const Description description = read_description(yaml, execution);
  to.cell = description.resolution;
  to.origin = {description.origin[0], description.origin[1]};
  to.yaw_rad = description.origin[2];
  PixelValues values(description, rules);
  const ImageSink sink{[&](const ImageHeader& header) {
                         values.begin(header);
                         begin(header);
                       },
                       [&](const PixelRun& run) { values.row(run, execution, take); }};
  to.image = path_beside(yaml.name(), description.image);
  std::optional<InputFile> image;
  try {
    image.emplace(to.image, execution);
  } catch (const ReadError& error) {
    const std::string_view what = error.what();
    throw ReadError(fmt::format("{}, the image of {}", to.image, yaml.name()), what.substr(what.rfind(": ") + 2));
  }
  read_image(*image, sink, execution);
}

/// As it is where nothing in it means anything to YAML, else quoted.
std::string yaml_text(std::string_view text) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./";
  const bool begins_plainly = plain.find(text.front()) != std::string_view::npos;
  if (begins_plainly && text.find_first_not_of("-+" + std::string{plain}) == std::string_view::npos)
    return std::string{text};
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (static_cast<unsigned char>(c) < 0x20U || c == 0x7f) {
      quoted += fmt::format("\\x{:02x}", c);
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

}  // namespace

OccupancyMap read_ros_map(const InputFile& yaml, const Execution& execution, MapServerRules rules) {
  OccupancyMap map;
  map.format = MapFormat::ros;
  map.source = yaml.name();
  const auto begin = [&](const ImageHeader& header) {
    map.blocked = cell_bitmap(header.width, header.height, execution);
    map.unknown = cell_bitmap(header.width, header.height, execution);
  };
  const auto take = [&](std::uint32_t x, std::uint32_t y, std::int8_t value, bool is_saved_unknown) {
    if (value == free_value) {
      ++map.free;
      map.grey_free += is_saved_unknown ? 1 : 0;
      return;
    }
    map.blocked.set(x, y);
    ++(value == occupied_value ? map.occupied : value == unknown_value ? map.unknown_count : map.between);
    if (value == unknown_value) map.unknown.set(x, y);
  };
  read_values(yaml, rules, map, begin, take, execution);
  if (map.unknown_count == 0) map.unknown = Bitmap();
  return map;
}

MaskCells read_mask(const InputFile& yaml, const Execution& execution) {
  MaskCells mask;
  const auto begin = [&](const ImageHeader& header) {
    mask.width = header.width;
    mask.height = header.height;
    execution.reserve(std::size_t{mask.width} * mask.height);
    mask.values.resize(std::size_t{mask.width} * mask.height);
  };
  const auto take = [&](std::uint32_t x, std::uint32_t y, std::int8_t value, bool) {
    mask.values[std::size_t{y} * mask.width + x] = value;
  };
  read_values(yaml, MapServerRules::nav2, mask, begin, take, execution);
  return mask;
}

std::string map_image_of(const std::string& yaml) { return yaml.substr(0, yaml.rfind('.')) + ".pgm"; }

void write_ros_map(const OccupancyMap& map, const std::string& path, const Execution& execution) {
  const std::string image = map_image_of(path);
  const std::string name = image.substr(image.rfind('/') + 1);
  OutputFile yaml(path, execution);
  yaml.write(
      fmt::format("image: {}\nresolution: {}\norigin: [{}, {}, {}]\nnegate: 0\noccupied_thresh: 0.65\n"
                  "free_thresh: 0.196\n",
                  yaml_text(name), map.cell, map.origin.x, map.origin.y, map.yaw_rad));
  yaml.complete();  // what comes after the image's place asks no more for the time
  FirstOfTwoFiles first(image);
  write_map_pgm(map, image, UnknownCells::grey, execution);
  yaml.commit();
  first.keep();
}

namespace {

/// Without what such a file names itself.
Scene read_polygons(const InputFile& file, const Execution& execution) {
  const WorldFormat format = format_of(file);
  if (format == WorldFormat::scene) return read_scene_text(file, execution);
  if (format == WorldFormat::geojson) return read_geojson(file, execution);
  if (format == WorldFormat::wkt) return read_wkt(file, execution);
  if (format == WorldFormat::ring_list) return read_ring_list(file, execution);
  throw InputError(file.name(), "expected the YAML of a map server, a GeoJSON or a scene with polygons");
}

/// A world's polygons and forbidden areas; masks of its own would be others' files.
void take_polygons(const PriceMask& mask, const InputFile& file, Prices& prices, const Execution& execution) {
  Scene scene = read_polygons(file, execution);
  check_polygons(scene, execution);
  const auto is_other = [&](const PriceMask& own) { return own.file != mask.file; };
  if (std::ranges::any_of(scene.prices.masks, is_other)) {
    throw InputError(file.name(), "has a `mask` line, which is not read here; say --keep-out for the mask, too");
  }
  if (mask.factor && !scene.seams.empty()) {
    throw InputError(file.name(), "has polygons with holes, whose cuts would be free of the factor; a mask takes one");
  }
  std::ranges::move(scene.prices.keep_out, std::back_inserter(scene.polygons));
  if (scene.polygons.empty()) {
    throw InputError(file.name(),
                     "has no polygons to keep out of; a GeoJSON, a scene with `polygon` or `keep-out` lines or a map "
                     "server's YAML has");
  }
  for (ScenePolygon& polygon : scene.polygons) {
    if (mask.factor) {
      push_asked(prices.areas, {*mask.factor, std::move(polygon.corners), polygon.line}, execution);
    } else {
      push_asked(prices.keep_out, std::move(polygon), execution);
    }
  }
}

}  // namespace

void read_masks(Prices& prices, const Execution& execution) {
  std::vector<PriceMask> masks = std::exchange(prices.masks, {});
  for (PriceMask& mask : masks) {
    if (!mask.read) {
      const InputFile file(mask.file, execution);
      if (format_of(file) == WorldFormat::ros_map) {
        mask.read = read_mask(file, execution);
      } else if (mask.kind == MaskKind::keep_out) {
        take_polygons(mask, file, prices, execution);
        continue;
      } else {
        throw InputError(file.name(), "a mask is the YAML of a map server, which names its image");
      }
    }
    prices.masks.push_back(std::move(mask));
  }
}

std::string path_beside(const std::string& file, const std::string& name) {
  if (name.starts_with("/")) return name;
  if (name.starts_with("~/")) {
    const passwd* user = ::getpwuid(::getuid());
    return (user == nullptr ? std::string{} : std::string{user->pw_dir}) + name.substr(1);
  }
  const std::size_t slash = file.rfind('/');
  return slash == std::string::npos ? name : file.substr(0, slash + 1) + name;
}

std::string name_beside(const std::string& file, const std::string& path) {
  namespace fs = std::filesystem;
  std::error_code error;
  const fs::path whole = fs::absolute(path, error).lexically_normal();
  if (error) return path;
  const bool is_stream = file == "-" || file.starts_with("/dev/");
  const fs::path folder = is_stream ? fs::path() : fs::absolute(file, error).lexically_normal().parent_path();
  const fs::path near = is_stream || error ? fs::path() : whole.lexically_relative(folder);
  const bool is_near = !near.empty() && *near.begin() != "..";
  return is_near ? near.string() : whole.string();
}

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// A pixel's class depends on one number (and its alpha), so classes are looked up in a table, made once. Of Nav2 the
// number is the grey of 8 bits that GraphicsMagick makes of the pixel, which Nav2's map_io looks at alone: the luma,
// rounded to 16 bits and then down to 8 (n / 257). Of ROS 1 it is the sum of the colours, for their mean: at
// most 4 x 65535 + 1 entries.
#include "scenes/files/ros_map_io.hpp"

#include <fmt/format.h>
#include <pwd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <string_view>
#include <vector>

#include "core/base/error.hpp"
#include "scenes/files/image_io.hpp"
#include "scenes/text/output_file_io.hpp"
#include "scenes/text/yaml_file_io.hpp"

namespace warren {
namespace {

enum class Mode : std::uint8_t { trinary, scale, raw };
enum class Class : std::uint8_t { free, occupied, unknown, between };

struct Description {
  std::string image;
  double resolution = 1.0;
  std::array<double, 3> origin{};
  double occupied_thresh = 0.0;
  double free_thresh = 0.0;
  bool negate = false;
  Mode mode = Mode::trinary;
};

/// Reads the keys; each error names file, line and what was expected.
class DescriptionReader {
 public:
  DescriptionReader(const InputFile& yaml, const Execution& execution)
      : name_(yaml.name()), yaml_(yaml, "a map server's YAML", 1, execution), root_(yaml_.root()) {}

  Description read() const {
    Description d;
    d.image = converted<std::string>(needed("image"), "image", "the name of an image");
    if (d.image.empty()) fail(root_["image"], "`image` must be the name of an image");
    d.resolution = positive("resolution");
    d.origin = origin();
    d.occupied_thresh = fraction("occupied_thresh");
    d.free_thresh = fraction("free_thresh");
    d.negate = negate();
    d.mode = mode();
    return d;
  }

 private:
  [[noreturn]] void fail(const YAML::Node& node, std::string_view what) const { yaml_.fail(node, what); }
  YAML::Node needed(const char* key) const {
    const YAML::Node node = root_[key];
    if (!node) throw InputError(name_, fmt::format("the key `{}` is missing: a map server needs it", key));
    return node;
  }
  double number(const YAML::Node& node, const char* key, std::string_view expected) const {
    return yaml_.number(node, key, expected);
  }
  template <class T>
  T converted(const YAML::Node& node, const char* key, std::string_view expected) const {
    try {
      return node.as<T>();
    } catch (const YAML::Exception&) {
      fail(node, fmt::format("`{}` must be {}", key, expected));
    }
  }
  double positive(const char* key) const {
    const double value = number(needed(key), key, "a number above 0");
    if (!(value > smallest_coordinate && value < largest_coordinate)) {
      fail(root_[key], fmt::format("`{}` must be a number above 0", key));
    }
    return value;
  }
  double fraction(const char* key) const {
    const double value = number(needed(key), key, "a number from 0 to 1");
    if (!(value >= 0.0 && value <= 1.0)) fail(root_[key], fmt::format("`{}` must be a number from 0 to 1", key));
    return value;
  }
  std::array<double, 3> origin() const {
    constexpr std::string_view expected = "three numbers, [x, y, yaw]";
    const YAML::Node node = needed("origin");
    if (!node.IsSequence() || node.size() != 3) fail(node, fmt::format("`origin` must be {}", expected));
    std::array<double, 3> numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i] = number(node[i], "origin", expected);
      if (!(std::abs(numbers[i]) <= largest_coordinate)) fail(node[i], fmt::format("`origin` must be {}", expected));
    }
    return numbers;
  }
  bool negate() const {
    const YAML::Node node = needed("negate");
    const std::string text = node.IsScalar() ? node.Scalar() : "";
    if (text == "0") return false;
    if (text == "1") return true;
    return converted<bool>(node, "negate", "0 or 1");
  }
  Mode mode() const {
    const YAML::Node node = root_["mode"];
    if (!node) return Mode::trinary;
    auto text = converted<std::string>(node, "mode", "trinary, scale or raw");
    for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    if (text == "trinary") return Mode::trinary;
    if (text == "scale") return Mode::scale;
    if (text == "raw") return Mode::raw;
    fail(node, "`mode` must be trinary, scale or raw");
  }

  const std::string& name_;
  YamlFile yaml_;
  const YAML::Node& root_;
};

/// What a pixel of brightness 0 … 1 is, its alpha apart.
Class class_of(double brightness, const Description& d, MapServerRules rules) {
  const bool ros1 = rules == MapServerRules::ros1;
  if (d.mode == Mode::raw) {
    const double value = 255.0 * (d.negate && ros1 ? 1.0 - brightness : brightness);
    constexpr double occupied = 100.0;
    const double whole = ros1 ? std::floor(value) : std::round(value);
    if (whole > occupied) return Class::unknown;
    return whole == 0.0 ? Class::free : whole == occupied ? Class::occupied : Class::between;
  }
  const double p = d.negate ? brightness : 1.0 - brightness;
  if (!ros1 && p <= d.free_thresh) return Class::free;  // applied last there, so it wins
  if (ros1 ? p > d.occupied_thresh : p >= d.occupied_thresh) return Class::occupied;
  if (p < d.free_thresh) return Class::free;
  if (d.mode == Mode::trinary) return Class::unknown;
  const double ratio = (p - d.free_thresh) / (d.occupied_thresh - d.free_thresh);
  const double value = ros1 ? std::floor(1.0 + 98.0 * ratio) : std::round(100.0 * ratio);
  return value <= 0.0 ? Class::free : value >= 100.0 ? Class::occupied : Class::between;
}

/// Takes pixels and fills in the map.
class Classifier {
 public:
  Classifier(const Description& description, MapServerRules rules, OccupancyMap& map)
      : description_(description), rules_(rules), map_(map) {}

  void begin(const ImageHeader& header, const Execution& execution) {
    header_ = header;
    const bool alpha_is_colour = rules_ == MapServerRules::ros1 && description_.mode == Mode::trinary;
    colours_ = header.channels - (header.has_alpha() && !alpha_is_colour ? 1 : 0);
    const bool looks_at_alpha =
        rules_ == MapServerRules::nav2 ? description_.mode != Mode::raw : description_.mode == Mode::scale;
    judges_alpha_ = header.has_alpha() && looks_at_alpha;
    const bool by_luma = rules_ == MapServerRules::nav2 && colours_ > 1;
    const std::size_t brightest = by_luma ? 255 : std::size_t{colours_} * header.maximum;
    classes_.resize(brightest + 1);
    for (std::size_t i = 0; i <= brightest; ++i) {
      double brightness = static_cast<double>(i) / static_cast<double>(brightest);
      if (rules_ == MapServerRules::nav2) brightness = high_byte((i * 65535 + brightest / 2) / brightest) / 255.0;
      classes_[i] = class_of(brightness, description_, rules_);
    }
    map_.blocked = cell_bitmap(header.width, header.height, execution);
    map_.unknown = cell_bitmap(header.width, header.height, execution);
  }

  void row(const PixelRun& run) {
    const std::uint32_t y = header_.height - 1 - run.y;
    std::uint32_t x = run.first_x;
    for (const std::uint16_t* pixel = run.samples.data(); pixel != run.samples.data() + run.samples.size();
         pixel += header_.channels, x += run.step_x) {
      const Class kind = class_at(pixel);
      ++counts_[static_cast<std::size_t>(kind)];
      if (kind == Class::free) {
        map_.grey_free += is_saved_unknown(pixel) ? 1 : 0;
        continue;
      }
      map_.blocked.set(x, y);
      if (kind == Class::unknown) map_.unknown.set(x, y);
    }
  }

  void end() {
    map_.free = counts_[static_cast<std::size_t>(Class::free)];
    map_.occupied = counts_[static_cast<std::size_t>(Class::occupied)];
    map_.unknown_count = counts_[static_cast<std::size_t>(Class::unknown)];
    map_.between = counts_[static_cast<std::size_t>(Class::between)];
    if (map_.unknown_count == 0) map_.unknown = Bitmap();
  }

 private:
  /// As map_saver writes what it does not know.
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
  Class class_at(const std::uint16_t* pixel) const {
    const Class kind = classes_[number_of(pixel)];
    if (!judges_alpha_) return kind;
    const unsigned alpha = pixel[header_.channels - 1];
    if (rules_ == MapServerRules::nav2) return alpha < header_.maximum ? Class::unknown : kind;
    return alpha == 0 && kind == Class::between ? Class::unknown : kind;
  }

  const Description& description_;
  MapServerRules rules_;
  OccupancyMap& map_;
  ImageHeader header_;
  unsigned colours_ = 1;
  bool judges_alpha_ = false;
  std::vector<Class> classes_;
  std::array<std::uint64_t, 4> counts_{};
};

std::string image_path(const std::string& yaml, const std::string& image) {
  if (image.starts_with("/")) return image;
  if (image.starts_with("~/")) {
    const passwd* user = ::getpwuid(::getuid());
    return (user == nullptr ? std::string{} : std::string{user->pw_dir}) + image.substr(1);
  }
  const std::size_t slash = yaml.rfind('/');
  return slash == std::string::npos ? image : yaml.substr(0, slash + 1) + image;
}

void read_pixels(const std::string& yaml, const Description& description, MapServerRules rules, OccupancyMap& map,
                 const Execution& execution) {
  const std::string path = image_path(yaml, description.image);
  map.image = path;
  Classifier classifier(description, rules, map);
  const ImageSink sink{[&](const ImageHeader& header) { classifier.begin(header, execution); },
                       [&](const PixelRun& run) { classifier.row(run); }};
  std::optional<InputFile> image;
  try {
    image.emplace(path, execution);
  } catch (const ReadError& error) {
    throw ReadError(fmt::format("{}, the image of {}", path, yaml),
                    std::string_view(error.what()).substr(std::string_view(error.what()).rfind(": ") + 2));
  }
  read_image(*image, sink, execution);
  classifier.end();
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
  const Description description = DescriptionReader(yaml, execution).read();
  if (description.mode != Mode::raw && description.free_thresh > description.occupied_thresh) {
    throw InputError(yaml.name(), "`free_thresh` must not be above `occupied_thresh`",
                     fmt::format("{} > {}", description.free_thresh, description.occupied_thresh));
  }
  OccupancyMap map;
  map.format = MapFormat::ros;
  map.source = yaml.name();
  map.cell = description.resolution;
  map.origin = {description.origin[0], description.origin[1]};
  map.yaw_rad = description.origin[2];
  read_pixels(yaml.name(), description, rules, map, execution);
  return map;
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

}  // namespace warren

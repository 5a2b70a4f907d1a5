// SPDX-License-Identifier: BSD-3-Clause
#include "scenes/text/scene_text.hpp"

#include <fmt/format.h>

#include <limits>
#include <tuple>

#include "core/base/error.hpp"
#include "core/base/printable.hpp"
#include "core/base/types.hpp"
#include "parallel/asked_memory.hpp"
#include "scenes/scene/plane_obstacles.hpp"
#include "scenes/text/human_units.hpp"

namespace warren::scene_text {

std::string Place::text() const { return line == 0 ? file : fmt::format("{}:{}", file, line); }

void Place::fail(std::string_view what, std::string_view found) const {
  constexpr std::size_t longest = 40;
  throw InputError(text(), what, printable(found, longest));
}

std::string_view Fields::word() {
  const char* begin = at_;
  skip_while([](char c) { return !is_blank(c) && c != '#'; });
  const std::string_view field(begin, static_cast<std::size_t>(at_ - begin));
  skip_blanks();
  return field;
}

double Fields::number() {
  const char* begin = at_;
  double value = 0.0;
  const char* digits = without_plus({at_, static_cast<std::size_t>(end_ - at_)}).data();
  const char* limit = at_ + std::min(longest_run, end_ - at_);
  const auto [last, error] = std::from_chars(digits, limit, value);
  if (error == std::errc() && std::abs(value) <= largest_coordinate &&
      (last == end_ || is_blank(*last) || *last == '#')) {
    at_ = last;
    skip_blanks();
    return std::abs(value) < smallest_coordinate ? 0.0 : value;
  }
  const std::string_view field = word();
  if (field.empty()) place_.fail("a number is missing");
  if (last == limit && last != begin + field.size()) {
    place_.fail("expected numbers of at most 65536 characters", field);
  }
  if (last != begin + field.size() || error == std::errc::invalid_argument) place_.fail("expected a number", field);
  if (error == std::errc::result_out_of_range && rounds_to_zero(field)) return 0.0;
  if (error == std::errc() && !std::isfinite(value)) place_.fail("numbers must be finite", field);
  place_.fail("numbers must not exceed 1e60 in magnitude", field);
}

bool rounds_to_zero(std::string_view number) {
  constexpr double beyond_all = 1e9;  // more than a number has digits
  const std::size_t end = std::min(number.find_first_of("eE"), number.size());
  const std::size_t point = std::min(number.find('.'), end);
  const std::string_view power = without_plus(number.substr(std::min(end + 1, number.size())));
  const double otherwise = power.empty() ? 0.0 : power.starts_with('-') ? -beyond_all : beyond_all;
  const double exponent = number_in_full<double>(power).value_or(otherwise);
  return static_cast<double>(point) + exponent < static_cast<double>(number.find_first_of("123456789"));
}

void read_numbers(Fields& fields, std::vector<double>& numbers, const Execution& execution) {
  while (!fields.done()) {
    push_asked(numbers, fields.number(), execution);
    execution.poll(numbers.size());
  }
}

std::string numbers_text(std::size_t count) { return fmt::format("{} number{}", count, count == 1 ? "" : "s"); }

std::vector<Vec2> points_of(std::span<const double> numbers, const Execution& execution) {
  execution.reserve(numbers.size() * sizeof(double));
  std::vector<Vec2> points;
  points.reserve(numbers.size() / 2);
  for (std::size_t i = 0; i < numbers.size(); i += 2) points.push_back({numbers[i], numbers[i + 1]});
  return points;
}

std::string_view nearest_word(std::string_view written, std::span<const std::string_view> known) {
  constexpr std::size_t longest_word = 32;
  if (written.size() > longest_word) return {};
  const auto distance = [&](std::string_view word) { return edit_distance(written, word); };
  const std::string_view best = *std::ranges::min_element(known, {}, distance);
  return distance(best) <= std::max<std::size_t>(2, written.size() / 2) ? best : std::string_view();
}

}  // namespace warren::scene_text

namespace warren {
namespace {

using scene_text::Fields;

/// What the readers of a line's words share: how they refuse it, and its numbers.
class LineReader {
 public:
  /// usage: what is expected of such a line.
  LineReader(std::string_view usage, Fields& fields, const Execution& execution)
      : usage_(usage), fields_(fields), execution_(execution) {}

  static bool is_option(const Fields& fields) { return fields.place().line == 0; }
  [[noreturn]] void refuse_usage(std::string_view found) const {
    fields_.place().fail(fmt::format("expected `{}`", usage_), found);
  }
  std::vector<double> numbers(std::size_t least, std::size_t most) {
    std::vector<double> read;
    scene_text::read_numbers(fields_, read, execution_);
    if (read.size() < least || read.size() > most) refuse_usage(scene_text::numbers_text(read.size()));
    return read;
  }
  /// what: the numbers are.
  std::vector<Vec2> corners(std::string_view what) {
    const std::vector<double> n = numbers(6, std::numeric_limits<std::size_t>::max());
    if (n.size() % 2 != 0) refuse_usage(fmt::format("{} {}", n.size(), what));
    return scene_text::points_of(n, execution_);
  }

 protected:
  std::string_view usage_;
  Fields& fields_;
  const Execution& execution_;
};

class RobotReader : LineReader {
 public:
  RobotReader(Fields& fields, const Execution& execution)
      : LineReader(is_option(fields) ? robot_option : robot_usage, fields, execution) {}

  RobotSpec read() {
    const std::string_view word = fields_.word();
    const auto kind = enum_named<RobotKind>(word);
    if (!kind) refuse_usage(word.empty() ? "nothing" : word);
    RobotSpec robot{.kind = *kind};
    if (kind == RobotKind::car || kind == RobotKind::urdf) {
      usage_ = kind == RobotKind::car ? car_usage : urdf_usage;
      if (is_option(fields_)) usage_.remove_prefix(usage_.find(' ') + 1);  // options take a line without its first word
    }
    if (kind == RobotKind::point) {
      numbers(0, 0);
    } else if (kind == RobotKind::disc) {
      robot.radius = not_negative("R", numbers(1, 1)[0]);
    } else if (kind == RobotKind::polygon) {
      robot.outline = corners("numbers");
    } else if (kind == RobotKind::urdf) {
      robot.files = urdf_files();
    } else {
      if (kind == RobotKind::arm) robot.table = fields_.word();
      if (kind == RobotKind::arm && robot.table.empty()) refuse_usage("no file");
      read_words(robot);
    }
    if (!robot.outline.empty()) check_body(robot.outline, fields_.place().text(), execution_);
    return robot;
  }

 private:
  [[noreturn]] void refuse(std::string_view what, double value) const {
    fields_.place().fail(fmt::format("`robot`: {}", what), fmt::format("{}", value));
  }
  bool has(std::string_view name) const { return std::ranges::find(seen_, name) != seen_.end(); }
  double not_negative(std::string_view name, double value) const {
    if (!(value >= 0.0)) refuse(fmt::format("{} must be at least 0", name), value);
    return value;
  }

  std::vector<Vec2> car_corners() {
    std::vector<Vec2> points;
    while (fields_.number_follows()) {
      const double x = fields_.number();
      if (!fields_.number_follows()) refuse_usage("an x without its y");
      push_asked(points, {x, fields_.number()}, execution_);
      execution_.poll(points.size());
    }
    if (points.size() < 3) refuse_usage(counted(points.size(), "corner", "corners"));
    return points;
  }
  /// Those of a car, puma560 or arm in any order, each once.
  void read_words(RobotSpec& robot) {
    const bool is_car = robot.kind == RobotKind::car;
    while (!fields_.done()) {
      const std::string_view name = fields_.word();
      if (has(name)) refuse_usage(name);
      seen_.push_back(name);
      if (name == "radius") {
        robot.radius = not_negative(name, fields_.number());
      } else if (is_car && name == "polygon") {
        robot.outline = car_corners();
      } else if (is_car && name == "turning") {
        robot.turning_radius = fields_.number();
        if (!(robot.turning_radius > 0.0)) refuse("turning must be greater than 0", robot.turning_radius);
      } else if (is_car && name == "steering") {
        const std::string_view which = fields_.word();
        const auto steering = enum_named<SteeringKind>(which);
        if (!steering) refuse_usage(which.empty() ? "no steering" : which);
        robot.steering = *steering;
      } else if (!is_car && name == "tool") {
        robot.tool = not_negative(name, fields_.number());
      } else if (!is_car && name == "self-collision") {
        robot.self_collision = true;
      } else if (robot.kind == RobotKind::puma560 && name == "limits") {
        const std::string_view which = fields_.word();
        if (which != "classic" && which != "symmetric") refuse_usage(which.empty() ? "nothing" : which);
        robot.limits = which;
      } else {
        refuse_usage(name);
      }
    }
    const bool has_radius = has("radius");
    if (has_radius == (is_car && has("polygon"))) refuse_usage(has_radius ? "radius and polygon" : "no radius");
    if (is_car && !has("turning")) refuse_usage("no turning radius");
  }

  std::string urdf_word(std::string_view before) {
    const std::string_view word = fields_.word();
    if (word.empty()) refuse_usage(fmt::format("nothing behind {}", before));
    return std::string{word};
  }
  /// Its words in any order, each once but package-path, hold and allow.
  ArmFiles urdf_files() {
    ArmFiles files{urdf_word("urdf")};
    while (!fields_.done()) {
      const std::string name(fields_.word());
      std::string* const once = name == "srdf"    ? &files.srdf
                                : name == "group" ? &files.group
                                : name == "base"  ? &files.base
                                : name == "tip"   ? &files.tip
                                : name == "tool"  ? &files.tool
                                                  : nullptr;
      if (once != nullptr && once->empty()) {
        *once = urdf_word(name);
      } else if (name == "package-path") {
        files.packages.push_back(urdf_word(name));
      } else if (name == "base-pose" && !files.base_pose) {
        read_base_pose(fields_, files);
      } else if (name == "hold") {
        read_hold(fields_, files);
      } else if (name == "allow") {
        read_allow(fields_, files);
      } else {
        refuse_usage(name);
      }
      execution_.check();
    }
    if (files.base.empty() != files.tip.empty())
      refuse_usage(files.base.empty() ? "tip without base" : "base without tip");
    if (!files.group.empty() && !files.base.empty()) refuse_usage("group and base");
    if (!files.group.empty() && files.srdf.empty()) refuse_usage("group without srdf");
    return files;
  }

  std::vector<std::string_view> seen_;  // words of the line that stand in it once
};

// A file's name is one word: blanks, commas, # and \ in it stand as \xHH.

std::string word_of_file(std::string_view file) {
  std::string word;
  for (const char c : file) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = byte > 0x20 && byte != 0x7f && c != ',' && c != '#' && c != '\\';
    word += is_plain ? std::string(1, c) : fmt::format("\\x{:02x}", byte);
  }
  return word;
}

std::string file_of_word(std::string_view word) {
  std::string file;
  for (std::size_t i = 0; i < word.size(); ++i) {
    unsigned byte = 0;
    const std::string_view digits = word.substr(i).starts_with("\\x") ? word.substr(i + 2, 2) : "";
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), byte, 16);
    const bool is_byte = error == std::errc{} && digits.size() == 2 && end == digits.data() + 2;
    file += is_byte ? static_cast<char>(byte) : word[i];
    if (is_byte) i += 3;
  }
  return file;
}

std::string digits_of(double x) { return fmt::format("{}", x + 0.0); }  // no negative zeros

std::string corners_text(const std::vector<Vec2>& corners) {
  std::string text;
  for (const Vec2 p : corners) text += fmt::format(" {} {}", digits_of(p.x), digits_of(p.y));
  return text;
}

std::string mask_text(const PriceMask& mask, const std::string& file) {
  const std::string text = "mask " + word_of_file(file);
  const std::string factor = mask.factor ? ' ' + digits_of(*mask.factor) : "";
  if (mask.kind == MaskKind::areas) return text + " areas" + factor;
  if (mask.kind == MaskKind::keep_out) return text + " keep-out" + factor;
  return fmt::format("{} speed {} {}", text, digits_of(mask.base), digits_of(mask.multiplier));
}

constexpr std::size_t bytes_a_look = std::size_t{1} << 18;

}  // namespace

void read_base_pose(Fields& fields, ArmFiles& files) {
  std::array<double, 7> pose{};
  for (double& x : pose) {
    if (!fields.number_follows())
      fields.place().fail("expected `base-pose X Y Z QX QY QZ QW`", fields.done() ? "too few numbers" : fields.word());
    x = fields.number();
  }
  if (std::all_of(pose.begin() + 3, pose.end(), [](double x) { return x == 0.0; }))
    fields.place().fail("`base-pose`: the quaternion QX QY QZ QW must not be 0 0 0 0");
  files.base_pose = pose;
}

void read_hold(Fields& fields, ArmFiles& files) {
  std::string joint(fields.word());
  if (fields.done()) fields.place().fail("expected `hold JOINT VALUE`", joint.empty() ? "too few words" : "0 numbers");
  const double value = fields.number();
  for (auto& [name, held] : files.held) {
    if (name == joint) fields.place().fail("`hold`: this joint is held already", joint);
  }
  files.held.emplace_back(std::move(joint), value);
}

void note_link(ArmFiles& files, const std::string& link, const scene_text::Place& place) {
  constexpr std::size_t most_noted = 8192;
  if (files.said.size() < most_noted) files.said.emplace_back(link, place.text());
}

void read_allow(Fields& fields, ArmFiles& files) {
  std::array<std::string, 2> links;
  for (std::string& link : links) link = fields.word();
  if (links[1].empty()) fields.place().fail("expected `allow LINK LINK`", "too few words");
  for (const std::string& link : links) note_link(files, link, fields.place());
  files.allowed.push_back(std::move(links));
}

RobotSpec read_robot(Fields& fields, const Execution& execution) { return RobotReader(fields, execution).read(); }

TextLines::TextLines(const InputFile& file, const Execution& execution) : file_(file), execution_(execution) {
  if (execution.progress != nullptr) execution.progress->begin("read", file.bytes().size());
  at_ = file.bytes().size() - without_byte_order_mark(file.bytes()).size();
}

bool TextLines::next() {
  const std::string_view all = file_.bytes();
  if (at_ >= all.size()) return false;
  if (at_ - forgotten_ >= bytes_a_look) look();
  const std::size_t end = std::min(all.find('\n', at_), all.size());
  line_ = all.substr(at_, end - at_);
  at_ = end + 1;
  ++number_;
  return true;
}

void TextLines::look() {
  constexpr std::size_t small_blocks_a_byte = 32;
  execution_.reserve(std::min(bytes_a_look, file_.bytes().size() - at_) * small_blocks_a_byte);
  execution_.advance(at_ - forgotten_);
  file_.forget(forgotten_, at_);
  forgotten_ = at_;
}

void read_price(const PriceWord& word, Fields& fields, Prices& prices, const Execution& execution) {
  const bool is_option = LineReader::is_option(fields);  // then the line is without its word
  LineReader line(word.usage.substr(is_option ? word.name.size() + 1 : 0), fields, execution);
  const auto check = [&](bool holds, std::string_view what, double value) {
    if (holds) return;
    fields.place().fail(is_option ? std::string(what) : fmt::format("`{}`: {}", word.name, what),
                        fmt::format("{}", value));
  };
  const auto factor_of = [&](double factor) {
    check(factor >= 1.0 && factor <= largest_price, fmt::format("F must be from 1 to {}", largest_price), factor);
    return factor;
  };
  const auto checked_corners = [&] {
    std::vector<Vec2> points = line.corners("coordinates");
    check_body(points, fields.place().text(), execution);
    return points;
  };
  if (word.name == "clearance-price") {
    const std::vector<double> n = line.numbers(1, 2);
    check(n[0] >= 0.0 && n[0] <= largest_price, fmt::format("P must be from 0 to {}", largest_price), n[0]);
    if (n.size() == 2) check(n[1] > 0.0, "D must be greater than 0", n[1]);
    prices.clearance = {n[0], n.size() == 2 ? std::optional(n[1]) : std::nullopt};
  } else if (word.name == "area") {
    if (!fields.number_follows()) line.refuse_usage(fields.done() ? "nothing" : fields.word());
    const double factor = factor_of(fields.number());
    push_asked(prices.areas, {factor, checked_corners(), fields.place().line}, execution);
  } else if (word.name == "keep-out") {
    push_asked(prices.keep_out, {checked_corners(), fields.place().line}, execution);
  } else if (word.name == "unknown") {
    prices.unknown = factor_of(line.numbers(1, 1)[0]);
  } else {
    PriceMask mask;
    mask.file = file_of_word(fields.word());
    const std::string_view kind = fields.word();
    if (mask.file.empty() || kind.empty()) line.refuse_usage("too few words");
    if (kind == "areas") {
      mask.factor = factor_of(line.numbers(1, 1)[0]);
    } else if (kind == "keep-out") {
      mask.kind = MaskKind::keep_out;
      if (const std::vector<double> n = line.numbers(0, 1); !n.empty()) mask.factor = factor_of(n[0]);
    } else if (kind == "speed") {
      constexpr double largest_of_speed = 1e6;
      mask.kind = MaskKind::speed;
      const std::vector<double> n = line.numbers(0, 2);
      if (n.size() == 1) line.refuse_usage("1 number");
      if (n.size() == 2) std::tie(mask.base, mask.multiplier) = std::pair(n[0], n[1]);
      for (const double x : n) check(std::abs(x) <= largest_of_speed, "BASE and MULTIPLIER are at most 1e6", x);
    } else {
      line.refuse_usage(kind);
    }
    push_asked(prices.masks, std::move(mask), execution);
  }
}

void read_price_line(std::string_view line, const std::string& where, Prices& prices, const Execution& execution) {
  Fields fields(line, {where, 0});
  const std::string_view name = fields.word();
  const auto word = std::ranges::find(price_line_words, name, &PriceWord::name);
  if (word == price_line_words.end())
    scene_text::Place{where, 0}.fail("expected lines of a scene's prices, such as 'clearance-price 3 0.5'", line);
  read_price(*word, fields, prices, execution);
}

std::vector<std::string> price_lines(const Prices& prices,
                                     const std::function<std::string(const std::string&)>& name_of_file) {
  std::vector<std::string> lines;
  if (const auto& clearance = prices.clearance) {
    const std::string reach = clearance->reach ? ' ' + digits_of(*clearance->reach) : "";
    lines.push_back(fmt::format("clearance-price {}{}", digits_of(clearance->price), reach));
  }
  for (const PricedArea& area : prices.areas)
    lines.push_back(fmt::format("area {}{}", digits_of(area.factor), corners_text(area.corners)));
  for (const PriceMask& mask : prices.masks) lines.push_back(mask_text(mask, name_of_file(mask.file)));
  for (const ScenePolygon& area : prices.keep_out) lines.push_back("keep-out" + corners_text(area.corners));
  if (prices.opens_unknown()) lines.push_back("unknown " + digits_of(*prices.unknown));
  return lines;
}

}  // namespace warren

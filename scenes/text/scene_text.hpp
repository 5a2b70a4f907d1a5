// SPDX-License-Identifier: BSD-3-Clause
// The words of one line of a scene file: fields between blanks or commas up to a `#`, numbers as the C locale writes
// them, and errors that name file and line. Numbers that are not finite or beyond largest_coordinate are refused,
// numbers nearer to zero than smallest_coordinate are zero. Robots, prices and forbidden areas as such words: the same
// lines in a scene, on a command line and in an answer.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <functional>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "core/plane/wall_set.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/prices.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren::scene_text {

/// Where an error is: "file:line"; line 0 is no line: an option, a key.
struct Place {
  const std::string& file;
  std::size_t line;
  std::string text() const;
  /// Throws InputError; `found` is shortened and made printable.
  [[noreturn]] void fail(std::string_view what, std::string_view found = {}) const;
};

/// Without a plus at its begin, which std::from_chars takes for no number; of "+-1" it stays.
inline std::string_view without_plus(std::string_view number) {
  if (number.size() > 1 && number[0] == '+' && number[1] != '-') number.remove_prefix(1);
  return number;
}

/// Of a number that no double holds: is it too near to zero, not too large?
bool rounds_to_zero(std::string_view number);

/// The number that a text is, all of it; nothing where it is none, or too large for a T. 0: it is nearer to zero than
/// any other T.
template <class T>
std::optional<T> number_in_full(std::string_view text) {
  T value{};
  const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (last != text.data() + text.size()) return std::nullopt;
  if (error == std::errc::result_out_of_range && rounds_to_zero(text)) return T{};
  return error == std::errc() ? std::optional(value) : std::nullopt;
}

inline bool is_blank(char c) { return c == ' ' || c == ',' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

/// May it stand in a line as one field?
inline bool is_word(std::string_view text) {
  const auto parts = [](unsigned char c) { return c <= ' ' || c == ',' || c == '#'; };
  return !text.empty() && std::none_of(text.begin(), text.end(), parts);
}

/// Walks over the fields of one line. With an execution, runs of blanks or letters look at the deadline every 64 KiB.
class Fields {
 public:
  Fields(std::string_view line, Place place, const Execution* execution = nullptr)
      : at_(line.data()), end_(line.data() + line.size()), place_(place), execution_(execution) {
    skip_blanks();
  }
  bool done() const { return at_ == end_; }
  /// Does a number come next, by its first character?
  bool number_follows() const {
    return !done() && ((*at_ >= '0' && *at_ <= '9') || *at_ == '-' || *at_ == '+' || *at_ == '.');
  }
  /// The next field as it stands; empty at the end.
  std::string_view word();
  /// The next field as a number. Throws InputError if it is none, or longer than 65,536 characters.
  double number();
  const Place& place() const { return place_; }

 private:
  static constexpr std::ptrdiff_t longest_run = 1 << 16;  // of letters without a look, and of a number's

  template <class Wanted>
  void skip_while(const Wanted& wanted) {
    const char* look = at_ + std::min(longest_run, end_ - at_);
    while (at_ != end_ && wanted(*at_)) {
      if (++at_ != look || look == end_) continue;
      if (execution_ != nullptr) execution_->check();
      look += std::min(longest_run, end_ - at_);
    }
  }
  void skip_blanks() {
    skip_while(is_blank);
    if (at_ != end_ && *at_ == '#') at_ = end_;
  }

  const char* at_;
  const char* end_;
  Place place_;
  const Execution* execution_;
};

/// The numbers that are left in the line, behind those that are there. Throws as Fields::number(), Stopped.
void read_numbers(Fields& fields, std::vector<double>& numbers, const Execution& execution);
/// "1 number", "4 numbers".
std::string numbers_text(std::size_t count);
/// Of x and y, one after the other. Throws Stopped.
std::vector<Vec2> points_of(std::span<const double> numbers, const Execution& execution);

/// The known word that is nearest to what was written, by edit distance; empty if none is near.
std::string_view nearest_word(std::string_view written, std::span<const std::string_view> known);

}  // namespace warren::scene_text

namespace warren {
// The body of a `robot` line, read: the same words in a scene, on a command line and in an answer.

inline constexpr std::string_view robot_usage =
    "robot point|disc R|polygon X Y X Y X Y ...|car radius R turning RHO|"
    "puma560 radius R [tool T] [limits classic|symmetric] [self-collision]|arm FILE radius R [tool T] [self-collision]|"
    "urdf FILE [srdf FILE] [group NAME] ...";
inline constexpr std::string_view urdf_usage =
    "robot urdf FILE [srdf FILE] [group NAME | base LINK tip LINK] [tool LINK] [package-path DIR] ... "
    "[base-pose X Y Z QX QY QZ QW] [hold JOINT VALUE] ... [allow LINK LINK] ...";
inline constexpr std::string_view car_usage =
    "robot car radius R|polygon X Y X Y X Y ... turning RHO [steering dubins|reeds-shepp|differential]";

/// The same as options take it.
inline constexpr std::string_view robot_option =
    "point, disc R, [[X, Y], [X, Y], [X, Y], ...], polygon X Y X Y X Y ..., car radius R turning RHO, "
    "car polygon X Y X Y X Y ... turning RHO, puma560 radius R, arm FILE radius R or "
    "urdf FILE [srdf FILE] [group NAME]";

/// Reads what follows `base-pose`, `hold` or `allow`, one of them, to the end of these words. Throws InputError.
void read_base_pose(scene_text::Fields& fields, ArmFiles& files);
void read_hold(scene_text::Fields& fields, ArmFiles& files);
void read_allow(scene_text::Fields& fields, ArmFiles& files);

/// Notes that a line names a link, which the robot must have: of the first few thousand of them.
void note_link(ArmFiles& files, const std::string& link, const scene_text::Place& place);

/// Reads what follows the word `robot`, to the line's end. Throws InputError naming the fields' place, Stopped.
RobotSpec read_robot(scene_text::Fields& fields, const Execution& execution);

/// The lines of a text file, one after the other: the deadline is looked at and the memory for what follows is asked
/// for every 256 KiB, and the pages behind are given back. Lines may be as long as the file; what is in them polls by
/// itself.
class TextLines {
 public:
  /// Begins before the first line, behind a byte order mark. Both must outlive it.
  TextLines(const InputFile& file, const Execution& execution);

  /// Goes to the next line; false if there is none. Throws Stopped.
  bool next();
  /// Without its end, "\n"; a "\r" before it is still there.
  std::string_view line() const { return line_; }
  /// 1 for the first line; 0 before it.
  std::size_t number() const { return number_; }
  scene_text::Place place() const { return {file_.name(), number_}; }
  /// The words of this line.
  scene_text::Fields fields() const { return {line_, place(), &execution_}; }

 private:
  void look();

  const InputFile& file_;
  const Execution& execution_;
  std::string_view line_;
  std::size_t number_ = 0;
  std::size_t at_ = 0;         // where the next line begins
  std::size_t forgotten_ = 0;  // what lies before was given back
};

/// Collects walls one by one when their number is not known: packed until the first that doesn't fit, as floats until
/// the first that no float holds, as doubles from then on. Growing asks for memory first.
class WallCollector {
 public:
  explicit WallCollector(const Execution& execution) : execution_(execution) {}

  void add(double x1, double y1, double x2, double y2) {
    if (auto* packed = std::get_if<RawVector<PackedWall>>(&walls_)) {
      if (PackedWall::fits(x1, y1, x2, y2)) return push(*packed, PackedWall::of(x1, y1, x2, y2));
      widen<float>(*packed);
    }
    if (auto* floats = std::get_if<RawVector<FloatWall>>(&walls_)) {
      if (exact_as_float(x1) && exact_as_float(y1) && exact_as_float(x2) && exact_as_float(y2))
        return push(*floats, FloatWall::of(x1, y1, x2, y2));
      widen<double>(*floats);
    }
    push(std::get<RawVector<DoubleWall>>(walls_), {x1, y1, x2, y2});
  }
  /// From each point to the next.
  void add_chain(std::span<const Vec2> points) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      add(points[i - 1].x, points[i - 1].y, points[i].x, points[i].y);
    }
  }
  WallSet take() {
    return std::visit([](auto& walls) { return WallSet(std::move(walls)); }, walls_);
  }

 private:
  template <class Wall>
  void push(RawVector<Wall>& walls, const Wall& wall) {
    if (walls.size() == walls.capacity()) execution_.reserve(2 * walls.capacity() * sizeof(Wall));
    walls.push_back(wall);
  }
  /// `narrow` ends with the call.
  template <class T, class Wall>
  void widen(const RawVector<Wall>& narrow) {
    execution_.reserve(narrow.size() * sizeof(WallOf<T>));
    RawVector<WallOf<T>> wide;
    wide.reserve(narrow.size());
    std::transform(narrow.begin(), narrow.end(), std::back_inserter(wide), [](const Wall& packed) {
      const auto [x1, y1, x2, y2] = unpacked(packed);
      return WallOf<T>::of(x1, y1, x2, y2);
    });
    walls_ = std::move(wide);
  }

  const Execution& execution_;
  std::variant<RawVector<PackedWall>, RawVector<FloatWall>, RawVector<DoubleWall>> walls_;
};

/// How a line of prices begins.
struct PriceWord {
  std::string_view name;
  std::string_view usage;
  bool once;  ///< in a file
};
inline constexpr std::array<PriceWord, 5> price_line_words{
    {{"clearance-price", "clearance-price P [D]", true},
     {"area", "area F X Y X Y X Y ...", false},
     {"mask", "mask FILE areas F | mask FILE speed [BASE MULTIPLIER] | mask FILE keep-out [F]", false},
     {"keep-out", "keep-out X Y X Y X Y ...", false},
     {"unknown", "unknown F", true}}};

/// Reads what follows the word, one of these, to the line's end: areas and masks are added, others are replaced. Masks
/// are named, not read (scenes/files/plane_formats_io.hpp). Throws InputError naming the fields' place, Stopped.
void read_price(const PriceWord& word, scene_text::Fields& fields, Prices& prices, const Execution& execution);

/// Reads such a line from its word on. Throws InputError naming `where`, Stopped.
void read_price_line(std::string_view line, const std::string& where, Prices& prices, const Execution& execution);

/// A line each, which read_price reads back the same; name_of_file(file): what a mask's file is to be called.
std::vector<std::string> price_lines(
    const Prices& prices, const std::function<std::string(const std::string&)>& name_of_file = std::identity());

}  // namespace warren

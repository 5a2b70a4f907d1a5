// SPDX-License-Identifier: BSD-3-Clause
// XML as robots and meshes are described in it: elements with their lines, attributes with numbers as the C locale
// writes them. Entities are not expanded, other files are not read.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <new>
#include <optional>
#include <pugixml.hpp>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/base/trigonometry.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "scenes/scene/scene.hpp"
#include "scenes/text/input_file_io.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {

/// Takes the next number and the blanks around it, 0 for one that is nearer to zero than smallest_coordinate; false
/// where there is none, or one that is not finite or beyond largest_coordinate.
template <class Number>
bool take_number(std::string_view& text, Number& number) {
  const auto skip_blanks = [&] { text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size())); };
  skip_blanks();
  const char* digits = scene_text::without_plus(text).data();
  const auto [last, error] = std::from_chars(digits, text.data() + text.size(), number);
  const auto taken = static_cast<std::size_t>(last - text.data());
  const bool is_tiny = error == std::errc::result_out_of_range && scene_text::rounds_to_zero(text.substr(0, taken));
  text.remove_prefix(taken);
  if ((error != std::errc() && !is_tiny) ||
      (!text.empty() && std::string_view(" \t\r\n").find(text[0]) == std::string_view::npos))
    return false;
  skip_blanks();
  if constexpr (std::is_same_v<Number, double>) {
    if (is_tiny || std::abs(number) < smallest_coordinate) number = 0.0;
    return std::abs(number) <= largest_coordinate;
  }
  return true;
}

class XmlFile {
 public:
  /// Reads all of it. Throws InputError where it is no XML, its first element is not `root`, or it is larger than
  /// `most_bytes`; Stopped. The file outlives it.
  XmlFile(const InputFile& file, std::string_view root, std::size_t most_bytes, const Execution& execution)
      : file_(file) {
    const std::string_view bytes = file.bytes();
    if (bytes.size() > most_bytes) place(0).fail(fmt::format("expected XML of at most {} MiB", most_bytes >> 20U));
    constexpr std::size_t tree_bytes_a_byte = 20;  // "<a/>" takes 64
    execution.reserve(tree_bytes_a_byte * bytes.size());
    const auto result = document_.load_buffer(bytes.data(), bytes.size(), pugi::parse_default, pugi::encoding_utf8);
    execution.check();
    if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
    if (result && this->root().name() == root) return;
    place(result.offset)
        .fail(fmt::format("expected XML whose first element is <{}>", root),
              result ? this->root().name() : result.description());
  }

  const std::string& name() const { return file_.name(); }
  pugi::xml_node root() const { return document_.document_element(); }
  /// Throws InputError naming file, line and element.
  [[noreturn]] void fail(pugi::xml_node at, std::string_view what, std::string_view found = {}) const {
    place(at.offset_debug()).fail(fmt::format("<{}>: {}", std::string_view(at.name()).substr(0, 40), what), found);
  }
  /// An attribute that must be there and not be empty.
  std::string word(pugi::xml_node at, const char* attribute) const {
    const std::string value = at.attribute(attribute).value();
    if (value.empty()) fail(at, fmt::format("`{}` is missing", attribute));
    return value;
  }
  /// An attribute that must be a number, if it is there.
  std::optional<double> number(pugi::xml_node at, const char* attribute) const {
    if (!at.attribute(attribute)) return std::nullopt;
    std::string_view text = at.attribute(attribute).value();
    double value = 0.0;
    if (!take_number(text, value) || !text.empty())
      fail(at, fmt::format("`{}` must be a number", attribute), at.attribute(attribute).value());
    return value;
  }
  /// The same, which must be there, and not be negative.
  double size(pugi::xml_node at, const char* attribute) const {
    word(at, attribute);
    const double value = *number(at, attribute);
    if (value < 0.0) fail(at, fmt::format("`{}` must be at least 0", attribute), at.attribute(attribute).value());
    return value;
  }
  /// An attribute of three numbers.
  Vec3 vector(pugi::xml_node at, const char* attribute, Vec3 otherwise) const {
    if (at.attribute(attribute)) numbers(at, at.attribute(attribute).value(), {otherwise.data(), 3});
    return otherwise;
  }
  /// As many numbers as `to` holds, which are all of the text.
  void numbers(pugi::xml_node at, std::string_view text, std::span<double> to) const {
    std::string_view rest = text;
    for (double& number : to)
      if (!take_number(rest, number)) rest = "x";
    if (!rest.empty()) fail(at, fmt::format("expected {} numbers", to.size()), text);
  }

 private:
  scene_text::Place place(std::ptrdiff_t offset) const {
    const std::string_view before =
        file_.bytes().substr(0, static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, offset)));
    return {name(), 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'))};
  }

  const InputFile& file_;
  pugi::xml_document document_;
};

/// A turn by so many radians about an axis of length 1. (Products of 3 x 3 Eigen makes number by number, alike on every
/// machine.)
inline Eigen::Matrix3d turn_about(const Vec3& axis, double radians) {
  const auto [sine, cosine] = portable::sin_and_cos(radians);
  Eigen::Matrix3d cross;
  cross << 0.0, -axis.z(), axis.y(), axis.z(), 0.0, -axis.x(), -axis.y(), axis.x(), 0.0;
  const Eigen::Matrix3d outer = axis * axis.transpose();
  return cosine * Eigen::Matrix3d::Identity() + sine * cross + (1.0 - cosine) * outer;
}

}  // namespace warren

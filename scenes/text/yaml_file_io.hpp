// SPDX-License-Identifier: BSD-3-Clause
// A YAML file as a tree, and errors that name its lines. For the readers of formats that are YAML.
#pragma once

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <istream>
#include <sstream>
#include <string>
#include <string_view>

#include "core/base/error.hpp"
#include "core/base/types.hpp"
#include "core/run/execution.hpp"
#include "scenes/text/input_file_io.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {
namespace detail {

/// The text as yaml-cpp takes it, 2 KiB at a time: for each block the deadline is looked at, and the memory asked for
/// that its tree needs. For the first one that is done before the library begins: it loses what it holds where its
/// constructor, which takes that block, is left by an exception.
class PolledText : public std::stringbuf {
 public:
  PolledText(const std::string& text, const Execution& execution) : std::stringbuf(text), execution_(execution) {
    ask_for(first_block_bytes);
  }

 private:
  static constexpr std::streamsize first_block_bytes = 2048;

  void ask_for(std::streamsize bytes) const {
    constexpr std::size_t tree_bytes_a_byte = 256;  // measured: 236
    execution_.reserve(tree_bytes_a_byte * static_cast<std::size_t>(bytes));
  }
  std::streamsize xsgetn(char* to, std::streamsize count) override {
    if (!is_first_) ask_for(count);
    is_first_ = false;
    return std::stringbuf::xsgetn(to, count);
  }

  const Execution& execution_;
  bool is_first_ = true;
};

/// Of the line where what is in it begins; 0: there is none. The library reads the first document alone, as far as a
/// line that begins with `...` or `%`.
inline std::size_t line_of_second_document(std::string_view text, const Execution& execution) {
  bool has_content = false;
  bool is_second = false;
  text = without_byte_order_mark(text);
  for (std::size_t number = 1; !text.empty(); ++number) {
    execution.poll(number);
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    constexpr std::string_view blanks = " \t\r";
    const std::string_view mark = line.substr(0, 3);
    const bool is_mark =
        (mark == "---" || mark == "...") && (line.size() == 3 || blanks.find(line[3]) != std::string_view::npos);
    is_second |= has_content && (is_mark || line.starts_with('%'));
    if (line.starts_with('%')) continue;
    if (is_mark) line.remove_prefix(3);
    const std::size_t first = line.find_first_not_of(blanks);
    if (first == std::string_view::npos || line[first] == '#') continue;
    if (is_second) return number;
    has_content = true;
  }
  return 0;
}

}  // namespace detail

class YamlFile {
 public:
  /// what: "a map server's YAML". Throws InputError where the file is larger, no YAML of keys with values, or
  /// more than one document, Stopped.
  YamlFile(const InputFile& file, std::string_view what, std::size_t most_mebibytes, const Execution& execution)
      : name_(file.name()) {
    if (file.bytes().size() > most_mebibytes << 20) {
      throw InputError(name_, fmt::format("expected {} of at most {} MiB", what, most_mebibytes),
                       fmt::format("{} bytes", file.bytes().size()));
    }
    detail::PolledText text(std::string{file.bytes()}, execution);
    std::istream stream(&text);
    try {
      root_ = YAML::Load(stream);
    } catch (const YAML::Exception& error) {
      place(error.mark).fail("expected YAML: " + error.msg);
    }
    if (const std::size_t line = detail::line_of_second_document(file.bytes(), execution); line > 0)
      scene_text::Place{name_, line}.fail(fmt::format("a second document begins here: {} is one", what));
    if (!root_.IsMap()) throw InputError(name_, fmt::format("expected {}: keys with values", what));
  }

  const YAML::Node& root() const { return root_; }
  /// Of a value; empty where the node is none. Lives as long as the file.
  static std::string_view text_of(const YAML::Node& node) {
    return node.IsScalar() ? std::string_view(node.Scalar()) : std::string_view();
  }
  /// Its file and line.
  scene_text::Place place(const YAML::Node& node) const { return place(node.Mark()); }
  /// Throws InputError naming the line, and the value where the node is one.
  [[noreturn]] void fail(const YAML::Node& node, std::string_view what) const { place(node).fail(what, text_of(node)); }
  /// A number of which is_right holds; infinities and what is no number are asked, too, and 0 for what is nearer to
  /// zero than smallest_coordinate. `key` and `expected` are for the error: "`key` must be EXPECTED". (yaml-cpp's own
  /// conversion takes memory that has run out for a wrong number.)
  double number(const YAML::Node& node, std::string_view key, std::string_view expected,
                bool (*is_right)(double)) const {
    auto value = scene_text::number_in_full<double>(scene_text::without_plus(text_of(node)));
    if (value && std::abs(*value) < smallest_coordinate) value = 0.0;
    if (!value || !is_right(*value)) fail(node, fmt::format("`{}` must be {}", key, expected));
    return *value;
  }

 private:
  scene_text::Place place(const YAML::Mark& mark) const {
    return {name_, mark.is_null() ? 0 : static_cast<std::size_t>(mark.line) + 1};
  }

  std::string name_;
  YAML::Node root_;
};

}  // namespace warren

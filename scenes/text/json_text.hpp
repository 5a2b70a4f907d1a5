// SPDX-License-Identifier: BSD-3-Clause
// JSON as text, piece by piece: values, and objects whose keys keep their order. Where memory is out, each call throws
// and leaves nothing behind; a tree of values (nlohmann's) ends the program there.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/run/execution.hpp"
#include "scenes/text/input_file_io.hpp"

namespace warren {

/// A text as a JSON string, quotes included; bytes that are not UTF-8 become U+FFFD.
std::string json_string(std::string_view text);
/// A finite number as JSON, "1.0" rather than "1"; null for others. It reads back as the same double.
std::string json_number(double value);
/// The same, appended.
void append_json_number(std::string& text, double value);

inline std::string json_of(std::same_as<bool> auto value) { return value ? "true" : "false"; }
inline std::string json_of(double value) { return json_number(value); }
inline std::string json_of(std::uint64_t value) { return std::to_string(value); }
inline std::string json_of(std::uint32_t value) { return std::to_string(value); }
inline std::string json_of(std::int32_t value) { return std::to_string(value); }
inline std::string json_of(std::string_view text) { return json_string(text); }
/// null where there is none.
template <class T>
std::string json_of(const std::optional<T>& value) {
  return value ? json_of(*value) : "null";
}

/// A list of what json_of_item(item) says of each.
template <class Items, class JsonOfItem>
std::string json_list_of(const Items& items, std::string_view between, const JsonOfItem& json_of_item) {
  std::string text = "[";
  for (const auto& item : items) text.append(text.size() > 1 ? between : "").append(json_of_item(item));
  return text + "]";
}
/// "[1.0,2.0]"
template <class T>
std::string json_list(std::span<const T> values, std::string_view between = ",") {
  return json_list_of(values, between, [](const T& value) { return json_of(value); });
}
/// A list of numbers, appended.
void append_json_list(std::string& text, std::span<const double> values);

/// An object as text. Keys are plain words, each added once.
class JsonObject {
 public:
  /// `between` goes before each key but the first.
  explicit JsonObject(std::string_view between = ",", std::string_view colon = ":")
      : between_(between), colon_(colon) {}

  /// value is JSON already.
  void add_json(std::string_view name, std::string_view value) {
    text_.append(text_.size() > 1 ? between_ : "").append("\"").append(name).append("\"").append(colon_).append(value);
  }
  /// more: names and values in turns.
  template <class T, class... More>
  void add(std::string_view name, const T& value, const More&... more) {
    add_json(name, json_of(value));
    if constexpr (sizeof...(more) > 0) add(more...);
  }
  /// null where there is none.
  template <class T>
  void add_or_null(std::string_view name, bool is_there, const T& value) {
    add_json(name, is_there ? json_of(value) : "null");
  }
  /// With its closing brace.
  std::string closed() const { return text_ + "}"; }
  /// Without, for one who goes on.
  const std::string& open() const { return text_; }

 private:
  std::string between_;
  std::string colon_;
  std::string text_ = "{";
};

/// An object of names and values in turns.
template <class... Members>
std::string json_object(const Members&... members) {
  JsonObject json;
  json.add(members...);
  return json.closed();
}

/// The bytes of a JSON text as its parser takes them, one by one: lines are counted, and every 64 KiB the deadline is
/// looked at and the memory asked for that the parser may need before the next look, however long a word or a run of
/// blanks is.
class JsonBytes {
 public:
  /// Begins behind a byte order mark. Both must outlive it, and it all of its iterators.
  JsonBytes(const InputFile& file, const Execution& execution);

  /// The line of the byte that is taken next, from 1 on.
  const std::size_t& line() const { return line_; }

  class Iterator {
   public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    Iterator(const char* at, JsonBytes* bytes) : at_(at), bytes_(bytes) {}
    const char& operator*() const { return *at_; }
    /// Throws Stopped, and InputError for numbers longer than any is.
    Iterator& operator++() {
      if (*at_ == '\n') ++bytes_->line_;
      if (++at_ == bytes_->next_look_) bytes_->look();
      return *this;
    }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.at_ == b.at_; }

   private:
    const char* at_;
    JsonBytes* bytes_;
  };

  Iterator begin() { return {text_.data(), this}; }
  Iterator end() { return {text_.data() + text_.size(), this}; }

 private:
  void look();

  const InputFile& file_;
  const Execution& execution_;
  std::string_view text_;
  const char* next_look_;
  std::size_t line_ = 1;
  std::size_t without_quote_ = 0;  // bytes since the last quotation mark, or a little more
};

}  // namespace warren

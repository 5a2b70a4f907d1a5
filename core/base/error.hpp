// SPDX-License-Identifier: BSD-3-Clause
// Bad input, and files that can't be read or written. An answer ("there is no path") is an Outcome, never an exception;
// a bug is an assert. The text of each error is one line that names the place and what to do, made printable here:
// names and words of files stand in it.
#pragma once

#include <cstddef>
#include <exception>
#include <stdexcept>
#include <string>
#include <string_view>

#include "core/base/printable.hpp"

namespace warren {

/// The base of all that the library throws, but for std::bad_alloc and bugs (std::logic_error).
class Error : public std::exception {};

/// An error with its line.
class TextError : public Error {
 public:
  /// The line; unprintable bytes are escaped.
  explicit TextError(std::string_view text) : text_(printable(text)) {}
  /// The line, valid while the error lives.
  const char* what() const noexcept override { return text_.what(); }

 private:
  std::runtime_error text_;  // its copies share the text, so that they can't fail
};

/// An error that names its place: "where: wrong (found: value)".
class PlacedError : public TextError {
 public:
  /// The place, what is wrong there or what would be right, and what was found.
  PlacedError(std::string_view where, std::string_view wrong, std::string_view value = {});

  /// The place.
  std::string_view where() const noexcept { return line().substr(0, where_bytes_); }
  /// What is wrong there.
  std::string_view wrong() const noexcept { return line().substr(where_bytes_ + 2, wrong_bytes_); }
  std::string_view value() const noexcept;  ///< empty: none was given

 private:
  std::string_view line() const noexcept { return what(); }

  std::size_t where_bytes_;
  std::size_t wrong_bytes_;
};

/// Input that contradicts its format or its stated range. `where` names the place (file:line, option, parameter).
class InputError : public PlacedError {
 public:
  /// The place, what is wrong there, and what was found.
  using PlacedError::PlacedError;
};

/// An input that can't be opened or read at all.
class ReadError : public PlacedError {
 public:
  /// A file, and the system's reason.
  ReadError(std::string_view where, std::string_view why) : PlacedError(where, "can't be read: " + std::string{why}) {}
};

/// An output that can't be written; nothing half-written stays.
class WriteError : public PlacedError {
 public:
  /// A file, and the system's reason.
  WriteError(std::string_view where, std::string_view why)
      : PlacedError(where, "can't be written: " + std::string{why}) {}
};

/// A question, an option or a command line that contradicts itself, the world, or names something unknown. Where the
/// text names an option it says @option, since each caller spells it in his own way.
class UsageError : public TextError {
 public:
  /// The line, with @option for options.
  explicit UsageError(std::string_view text) : TextError(spelled(text, "", '_')), written_(std::string{text}) {}
  /// The line with "--goal-bias" for @goal_bias, or whatever prefix and hyphen are.
  std::string spelled(std::string_view prefix, char hyphen) const {
    return printable(spelled(written_.what(), prefix, hyphen));
  }

 private:
  static std::string spelled(std::string_view text, std::string_view prefix, char hyphen);

  std::runtime_error written_;
};

}  // namespace warren

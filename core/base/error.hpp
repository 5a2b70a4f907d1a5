// SPDX-License-Identifier: BSD-3-Clause
// Bad input, and files that can't be read or written. An answer ("there is no path") is an Outcome, never an exception;
// a bug is an assert. The text of each error is one line that names the place and what to do, made printable here:
// names and words of files stand in it.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "core/base/printable.hpp"

namespace warren {

/// Input that contradicts its format or its stated range. `where` names the place (file:line, option, parameter).
class InputError : public std::runtime_error {
 public:
  InputError(std::string_view where, std::string_view what, std::string_view value = {})
      : std::runtime_error(text(where, what, value)) {}

 private:
  static std::string text(std::string_view where, std::string_view what, std::string_view value) {
    std::string line{where};
    line.append(": ").append(what);
    if (!value.empty()) line.append(" (found: ").append(value).append(")");
    return printable(line);
  }
};

/// An input that can't be opened or read at all.
class ReadError : public std::runtime_error {
 public:
  ReadError(std::string_view where, std::string_view why)
      : std::runtime_error(printable(std::string{where} + ": can't be read: " + std::string{why})) {}
};

/// An output that can't be written; nothing half-written stays.
class WriteError : public std::runtime_error {
 public:
  WriteError(std::string_view where, std::string_view why)
      : std::runtime_error(printable(std::string{where} + ": can't be written: " + std::string{why})) {}
};

/// A command line that contradicts itself or names something unknown.
class UsageError : public std::runtime_error {
 public:
  explicit UsageError(std::string_view what) : std::runtime_error(printable(what)) {}
};

}  // namespace warren

// SPDX-License-Identifier: BSD-3-Clause
// The lines of a text file, one after the other: the deadline is looked at and the memory for what follows is asked for
// every 256 KiB, and the pages behind are given back. Lines may be as long as the file; what is in them polls by
// itself.
#pragma once

#include <cstddef>
#include <string_view>

#include "parallel/execution.hpp"
#include "scenes/text/input_file_io.hpp"
#include "scenes/text/scene_text.hpp"

namespace warren {

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

}  // namespace warren
